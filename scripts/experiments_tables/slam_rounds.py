"""EKF-SLAM against dead reckoning and the textbook EKF, in the first and the second round of the
same simulated drive: from pixels, with landmark_svc's landmarks and without their names. Errors are
distances to the true path from the known start on, nothing is aligned.
"""
import pathlib

from plotting.line_plot import Axis, line_plot
from recordings import simulated
from recordings.trajectory import Trajectory, rms
from report_parts.results import Bar, Figure, Result, Table, at_most

TITLE = "SLAM: one round and two, against dead reckoning and the plain EKF"
TARGETS = ["ekf_svc", "landmark_svc", "rwlog", "simulator"]
SCENARIOS = ("living_room", "apartment")
STEP_S = 0.5
PATH_RMSE_MOST_M = 0.05
NAMES = ("odometry alone", "plain EKF", "ekf_svc")


def error_lines(bin_folder, scenario):
    """{estimate: [(s, m)]}, and {estimate: RMSE after the best alignment [m]}"""
    log = simulated.mapped(bin_folder, scenario, "loop2")
    plain = simulated.mapped(bin_folder, scenario, "loop2", "--filter", "plain")
    truth = Trajectory(bin_folder, log, "TRUTH")
    paths = (Trajectory(bin_folder, log, "ODOMETRY"), Trajectory(bin_folder, plain, "POSE"),
             Trajectory(bin_folder, log, "POSE"))
    aligned_m = (simulated.scores(bin_folder, log)["odometry_ate_aligned_m"],
                 simulated.scores(bin_folder, plain)["ate_aligned_m"],
                 simulated.scores(bin_folder, log)["ate_aligned_m"])
    return ({name: path.errors(truth, STEP_S) for name, path in zip(NAMES, paths)},
            dict(zip(NAMES, aligned_m)))


def by_round(line):
    """RMSE of the first round, of the second, and of both; the error at the end [m]."""
    errors = [error for _, error in line]
    half = len(errors) // 2
    return [rms(errors[:half]), rms(errors[half:]), rms(errors), errors[-1]]


def running_rms(line):
    squares, points = 0.0, []
    for count, (time_s, error_m) in enumerate(line, start=1):
        squares += error_m * error_m
        points.append((time_s, (squares / count) ** 0.5))
    return points


def plots(scenario, lines):
    time = Axis("time since the start, s; the second round begins half-way")
    return [Figure(f"{scenario}: distance to the true path. That of odometry alone grows with the "
                   "way driven; that of a map does not (Figures 5.18 to 5.20).",
                   line_plot(f"Distance to the true path, two rounds of {scenario}", time,
                             Axis("distance, m", least=0.0), lines), f"slam_rounds_{scenario}"),
            Figure(f"{scenario}: root mean square error of all so far (Figure 5.17).",
                   line_plot(f"RMSE so far, two rounds of {scenario}", time,
                             Axis("RMSE, m", least=0.0),
                             {name: running_rms(line) for name, line in lines.items()}),
                   f"slam_rmse_{scenario}")]


def run(bin_folder):
    bin_folder = pathlib.Path(bin_folder)
    table = Table("Error of the position, m (Figures 5.16 to 5.20)",
                  ["scenario", "estimate", "RMSE, round 1", "RMSE, round 2", "RMSE, both",
                   "at the end", "RMSE, aligned"], [],
                  note="All from the known start; the last column after the best turn and shift of "
                       "the whole path (Umeyama 1991), which is how data sets are judged.")
    pictures, bars = [], []
    for scenario in SCENARIOS:
        lines, aligned_m = error_lines(bin_folder, scenario)
        figures = {name: by_round(line) for name, line in lines.items()}
        table.rows += [[scenario, name, *values, aligned_m[name]] for name, values in figures.items()]
        pictures += plots(scenario, lines)
        ours, odometry = figures["ekf_svc"][2], figures["odometry alone"][2]
        bars += [at_most(f"{scenario}: RMSE of ekf_svc, m", ours, PATH_RMSE_MOST_M),
                 Bar(f"{scenario}: better than odometry alone", f"{ours:.3f} against"
                     f" {odometry:.3f} m", ours < odometry)]
    title = "apartment, two rounds"
    pictures.append(Figure(
        "Two rounds of the apartment (Figure 5.16): the map as ekf_svc has it at the end, with the "
        "true path, odometry's and the estimate.", simulated.picture(
            bin_folder, "map-png", simulated.mapped(bin_folder, "apartment", "loop2"), "--title",
            title), "slam_map_apartment"))
    return Result([table, *pictures], bars)
