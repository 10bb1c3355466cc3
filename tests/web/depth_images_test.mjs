// The page's PDZ16 decoder against images the C++ encoder wrote; bad bytes are refused.
// usage: node --test depth_images_test.mjs, with ROOMWISE_PDZ16 naming the bundled decoder and
// ROOMWISE_DEPTH_IMAGES what tests/web/depth_images.cpp wrote.
import assert from "node:assert";
import fs from "node:fs";
import test from "node:test";
import url from "node:url";

const { decodePdz16 } = await import(url.pathToFileURL(process.env.ROOMWISE_PDZ16));

function* imagesIn(file) {
  for (let at = 0; at < file.length; ) {
    const [width, height, size] = [0, 4, 8].map((offset) => file.readUInt32LE(at + offset));
    const pixelsAt = at + 12 + size;
    const end = pixelsAt + 2 * width * height;
    const pixels = new Uint16Array(new Uint8Array(file.subarray(pixelsAt, end)).buffer);
    yield { width, height, bytes: new Uint8Array(file.subarray(at + 12, pixelsAt)), pixels };
    at = end;
  }
}

const images = [...imagesIn(fs.readFileSync(process.env.ROOMWISE_DEPTH_IMAGES))];

test("every image the encoder wrote comes back exactly", () => {
  assert.ok(images.length >= 30, `only ${images.length} images`);
  for (const { width, height, bytes, pixels } of images) {
    const decoded = decodePdz16(bytes, width, height);
    assert.ok(Buffer.from(decoded.buffer).equals(Buffer.from(pixels.buffer)), `${width} x ${height}`);
  }
});

test("another size than the image's is refused", () => {
  for (const { width, height, bytes } of images) {
    assert.throws(() => decodePdz16(bytes, width + 1, height), RangeError);
    assert.throws(() => decodePdz16(bytes, width, height + 1), RangeError);
  }
});

test("an image cut short anywhere or too long is refused", () => {
  const small = images.filter(({ pixels }) => pixels.length < 3000);
  for (const { width, height, bytes } of small) {
    for (let size = 0; size < bytes.length; ++size) {
      assert.throws(() => decodePdz16(bytes.subarray(0, size), width, height), RangeError);
    }
    assert.throws(() => decodePdz16(new Uint8Array([...bytes, 0]), width, height), RangeError);
  }
});

test("changed bytes are refused, or give an image of the right size, and nothing else", () => {
  let state = 1;
  const random = (end) => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) % end;
  for (let i = 0; i < 2000; ++i) {
    const { width, height, bytes } = images[random(images.length - 12)];
    const changed = bytes.slice();
    for (let flips = 1 + random(4); flips > 0; --flips) changed[random(changed.length)] ^= 1 + random(255);
    try {
      assert.equal(decodePdz16(changed, width, height).length, width * height);
    } catch (error) {
      assert.ok(error instanceof RangeError, error.stack);
    }
  }
});
