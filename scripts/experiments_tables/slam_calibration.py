"""Statistics over seeded worlds; the program is tests/ekf_svc/experiment."""
from report_parts.slam_programs import Experiment, measured

TITLE = "SLAM: wheels that are wrong"
TARGETS = ["slam_experiment"]
EXPERIMENT = Experiment(
    "calibration", 50, "Wheels learned while driving, 50 drives",
    ["odometry", "RMSE m", "NEES/3", "distance off, %", "turn off, %", "pull off, rad/m"],
    "wrong wheels are found within 1 %, the error at least halved, NEES/3 at most 1.1",
    note_with="worse than believing")


def run(bin_folder):
    return measured(bin_folder, EXPERIMENT)
