"""Statistics over seeded worlds; the program is tests/ekf_svc/experiment."""
import subprocess

TITLE = "SLAM: landmarks that look alike, round a square corridor"
TARGETS = ["slam_experiment"]


def run(bin_folder):
    return subprocess.run([bin_folder / "slam_experiment", "association", "34"]).returncode == 0
