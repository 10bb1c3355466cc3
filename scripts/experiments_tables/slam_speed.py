"""What a frame costs ekf_svc against the size of the map, beside MRPT in the same run, and its
sweep over the covariance beside what the memory gives. Plot: report/slam_speed.svg.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from plotting.line_plot import Axis, save_line_plot  # noqa: E402

TITLE = "SLAM: what a frame costs"
TARGETS = ["ekf_bench"]
MRPT_RATIO_LEAST = 100.0  # at 300 landmarks
MEMORY_RATIO_LEAST = 0.7
NAMES = {"roomwise": "ekf_svc", "mrpt_naive": "MRPT", "mrpt_davison": "MRPT (Davison)"}


def measure(bin_folder):
    with tempfile.NamedTemporaryFile(suffix=".json") as results:
        subprocess.run([bin_folder.parent / "bench" / "ekf_bench",
                        f"--benchmark_out={results.name}", "--benchmark_out_format=json"],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        runs = json.loads(pathlib.Path(results.name).read_text())["benchmarks"]
    return {run["name"]: run for run in runs if not run.get("error_occurred")}


def frames_by_filter(runs):
    """{filter: [(landmarks, CPU ms a frame), ...]}"""
    lines = {}
    for name, run in runs.items():
        subject, who, what = name.split("/")
        if what == "frame":
            lines.setdefault(who, []).append((int(subject.split("_")[1]), run["cpu_time"]))
    return {who: sorted(points) for who, points in lines.items()}


def run(bin_folder):
    runs = measure(pathlib.Path(bin_folder))
    lines = frames_by_filter(runs)
    own = dict(lines["roomwise"])
    print("CPU ms a frame".ljust(28) + "".join(f"{count:>12} lm." for count in own))
    for who, points in lines.items():
        print(NAMES[who].ljust(28) + "".join(f"{ms:16.3f}" for _, ms in points))
        if who != "roomwise":
            print("  times ekf_svc".ljust(28) + "".join(f"{ms / own[n]:16.1f}" for n, ms in points))
    save_line_plot(ROOT / "report" / "slam_speed.svg", "What a frame costs",
                   Axis("landmarks in the map", log=True), Axis("CPU ms a frame", log=True),
                   {NAMES[who]: points for who, points in lines.items()})
    met = "mrpt_naive" not in lines or dict(lines["mrpt_naive"])[300] / own[300] >= MRPT_RATIO_LEAST
    for size in (1000, 2000):
        speed = {who: runs[f"sweep_{size}/{who}/pass"]["GB_per_s"]
                 for who in ("memory_in_place", "roomwise")}
        ratio = speed["roomwise"] / speed["memory_in_place"]
        print(f"sweep of {size} rows: {ratio:.2f} of what the memory gives")
        met = met and ratio >= MEMORY_RATIO_LEAST
    return met
