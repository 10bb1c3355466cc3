/** The page: one connection, and the panels that look at it. First what stops the robot and the
 * colour picture; the instruments, which take longer to load, when that is shown. */
import { CameraPanel } from "./camera_panel";
import { Connection } from "./connection";
import { Drive } from "./drive";
import { Frames } from "./frames";
import { followLabels } from "./labels_legend";
import { ReplayBar } from "./replay_bar";
import { StatePanels } from "./state_panels";

/** The instruments wait no longer than this for a camera that may not be there. */
const LONGEST_WAIT_MS = 700;

const connection = new Connection();
connection.open();
new Drive(connection);
new StatePanels(connection);
new ReplayBar(connection);
const frames = new Frames(connection);
new CameraPanel(connection, frames);
followLabels(connection);

await Promise.race([frames.firstShown, new Promise((resolve) => setTimeout(resolve, LONGEST_WAIT_MS))]);
const { openInstruments } = await import("./instruments");
openInstruments(connection, frames);

/** Its library is larger than all the rest, and starting WebGL takes long. */
await frames.firstShown;
try {
  const { CloudPanel } = await import("./cloud_panel");
  new CloudPanel(connection, frames);
} catch {
  document.body.dataset.webgl = "none"; // the rest of the page does without
}
