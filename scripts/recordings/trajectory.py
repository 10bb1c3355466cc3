"""Trajectories of a log, and how far one strays from another that started with it."""
import bisect
import cmath
import math

from recordings import simulated
from recordings.programs import run_quietly


class Trajectory:
    """Positions over time as complex numbers [m], seen from where it started."""

    def __init__(self, bin_folder, log, channel):
        out = simulated.scratch("trajectory.txt")
        run_quietly(bin_folder / "rwlog", "export", "trajectory", log, "-o", out,
                              "--channel", channel)
        rows = [[float(word) for word in line.split()]
                for line in out.read_text(encoding="utf-8").splitlines()
                if not line.startswith("#")]
        turn = cmath.rect(1.0, -2.0 * math.atan2(rows[0][6], rows[0][7]))
        start = complex(rows[0][1], rows[0][2])
        self.times_s = [row[0] for row in rows]
        self.points_m = [(complex(row[1], row[2]) - start) * turn for row in rows]

    def at(self, time_s):
        after = min(max(bisect.bisect(self.times_s, time_s), 1), len(self.times_s) - 1)
        begin_s, end_s = self.times_s[after - 1], self.times_s[after]
        share = min(max((time_s - begin_s) / (end_s - begin_s), 0.0), 1.0)
        return self.points_m[after - 1] * (1.0 - share) + self.points_m[after] * share

    def errors(self, truth, step_s):
        """[(seconds since the start, distance to the truth [m])]"""
        begin_s = max(self.times_s[0], truth.times_s[0])
        end_s = min(self.times_s[-1], truth.times_s[-1])
        times_s = [begin_s + step_s * i for i in range(int((end_s - begin_s) / step_s) + 1)]
        return [(t - begin_s, abs(self.at(t) - truth.at(t))) for t in times_s]


def rms(values):
    return math.sqrt(sum(value * value for value in values) / len(values))
