/** The newest camera frame, decoded once for every panel that shows it. */
import type { Connection } from "./connection";
import { kinect_frame_t } from "./messages";
import { decodePdz16 } from "./pdz16";

export class Frame {
  private decoded?: Uint16Array;

  constructor(
    readonly message: kinect_frame_t,
    /** Null where the camera gives no colour. */
    readonly color: ImageBitmap | null,
  ) {}

  /** Decoded when first asked for. Throws RangeError if it is none. */
  get depth(): Uint16Array {
    return (this.decoded ??= depthOf(this.message));
  }
}

/** The mark by which a browser's tools tell how long a person waits. */
const FIRST_PICTURE = "first picture";
const LONGEST_SIDE_PX = 4096;
/** Decoding and drawing is the dearest thing the page does; the eye is content with this. */
const SHORTEST_PAUSE_MS = 40;

function depthOf(m: kinect_frame_t): Uint16Array {
  const size = m.depth_width_px * m.depth_height_px;
  if (Math.max(m.depth_width_px, m.depth_height_px) > LONGEST_SIDE_PX || size <= 0) {
    throw new RangeError("a depth image of absurd size");
  }
  if (m.depth_encoding === 1) return decodePdz16(m.depth_data, m.depth_width_px, m.depth_height_px);
  if (m.depth_data.length !== 2 * size) throw new RangeError("a depth image of another size");
  const words = new Uint16Array(m.depth_data.slice().buffer);
  if (m.depth_encoding === 0) return words;
  if (m.depth_encoding === 2) return words.map((word) => word >> 3); // the rest says whose it is
  throw new RangeError(`a depth image of unknown encoding ${m.depth_encoding}`);
}

async function colorOf(m: kinect_frame_t): Promise<ImageBitmap | null> {
  if (m.color_encoding === 2) {
    return createImageBitmap(new Blob([m.color_data.slice()], { type: "image/jpeg" }));
  }
  const size = m.color_width_px * m.color_height_px;
  if (m.color_encoding !== 1 || size <= 0 || m.color_data.length !== 3 * size) return null;
  const image = new ImageData(m.color_width_px, m.color_height_px);
  for (let from = 0, to = 0; from < 3 * size; from += 3, to += 4) {
    image.data[to] = m.color_data[from];
    image.data[to + 1] = m.color_data[from + 1];
    image.data[to + 2] = m.color_data[from + 2];
    image.data[to + 3] = 255;
  }
  return createImageBitmap(image);
}

export class Frames {
  private waiting: kinect_frame_t | null = null;
  private busy = false;
  private handlers: ((frame: Frame) => void)[] = [];
  private tellShown!: () => void;
  /** The first frame is on the screen. */
  readonly firstShown = new Promise<void>((resolve) => (this.tellShown = resolve));

  constructor(connection: Connection) {
    connection.on("KINECT_FRAME", kinect_frame_t, (message) => {
      this.waiting = message;
      void this.decodeNext();
    });
  }

  onFrame(handle: (frame: Frame) => void): void {
    this.handlers.push(handle);
  }

  private tellOfFirst(): void {
    performance.mark(FIRST_PICTURE);
    requestAnimationFrame(() => setTimeout(this.tellShown));
  }

  private async decodeNext(): Promise<void> {
    const message = this.waiting;
    if (this.busy || message === null || document.hidden) return;
    this.busy = true;
    this.waiting = null;
    const began_ms = performance.now();
    try {
      const frame = new Frame(message, await colorOf(message).catch(() => null));
      this.handlers.forEach((handle) => handle(frame));
      frame.color?.close();
      if (performance.getEntriesByName(FIRST_PICTURE).length === 0) this.tellOfFirst();
    } catch (error) {
      if (!(error instanceof RangeError)) throw error;
    } finally {
      setTimeout(() => {
        this.busy = false;
        void this.decodeNext();
      }, Math.max(SHORTEST_PAUSE_MS, performance.now() - began_ms)); // half the time is for the rest
    }
  }
}
