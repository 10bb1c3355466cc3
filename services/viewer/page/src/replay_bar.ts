/** LIVE or REPLAY, and everything to move about in a log. */
import type { Connection, Status } from "./connection";
import { element, say } from "./dom";

const clock = (s: number) => `${Math.floor(s / 60)}:${(s % 60).toFixed(1).padStart(4, "0")}`;

export class ReplayBar {
  private readonly logs = element<HTMLSelectElement>("logs");
  private readonly seek = element<HTMLInputElement>("seek");
  private seeking = false;
  private playing = false;

  constructor(private readonly connection: Connection) {
    connection.onStatus((status) => this.show(status));
    this.logs.addEventListener("change", () => connection.order(this.logs.value ? `open ${this.logs.value}` : "live"));
    element("play").addEventListener("click", () => connection.order(this.playing ? "pause" : "play"));
    element("step").addEventListener("click", () => connection.order("step"));
    element<HTMLSelectElement>("speed").addEventListener("change", (e) =>
      connection.order(`speed ${(e.target as HTMLSelectElement).value}`));
    this.seek.addEventListener("input", () => (this.seeking = true));
    this.seek.addEventListener("change", () => {
      this.seeking = false;
      connection.order(`seek ${this.seek.value}`);
    });
  }

  private show(status: Status | null): void {
    const mode = status?.mode ?? "offline";
    document.body.dataset.mode = mode;
    document.body.dataset.control = String(mode === "live" && status?.control === true);
    say("mode", mode.toUpperCase());
    if (status === null) return;
    this.playing = status.playing ?? false;
    this.showLogs(status);
    say("play", this.playing ? "Pause" : "Play");
    if (status.mode === "replay" && !this.seeking) {
      this.seek.max = String(status.length_s);
      this.seek.value = String(status.position_s);
    }
    say("position", status.mode === "replay" ? `${clock(status.position_s ?? 0)} / ${clock(status.length_s ?? 0)}` : "");
    say("refusal", status.refusal);
    say("dropped", status.control ? "" : "viewing only");
  }

  private showLogs(status: Status): void {
    const names = ["", ...status.logs];
    if (names.length !== this.logs.options.length || names.some((name, i) => this.logs.options[i].value !== name)) {
      this.logs.replaceChildren(...names.map((name) => new Option(name || "live", name)));
    }
    if (document.activeElement !== this.logs) this.logs.value = status.log ?? "";
  }
}
