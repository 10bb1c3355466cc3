"""Simulated drives as logs, each made once while the process lives, and what services make of them."""
import functools
import itertools
import pathlib
import tempfile

from recordings.programs import run_quietly

CAMERA = ("--camera_size", "320x240")
NUMBERS = itertools.count()


@functools.cache
def _folder():
    return tempfile.TemporaryDirectory(prefix="roomwise-experiments-")


def scratch(name):
    """A path for a file of this process."""
    return pathlib.Path(_folder().name, name)


def _new_log(name):
    return scratch(f"{next(NUMBERS)}-{name}.lcmlog")


@functools.cache
def drive(bin_folder, scenario, path="loop1", *options):
    """A log of one drive: frames, odometry and truth."""
    log = _new_log(pathlib.Path(scenario).stem)  # or a scenario's file
    run_quietly(bin_folder / "simulator", "--record", log, "--scenario", scenario, "--path", path,
                *(options if "--camera_size" in options else (*CAMERA, *options)))
    return log


@functools.cache
def replayed(bin_folder, service, log, *options):
    """`log` with what the service makes of it."""
    out = _new_log(service)
    run_quietly(bin_folder / service, "--replay", log, "--record", out, *options)
    return out


def mapped(bin_folder, scenario, path="loop1", *ekf_options):
    """A drive with its landmarks, poses and map."""
    seen = replayed(bin_folder, "landmark_svc", drive(bin_folder, scenario, path))
    return replayed(bin_folder, "ekf_svc", seen, *ekf_options)


def scores(bin_folder, log):
    """{name: value} of rwlog score."""
    return {name: float(value) for name, value in
            (line.split()[:2] for line in
             run_quietly(bin_folder / "rwlog", "score", log).splitlines())}


def picture(bin_folder, kind, log, *options):
    """The PNG's bytes of `rwlog export KIND`."""
    out = scratch("picture.png")
    run_quietly(bin_folder / "rwlog", "export", kind, log, "-o", out, *options)
    return out.read_bytes()
