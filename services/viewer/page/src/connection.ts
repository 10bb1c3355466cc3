/** The page's side of the WebSocket: messages by channel in, commands and orders out. */
import type { Codec } from "./wire";

export interface Status {
  mode: "live" | "replay";
  log?: string;
  position_s?: number;
  length_s?: number;
  playing?: boolean;
  speed?: number;
  control: boolean;
  dropped: number;
  refusal: string;
  logs: string[];
}

const RETRY_MS = 1000;

interface Listeners {
  decode: (bytes: Uint8Array) => unknown;
  handles: ((message: unknown, utime: number) => void)[];
}

export class Connection {
  private socket?: WebSocket;
  private readonly listeners = new Map<string, Listeners>();
  private statusHandlers: ((status: Status | null) => void)[] = [];
  private resetHandlers: (() => void)[] = [];
  private source = "";
  private lastPosition_s = 0;
  undecodable = 0;

  /** `handle(message, time [us])`. A message that does not decode is counted and dropped. */
  on<T>(channel: string, codec: Codec<T>, handle: (message: T, utime: number) => void): void {
    const listeners = this.listeners.get(channel) ?? { decode: codec.decode, handles: [] };
    listeners.handles.push((message, utime) => handle(message as T, utime));
    this.listeners.set(channel, listeners);
  }

  /** Null: the server is gone. */
  onStatus(handle: (status: Status | null) => void): void {
    this.statusHandlers.push(handle);
  }

  /** What was gathered belongs to another source or another time: forget it. */
  onReset(handle: () => void): void {
    this.resetHandlers.push(handle);
  }

  open(): void {
    const token = new URLSearchParams(location.hash.slice(1)).get("token") ?? "";
    this.socket = new WebSocket(`ws://${location.host}/bus?token=${encodeURIComponent(token)}`);
    this.socket.binaryType = "arraybuffer";
    this.socket.onmessage = (event) => this.take(event.data);
    this.socket.onclose = () => {
      this.statusHandlers.forEach((handle) => handle(null));
      setTimeout(() => this.open(), RETRY_MS);
    };
  }

  send<T>(channel: string, codec: Codec<T>, message: T): void {
    if (this.socket?.readyState !== WebSocket.OPEN) return;
    const name = new TextEncoder().encode(channel);
    this.socket.send(new Uint8Array([name.length, ...name, ...codec.encode(message)]));
  }

  order(text: string): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(text);
  }

  private take(data: string | ArrayBuffer): void {
    if (typeof data === "string") this.takeStatus(JSON.parse(data) as Status);
    else this.takeMessage(new Uint8Array(data));
  }

  private takeStatus(status: Status): void {
    const source = `${status.mode} ${status.log ?? ""}`;
    const position_s = status.position_s ?? 0;
    if (source !== this.source || position_s < this.lastPosition_s - 0.001) {
      this.resetHandlers.forEach((handle) => handle());
    }
    this.source = source;
    this.lastPosition_s = position_s;
    this.statusHandlers.forEach((handle) => handle(status));
  }

  private takeMessage(bytes: Uint8Array): void {
    const first = 1 + bytes[0];
    const channel = new TextDecoder().decode(bytes.subarray(1, first));
    const utime = Number(new DataView(bytes.buffer).getBigInt64(first));
    const listeners = this.listeners.get(channel);
    if (!listeners) return;
    try {
      const message = listeners.decode(bytes.subarray(first + 8));
      listeners.handles.forEach((handle) => handle(message, utime));
    } catch (error) {
      if (!(error instanceof RangeError)) throw error;
      ++this.undecodable;
    }
  }
}
