/** How well the filter does and what each service costs, over the last minutes. */
import uPlot from "uplot";
import type { Connection } from "./connection";
import { element } from "./dom";
import { health_t, pose_t } from "./messages";
import type { Poses } from "./poses";

const LONGEST = 600;
const SHORTEST_INTERVAL_S = 0.2;
const COLORS = ["#ffb454", "#58a6ff", "#3fc964", "#f778ba", "#d2a8ff", "#3ddbd9", "#ff8f6b", "#a0a7b4", "#fff45c"];

class Plot {
  private readonly plot: uPlot;
  private columns: (number | null)[][];

  constructor(
    private readonly host: HTMLElement,
    labels: string[],
    colors = labels.map((_, i) => i % COLORS.length),
  ) {
    this.columns = [[], ...labels.map(() => [])];
    const axis = { stroke: "#8b929e", grid: { stroke: "#262b34" }, ticks: { show: false }, font: "10px system-ui" };
    this.plot = new uPlot(
      {
        ...this.size(),
        cursor: { show: false },
        legend: { show: false },
        scales: { x: { time: false } },
        axes: [{ ...axis, size: 20 }, { ...axis, size: 44 }],
        series: [{}, ...labels.map((label, i) => ({
          label,
          stroke: COLORS[colors[i]],
          width: 1.2,
          spanGaps: true,
          points: { show: false },
        }))],
      },
      this.columns as uPlot.AlignedData,
      host,
    );
    new ResizeObserver(() => this.plot.setSize(this.size())).observe(host);
  }

  add(time_s: number, values: (number | null)[]): void {
    [time_s, ...values].forEach((value, i) => this.columns[i].push(value));
    if (this.columns[0].length > LONGEST) this.columns.forEach((column) => column.shift());
    this.plot.setData(this.columns as uPlot.AlignedData);
  }

  clear(): void {
    this.columns = this.columns.map(() => []);
    this.plot.setData(this.columns as uPlot.AlignedData);
  }

  private size(): { width: number; height: number } {
    return { width: Math.max(50, this.host.clientWidth), height: Math.max(40, this.host.clientHeight - 2) };
  }
}

/** The 95 % band of chi squared / its degrees of freedom (Wilson and Hilferty 1931). */
function nisBand(dof: number): [number, number] {
  const at = (z: number) => (1 - 2 / (9 * dof) + z * Math.sqrt(2 / (9 * dof))) ** 3;
  return [Math.max(0, at(-1.96)), at(1.96)];
}

const SERVICES = ["kinect_pub", "landmark_svc", "segment_svc", "ekf_svc", "safety_svc", "pilot_svc", "create_driver", "simulator", "viewer"];

export class Plots {
  private first_utime = 0;
  private last_s = -1;

  constructor(connection: Connection, poses: Poses) {
    const nis = new Plot(element("plot_nis"), ["NIS / dof", "95 % low", "95 % high"], [0, 1, 1]);
    const sigma = new Plot(element("plot_sigma"), ["sigma x m", "sigma y m", "error to truth m"]);
    const cost = new Plot(element("plot_cost"), SERVICES);
    const latency = new Plot(element("plot_latency"), SERVICES);
    connection.on("POSE", pose_t, (m, utime) => {
      const time_s = this.seconds(utime);
      if (time_s - this.last_s < SHORTEST_INTERVAL_S) return;
      this.last_s = time_s;
      const [low, high] = m.nis_dof > 0 ? nisBand(m.nis_dof) : [null, null];
      nis.add(time_s, [m.nis_dof > 0 ? m.nis_ratio : null, low, high]);
      sigma.add(time_s, [Math.sqrt(m.covariance_x_x_m2), Math.sqrt(m.covariance_y_y_m2), poses.error_m()]);
    });
    connection.on("HEALTH", health_t, (m, utime) => {
      const service = SERVICES.indexOf(m.service);
      if (service < 0) return;
      const row = (value: number) => SERVICES.map((_, i) => (i === service ? value : null));
      cost.add(this.seconds(utime), row(100 * m.cpu_ratio));
      latency.add(this.seconds(utime), row(1000 * Math.max(0, ...m.channels.map((c) => c.handler_mean_s))));
    });
    connection.onReset(() => {
      this.first_utime = 0;
      this.last_s = -1;
      [nis, sigma, cost, latency].forEach((plot) => plot.clear());
    });
  }

  private seconds(utime: number): number {
    if (this.first_utime === 0) this.first_utime = utime;
    return (utime - this.first_utime) / 1e6;
  }
}
