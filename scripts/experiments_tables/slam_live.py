"""Detector and filter together, live: real processes drive a simulated robot twice round the
apartment, from corner to corner by pilot_svc's go_to, in a network of their own and in real time.
The path as the robot has it at each moment, against the truth.

Give it a quiet machine of two cores: about sixteen minutes a drive, and three are driven at a time
(each takes a quarter of a core).
"""
import concurrent.futures
import pathlib
import subprocess
import tempfile

from report_parts.results import Bar, Result, Table, at_least, at_most

TITLE = "SLAM: detector and filter together, live, two rounds of the apartment"
TARGETS = ["pilot_trial", "rwlog"]
SEEDS = range(1, 6)
MINUTES = 17
AT_A_TIME = 3
PATH_MOST_M = 0.05
HEADING_MOST_DEG = 2.0
ODOMETRY_LEAST_M = 0.5
DEGREES_PER_RAD = 57.29578


def drive(bin_folder, seed, log):
    """The trial's last words on what the robot did. Raises CalledProcessError if it did not."""
    trial = bin_folder.parent / "tests" / "pilot_trial"
    words = [trial, "--scenario", "apartment", "--behaviour", "tour", "--path", "loop2",
             "--seed", str(seed), "--minutes", str(MINUTES), "--log", log]
    said = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    return said.rsplit("apartment: ", maxsplit=1)[1]


def scores(bin_folder, log):
    out = subprocess.run([bin_folder / "rwlog", "score", log], check=True, capture_output=True,
                         text=True).stdout
    return {line.split()[0]: float(line.split()[1]) for line in out.splitlines()
            if len(line.split()) == 2}


def row(seed, score, words):
    return [str(seed), score["ate_raw_m"], score["ate_aligned_m"],
            score["heading_rmse_rad"] * DEGREES_PER_RAD, score["odometry_ate_raw_m"],
            f"{score['landmarks']:.0f}", words.splitlines()[0].split(" driven")[0]]


def driven(bin_folder, folder, seed):
    """The row of one seed, and whether it came to its end."""
    log = pathlib.Path(folder) / f"seed{seed}.lcmlog"
    words = drive(bin_folder, seed, log)
    found = row(seed, scores(bin_folder, log), words)
    log.unlink()
    return found, "ends in state 4" in words


def run(bin_folder):
    bin_folder = pathlib.Path(bin_folder)
    table = Table("RMSE over two rounds; nothing is aligned but where it says so",
                  ["seed", "path, m", "aligned, m", "heading, degrees", "odometry's path, m",
                   "landmarks", "drive"], [],
                  note=f"Live on two cores, {AT_A_TIME} drives at a time, so no two runs are alike.",
                  timing=True)
    with (tempfile.TemporaryDirectory() as folder,
          concurrent.futures.ThreadPoolExecutor(AT_A_TIME) as drivers):
        drives = list(drivers.map(lambda seed: driven(bin_folder, folder, seed), SEEDS))
    table.rows += [found for found, _ in drives]
    finished = [is_finished for _, is_finished in drives]
    bars = [at_most("worst path, m", max(r[1] for r in table.rows), PATH_MOST_M),
            at_most("worst heading, degrees", max(r[3] for r in table.rows), HEADING_MOST_DEG, 2),
            at_least("odometry's best path, m", min(r[4] for r in table.rows), ODOMETRY_LEAST_M),
            Bar("both rounds driven to the end", f"{sum(finished)} of {len(finished)}",
                all(finished))]
    return Result([table], bars)
