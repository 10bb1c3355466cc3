"""Statistics over seeded worlds; the program is tests/ekf_svc/experiment."""
import subprocess

TITLE = "SLAM: does the filter know how wrong it is"
TARGETS = ["slam_experiment"]


def run(bin_folder):
    return subprocess.run([bin_folder / "slam_experiment", "consistency", "100"]).returncode == 0
