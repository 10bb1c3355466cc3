"""Detector and filter together, live: real processes drive a simulated robot twice round the
apartment, from corner to corner by pilot_svc's go_to, in a network of their own and in real time.
The path as the robot has it at each moment, against the truth.

Give it a quiet machine of two cores: about seven minutes a seed.
"""
import pathlib
import subprocess
import sys
import tempfile

from report_parts.results import Result, Table, at_least, at_most

TITLE = "SLAM: live, apartment, two rounds"
TARGETS = ["pilot_trial", "rwlog"]
SEEDS = range(1, 6)
MINUTES = 12
PATH_MOST_m = 0.05
HEADING_MOST_rad = 0.0349
ODOMETRY_LEAST_m = 0.5
DEGREES_PER_RAD = 57.29578


def score(rwlog, log):
    out = subprocess.run([rwlog, "score", log], check=True, capture_output=True, text=True).stdout
    return {line.split()[0]: float(line.split()[1]) for line in out.splitlines()
            if len(line.split()) == 2}


def drive(bin_folder, seed, log):
    """What the robot did, in the trial's words. Raises CalledProcessError if it did not drive."""
    trial = bin_folder.parent / "tests" / "pilot_trial"
    words = [trial, "--scenario", "apartment", "--behaviour", "tour", "--path", "loop2",
             "--seed", str(seed), "--minutes", str(MINUTES), "--log", log]
    said = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    return said.strip().split("\n\n")[-1].splitlines()[0].removeprefix("apartment: ")


def bars_of(rows):
    """Of the worst seed."""
    path_m, heading_deg, odometry_m = ([row[column] for row in rows] for column in (1, 3, 4))
    return [at_most("worst path, m", max(path_m), PATH_MOST_m),
            at_most("worst heading, degrees", max(heading_deg),
                    round(HEADING_MOST_rad * DEGREES_PER_RAD, 2), 2),
            at_least("least of odometry alone, m", min(odometry_m), ODOMETRY_LEAST_m)]


def run(bin_folder):
    table = Table("Errors of position and heading over the whole drive, RMS",
                  ["seed", "path m", "aligned m", "heading deg", "odometry m", "landmarks",
                   "what it did"], [])
    with tempfile.TemporaryDirectory() as folder:
        for seed in SEEDS:
            log = pathlib.Path(folder) / f"seed{seed}.lcmlog"
            did = drive(bin_folder, seed, log)
            s = score(bin_folder / "rwlog", log)
            table.rows.append([str(seed), s["ate_raw_m"], s["ate_aligned_m"],
                               s["heading_rmse_rad"] * DEGREES_PER_RAD, s["odometry_ate_raw_m"],
                               f"{s.get('landmarks', 0):.0f}", did])
            print(f"seed {seed}: path {s['ate_raw_m']:.3f} m", file=sys.stderr, flush=True)
            log.unlink()
    return Result([table], bars_of(table.rows))
