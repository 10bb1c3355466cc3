"""Statistics over seeded worlds; the program is tests/ekf_svc/experiment."""
from report_parts.slam_programs import Experiment, measured

TITLE = "SLAM: landmarks that look alike, round a square corridor"
TARGETS = ["slam_experiment"]
EXPERIMENT = Experiment(
    "association", 34, "Landmarks without names, 34 drives a world",
    ["world", "lost", "RMSE m", "NEES/3", "merged", "wrongly", "landmarks", "ms a step"],
    "no drive is lost, and at most 0.03 (with clutter 0.05) wrong merges a drive", timing=True)


def run(bin_folder):
    return measured(bin_folder, EXPERIMENT)
