// What depths the page reads from a KINECT_FRAME's two-byte pixels, encoding by encoding.
// usage: node --test frame_depths_test.mjs, with ROOMWISE_FRAMES naming the bundled frames.ts.
import assert from "node:assert";
import test from "node:test";
import url from "node:url";

const { Frame } = await import(url.pathToFileURL(process.env.ROOMWISE_FRAMES));
const words = [0, 8, 1000 * 8 + 5, 65535];
const data = new Uint8Array(new Uint16Array(words).buffer);
const depthsOf = (depth_encoding, width = 2, height = 2) =>
  [...new Frame({ depth_encoding, depth_width_px: width, depth_height_px: height, depth_data: data }, null).depth];

test("RAW16 is the words themselves", () => assert.deepEqual(depthsOf(0), words));

test("PLAYER16 is their upper 13 bits", () => assert.deepEqual(depthsOf(2), [0, 1, 1000, 8191]));

test("an encoding nobody knows is refused, and another size", () => {
  for (const encoding of [-1, 3, 127]) assert.throws(() => depthsOf(encoding), RangeError);
  for (const encoding of [0, 2]) assert.throws(() => depthsOf(encoding, 3), RangeError);
});
