"""Statistics over seeded worlds; the program is tests/ekf_svc/experiment."""
from report_parts.slam_programs import Experiment, measured

TITLE = "SLAM: wheels that are wrong"
TARGETS = ["slam_experiment"]
EXPERIMENT = Experiment(
    "calibration", 50, "Wheels learned while driving, 50 drives",
    ["odometry", "RMSE m", "NEES/3", "distance %", "turn %", "pull rad/m"],
    "learning wrong wheels makes no drive worse", note_with="the last three")


def run(bin_folder):
    return measured(bin_folder, EXPERIMENT)
