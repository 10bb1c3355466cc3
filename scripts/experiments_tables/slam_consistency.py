"""Statistics over seeded worlds; the program is tests/ekf_svc/experiment."""
from report_parts.slam_programs import Experiment, measured

TITLE = "SLAM: does the filter know how wrong it is"
TARGETS = ["slam_experiment"]
EXPERIMENT = Experiment(
    "consistency", 100, "Error as a multiple of what the filter says it is (ANEES/3), 100 drives",
    ["world", "invariant", "plain EKF", "invariant, RMSE m", "plain EKF, RMSE m"],
    "the invariant filter within the band of an honest one, the plain EKF above it",
    note_with="an honest filter")


def run(bin_folder):
    return measured(bin_folder, EXPERIMENT)
