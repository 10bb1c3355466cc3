"""What a frame costs ekf_svc against the size of the map, beside MRPT in the same run, and its
sweep over the covariance beside what the memory gives. """
import json
import pathlib
import subprocess
import tempfile

from plotting.line_plot import Axis, line_plot
from report_parts.results import Figure, Result, Table, at_least

TITLE = "SLAM: what a frame costs"
TARGETS = ["ekf_bench"]
MRPT_RATIO_LEAST = 100.0  # at 300 landmarks
MEMORY_RATIO_LEAST = 0.7
SWEEP_SIZES = (1000, 2000)
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


def table_of(lines):
    own = dict(lines["roomwise"])
    rows = []
    for who, points in lines.items():
        rows.append([NAMES[who], *(ms for _, ms in points)])
        if who != "roomwise":
            rows.append([f"{NAMES[who]}, times ekf_svc",
                         *(f"{ms / own[count]:.1f}" for count, ms in points)])
    return Table("CPU ms a frame, by landmarks in the map", ["", *map(str, own)], rows, timing=True)


def sweep_speeds(runs):
    """[(rows' landmarks, GB/s of the sweep, of as many bytes in place, of the memory), ...]"""
    speed = {name: run["GB_per_s"] for name, run in runs.items() if "GB_per_s" in run}
    return [(size, speed[f"sweep_{size}/roomwise/pass"], speed[f"sweep_{size}/in_place/pass"],
             speed["memory/in_place/pass"]) for size in SWEEP_SIZES]


def sweep_table(speeds):
    return Table("GB/s of the covariance's sweep for one landmark, bytes counted in and out",
                 ["landmarks", "sweep", "as many bytes in one row (a cache, where one is as large)",
                  "memory"], speeds, timing=True)


def sweep_bars(speeds):
    """The covariance sweep, as a share of what the memory gives."""
    return [at_least(f"sweep of {size} landmarks / memory's own speed", sweep / memory,
                     MEMORY_RATIO_LEAST, 2) for size, sweep, _, memory in speeds]


def run(bin_folder):
    runs = measure(pathlib.Path(bin_folder))
    lines = frames_by_filter(runs)
    plot = line_plot("What a frame costs", Axis("landmarks in the map", log=True),
                     Axis("CPU ms a frame", log=True),
                     {NAMES[who]: points for who, points in lines.items()})
    speeds = sweep_speeds(runs)
    bars = sweep_bars(speeds)
    if "mrpt_naive" in lines:
        ratio = dict(lines["mrpt_naive"])[300] / dict(lines["roomwise"])[300]
        bars.append(at_least("300 landmarks: MRPT / ekf_svc", ratio, MRPT_RATIO_LEAST, 1))
    missing = "" if "mrpt_naive" in lines else "MRPT is not installed here"
    return Result([table_of(lines), sweep_table(speeds),
                   Figure("What a frame costs (times)", plot, "slam_speed")], bars, missing)
