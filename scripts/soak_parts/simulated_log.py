"""A log as long as a soak is: round after round of one way through a simulated room."""
import math
import pathlib
import subprocess
import tempfile

SCENARIOS = pathlib.Path(__file__).resolve().parents[2] / "services/simulator/scenarios"
ROUND_LEAST_s = 30.0
PATH = '\n[[path]]\nname = "soak"\nsame_as = "loop1"\nrounds = {}\n'


def make(programs, scenario, duration_s, log):
    text = (SCENARIOS / f"{scenario}.toml").read_text()
    with tempfile.NamedTemporaryFile("w", suffix=".toml") as rounds:
        rounds.write(text + PATH.format(math.ceil(duration_s / ROUND_LEAST_s)))
        rounds.flush()
        subprocess.run([programs / "simulator", "--record", log, "--scenario", rounds.name,
                        "--path", "soak", "--camera_size", "320x240", "--seconds",
                        f"{duration_s:g}"], check=True)
