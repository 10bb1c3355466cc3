/** The map from above: landmarks with their 95 % ellipses, paths, the robot and its free range. */
import { sendBehaviour } from "./behaviour";
import { kindColor, PATH_COLORS } from "./colors";
import type { Connection } from "./connection";
import { context2d, element, fitToScreen, say } from "./dom";
import { landmark_map_t, type map_landmark_t, pilot_goal_t, segmentation_t } from "./messages";
import type { Path, Pose, Poses } from "./poses";

/** Square root of the 95 % quantile of chi squared with two degrees of freedom. */
const SIGMAS_95 = Math.sqrt(5.991);
const ROBOT_RADIUS_M = 0.17;
const SMALLEST_HALF_VIEW_M = 2.5;
const BEHAVIOUR_GO_TO = 3;

export class MapPanel {
  private readonly canvas = element<HTMLCanvasElement>("map");
  private readonly context = context2d(this.canvas);
  private landmarks: map_landmark_t[] = [];
  private segments: segmentation_t | null = null;
  private goal: { x: number; y: number } | null = null;
  private center = { x: 0, y: 0 };
  private scale = 60;

  constructor(
    private readonly connection: Connection,
    private readonly poses: Poses,
  ) {
    connection.on("LANDMARK_MAP", landmark_map_t, (m) => (this.landmarks = m.map_landmarks));
    connection.on("SEGMENTS", segmentation_t, (m) => (this.segments = m));
    connection.on("PILOT_GOAL", pilot_goal_t, (m) => {
      this.goal = m.behaviour === BEHAVIOUR_GO_TO ? { x: m.goal_x_m, y: m.goal_y_m } : null;
    });
    connection.onReset(() => {
      this.landmarks = [];
      this.segments = null;
      this.goal = null;
    });
    this.canvas.addEventListener("click", (e) => this.sendGoal(e));
    setInterval(() => requestAnimationFrame(() => this.draw()), 100);
  }

  private draw(): void {
    fitToScreen(this.canvas);
    this.fitView();
    const c = this.context;
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.clearRect(0, 0, this.canvas.width, this.canvas.height);
    c.translate(this.canvas.width / 2, this.canvas.height / 2);
    c.scale(this.scale, -this.scale);
    c.translate(-this.center.x, -this.center.y);
    this.drawGrid();
    this.drawFreeRange();
    this.drawPath(this.poses.odometry, PATH_COLORS.odometry);
    this.drawPath(this.poses.truth, PATH_COLORS.truth);
    this.drawPath(this.poses.estimate, PATH_COLORS.estimate);
    this.landmarks.forEach((landmark) => this.drawLandmark(landmark));
    if (this.poses.truth.now) this.drawRobot(this.poses.truth.now, PATH_COLORS.truth);
    if (this.poses.estimate.now) this.drawRobot(this.poses.estimate.now, PATH_COLORS.estimate);
    if (this.goal) this.drawGoal(this.goal);
    this.canvas.dataset.landmarks = String(this.landmarks.length);
    // What is seen from one place only may be an error of the detector: ekf_svc waits for a second.
    const count = this.landmarks.length;
    say("map_note", count > 0 ? `${count} landmarks` : "no landmarks yet: drive or turn a little");
  }

  /** Robot, paths and landmarks in view, with a margin. */
  private fitView(): void {
    const seen = [...this.landmarks.map((l) => ({ x: l.map_x_m, y: l.map_y_m })), ...this.poses.estimate.points]
      .filter((p) => Math.hypot(p.x, p.y) < 100);
    const xs = seen.map((p) => p.x).concat(0);
    const ys = seen.map((p) => p.y).concat(0);
    const [left, right] = [Math.min(...xs), Math.max(...xs)];
    const [low, high] = [Math.min(...ys), Math.max(...ys)];
    const half_x = Math.max(SMALLEST_HALF_VIEW_M, (right - left) / 2 + 0.4);
    const half_y = Math.max(SMALLEST_HALF_VIEW_M, (high - low) / 2 + 0.4);
    this.center = { x: (left + right) / 2, y: (low + high) / 2 };
    this.scale = Math.min(this.canvas.width / (2 * half_x), this.canvas.height / (2 * half_y));
  }

  private px(pixels: number): number {
    return (pixels * devicePixelRatio) / this.scale;
  }

  private drawGrid(): void {
    const half_x = this.canvas.width / this.scale / 2 + 1;
    const half_y = this.canvas.height / this.scale / 2 + 1;
    this.context.strokeStyle = "#262b34";
    this.context.lineWidth = this.px(1);
    this.context.beginPath();
    for (let x = Math.ceil(this.center.x - half_x); x < this.center.x + half_x; ++x) {
      this.context.moveTo(x, this.center.y - half_y);
      this.context.lineTo(x, this.center.y + half_y);
    }
    for (let y = Math.ceil(this.center.y - half_y); y < this.center.y + half_y; ++y) {
      this.context.moveTo(this.center.x - half_x, y);
      this.context.lineTo(this.center.x + half_x, y);
    }
    this.context.stroke();
  }

  private drawFreeRange(): void {
    const [pose, m] = [this.poses.estimate.now ?? this.poses.odometry.now, this.segments];
    if (!pose || !m) return;
    this.context.fillStyle = "#3fc96426";
    this.context.beginPath();
    this.context.moveTo(pose.x, pose.y);
    m.free_range_m.forEach((range_m, i) => {
      const angle = pose.heading + m.bin_first_bearing_rad + i * m.bin_step_rad;
      this.context.lineTo(pose.x + range_m * Math.cos(angle), pose.y + range_m * Math.sin(angle));
    });
    this.context.fill();
  }

  private drawPath(path: Path, color: string): void {
    this.context.strokeStyle = color;
    this.context.lineWidth = this.px(1.6);
    this.context.beginPath();
    path.points.forEach((p) => this.context.lineTo(p.x, p.y));
    this.context.stroke();
  }

  private drawLandmark(l: map_landmark_t): void {
    const [a, b, d] = [l.covariance_x_x_m2, l.covariance_x_y_m2, l.covariance_y_y_m2];
    const root = Math.hypot((a - d) / 2, b);
    const axis = (variance: number) => Math.min(20, SIGMAS_95 * Math.sqrt(Math.max(0, variance)));
    const angle = Math.atan2(2 * b, a - d) / 2;
    if (![l.map_x_m, l.map_y_m, root].every(Number.isFinite)) return;
    const c = this.context;
    c.strokeStyle = c.fillStyle = kindColor(l.kind);
    c.lineWidth = this.px(1);
    c.beginPath();
    c.ellipse(l.map_x_m, l.map_y_m, axis((a + d) / 2 + root), axis((a + d) / 2 - root), angle, 0, 2 * Math.PI);
    c.stroke();
    c.beginPath();
    c.arc(l.map_x_m, l.map_y_m, this.px(2.2), 0, 2 * Math.PI);
    c.fill();
  }

  private drawRobot(pose: Pose, color: string): void {
    const c = this.context;
    c.strokeStyle = color;
    c.lineWidth = this.px(2);
    c.beginPath();
    c.arc(pose.x, pose.y, ROBOT_RADIUS_M, pose.heading, pose.heading + 2 * Math.PI);
    c.lineTo(pose.x, pose.y);
    c.stroke();
  }

  private drawGoal(goal: { x: number; y: number }): void {
    this.context.strokeStyle = "#f778ba";
    this.context.lineWidth = this.px(2);
    this.context.beginPath();
    this.context.moveTo(goal.x - this.px(7), goal.y);
    this.context.lineTo(goal.x + this.px(7), goal.y);
    this.context.moveTo(goal.x, goal.y - this.px(7));
    this.context.lineTo(goal.x, goal.y + this.px(7));
    this.context.stroke();
  }

  private sendGoal(e: MouseEvent): void {
    const box = this.canvas.getBoundingClientRect();
    const right_px = (e.clientX - box.left - box.width / 2) * devicePixelRatio;
    const down_px = (e.clientY - box.top - box.height / 2) * devicePixelRatio;
    sendBehaviour(this.connection, BEHAVIOUR_GO_TO, {
      goal_x_m: this.center.x + right_px / this.scale,
      goal_y_m: this.center.y - down_px / this.scale,
    });
  }
}
