"""Landmarks of a real hand-held Kinect, placed in the room by the recorded camera poses: is a
landmark there again half a second later, and at the same place?

A landmark counts as seen again if the later frame shows one of its kind within 5 cm + 2 % of its
range, and it should be seen again if its place is well inside the later frame's view and range
(whether something hides it then is not asked, so the rate is a lower bound). By chance others of
that kind stand there: what the same test finds half a metre beside is told with it. The spread is
that of all sightings linked from frame to frame about their mean, along and across the view; it
holds the recorded poses' own errors, some millimetres to centimetres.
"""
import math
import os
import pathlib

from recordings import simulated
from recordings.messages import rows_of
from recordings.programs import run_quietly
from recordings.sightings import TruePoses
from report_parts.results import Figure, Result, Table, left_out

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = pathlib.Path(os.environ.get("ROOMWISE_DATA", ROOT / ".." / "shared" / "data"))
SEQUENCE = "rgbd_7scenes_redkitchen_000_119"
TITLE = "Landmarks seen again by a real Kinect (7-Scenes)"
TARGETS = ["landmark_svc", "rwlog"]
KINDS = {1: "left edge", 2: "right edge", 3: "convex crease", 4: "concave crease", 5: "pole"}
RANGES_M = ((0.0, 1.5), (1.5, 2.5), (2.5, 3.5), (3.5, 9.0))
LATER_FRAMES = 15
SAME_PLACE_M, SAME_PLACE_PER_RANGE = 0.05, 0.02
VIEW_HALF_ANGLE_RAD = 0.40
VIEW_RANGE_M = (0.8, 3.6)
BESIDE_M = 0.5
PICTURES = (0, 40, 80, 110)


class Seen:
    """A landmark of one frame, in the world."""

    def __init__(self, kind, range_m, bearing_rad, pose):
        x_m, y_m, heading_rad = pose
        self.kind, self.range_m, self.view_rad = kind, range_m, heading_rad + bearing_rad
        self.x_m = x_m + range_m * math.cos(self.view_rad)
        self.y_m = y_m + range_m * math.sin(self.view_rad)

    def reach_m(self):
        return SAME_PLACE_M + SAME_PLACE_PER_RANGE * self.range_m


def frames_of(bin_folder, log):
    """[(pose, [Seen])] in order of time; those flagged as moving are left out."""
    truth = TruePoses(bin_folder, log)
    pose_of = dict(zip(truth.utimes, truth.poses))
    seen = {int(row["utime"]): [] for row in rows_of(bin_folder, log, "LANDMARKS")}
    for row in rows_of(bin_folder, log, "LANDMARKS", "--list", "landmarks"):
        utime = int(row["utime"])
        if row["moving"] == "0" and utime in pose_of:
            seen[utime].append(Seen(int(row["kind"]), float(row["range_m"]),
                                    float(row["bearing_rad"]), pose_of[utime]))
    return [(pose_of[utime], seen[utime]) for utime in sorted(seen) if utime in pose_of]


def is_in_view(x_m, y_m, pose):
    ahead_m, left_m = x_m - pose[0], y_m - pose[1]
    off_rad = math.remainder(math.atan2(left_m, ahead_m) - pose[2], math.tau)
    return (abs(off_rad) < VIEW_HALF_ANGLE_RAD and
            VIEW_RANGE_M[0] < math.hypot(ahead_m, left_m) < VIEW_RANGE_M[1])


def nearest(kind, x_m, y_m, reach_m, offered):
    """The nearest of that kind within reach; None: there is none."""
    near = [each for each in offered if each.kind == kind
            and math.hypot(each.x_m - x_m, each.y_m - y_m) <= reach_m]
    return min(near, key=lambda each: math.hypot(each.x_m - x_m, each.y_m - y_m), default=None)


def again(frames, wanted):
    """(expected, seen again, seen beside by chance) of those that `wanted` says yes to."""
    expected = found = by_chance = 0.0
    for (_, before), (pose, after) in zip(frames, frames[LATER_FRAMES:]):
        for each in filter(wanted, before):
            if not is_in_view(each.x_m, each.y_m, pose):
                continue
            expected += 1
            found += nearest(each.kind, each.x_m, each.y_m, each.reach_m(), after) is not None
            beside = [(each.x_m + BESIDE_M * dx, each.y_m + BESIDE_M * dy)
                      for dx, dy in ((1, 0), (-1, 0), (0, 1), (0, -1))]
            inside = [place for place in beside if is_in_view(*place, pose)]
            hits = sum(nearest(each.kind, *place, each.reach_m(), after) is not None
                       for place in inside)
            by_chance += hits / len(inside) if inside else 0.0
    return expected, found, by_chance


def tracks_of(frames):
    """Sightings linked from each frame to the next."""
    tracks, ends = [], []
    for _, seen in frames:
        free = list(seen)
        following = []
        for track in ends:
            last = track[-1]
            found = nearest(last.kind, last.x_m, last.y_m, last.reach_m(), free)
            if found:
                free.remove(found)
                track.append(found)
                following.append(track)
        fresh = [[each] for each in free]
        tracks += fresh
        ends = following + fresh
    return [track for track in tracks if len(track) >= 5]


def spread_m(tracks):
    """Standard deviation about each track's mean, along and across the view; NaN without any."""
    along = across = count = 0.0
    for track in tracks:
        x_m = sum(each.x_m for each in track) / len(track)
        y_m = sum(each.y_m for each in track) / len(track)
        for each in track:
            c, s = math.cos(each.view_rad), math.sin(each.view_rad)
            along += (c * (each.x_m - x_m) + s * (each.y_m - y_m)) ** 2
            across += (c * (each.y_m - y_m) - s * (each.x_m - x_m)) ** 2
        count += len(track) - 1
    return [math.sqrt(total / count) if count else math.nan for total in (along, across)]


def row(name, frames, tracks, wanted):
    expected, found, by_chance = again(frames, wanted)
    share = (lambda part: f"{100 * part / expected:.0f} %" if expected else "-")
    parts = [part for part in ([each for each in track if wanted(each)] for track in tracks)
             if len(part) >= 2]
    spread = [f"{100 * value:.1f}" if parts else "-" for value in spread_m(parts)]
    sightings = sum(wanted(each) for _, seen in frames for each in seen)
    return [name, str(sightings), f"{expected:.0f}", share(found), share(by_chance), *spread]


def table(method, frames):
    tracks = tracks_of(frames)
    rows = [row("all", frames, tracks, lambda each: True)]
    rows += [row(f"{least:g} to {most:g} m", frames, tracks,
                 lambda each, least=least, most=most: least <= each.range_m < most)
             for least, most in RANGES_M]
    rows += [row(name, frames, tracks, lambda each, kind=kind: each.kind == kind)
             for kind, name in KINDS.items()]
    return Table(f"method {method}, {len(frames)} frames, "
                 f"{sum(len(seen) for _, seen in frames) / len(frames):.1f} landmarks each",
                 ["range or kind", "sightings", "expected again", "seen again", "by chance",
                  "spread along, cm", "across, cm"], rows)


def run(bin_folder):
    bin_folder = pathlib.Path(bin_folder)
    sequence = DATA / SEQUENCE
    if not sequence.exists():
        return left_out(f"the recorded kitchen is not there: {SEQUENCE} in ROOMWISE_DATA")
    recorded = simulated.scratch("kitchen.lcmlog")
    run_quietly(bin_folder / "rwlog", "import", "7scenes", sequence, "-o", recorded)
    ours = simulated.replayed(bin_folder, "landmark_svc", recorded)
    thesis = simulated.replayed(bin_folder, "landmark_svc", recorded, "--method", "thesis")
    blocks = [table("disparity", frames_of(bin_folder, ours)),
              table("thesis", frames_of(bin_folder, thesis))]
    for frame in PICTURES:
        image = simulated.picture(bin_folder, "landmarks-png", ours, "--frame", str(frame))
        blocks.append(Figure(f"Frame {frame}: edges and landmarks.", image,
                             f"landmark_7scenes_{frame}"))
    return Result(blocks)
