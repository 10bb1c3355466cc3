"""Detector and filter together, live: real processes drive a simulated robot twice round the
apartment, from corner to corner by pilot_svc's go_to, in a network of their own and in real time.
The path as the robot has it at each moment, against the truth.

Give it a quiet machine of two cores: about seven minutes a seed.
"""
import pathlib
import subprocess
import tempfile

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


def run(bin_folder):
    print(f"{'seed':>4} {'path m':>8} {'aligned m':>10} {'heading deg':>12} {'odometry m':>11}"
          f" {'landmarks':>10}")
    met = True
    with tempfile.TemporaryDirectory() as folder:
        for seed in SEEDS:
            log = pathlib.Path(folder) / f"seed{seed}.lcmlog"
            did = drive(bin_folder, seed, log)
            s = score(bin_folder / "rwlog", log)
            print(f"{seed:4} {s['ate_raw_m']:8.3f} {s['ate_aligned_m']:10.3f}"
                  f" {s['heading_rmse_rad'] * DEGREES_PER_RAD:12.2f}"
                  f" {s['odometry_ate_raw_m']:11.3f} {s.get('landmarks', 0):10.0f}   {did}",
                  flush=True)
            met = (met and s["ate_raw_m"] <= PATH_MOST_m
                   and s["heading_rmse_rad"] <= HEADING_MOST_rad
                   and s["odometry_ate_raw_m"] > ODOMETRY_LEAST_m)
            log.unlink()
    return met
