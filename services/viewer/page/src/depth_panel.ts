/** Depth in false colour, its histogram, and the range that landmark_svc takes from it. */
import { falseColor, pixelsOf, rgba } from "./colors";
import type { Connection } from "./connection";
import { context2d, element, fitToScreen, IN_MEMORY, say } from "./dom";
import type { Frame, Frames } from "./frames";
import { landmark_list_t } from "./messages";

const FARTHEST_M = 6;
const BINS = 120;
const PALETTE = Array.from({ length: 256 }, (_, i) => falseColor(i / 255));
const PIXELS = Uint32Array.from(PALETTE, (color) => rgba(...color));
const NO_DEPTH = rgba(0, 0, 0);

export class DepthPanel {
  private readonly canvas = element<HTMLCanvasElement>("depth");
  private readonly context = context2d(this.canvas, IN_MEMORY);
  private readonly chart = element<HTMLCanvasElement>("histogram");
  private readonly chartContext = context2d(this.chart);
  private range_m: [number, number] | null = null;

  constructor(connection: Connection, frames: Frames) {
    frames.onFrame((frame) => this.draw(frame));
    connection.on("LANDMARKS", landmark_list_t, (m) => (this.range_m = [m.range_min_m, m.range_max_m]));
    connection.onReset(() => (this.range_m = null));
  }

  private draw({ message, depth }: Frame): void {
    const image = new ImageData(message.depth_width_px, message.depth_height_px);
    const counts = new Array<number>(BINS).fill(0);
    const pixels = pixelsOf(image).fill(NO_DEPTH);
    const ratioPerStep = message.depth_unit_m / FARTHEST_M;
    for (let i = 0; i < depth.length; ++i) {
      const ratio = depth[i] * ratioPerStep;
      if (ratio <= 0 || ratio >= 1) continue;
      counts[(ratio * BINS) | 0]++;
      pixels[i] = PIXELS[(ratio * 255) | 0];
    }
    this.canvas.width = image.width;
    this.canvas.height = image.height;
    this.context.putImageData(image, 0, 0);
    this.drawHistogram(counts);
    const [low, high] = this.range_m ?? [0, 0];
    say("depth_note", this.range_m ? `used ${low.toFixed(2)} to ${high.toFixed(2)} m` : "");
  }

  private drawHistogram(counts: number[]): void {
    fitToScreen(this.chart);
    const { width, height } = this.chart;
    const tallest = Math.max(1, ...counts);
    this.chartContext.clearRect(0, 0, width, height);
    counts.forEach((count, i) => {
      this.chartContext.fillStyle = `rgb(${PALETTE[Math.floor((i / BINS) * 255)]})`;
      const tall = (count / tallest) * height;
      this.chartContext.fillRect((i / BINS) * width, height - tall, width / BINS, tall);
    });
    this.chartContext.fillStyle = "#ffffff";
    for (const limit_m of this.range_m ?? []) {
      this.chartContext.fillRect((limit_m / FARTHEST_M) * width - 1, 0, 2, height);
    }
  }
}
