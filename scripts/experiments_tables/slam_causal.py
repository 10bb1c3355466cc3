"""How good can an estimate be that knows only what came before? The best batch estimate is made
anew of every beginning of a real run (UTIAS MRCLAM set 7, known identities), and its last pose is
taken: what came later plays no part in it. Beside it the filter's pose at the same instants, and
the batch estimate of the whole run, which knows all that came later.
"""
import bisect
import cmath
import math
import pathlib
import tempfile

from recordings import mrclam
from recordings.programs import run_quietly
from report_parts.results import Result, Table, at_most, left_out

TITLE = "SLAM: what can be known at the time (MRCLAM set 7)"
TARGETS = ["ekf_svc", "rwlog"]
FIRST_S, STEP_S, LAST_S = 20, 10, 890
RATIO_MAX = 1.1


class Path:
    """Positions over time, as complex numbers."""

    def __init__(self, rwlog, log, text, channel="POSE"):
        run_quietly(rwlog, "export", "trajectory", log, "-o", text, "--channel", channel)
        with open(text, encoding="utf-8") as lines:
            rows = [line.split() for line in lines if not line.startswith("#")]
        self.times_s = [float(row[0]) for row in rows]
        self.points_m = [complex(float(row[1]), float(row[2])) for row in rows]

    def at(self, time_s):
        after = min(max(bisect.bisect(self.times_s, time_s), 1), len(self.times_s) - 1)
        a, b = self.times_s[after - 1], self.times_s[after]
        share = min(max((time_s - a) / (b - a), 0.0), 1.0) if b > a else 0.0
        return self.points_m[after - 1] * (1.0 - share) + self.points_m[after] * share


def aligned_rms_m(estimate, truth):
    """Root mean square distance after the best turn and shift (Horn 1987, in the plane)."""
    middle = sum(estimate) / len(estimate), sum(truth) / len(truth)
    a, b = [p - middle[0] for p in estimate], [p - middle[1] for p in truth]
    turn = cmath.phase(sum(q * p.conjugate() for p, q in zip(a, b)))
    return math.sqrt(sum(abs(p * cmath.exp(1j * turn) - q) ** 2 for p, q in zip(a, b)) / len(a))


def causal_points(rwlog, out, folder):
    """Times, and where the batch estimate of all until then ends."""
    times_s, points_m = [], []
    beginning, best = folder / "beginning", folder / "best"
    for until_s in range(FIRST_S, LAST_S + 1, STEP_S):
        run_quietly(rwlog, "cut", out, "-o", beginning, "--to", str(until_s))
        run_quietly(rwlog, "smooth", beginning, "-o", best)
        path = Path(rwlog, best, folder / "path")
        times_s.append(path.times_s[-1])
        points_m.append(path.points_m[-1])
    return times_s, points_m


def errors_m(bin_folder, data, robot, folder):
    """Of the filter, of the batch estimate of what came before, and of the one of everything."""
    rwlog = bin_folder / "rwlog"
    log, out, best = folder / "log", folder / "out", folder / "best"
    mrclam.mapped_run(bin_folder, data, robot, log, out)
    times_s, causal_m = causal_points(rwlog, out, folder)
    truth = Path(rwlog, out, folder / "path", "TRUTH")
    online = Path(rwlog, out, folder / "path")
    run_quietly(rwlog, "smooth", out, "-o", best)
    whole = Path(rwlog, best, folder / "path")
    truth_m = [truth.at(t) for t in times_s]
    return [aligned_rms_m(points, truth_m) for points in
            ([online.at(t) for t in times_s], causal_m, [whole.at(t) for t in times_s])]


def run(bin_folder):
    data = mrclam.folder()
    if data is None:
        return left_out(mrclam.MISSING)
    rows, bars = [], []
    for robot in mrclam.ROBOTS:
        with tempfile.TemporaryDirectory() as folder:
            online, causal, whole = errors_m(bin_folder, data, robot, pathlib.Path(folder))
        rows.append([f"robot {robot}", online, causal, online / causal, whole])
        bars.append(at_most(f"robot {robot}: ekf_svc / batch so far", online / causal, RATIO_MAX))
    table = Table("Error of the path at the same instants, m",
                  ["", "ekf_svc", "batch so far", "ratio", "in hindsight"], rows)
    return Result([table], bars)
