"""What a recorded drive was like, by the simulator's truth and by the log's own times."""
import csv
import dataclasses
import math
import subprocess

from demo_parts.log_events import events
from demo_parts.replayed import ANSWERS, same_ratio

PATH_MOST_m = 0.05
HEADING_MOST_rad = math.radians(2)
DRIVEN_LEAST_mps = 0.03  # in the mean: it does wander
LANDMARKS_LEAST = 10
CONTACT_mps = 0.1
FRAMES_LOST_MOST_ratio = 0.01
LATENCY_MOST_ms = 50.0
REPLAYED_LEAST_ratio = 0.99  # a frame the live service had no time for leaves its mark


@dataclasses.dataclass
class Figure:
    """`least` and `most` are its bars; a figure without either is told and not judged."""
    name: str
    value: float
    unit: str = ""
    least: float = None
    most: float = None

    def held(self):
        return not (self.least is not None and not self.value >= self.least
                    or self.most is not None and not self.value <= self.most)


def rows(rwlog, log, channel, *options):
    out = subprocess.run([rwlog, "csv", log, channel, *options], check=True, capture_output=True,
                         text=True).stdout
    return list(csv.DictReader(out.splitlines()))


def scores(rwlog, log):
    out = subprocess.run([rwlog, "score", log], check=True, capture_output=True, text=True).stdout
    return {line.split()[0]: float(line.split()[1]) for line in out.splitlines()
            if len(line.split()) == 2}


def driven(truth):
    """(metres, contacts that began while it was faster than CONTACT_mps)"""
    way_m, contacts, touched = 0.0, 0, False
    for before, now in zip(truth, truth[1:]):
        step_m = math.hypot(float(now["true_x_m"]) - float(before["true_x_m"]),
                            float(now["true_y_m"]) - float(before["true_y_m"]))
        step_s = 1e-6 * (int(now["utime"]) - int(before["utime"]))
        touches = int(now["contacts"]) > 0
        contacts += touches and not touched and step_m > CONTACT_mps * step_s
        touched = touches
        way_m += step_m
    return way_m, contacts


def frames_lost_ratio(log):
    """By their sequence numbers, on their way to the logger."""
    numbers = [event.seq for event in events(log, ("KINECT_FRAME",))]
    return 1.0 - len(numbers) / (numbers[-1] - numbers[0] + 1)


def command_latencies_ms(log):
    """From a frame's exposure to the first command after what was seen in it, as the logger heard."""
    waiting, found = None, []
    for event in events(log, ("SEGMENTS", "VEL_CMD")):
        if event.channel == "SEGMENTS":
            waiting = event
        elif waiting:
            found.append(1e-3 * (event.heard_us - waiting.utime))
            waiting = None
    return sorted(found)


def closures(rwlog, log):
    """Frames in which landmarks turned out to be others, mapped before. POSE repeats a frame's."""
    merged = [int(row["landmarks_merged"]) > 0 for row in rows(rwlog, log, "POSE")]
    return sum(now and not before for before, now in zip([False, *merged], merged))


def cpu_ratios(rwlog, log):
    """{service: mean share of a core}"""
    shares = {}
    for row in rows(rwlog, log, "HEALTH"):
        shares.setdefault(row["service"], []).append(float(row["cpu_ratio"]))
    return {name: sum(values) / len(values) for name, values in sorted(shares.items())}


def of_log(bin_folder, log):
    rwlog = bin_folder / "rwlog"
    truth = rows(rwlog, log, "TRUTH")
    duration_s = 1e-6 * (int(truth[-1]["utime"]) - int(truth[0]["utime"]))
    way_m, contacts = driven(truth)
    score = scores(rwlog, log)
    latencies_ms = command_latencies_ms(log)
    found = [
        Figure("driven", way_m, "m", least=DRIVEN_LEAST_mps * duration_s),
        Figure("landmarks in the map", score["landmarks"], least=LANDMARKS_LEAST),
        Figure("path, RMSE", score["ate_raw_m"], "m", most=PATH_MOST_m),
        Figure("path by odometry alone, RMSE", score["odometry_ate_raw_m"], "m"),
        Figure("heading, RMSE", score["heading_rmse_rad"], "rad", most=HEADING_MOST_rad),
        Figure("loops closed", closures(rwlog, log)),
        Figure("contacts faster than 0.1 m/s", contacts, most=0),
        Figure("frames lost", 100.0 * frames_lost_ratio(log), "%",
               most=100.0 * FRAMES_LOST_MOST_ratio),
        Figure("exposure to command, median", latencies_ms[len(latencies_ms) // 2], "ms"),
        Figure("exposure to command, 99 %", latencies_ms[99 * len(latencies_ms) // 100], "ms",
               most=LATENCY_MOST_ms),
    ]
    found += [Figure(f"{name} says the same replayed", 100.0 * same_ratio(bin_folder, log, name),
                     "%", least=100.0 * REPLAYED_LEAST_ratio) for name in ANSWERS]
    return found + [Figure(f"core used by {name}", 100.0 * ratio, "%")
                    for name, ratio in cpu_ratios(rwlog, log).items()]
