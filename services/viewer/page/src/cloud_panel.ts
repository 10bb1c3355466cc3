/** The coloured point cloud, seen from any side. */
import * as three from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Connection } from "./connection";
import { context2d, element, IN_MEMORY } from "./dom";
import type { Frame, Frames } from "./frames";

const WITHOUT_COLOR = [190, 196, 206];
const MOST_POINTS = 80_000;
/** Where a processor must do the graphics, drawing costs more than all else. */
const SHORTEST_INTERVAL_MS = 250;

export class CloudPanel {
  private readonly canvas = element<HTMLCanvasElement>("cloud");
  private readonly renderer = new three.WebGLRenderer({ canvas: this.canvas, antialias: false });
  private readonly scene = new three.Scene();
  private readonly camera = new three.PerspectiveCamera(55, 1, 0.05, 50);
  private readonly controls = new OrbitControls(this.camera, this.canvas);
  private readonly geometry = new three.BufferGeometry();
  private readonly positions = new Float32Array(3 * MOST_POINTS);
  private readonly colors = new Uint8Array(3 * MOST_POINTS);
  private readonly picture = context2d(document.createElement("canvas"), IN_MEMORY);
  private due_ms = 0;

  constructor(connection: Connection, frames: Frames) {
    this.geometry.setAttribute("position", new three.BufferAttribute(this.positions, 3));
    this.geometry.setAttribute("color", new three.BufferAttribute(this.colors, 3, true));
    const material = new three.PointsMaterial({ size: 0.02, vertexColors: true });
    const points = new three.Points(this.geometry, material);
    points.frustumCulled = false;
    const grid = new three.GridHelper(10, 20, 0x3a404b, 0x252a33);
    grid.rotation.x = Math.PI / 2;
    this.scene.add(points, grid, new three.AxesHelper(0.3));
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(-1.4, 1.2, 1.7);
    this.controls.target.set(1.8, 0, 0.4);
    this.controls.addEventListener("change", () => this.render());
    this.controls.update();
    frames.onFrame((frame) => this.take(frame));
    connection.onReset(() => this.geometry.setDrawRange(0, 0));
  }

  private take(frame: Frame): void {
    if (performance.now() < this.due_ms) return;
    const began_ms = performance.now();
    this.canvas.dataset.points = String(this.fill(frame));
    this.render();
    this.due_ms = performance.now() + Math.max(SHORTEST_INTERVAL_MS, 3 * (performance.now() - began_ms));
  }

  /** p_robot = R(quaternion) p_camera + translation. */
  private fill({ message: m, depth, color }: Frame): number {
    const step = Math.ceil(Math.sqrt(depth.length / MOST_POINTS));
    const pixels = this.pixelsOf(color, m.depth_width_px, m.depth_height_px);
    const [w, x, y, z] = m.T_robot_camera_quat;
    const turn = new three.Matrix4().makeRotationFromQuaternion(new three.Quaternion(x, y, z, w)).elements;
    const move = m.T_robot_camera_translation_m;
    const { positions, colors } = this;
    let count = 0;
    for (let v = 0; v < m.depth_height_px; v += step) {
      for (let u = 0; u < m.depth_width_px; u += step) {
        const pixel = v * m.depth_width_px + u;
        const z_m = depth[pixel] * m.depth_unit_m;
        if (z_m === 0 || count === MOST_POINTS) continue;
        const x_m = ((u - m.depth_cx_px) / m.depth_fx_px) * z_m;
        const y_m = ((v - m.depth_cy_px) / m.depth_fy_px) * z_m;
        const at = 3 * count++;
        for (let i = 0; i < 3; ++i) {
          positions[at + i] = turn[i] * x_m + turn[4 + i] * y_m + turn[8 + i] * z_m + move[i];
          colors[at + i] = pixels ? pixels[4 * pixel + i] : WITHOUT_COLOR[i];
        }
      }
    }
    this.geometry.setDrawRange(0, count);
    this.geometry.attributes.position.needsUpdate = true;
    this.geometry.attributes.color.needsUpdate = true;
    return count;
  }

  private pixelsOf(color: ImageBitmap | null, width: number, height: number): Uint8ClampedArray | null {
    if (!color) return null;
    this.picture.canvas.width = width;
    this.picture.canvas.height = height;
    this.picture.drawImage(color, 0, 0, width, height);
    return this.picture.getImageData(0, 0, width, height).data;
  }

  private render(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 1.5));
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.renderer.render(this.scene, this.camera);
  }
}
