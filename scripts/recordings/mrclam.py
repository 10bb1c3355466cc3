"""Real Create robots of UTIAS MRCLAM (Leung et al., IJRR 2011), set 7, as logs.

The recordings are in ROOMWISE_DATA/mrclam7, by default ../shared/data/mrclam7.
"""
import os
import pathlib

from recordings.programs import run_quietly

ROBOTS = (2, 5)
MISSING = "the recordings are not there: a folder mrclam7 in ROOMWISE_DATA"


def folder():
    """Where the recordings are; None where there are none."""
    root = pathlib.Path(__file__).resolve().parents[2]
    data = pathlib.Path(os.environ.get("ROOMWISE_DATA", root.parent / "shared" / "data"))
    return data / "mrclam7" if (data / "mrclam7").is_dir() else None


def mapped_run(bin_folder, data, robot, log, out, unknown_identities=False):
    """Makes the log of a robot's drive, and the log of what ekf_svc makes of it."""
    extra = ["--unknown-identities"] if unknown_identities else []
    run_quietly(bin_folder / "rwlog", "import", "mrclam", data, "--robot", str(robot), "-o", log,
                *extra)
    run_quietly(bin_folder / "ekf_svc", "--replay", log, "--record", out)
