"""Landmarks with the lights on and off: the same room, drive and seed recorded at full light and
at a twentieth of it, and the landmarks of the two compared frame by frame.

A landmark of the light is there in the dark too if the same frame shows one of its kind within
5 cm, each counted once. Those flagged as moving are left out, as they are "at rest": what has just
come into view is flagged until it is known to stand. The other figures are rwlog score's. "In
sight" are the corners and poles of the scenario that the frame's scan comes near to, four of them
at each side of a door in its frame; "found" is the share of them that a landmark at rest shows.
The simulated depth camera brings its own light, as the real one does, so that what this shows is
that no colour gets into the decision; what sunlight does to a real camera it does not show.
"""
import math
import pathlib
import re
from collections import defaultdict

from recordings import sightings, simulated
from report_parts.results import Result, Table, at_least, at_most

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENARIOS = ROOT / "services" / "simulator" / "scenarios"
TITLE = "Landmarks in the dark"
TARGETS = ["landmark_svc", "rwlog", "simulator"]
NAMES = ("living_room", "apartment", "dark_room", "crowd")
LAMP_LEVELS = {"light": 1.0, "dark": 0.05}
SAME_PLACE_M = 0.05
CAMERA = ("--camera_size", "640x480")
FIGURES = {"a frame": "landmarks_per_frame", "at rest": "landmarks_at_rest_per_frame",
           "in sight": "landmarks_in_sight_per_frame", "found": "landmarks_in_sight_found",
           "precision": "landmarks_precision",
           "repeat to 2 m": "landmarks_repeat_std_to_2m",
           "repeat 2 to 3.5 m": "landmarks_repeat_std_2m_to_3.5m",
           "viewpoints": "landmarks_viewpoint_median_m"}


def lit(name, lamp_level):
    """A copy of the scenario with that much light."""
    text = re.sub(r"(?m)^lamp_level = .*\n", "", (SCENARIOS / f"{name}.toml").read_text())
    path = simulated.scratch(f"{name}_{lamp_level}.toml")
    path.write_text(text.replace("[light]\n", f"[light]\nlamp_level = {lamp_level}\n", 1))
    return path


def replay_of(bin_folder, name, lamp_level):
    log = simulated.drive(bin_folder, lit(name, lamp_level), "loop1", *CAMERA)
    return simulated.replayed(bin_folder, "landmark_svc", log)


def frames_of(bin_folder, log):
    """{utime: [(kind, x, y)]} at rest, in the robot frame."""
    frames = defaultdict(list)
    for row in sightings.rows_of(bin_folder, log, "LANDMARKS", "--list", "landmarks"):
        if row["moving"] == "0":
            range_m, bearing_rad = float(row["range_m"]), float(row["bearing_rad"])
            frames[int(row["utime"])].append((row["kind"], range_m * math.cos(bearing_rad),
                                              range_m * math.sin(bearing_rad)))
    return frames


def count_again(wanted, offered):
    """How many of `wanted` have one of `offered` to themselves."""
    left = list(offered)
    count = 0
    for kind, x_m, y_m in wanted:
        near = [each for each in left if each[0] == kind
                and math.dist(each[1:], (x_m, y_m)) <= SAME_PLACE_M]
        if near:
            left.remove(min(near, key=lambda each: math.dist(each[1:], (x_m, y_m))))
            count += 1
    return count


def share_again(light, dark):
    again = sum(count_again(wanted, dark.get(utime, [])) for utime, wanted in light.items())
    return again / max(sum(map(len, light.values())), 1)


def run(bin_folder):
    bin_folder = pathlib.Path(bin_folder)
    table = Table("One round (loop1), 640x480; spreads in metres",
                  ["room, light", "again in the dark", *FIGURES], [], digits=4)
    bars = []
    for name in NAMES:
        logs = {light: replay_of(bin_folder, name, level) for light, level in LAMP_LEVELS.items()}
        share = share_again(*(frames_of(bin_folder, log) for log in logs.values()))
        for light, log in logs.items():
            scores = simulated.scores(bin_folder, log)
            figures = {column: scores.get(key, math.nan) for column, key in FIGURES.items()}
            table.rows.append([f"{name}, {light}", share if light == "dark" else "",
                               *figures.values()])
            bars += [at_least(f"{name}, {light}: precision", figures["precision"], 0.95),
                     at_least(f"{name}, {light}: landmarks a frame", figures["a frame"], 5, 2),
                     at_most(f"{name}, {light}: repeat to 2 m", figures["repeat to 2 m"], 0.01, 4),
                     at_most(f"{name}, {light}: repeat 2 to 3.5 m",
                             figures["repeat 2 to 3.5 m"], 0.02, 4),
                     at_most(f"{name}, {light}: viewpoints", figures["viewpoints"], 0.03, 4)]
        bars.append(at_least(f"{name}: again in the dark", share, 0.95, 4))
    return Result([table], bars)
