"""Statistics over seeded worlds; the program is tests/ekf_svc/experiment."""
from report_parts.slam_programs import Experiment, measured

TITLE = "SLAM: waking up in a saved map"
TARGETS = ["slam_experiment"]
EXPERIMENT = Experiment(
    "relocalisation", 100,
    "Put down 100 times anywhere in a known map, and where the place cannot be told",
    ["world", "starts", "found %", "wrong", "way until found, m"],
    "at least 95 % find their place where it can be told, and none a wrong one")


def run(bin_folder):
    return measured(bin_folder, EXPERIMENT)
