"""Statistics over seeded worlds; the program is tests/ekf_svc/experiment."""
import subprocess

TITLE = "SLAM: waking up in a saved map"
TARGETS = ["slam_experiment"]


def run(bin_folder):
    return subprocess.run([bin_folder / "slam_experiment", "relocalisation", "100"]).returncode == 0
