/** All that is drawn besides the colour picture and the cloud. */
import type { Connection } from "./connection";
import { DepthPanel } from "./depth_panel";
import type { Frames } from "./frames";
import { MapPanel } from "./map_panel";
import { Plots } from "./plots";
import { Poses } from "./poses";

export function openInstruments(connection: Connection, frames: Frames): void {
  const poses = new Poses(connection);
  new MapPanel(connection, poses);
  new Plots(connection, poses);
  new DepthPanel(connection, frames);
}
