/** Where the robot was, by each source, in the map frame. */
import type { Connection } from "./connection";
import { odometry_t, pose_t, truth_t } from "./messages";

export interface Pose {
  x: number;
  y: number;
  heading: number;
}

const SHORTEST_STEP_M = 0.02;
const LONGEST_PATH = 5000;

export class Path {
  points: Pose[] = [];
  now: Pose | null = null;

  add(pose: Pose): void {
    this.now = pose;
    const last = this.points[this.points.length - 1];
    if (last && Math.hypot(pose.x - last.x, pose.y - last.y) < SHORTEST_STEP_M) return;
    this.points.push(pose);
    if (this.points.length > LONGEST_PATH) this.points = this.points.filter((_, i) => i % 2 === 0);
  }
}

export function compose(a: Pose, b: Pose): Pose {
  const [c, s] = [Math.cos(a.heading), Math.sin(a.heading)];
  return { x: a.x + c * b.x - s * b.y, y: a.y + s * b.x + c * b.y, heading: a.heading + b.heading };
}

export function inverse(a: Pose): Pose {
  const [c, s] = [Math.cos(a.heading), Math.sin(a.heading)];
  return { x: -c * a.x - s * a.y, y: s * a.x - c * a.y, heading: -a.heading };
}

/** The world frame of TRUTH is laid over the map where both are first known. */
export class Poses {
  estimate = new Path();
  odometry = new Path();
  truth = new Path();
  newest: pose_t | null = null;
  private T_map_world: Pose | null = null;

  constructor(connection: Connection) {
    connection.on("POSE", pose_t, (m) => {
      this.newest = m;
      this.estimate.add({ x: m.x_m, y: m.y_m, heading: m.heading_rad });
    });
    connection.on("ODOMETRY", odometry_t, (m) => {
      this.odometry.add({ x: m.x_m, y: m.y_m, heading: m.heading_rad });
    });
    connection.on("TRUTH", truth_t, (m) => this.takeTruth(m));
    connection.onReset(() => {
      [this.estimate, this.odometry, this.truth] = [new Path(), new Path(), new Path()];
      this.T_map_world = null;
      this.newest = null;
    });
  }

  /** Between estimate and truth; null where one is unknown. */
  error_m(): number | null {
    const [a, b] = [this.estimate.now, this.truth.now];
    return a && b ? Math.hypot(a.x - b.x, a.y - b.y) : null;
  }

  private takeTruth(m: truth_t): void {
    const true_pose = { x: m.true_x_m, y: m.true_y_m, heading: m.true_heading_rad };
    if (!this.T_map_world && this.estimate.now) {
      this.T_map_world = compose(this.estimate.now, inverse(true_pose));
    }
    if (this.T_map_world) this.truth.add(compose(this.T_map_world, true_pose));
  }
}
