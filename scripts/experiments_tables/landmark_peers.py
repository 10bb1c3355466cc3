"""Landmarks seen again half a second later: ours, the thesis's, and what edge pictures and features
of others give on the same frames, with the true camera poses.

A place of one frame should be seen again if it is well inside the later frame's view, whether
something hides it or not, and is if a place of the later frame lies within 5 cm. Of OpenCV's Canny
on depth and PCL's organised edges (its occluding ones; parameters as they come) every upright
connected component makes a place. A keypoint of ORB (1000 at most, with depth) must match by its
descriptor. Times are processor time of the detector alone, without making places and point clouds.
"""
import os
import pathlib

from recordings import simulated
from recordings.programs import run_quietly
from report_parts.results import Result, Table

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = pathlib.Path(os.environ.get("ROOMWISE_DATA", ROOT / ".." / "shared" / "data"))
SEQUENCE = "rgbd_7scenes_redkitchen_000_119"
TITLE = "Landmarks seen again, beside Canny, PCL and ORB"
TARGETS = ["landmark_peers", "rwlog", "simulator"]
SECONDS = "20"
NAMES = {"roomwise": "landmark_svc", "thesis": "landmark_svc, method thesis",
         "canny": "Canny on depth (OpenCV)", "pcl": "organised edges (PCL)",
         "orb": "ORB and matching (OpenCV)"}


def table(bin_folder, what, log):
    said = run_quietly(bin_folder.parent / "bench" / "landmark_peers", log)
    measured = {method: map(float, figures)
                for method, *figures in map(str.split, said.splitlines())}
    rows = []
    for method, name in NAMES.items():
        if method not in measured:
            rows.append([name, *["not installed"] * 4])
            continue
        a_frame, again, spread_m, ms = measured[method]
        rows.append([name, f"{a_frame:.1f}", f"{100 * again:.0f} %", f"{100 * spread_m:.1f}",
                     f"{ms:.2f}"])
    return Table(what, ["method", "a frame", "seen again", "apart, cm", "ms a frame"], rows,
                 timing=True)


def run(bin_folder):
    bin_folder = pathlib.Path(bin_folder)
    blocks = [table(bin_folder, f"simulated {scenario}, {SECONDS} s of driving, 640x480",
                    simulated.drive(bin_folder, scenario, "loop1", "--seconds", SECONDS,
                                    "--camera_size", "640x480"))
              for scenario in ("living_room", "apartment")]
    if (DATA / SEQUENCE).exists():
        recorded = simulated.scratch("kitchen.lcmlog")
        run_quietly(bin_folder / "rwlog", "import", "7scenes", DATA / SEQUENCE, "-o", recorded)
        blocks.append(table(bin_folder, "a real Kinect in a kitchen (7-Scenes), 640x480", recorded))
    return Result(blocks)
