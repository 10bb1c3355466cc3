/** Driving by hand, the emergency stop and the pilot's behaviours. */
import { sendBehaviour } from "./behaviour";
import type { Connection } from "./connection";
import { element } from "./dom";
import { estop_t, safety_reset_t, safety_state_t, velocity_request_t } from "./messages";

const REPEAT_MS = 100;
const VALID_US = 300_000n;
const HELD_REPEAT_MS = 500;
const KEYS: Record<string, [number, number]> = {
  KeyW: [1, 0], ArrowUp: [1, 0], KeyS: [-1, 0], ArrowDown: [-1, 0],
  KeyA: [0, 1], ArrowLeft: [0, 1], KeyD: [0, -1], ArrowRight: [0, -1],
};

export class Drive {
  private readonly keys = new Set<string>();
  private stick: [number, number] | null = null;
  private timer = 0;
  private heldTimer = 0;
  private latch_id = 0n;

  constructor(private readonly connection: Connection) {
    connection.on("SAFETY_STATE", safety_state_t, (m) => (this.latch_id = m.latch_id));
    this.listenToKeys();
    this.listenToStick();
    this.listenToButtons();
  }

  private listenToKeys(): void {
    addEventListener("keydown", (e) => {
      if (e.code === "Space") {
        e.preventDefault();
        e.stopPropagation();
        if (!e.repeat) this.press("space bar");
      } else if (e.code in KEYS && !(e.target as HTMLElement).matches("input, select")) {
        e.preventDefault();
        this.keys.add(e.code);
        this.go();
      }
    }, { capture: true });
    addEventListener("keyup", (e) => {
      if (e.code === "Space") {
        e.preventDefault();
        this.release();
      }
      if (this.keys.delete(e.code)) this.go();
    }, { capture: true });
    const letGo = () => {
      this.keys.clear();
      this.stick = null;
      this.release();
      this.go();
    };
    addEventListener("blur", letGo);
    document.addEventListener("visibilitychange", letGo);
  }

  private listenToStick(): void {
    const pad = element("stick");
    const knob = element("knob");
    const move = (e: PointerEvent) => {
      const box = pad.getBoundingClientRect();
      const side = (value: number) => Math.max(-1, Math.min(1, value));
      const right = side((2 * (e.clientX - box.left)) / box.width - 1);
      const down = side((2 * (e.clientY - box.top)) / box.height - 1);
      knob.style.transform = `translate(${right * 70}%, ${down * 70}%)`;
      this.stick = [-down, -right];
      this.go();
    };
    const end = () => {
      knob.style.transform = "";
      this.stick = null;
      this.go();
    };
    pad.addEventListener("pointerdown", (e) => {
      pad.setPointerCapture(e.pointerId);
      move(e);
    });
    pad.addEventListener("pointermove", (e) => {
      if (this.stick) move(e);
    });
    for (const name of ["pointerup", "pointercancel", "lostpointercapture"]) pad.addEventListener(name, end);
  }

  private listenToButtons(): void {
    const stop = element("estop");
    stop.addEventListener("pointerdown", () => this.press("button"));
    stop.addEventListener("pointerup", () => this.release());
    stop.addEventListener("pointerleave", () => this.release());
    stop.addEventListener("keydown", (e) => {
      if (e.code === "Enter") this.pressOnce("button");
    });
    element("reset").addEventListener("click", () =>
      this.connection.send("SAFETY_RESET", safety_reset_t, { utime: 0n, seq: 0n, source: "viewer", latch_id: this.latch_id }));
    ["stop", "wander", "circle"].forEach((name, behaviour) =>
      element(`pilot_${name}`).addEventListener("click", () => sendBehaviour(this.connection, behaviour)));
  }

  private press(cause: string): void {
    this.pressOnce(cause);
    clearInterval(this.heldTimer);
    this.heldTimer = window.setInterval(() => this.pressOnce(cause), HELD_REPEAT_MS);
  }

  private pressOnce(cause: string): void {
    this.connection.send("ESTOP", estop_t, { utime: 0n, seq: 0n, source: "viewer", held: 1, cause });
  }

  private release(): void {
    if (this.heldTimer === 0) return;
    clearInterval(this.heldTimer);
    this.heldTimer = 0;
    this.connection.send("ESTOP", estop_t, { utime: 0n, seq: 0n, source: "viewer", held: 0, cause: "released" });
  }

  private wish(): [number, number] {
    if (this.stick) return this.stick;
    const sum: [number, number] = [0, 0];
    for (const key of this.keys) {
      sum[0] += KEYS[key][0];
      sum[1] += KEYS[key][1];
    }
    return sum;
  }

  /** Repeats while a key or the stick is held; one zero when all are let go. */
  private go(): void {
    const isHeld = this.keys.size > 0 || this.stick !== null;
    if (isHeld && this.timer === 0) this.timer = window.setInterval(() => this.request(), REPEAT_MS);
    if (!isHeld && this.timer === 0) return;
    if (!isHeld) {
      clearInterval(this.timer);
      this.timer = 0;
    }
    this.request();
  }

  private request(): void {
    const [forward, left] = this.wish();
    const speed = Number(element<HTMLInputElement>("speed_limit").value);
    this.connection.send("VEL_REQUEST", velocity_request_t, {
      utime: 0n,
      seq: 0n,
      source: "viewer",
      priority: 50,
      valid_for_us: VALID_US,
      requested_speed_mps: speed * forward,
      requested_turn_rate_radps: 4 * speed * left,
    });
  }
}
