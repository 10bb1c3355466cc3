/** The page: one connection, and the panels that look at it. */
import { CameraPanel } from "./camera_panel";
import { Connection } from "./connection";
import { DepthPanel } from "./depth_panel";
import { Drive } from "./drive";
import { Frames } from "./frames";
import { MapPanel } from "./map_panel";
import { Plots } from "./plots";
import { Poses } from "./poses";
import { ReplayBar } from "./replay_bar";
import { StatePanels } from "./state_panels";

const connection = new Connection();
new ReplayBar(connection);
new Drive(connection);
new StatePanels(connection);
const poses = new Poses(connection);
new MapPanel(connection, poses);
new Plots(connection, poses);
const frames = new Frames(connection);
new CameraPanel(connection, frames);
new DepthPanel(connection, frames);
connection.open();

/** Its library is larger than all the rest, and starting WebGL takes long: first a picture. */
frames.onceShown(async () => {
  try {
    const { CloudPanel } = await import("./cloud_panel");
    new CloudPanel(connection, frames);
  } catch {
    document.body.dataset.webgl = "none"; // the rest of the page does without
  }
});
