/** Colours by meaning, the same on every panel. */
export const KIND_NAMES = ["unknown", "edge left", "edge right", "crease convex", "crease concave", "pole", "fiducial"];
export const KIND_COLORS = ["#a0a7b4", "#58a6ff", "#3ddbd9", "#ffb454", "#ff8f6b", "#d2a8ff", "#f778ba"];
export const kindColor = (kind: number) => KIND_COLORS[kind] ?? KIND_COLORS[0];

export const LABEL_COLORS: Record<number, [number, number, number]> = {
  0: [248, 81, 73],
  50: [255, 0, 200],
  100: [88, 130, 255],
  200: [63, 201, 100],
};

/** A pixel of ImageData, taken as one 32-bit number (every machine with a browser is little-endian). */
export const rgba = (red: number, green: number, blue: number, alpha = 255): number =>
  ((alpha << 24) | (blue << 16) | (green << 8) | red) >>> 0;

/** ImageData's pixels as such numbers. */
export const pixelsOf = (image: ImageData): Uint32Array => new Uint32Array(image.data.buffer);

export const PATH_COLORS = { truth: "#3fc964", odometry: "#8b929e", estimate: "#ffb454" };

/** Turbo-like false colour, near red to far blue, of a ratio in [0, 1]. */
export function falseColor(ratio: number): [number, number, number] {
  const bump = (middle: number) => Math.max(0, Math.min(1, 1.5 - Math.abs(4 * ratio - middle)));
  return [255 * bump(1), 255 * bump(2), 255 * bump(3)];
}
