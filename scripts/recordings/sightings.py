"""Landmarks of a log, placed in the room by the robot's true pose."""
import bisect
import csv
import dataclasses
import io
import math

from recordings import simulated


@dataclasses.dataclass(frozen=True)
class Sighting:
    time_s: float  # since the world began
    x_m: float
    y_m: float
    robot_x_m: float
    robot_y_m: float
    moving: bool


def rows(bin_folder, log, channel, *options):
    text = simulated.run_quietly(bin_folder / "rwlog", "csv", log, channel, *options)
    return csv.DictReader(io.StringIO(text))


class TruePoses:
    """Where the robot is; the simulated world begins with a whole second."""

    def __init__(self, bin_folder, log):
        told = [(int(row["utime"]), float(row["true_x_m"]), float(row["true_y_m"]),
                 float(row["true_heading_rad"])) for row in rows(bin_folder, log, "TRUTH")]
        self.utimes = [row[0] for row in told]
        self.poses = [row[1:] for row in told]
        self.began_utime = self.utimes[0] - self.utimes[0] % 1_000_000

    def at(self, utime):
        """The pose told next to that time (60 a second)."""
        return self.poses[min(bisect.bisect(self.utimes, utime), len(self.poses) - 1)]


def of_log(bin_folder, log):
    truth = TruePoses(bin_folder, log)
    found = []
    for row in rows(bin_folder, log, "LANDMARKS", "--list", "landmarks"):
        x_m, y_m, heading_rad = truth.at(int(row["utime"]))
        range_m, bearing_rad = float(row["range_m"]), heading_rad + float(row["bearing_rad"])
        found.append(Sighting((int(row["utime"]) - truth.began_utime) * 1e-6,
                              x_m + range_m * math.cos(bearing_rad),
                              y_m + range_m * math.sin(bearing_rad), x_m, y_m,
                              row["moving"] == "1"))
    return found
