"""Depths of one simulated frame as a histogram, and the range threshold landmark_svc takes from it."""
import pathlib

from plotting.line_plot import Axis, line_plot
from recordings import messages, point_file, simulated
from report_parts.results import Figure, Result, Table

TITLE = "Histogram of depths, and the threshold taken from it"
TARGETS = ["landmark_svc", "rwlog", "simulator"]
SCENARIOS = ("living_room", "apartment")
FRAME = 100
BIN_MM, MOST_MM = 50, 4500
CAMERA_UP_M, CAMERA_DOWN_RAD = 0.4, 0.1  # of these scenarios


def depths_mm(points):
    """Along the camera's axis."""
    ahead, down = 1.0 - CAMERA_DOWN_RAD ** 2 / 2, CAMERA_DOWN_RAD
    return [1000.0 * (x * ahead + (CAMERA_UP_M - z) * down) for x, _, z, *_ in points]


def histogram(values):
    """[(middle of the bin [mm], % of the readings)]"""
    counts = [0] * (MOST_MM // BIN_MM)
    for value in values:
        if 0 <= value < MOST_MM:
            counts[int(value / BIN_MM)] += 1
    return [((i + 0.5) * BIN_MM, 100.0 * count / len(values)) for i, count in enumerate(counts)]


def range_max_m(bin_folder, log):
    """What landmark_svc derives from this frame's histogram."""
    seen = simulated.replayed(bin_folder, "landmark_svc", log, "--range_is_automatic", "true")
    return float(messages.landmarks_of_frame(bin_folder, seen, FRAME)["range_max_m"])


def run(bin_folder):
    bin_folder = pathlib.Path(bin_folder)
    lines, rows = {}, []
    for scenario in SCENARIOS:
        log = simulated.drive(bin_folder, scenario, "loop1", "--seconds", "4", "--camera_size",
                              "640x480")
        depths = depths_mm(point_file.of_frame(bin_folder, log, FRAME))
        lines[scenario] = histogram(depths)
        share = sum(1000.0 <= depth <= 3000.0 for depth in depths) / len(depths)
        rows.append([scenario, f"{sum(depths) / len(depths):.0f}", f"{share:.1%}",
                     f"{1000.0 * range_max_m(bin_folder, log):.0f}"])
    plot = line_plot("Depths in one frame", Axis("depth, mm"),
                     Axis(f"% of the readings, by {BIN_MM} mm", least=0.0), lines)
    table = Table("Depths of frame 100, mm",
                  ["scenario", "mean", "from 1000 to 3000 mm", "range threshold taken"], rows,
                  note="The threshold is landmark_svc's with range_is_automatic; it is never beyond "
                       "3810 mm.")
    return Result([Figure("Each peak is something upright at that distance; the slope below them is "
                          "the floor.", plot, "depth_histogram"), table])
