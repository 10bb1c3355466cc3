/** Safety, battery, pilot and the table of services. */
import type { Connection } from "./connection";
import { element, rowOf, say } from "./dom";
import { create_state_t, health_t, pilot_state_t, pose_t, safety_state_t } from "./messages";

const SAFETY_NAMES = ["RUN", "SLOW", "STOP", "E-STOP"];
const PILOT_NAMES = ["idle", "driving", "recovering", "waiting", "done", "failed"];
const POSE_NAMES = ["starting", "tracking", "lost", "relocalised"];
const STALE_MS = 2500;

export class StatePanels {
  private readonly health = new Map<string, { message: health_t; at: number }>();
  private safetyAt = 0;

  constructor(connection: Connection) {
    connection.on("SAFETY_STATE", safety_state_t, (m) => this.showSafety(m));
    connection.on("CREATE_STATE", create_state_t, (m) => this.showBattery(m));
    connection.on("PILOT_STATE", pilot_state_t, (m) => {
      say("pilot_state", `${PILOT_NAMES[m.state] ?? "?"} ${m.explanation}`);
    });
    connection.on("POSE", pose_t, (m) => {
      const degrees = ((m.heading_rad * 180) / Math.PI).toFixed(0);
      say("pose", `${POSE_NAMES[m.state] ?? "?"} · ${m.x_m.toFixed(2)}, ${m.y_m.toFixed(2)} m · ${degrees}°`);
    });
    connection.on("HEALTH", health_t, (message) => this.health.set(message.service, { message, at: Date.now() }));
    connection.onReset(() => this.health.clear());
    setInterval(() => this.showHealth(), 500);
  }

  private showSafety(m: safety_state_t): void {
    this.safetyAt = Date.now();
    element("safety").dataset.state = SAFETY_NAMES[m.state] ?? "";
    say("safety", SAFETY_NAMES[m.state] ?? "?");
    say("reasons", m.reason_text);
    say("granted", `${m.granted_speed_mps.toFixed(2)} m/s · ${m.granted_turn_rate_radps.toFixed(2)} rad/s`);
  }

  private showBattery(m: create_state_t): void {
    const ratio = m.battery_capacity_ah > 0 ? m.battery_charge_ah / m.battery_capacity_ah : 0;
    say("battery", `${(100 * ratio).toFixed(0)} % · ${m.battery_v.toFixed(1)} V`);
  }

  private showHealth(): void {
    if (Date.now() - this.safetyAt > STALE_MS) {
      element("safety").dataset.state = "";
      say("safety", "NO SAFETY");
      say("reasons", "safety_svc is not heard");
    }
    const rows = [...this.health.entries()].sort(([a], [b]) => a.localeCompare(b)).map(([service, { message, at }]) => {
      const dropped = message.channels.reduce((sum, c) => sum + Number(c.missed + c.undecodable), 0);
      const slowest_ms = 1000 * Math.max(0, ...message.channels.map((c) => c.handler_mean_s));
      const row = rowOf(
        service,
        `${(100 * message.cpu_ratio).toFixed(0)} %`,
        `${slowest_ms.toFixed(1)}`,
        `${dropped}`,
        `${((Date.now() - at) / 1000).toFixed(1)}`,
      );
      row.classList.toggle("stale", Date.now() - at > STALE_MS);
      row.title = message.last_error;
      return row;
    });
    element("health").replaceChildren(...rows);
  }
}
