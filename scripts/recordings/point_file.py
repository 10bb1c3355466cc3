"""Points of a frame, as rwlog export ply writes them."""
import struct

from recordings import simulated
from recordings.programs import run_quietly

SIZES = {"float": "f", "double": "d", "uchar": "B", "uint8": "B", "float32": "f"}


def read(path):
    """[(x, y, z [m], red, green, blue)]"""
    head, data = path.read_bytes().split(b"end_header\n", 1)
    lines = head.decode("ascii").splitlines()
    if "format binary_little_endian 1.0" not in lines:
        raise ValueError(f"{path}: not a binary PLY")
    count = next(int(line.split()[2]) for line in lines if line.startswith("element vertex"))
    shape = "<" + "".join(SIZES[line.split()[1]] for line in lines if line.startswith("property"))
    return list(struct.iter_unpack(shape, data[:count * struct.calcsize(shape)]))


def of_frame(bin_folder, log, frame):
    """The points of one frame in the robot's frame: x ahead, y left, z up [m]."""
    out = simulated.scratch("points.ply")
    run_quietly(bin_folder / "rwlog", "export", "ply", log, "-o", out, "--frame",
                          str(frame), "--voxel", "0.001")
    return read(out)
