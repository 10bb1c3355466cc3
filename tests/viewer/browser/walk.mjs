// Uses the page as a person would, in a real browser, and prints one JSON line for each thing found:
// {"walk", "name", "ok", "detail"}. usage: node walk.mjs NODE_MODULES URL FOLDER WALK...
// FOLDER gets a screenshot at the end of each walk, and whenever something was not as it should be.
import { createRequire } from "node:module";

const [nodeModules, url, folder, ...walks] = process.argv.slice(2);
const { chromium } = createRequire(`${nodeModules}/`)("playwright-core");
const PATIENCE_MS = 25_000;

let walk = "start";

function report(name, ok, detail = "") {
  console.log(JSON.stringify({ walk, name, ok, detail: String(detail) }));
}

/** Waits until `look` returns something true in the page; returns it. */
async function until(page, look, argument) {
  const handle = await page.waitForFunction(look, argument, { timeout: PATIENCE_MS, polling: 50 });
  return handle.jsonValue();
}

/** A picture that cannot be taken is no finding. */
async function picture(page, name, options = {}) {
  await page.screenshot({ path: `${folder}/${name}.png`, timeout: 10_000, ...options }).catch(() => {});
}

/** One finding: `run` throws if it is not so, or returns what is worth telling. */
async function check(page, name, run) {
  try {
    report(name, true, (await run()) ?? "");
  } catch (error) {
    report(name, false, error.message.split("\n")[0]);
    await picture(page, name.replaceAll(/\W+/g, "_"));
  }
}

const text = (page, id) => page.locator(`#${id}`).textContent();

/** What a canvas shows, as a number that differs from picture to picture. */
const fingerprint = (id) => {
  const canvas = document.getElementById(id);
  const small = document.createElement("canvas");
  small.width = 48;
  small.height = 36;
  const context = small.getContext("2d");
  context.drawImage(canvas, 0, 0, 48, 36);
  return context.getImageData(0, 0, 48, 36).data.reduce((sum, value, i) => (sum * 31 + value * (i + 1)) | 0, 7);
};

async function changes(page, id) {
  const before = await page.evaluate(fingerprint, id);
  await until(page, ([source, canvas, seen]) => new Function(`return (${source})`)()(canvas) !== seen,
    [fingerprint.toString(), id, before]);
}

const position = (page) => page.evaluate(() => document.getElementById("pose").textContent);
const speed = () => Number(document.getElementById("granted").textContent.split(" ")[0]);

async function look(page) {
  await check(page, "it is live and may control", () =>
    until(page, () => document.body.dataset.mode === "live" && document.body.dataset.control === "true"));
  for (const id of ["camera", "depth", "histogram", "map"]) {
    await check(page, `${id} shows something that changes`, async () => {
      if (id === "map") await until(page, () => Number(document.getElementById("map").dataset.landmarks) > 0);
      if (id !== "map") await changes(page, id);
    });
  }
  await check(page, "cloud has points", () =>
    until(page, () => Number(document.getElementById("cloud").dataset.points) > 1000));
  for (const plot of ["plot_nis", "plot_sigma", "plot_cost", "plot_latency"]) {
    await check(page, `${plot} draws`, () => draws(page, plot));
  }
  await check(page, "services are listed", () =>
    until(page, () => document.querySelectorAll("#health tr").length >= 8 && document.getElementById("health").innerText));
  await check(page, "battery is shown", () => until(page, () => /\d+ %/.test(document.getElementById("battery").textContent)));
}

/** A plot's canvas has something in the colour of a line. */
const draws = (page, id) => until(page, (plot) => {
  const canvas = document.querySelector(`#${plot} canvas`);
  if (!canvas) return false;
  const data = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
  for (let i = 0; i < data.length; i += 4) {
    if (data[i + 3] > 128 && Math.max(data[i], data[i + 1], data[i + 2]) > 200) return true;
  }
  return false;
}, id);

async function drive(page) {
  await page.bringToFront();
  await check(page, "robot stands ready", () =>
    until(page, () => ["RUN", "STOP", "SLOW"].includes(document.getElementById("safety").textContent)));
  const before = await position(page);
  await page.keyboard.down("KeyA");
  // So far that landmarks are seen from elsewhere, and mapped.
  await check(page, "a held key turns it", () => until(page, (seen) => {
    const degrees = (pose) => parseInt(pose.split("·")[2]);
    const now = document.getElementById("pose").textContent;
    return Math.abs(degrees(now) - degrees(seen)) >= 12 && now;
  }, before));
  await page.keyboard.up("KeyA");
  await check(page, "letting go stops it", () =>
    until(page, () => document.getElementById("granted").textContent === "0.00 m/s · 0.00 rad/s"));
  await page.keyboard.down("KeyD");
  await check(page, "it turns again", () =>
    until(page, () => !document.getElementById("granted").textContent.endsWith(" 0.00 rad/s")));
  await page.keyboard.press("Space");
  await check(page, "e-stop stops it though the key is held", () =>
    until(page, () => document.getElementById("safety").textContent === "E-STOP" &&
      document.getElementById("granted").textContent === "0.00 m/s · 0.00 rad/s"));
  await page.keyboard.up("KeyD");
  await page.waitForTimeout(1200); // a reset needs a calm robot and nobody who asks
  await check(page, "reset lets it go on", async () => {
    await page.locator("#reset").click();
    return until(page, () => document.getElementById("safety").textContent !== "E-STOP");
  });
}

async function stick(page) {
  const box = await page.locator("#stick").boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.1, box.y + box.height / 2, { steps: 3 });
  await check(page, "the stick turns it", () =>
    until(page, () => !document.getElementById("granted").textContent.endsWith(" 0.00 rad/s")));
  await page.mouse.up();
  await check(page, "letting go of the stick stops it", () =>
    until(page, () => document.getElementById("granted").textContent === "0.00 m/s · 0.00 rad/s"));
}

async function train(page) {
  const drag = async (label, from, to) => {
    const box = await page.locator("#camera").boundingBox();
    const at = ([x, y]) => [box.x + x * box.width, box.y + y * box.height];
    await page.locator("#train_label").selectOption(label);
    await page.mouse.move(...at(from));
    await page.mouse.down();
    await page.mouse.move(...at(to), { steps: 3 });
    await page.mouse.up();
  };
  await drag("200", [0.4, 0.82], [0.6, 0.95]);
  await drag("0", [0.4, 0.05], [0.6, 0.2]);
  await drag("100", [0.28, 0.4], [0.36, 0.6]);
  await check(page, "three rectangles are drawn", () =>
    until(page, () => document.getElementById("train_note").textContent === "3 drawn"));
  const before = await wallShares(page);
  await page.locator("#train").click();
  await check(page, "they are sent", () =>
    until(page, () => document.getElementById("train_note").textContent === "3 sent"));
  // Geometry's walls were taught as obstacles: by what they look like they are now.
  await check(page, "the labels follow", () => until(page, ([least, largest]) => {
    const now = Number(document.getElementById("labels_legend").dataset.wall);
    return (now < least - 0.03 || now > largest + 0.03) &&
      `wall ${least.toFixed(3)} to ${largest.toFixed(3)} before, now ${now.toFixed(3)}`;
  }, [Math.min(...before), Math.max(...before)]));
}

/** The share of the picture that is wall, over a second: the robot stands, so it differs by noise. */
async function wallShares(page) {
  const shares = [];
  for (let i = 0; i < 20; ++i) {
    shares.push(await page.evaluate(() => Number(document.getElementById("labels_legend").dataset.wall)));
    await page.waitForTimeout(50);
  }
  return shares;
}

async function goal(page) {
  const before = await position(page);
  const box = await page.locator("#map").boundingBox();
  await page.mouse.click(box.x + box.width * 0.62, box.y + box.height * 0.5);
  await check(page, "a goal on the map makes it drive", () => until(page, (seen) => {
    const now = document.getElementById("pose").textContent;
    return now.split("·")[1] !== seen.split("·")[1] && `${seen} -> ${now}, ${document.getElementById("pilot_state").textContent}`;
  }, before));
  await page.locator("#pilot_stop").click();
  await check(page, "stop stands it still", () =>
    until(page, () => document.getElementById("granted").textContent === "0.00 m/s · 0.00 rad/s"));
}

/** Opening a log plays it: presses the button until nothing moves any more. */
async function pause(page) {
  const state = () => ["play", "position"].map((id) => document.getElementById(id).textContent).join(" ") +
    document.getElementById("camera").dataset.frame;
  for (let i = 0; i < 10; ++i) {
    const before = await page.evaluate(state);
    await page.waitForTimeout(1000);
    if ((await page.evaluate(state)) === before && before.startsWith("Play ")) return before;
    if (before.startsWith("Pause ")) await page.locator("#play").click();
  }
  throw new Error(`still ${await page.evaluate(state)}`);
}

async function replay(page) {
  await check(page, "there are logs to choose from", () =>
    until(page, () => document.querySelectorAll("#logs option").length > 1));
  // A sample, whose camera runs from its first second on; there may be recordings of one's own too.
  const log = await page.locator('#logs option[value^="samples/"]').first().getAttribute("value");
  await page.locator("#logs").selectOption(log);
  await check(page, "the page says REPLAY", () => until(page, () => document.getElementById("mode").textContent === "REPLAY"));
  await check(page, "driving is off in replay", () => until(page, () => document.body.dataset.control === "false"));
  const frame = () => document.getElementById("camera").dataset.frame;
  await until(page, () => Number(document.getElementById("seek").max) > 1);
  await check(page, "it stands still when paused", () => pause(page));
  const seek = (to) => page.evaluate((value) => {
    const slider = document.getElementById("seek");
    slider.value = String(value);
    slider.dispatchEvent(new Event("input"));
    slider.dispatchEvent(new Event("change"));
  }, to);
  await seek(1.5);
  await page.waitForTimeout(500);
  const later = await page.evaluate(frame);
  await seek(0.5);
  await until(page, (seen) => document.getElementById("camera").dataset.frame !== seen, later);
  await page.waitForTimeout(500);
  const earlier = await page.evaluate(frame);
  await seek(1.5);
  await check(page, "seek lands on the same frame again", () =>
    until(page, (seen) => document.getElementById("camera").dataset.frame === seen, later));
  await check(page, "an earlier time is an earlier frame", () => {
    if (!(Number(earlier) < Number(later))) throw new Error(`${earlier} is not before ${later}`);
    return `${earlier} before ${later}`;
  });
  await page.locator("#step").click();
  await check(page, "a step is the next frame", () =>
    until(page, (seen) => Number(document.getElementById("camera").dataset.frame) === Number(seen) + 1, later));
  await page.locator("#logs").selectOption("");
  await check(page, "and it is live again", () => until(page, () => document.getElementById("mode").textContent === "LIVE"));
}

const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
// The page forbids eval, which is how playwright waits for conditions in it.
const fresh = () => browser.newContext({ viewport: { width: 1280, height: 720 }, bypassCSP: true });

/** From entering the address, with nothing in the browser's cache, to a picture [ms]. */
async function firstPicture_ms(page) {
  await page.goto(url);
  return until(page, () => performance.getEntriesByName("first picture")[0]?.startTime);
}

async function first(page) {
  await page.goto("about:blank");
  const times_ms = [];
  for (let i = 0; i < 9; ++i) {
    const context = await fresh();
    times_ms.push(Math.round(await firstPicture_ms(await context.newPage())));
    await context.close();
  }
  const sorted = times_ms.toSorted((a, b) => a - b);
  report("first picture in nine fresh browsers", true, `median ${sorted[4]} ms of ${times_ms.join(", ")}`);
  await page.goto(url);
}

const WALKS = { drive, look, first, stick, train, goal, replay };
const context = await fresh();
const page = await context.newPage();
page.on("pageerror", (error) => report("the page's code has no error", false, error.message));
await check(page, "first picture", async () => `${Math.round(await firstPicture_ms(page))} ms`);
for (walk of walks) {
  await check(page, "it goes through to its end", () => WALKS[walk](page));
  await picture(page, walk);
}
await page.setViewportSize({ width: 390, height: 844 });
await page.waitForTimeout(1000);
await picture(page, "phone", { fullPage: true });
await browser.close();
