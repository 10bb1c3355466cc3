"""Landmarks on people and in mirrors, before and after what is there to remove them.

People: the simulated crowd, where seven walk about; where each is, is known. A landmark within
0.4 m of a walker's axis (radius 0.25 m) is on that walker, unless it is where the truth has an edge
of a thing he passes; landmark_svc should flag it as moving.
Mirror: the living room's hangs on its east wall; a landmark in line with it and behind the wall is
one of the mirror's world.
"""
import math
import pathlib
import tomllib

from plotting.plan import Marks, plan
from recordings import sightings, simulated
from recordings.messages import rows_of
from report_parts.results import Figure, Result, Table, at_most

ROOT = pathlib.Path(__file__).resolve().parents[2]
TITLE = "Landmarks on people and in the mirror"
TARGETS = ["landmark_svc", "rwlog", "simulator"]
ON_WALKER_M = 0.4
AT_THING_M = 0.1
SEEDS = ("1", "2", "3")
DRAWN_S = 60.0
METHODS = {"thesis, threshold 100": ("--method", "thesis"), "ours": ("--method", "disparity")}
MIRROR_X_M, MIRROR_Y_M = 6.0, (2.8, 3.6)
BEHIND_WALL_M = 0.15


class Walker:
    def __init__(self, table):
        self.way_m = [*table["way_m"], table["way_m"][0]]
        self.legs_m = [math.dist(a, b) for a, b in zip(self.way_m, self.way_m[1:])]
        self.speed_mps, self.start_m = table["speed_mps"], table.get("start_m", 0.0)

    def at(self, time_s):
        gone_m = (self.start_m + self.speed_mps * time_s) % sum(self.legs_m)
        for a, b, leg_m in zip(self.way_m, self.way_m[1:], self.legs_m):
            if gone_m <= leg_m:
                return [p + (q - p) * gone_m / leg_m for p, q in zip(a, b)]
            gone_m -= leg_m
        return self.way_m[-1]


def walkers():
    path = ROOT / "services" / "simulator" / "scenarios" / "crowd.toml"
    return [Walker(table) for table in tomllib.loads(path.read_text())["walker"]]


def things_of(bin_folder, log):
    """Where the edges of what stands are."""
    rows = rows_of(bin_folder, log, "TRUTH", "--list", "true_landmarks")
    return {(float(row["true_x_m"]), float(row["true_y_m"])) for row in rows}


def is_on_walker(seen, people, things):
    place = seen.x_m, seen.y_m
    return (any(math.dist(walker.at(seen.time_s), place) < ON_WALKER_M for walker in people) and
            all(math.dist(thing, place) > AT_THING_M for thing in things))


def crowd_of(bin_folder, options):
    """What was seen on two rounds with each seed, by group."""
    groups = {"kept": [], "removed": [], "kept, on a person": [], "removed, on a person": []}
    for seed in SEEDS:
        log = simulated.drive(bin_folder, "crowd", "loop2", "--seed", seed)
        seen = sightings.of_log(bin_folder, simulated.replayed(bin_folder, "landmark_svc", log,
                                                               *options))
        people, things = walkers(), things_of(bin_folder, log)
        for each in seen:
            name = "removed" if each.moving else "kept"
            on_walker = is_on_walker(each, people, things)
            groups[name + (", on a person" if on_walker else "")].append(each)
    return groups


def is_in_mirror(seen):
    if seen.x_m < MIRROR_X_M + BEHIND_WALL_M:
        return False
    share = (MIRROR_X_M - seen.robot_x_m) / (seen.x_m - seen.robot_x_m)
    y_m = seen.robot_y_m + share * (seen.y_m - seen.robot_y_m)
    return MIRROR_Y_M[0] < y_m < MIRROR_Y_M[1]


def mirror_of(bin_folder, options):
    """Landmarks in the mirror, and all of them."""
    log = simulated.drive(bin_folder, "living_room")
    seen = sightings.of_log(bin_folder, simulated.replayed(bin_folder, "landmark_svc", log,
                                                           *options))
    return sum(map(is_in_mirror, seen)), len(seen)


def crowd_plan(groups):
    def points(name):
        return [(each.x_m, each.y_m) for each in groups[name] if each.time_s < DRAWN_S]
    return plan("Landmarks in the crowd, the first minute of driving", [
        Marks("removed, no person near", points("removed"), "#e3b23c", radius_px=3.5),
        Marks("kept", points("kept"), "#3a3a3a", radius_px=1.5),
        Marks("removed, on a person", points("removed, on a person"), "#0b61a4", radius_px=2.0),
        Marks("kept, on a person", points("kept, on a person"), "#b3132b", radius_px=5.0)])


def run(bin_folder):
    bin_folder = pathlib.Path(bin_folder)
    people = Table(f"Sightings of landmarks in the crowd, two rounds, {len(SEEDS)} seeds",
                   ["method", "all", "on people", "of those kept", "elsewhere",
                    "of those removed"], [],
                   note="Removed: flagged as moving; a landmark is kept once it has stood a while.")
    mirror = Table("Sightings behind the living room's mirror, one round",
                   ["method", "all", "in the mirror"], [])
    for name, options in METHODS.items():
        groups = crowd_of(bin_folder, options)
        count = {key: len(group) for key, group in groups.items()}
        on_people = count["kept, on a person"] + count["removed, on a person"]
        elsewhere = count["kept"] + count["removed"]
        people.rows.append([name, str(on_people + elsewhere), str(on_people),
                            str(count["kept, on a person"]), str(elsewhere),
                            f"{count['removed'] / max(elsewhere, 1):.1%}"])
        in_mirror, total = mirror_of(bin_folder, options)
        mirror.rows.append([name, str(total), str(in_mirror)])
    figure = Figure("The crowd from above, ours: what is flagged as moving, and what is kept for "
                    "the map. Things that come into view are flagged for a moment too.",
                    crowd_plan(groups), "people_removed")
    return Result([people, figure, mirror],
                  [at_most("ours: sightings on people kept", count["kept, on a person"], 0, 0),
                   at_most("ours: sightings in the mirror", in_mirror, 0, 0)])
