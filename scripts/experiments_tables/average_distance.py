"""The thesis's average distance of all that is in view, beside the near quantile in the corridor the
robot is about to sweep, along one round of the simulated living room.
"""
import pathlib

from plotting.line_plot import Axis, line_plot
from recordings import messages, simulated
from report_parts.results import Figure, Note, Result, Table

TITLE = "Average distance, and the nearest thing ahead"
TARGETS = ["rwlog", "segment_svc", "simulator"]
EVERY = 6  # frames


def run(bin_folder):
    bin_folder = pathlib.Path(bin_folder)
    log = simulated.replayed(bin_folder, "segment_svc",
                             simulated.drive(bin_folder, "living_room"))
    rows = list(messages.rows_of(bin_folder, log, "SEGMENTS"))[::EVERY]
    begin = int(rows[0]["utime"])
    times_s = [(int(row["utime"]) - begin) * 1e-6 for row in rows]
    mean_m = [float(row["mean_distance_m"]) or None for row in rows]
    near_m = [float(row["near_distance_m"]) or None for row in rows]
    safe_m = [float(row["safe_distance_m"]) for row in rows]
    plot = line_plot("Distance ahead, one round of the living room", Axis("time, s"),
                     Axis("distance, m", least=0.0),
                     {"average of all (thesis)": list(zip(times_s, mean_m)),
                      "nearest in the corridor": list(zip(times_s, near_m)),
                      "safe distance (thesis)": list(zip(times_s, safe_m))})
    both = [(mean, near) for mean, near in zip(mean_m, near_m) if mean and near]
    closer = max(both, key=lambda pair: pair[0] - pair[1])
    table = Table("Along the round", ["", "least m", "mean m", "largest m"],
                  [[name, min(values), sum(values) / len(values), max(values)]
                   for name, values in (("average of all", [m for m in mean_m if m]),
                                        ("nearest in the corridor", [n for n in near_m if n]))])
    return Result([
        Figure("The average mixes the floor, the walls and what stands ahead. The nearest thing in the "
               "corridor that the robot is about to sweep, without the floor, falls by a metre a "
               "metre as it drives up, and jumps when it turns away. A gap: nothing stands there.", plot, "average_distance"), table,
        Note(f"Where they differ most the average said {closer[0]:.2f} m while something stood {closer[1]:.2f} m "
             "ahead.")])
