/** What the pilot is asked to do. */
import type { Connection } from "./connection";
import { pilot_goal_t } from "./messages";

export function sendBehaviour(connection: Connection, behaviour: number, more: Partial<pilot_goal_t> = {}): void {
  connection.send("PILOT_GOAL", pilot_goal_t, {
    utime: 0n,
    seq: 0n,
    source: "viewer",
    behaviour,
    goal_speed_mps: 0,
    goal_duration_s: 0,
    goal_x_m: 0,
    goal_y_m: 0,
    circle_distance_m: 0.4,
    circle_sense: 1,
    circle_rounds_ratio: 1,
    ...more,
  });
}
