"""Statistics over seeded worlds; the program is tests/ekf_svc/experiment."""
import subprocess

TITLE = "SLAM: wheels that are wrong"
TARGETS = ["slam_experiment"]


def run(bin_folder):
    return subprocess.run([bin_folder / "slam_experiment", "calibration", "50"]).returncode == 0
