"""From one frame's landmarks to the map of a room: a frame from above, how many landmarks are bad
by method, and the map after one round beside the truth.
"""
import math
import pathlib

from plotting.plan import Marks, plan
from recordings import messages, simulated
from report_parts.results import Bar, Figure, Result, Table, at_most

TITLE = "One frame from above, and the map of a round"
TARGETS = ["ekf_svc", "landmark_svc", "rwlog", "simulator"]
FRAME = 100
SCENARIOS = ("living_room", "apartment")
METHODS = {"thesis, threshold 100": ("--method", "thesis"), "ours": ("--method", "disparity")}
PATH_MOST_M = 0.05


def numbers(row, name):
    return [float(word) for word in row[name].split(";")] if row[name] else []


def frame_plan(row):
    """The frame from above; the robot looks up the page."""
    scan = zip(numbers(row, "scan_x_m"), numbers(row, "scan_y_m"))
    places = [(r * math.cos(b), r * math.sin(b)) for r, b in
              zip(numbers(row, "landmarks.range_m"), numbers(row, "landmarks.bearing_rad"))]
    return plan("One frame from above", [
        Marks("surfaces 10 to 60 cm up", [(-y, x) for x, y in scan], "#8a949d",
              radius_px=1.6),
        Marks("landmarks", [(-y, x) for x, y in places], "#d55e00", radius_px=5.0),
        Marks("robot", [(0.0, 0.0)], "#0072b2", radius_px=7.0)])


def bad_landmarks(bin_folder):
    table = Table("Landmarks a frame, judged by the true ones (Figure 5.7)",
                  ["scenario", "method", "a frame", "of those bad", "precision", "RMS error, m"],
                  [])
    for scenario in SCENARIOS:
        for name, options in METHODS.items():
            seen = simulated.replayed(bin_folder, "landmark_svc",
                                      simulated.drive(bin_folder, scenario), *options)
            score = simulated.scores(bin_folder, seen)
            table.rows.append([scenario, name, *(score[f"landmarks_{each}"] for each in
                                                 ("at_rest_per_frame", "false_per_frame",
                                                  "precision", "error_rms_m"))])
    return table


def run(bin_folder):
    bin_folder = pathlib.Path(bin_folder)
    blocks, bars = [], []
    seen = simulated.replayed(bin_folder, "landmark_svc",
                              simulated.drive(bin_folder, "living_room"))
    blocks += [Figure("A frame of the living room and its landmarks (Figure 5.6, left).",
                      simulated.picture(bin_folder, "landmarks-png", seen, "--frame", str(FRAME)),
                      "frame_view"),
               Figure("The same frame from above (Figure 5.6, right); the robot looks up the page.",
                      frame_plan(messages.landmarks_of_frame(bin_folder, seen, FRAME)), "frame_plan"),
               bad_landmarks(bin_folder)]
    table = Table("Path and map after one round, RMS after the best alignment, m",
                  ["scenario", "path", "odometry alone", "map", "landmarks in the map"], [])
    for scenario in SCENARIOS:
        log = simulated.mapped(bin_folder, scenario)
        score = simulated.scores(bin_folder, log)
        path_m, odometry_m = score["ate_aligned_m"], score["odometry_ate_aligned_m"]
        table.rows.append([scenario, path_m, odometry_m, score["map_aligned_m"],
                           f"{score['landmarks']:.0f}"])
        bars += [at_most(f"{scenario}: path, m", path_m, PATH_MOST_M),
                 Bar(f"{scenario}: path better than odometry's", f"{path_m:.3f} against"
                     f" {odometry_m:.3f} m", path_m < odometry_m)]
    picture = simulated.picture(bin_folder, "map-png", simulated.mapped(bin_folder, "living_room"),
                                "--title", "living room, one round")
    return Result([*blocks, table,
                   Figure("The living room mapped in one round, with 95 % ellipses, beside the true "
                          "landmarks and paths.", picture, "map_living_room")], bars)
