// Every golden message decodes in the page and encodes to the same bytes; bad bytes are refused.
// usage: node --test messages_test.mjs, with ROOMWISE_MESSAGES naming the bundled decoders.
import assert from "node:assert";
import fs from "node:fs";
import path from "node:path";
import test from "node:test";
import url from "node:url";

const messages = await import(url.pathToFileURL(process.env.ROOMWISE_MESSAGES));
const here = path.dirname(url.fileURLToPath(import.meta.url));
const golden = path.join(here, "..", "lcmtypes", "golden");
const stems = fs.readdirSync(golden).map((file) => path.parse(file).name);
const bytesOf = (stem) => {
  const text = fs.readFileSync(path.join(golden, `${stem}.hex`), "utf8");
  return new Uint8Array(Buffer.from(text.replace(/\s/g, ""), "hex"));
};

test("every message has a golden file", () => {
  assert.deepEqual(Object.keys(messages).sort(), [...stems].sort());
});

for (const stem of stems) {
  const bytes = bytesOf(stem);
  test(`${stem}: decoding and encoding gives the same bytes`, () => {
    assert.deepEqual(messages[stem].encode(messages[stem].decode(bytes)), bytes);
  });
  test(`${stem}: cut short anywhere or too long is refused`, () => {
    for (let size = 0; size < bytes.length; ++size) {
      assert.throws(() => messages[stem].decode(bytes.subarray(0, size)), RangeError);
    }
    assert.throws(() => messages[stem].decode(new Uint8Array([...bytes, 0])), RangeError);
  });
  test(`${stem}: another type's fingerprint is refused`, () => {
    const other = bytes.slice();
    other[0] ^= 1;
    assert.throws(() => messages[stem].decode(other), RangeError);
  });
}
