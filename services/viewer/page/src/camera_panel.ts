/** The colour picture with what the services see in it, and rectangles to train from. */
import { decompress } from "fzstd";
import { kindColor, LABEL_COLORS, pixelsOf, rgba } from "./colors";
import type { Connection } from "./connection";
import { context2d, element, IN_MEMORY, say } from "./dom";
import type { Frame, Frames } from "./frames";
import { landmark_list_t, segment_training_t, segmentation_t, type training_rectangle_t } from "./messages";

const LABEL_OPACITY = 64;
const LARGEST_LABELS = 1 << 24;
const LABEL_PIXELS = Uint32Array.from({ length: 256 }, (_, label) =>
  LABEL_COLORS[label] ? rgba(...LABEL_COLORS[label], LABEL_OPACITY) : 0);
const isOn = (id: string) => element<HTMLInputElement>(id).checked;

interface Rectangle {
  label: number;
  u: number;
  v: number;
  width: number;
  height: number;
}

export class CameraPanel {
  private readonly canvas = element<HTMLCanvasElement>("camera");
  private readonly context = context2d(this.canvas, IN_MEMORY);
  private landmarks: landmark_list_t | null = null;
  private segments: segmentation_t | null = null;
  private readonly labels = context2d(document.createElement("canvas"), IN_MEMORY);
  private rectangles: Rectangle[] = [];
  private start: { u: number; v: number } | null = null;
  private frame_utime = 0n;
  private color_scale = 1;

  constructor(
    private readonly connection: Connection,
    frames: Frames,
  ) {
    frames.onFrame((frame) => this.draw(frame));
    connection.on("LANDMARKS", landmark_list_t, (m) => (this.landmarks = m));
    connection.on("SEGMENTS", segmentation_t, (m) => (this.segments = m));
    connection.onReset(() => {
      this.landmarks = null;
      this.segments = null;
      this.rectangles = [];
    });
    this.canvas.addEventListener("pointerdown", (e) => this.begin(e));
    this.canvas.addEventListener("pointerup", (e) => this.finish(e));
    element("train").addEventListener("click", () => this.train());
    element("train_clear").addEventListener("click", () => (this.rectangles = []));
  }

  private drawLabels(): void {
    const m = this.segments;
    if (!m) return;
    const size = m.label_width_px * m.label_height_px;
    if (size <= 0 || size > LARGEST_LABELS) return;
    const bytes =
      m.label_encoding === 1 ? decompress(m.label_data, new Uint8Array(size)) : m.label_data;
    if (bytes.length !== size) return;
    const image = new ImageData(m.label_width_px, m.label_height_px);
    const pixels = pixelsOf(image);
    for (let i = 0; i < size; ++i) pixels[i] = LABEL_PIXELS[bytes[i]];
    this.labels.canvas.width = image.width;
    this.labels.canvas.height = image.height;
    this.labels.putImageData(image, 0, 0);
    this.context.drawImage(this.labels.canvas, 0, 0, this.canvas.width, this.canvas.height);
    this.canvas.dataset.labels = String(m.seq);
  }

  private draw(frame: Frame): void {
    const { message, color } = frame;
    this.frame_utime = message.utime;
    this.color_scale = (message.color_width_px || message.depth_width_px) / message.depth_width_px;
    this.canvas.width = message.depth_width_px;
    this.canvas.height = message.depth_height_px;
    const { width, height } = this.canvas;
    if (color) this.context.drawImage(color, 0, 0, width, height);
    if (isOn("show_labels")) this.drawLabels();
    if (isOn("show_edges")) this.drawEdges();
    if (isOn("show_landmarks")) this.drawLandmarks();
    this.rectangles.forEach((r) => this.drawRectangle(r));
    this.canvas.dataset.frame = String(message.seq);
    say("camera_note", `${color ? "" : "no colour · "}frame ${message.seq}`);
  }

  private drawEdges(): void {
    const m = this.landmarks;
    if (!m) return;
    const size = Math.max(1, this.canvas.width / 320);
    this.context.fillStyle = "#fff45c";
    for (let i = 0; i < m.edge_listed; ++i) {
      this.context.fillRect(m.edge_u_px[i], m.edge_v_px[i], size, size);
    }
  }

  private drawLandmarks(): void {
    this.context.lineWidth = this.canvas.width / 200;
    for (const seen of this.landmarks?.landmarks ?? []) {
      this.context.strokeStyle = kindColor(seen.kind);
      this.context.setLineDash(seen.moving ? [6, 6] : []);
      this.context.beginPath();
      this.context.moveTo(seen.pixel_u_px, seen.pixel_v_top_px);
      this.context.lineTo(seen.pixel_u_px, seen.pixel_v_bottom_px);
      this.context.stroke();
    }
    this.context.setLineDash([]);
  }

  private drawRectangle(r: Rectangle): void {
    this.context.lineWidth = 2;
    this.context.strokeStyle = `rgb(${LABEL_COLORS[r.label]})`;
    this.context.strokeRect(r.u, r.v, r.width, r.height);
  }

  private pixelOf(e: PointerEvent): { u: number; v: number } {
    const box = this.canvas.getBoundingClientRect();
    const scale = Math.min(box.width / this.canvas.width, box.height / this.canvas.height);
    const left = (box.width - scale * this.canvas.width) / 2;
    const top = (box.height - scale * this.canvas.height) / 2;
    const inside = (value: number, end: number) => Math.max(0, Math.min(end, Math.round(value)));
    return {
      u: inside((e.clientX - box.left - left) / scale, this.canvas.width),
      v: inside((e.clientY - box.top - top) / scale, this.canvas.height),
    };
  }

  private begin(e: PointerEvent): void {
    this.start = this.pixelOf(e);
    this.canvas.setPointerCapture(e.pointerId);
  }

  private finish(e: PointerEvent): void {
    if (!this.start) return;
    const end = this.pixelOf(e);
    const rectangle = {
      label: Number(element<HTMLSelectElement>("train_label").value),
      u: Math.min(this.start.u, end.u),
      v: Math.min(this.start.v, end.v),
      width: Math.abs(end.u - this.start.u),
      height: Math.abs(end.v - this.start.v),
    };
    this.start = null;
    if (rectangle.width > 3 && rectangle.height > 3) this.rectangles.push(rectangle);
    say("train_note", `${this.rectangles.length} drawn`);
  }

  /** The picture is shown in the depth image's pixels; rectangles are meant in the colour's. */
  private onColor(r: Rectangle): training_rectangle_t {
    return {
      label: r.label,
      left_px: Math.round(r.u * this.color_scale),
      top_px: Math.round(r.v * this.color_scale),
      width_px: Math.round(r.width * this.color_scale),
      height_px: Math.round(r.height * this.color_scale),
    };
  }

  private train(): void {
    this.connection.send("SEGMENT_TRAIN", segment_training_t, {
      utime: 0n,
      seq: 0n,
      train_frame_utime: this.frame_utime,
      rectangle_count: this.rectangles.length,
      rectangles: this.rectangles.map((r) => this.onColor(r)),
    });
    say("train_note", `${this.rectangles.length} sent`);
    this.rectangles = [];
  }
}
