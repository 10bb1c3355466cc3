"""One frame of the simulated living room with what the thesis's method marks at its three
thresholds, and what ours does: edge pixels, and the landmarks made of them.
"""
import pathlib

from recordings import messages, simulated
from report_parts.results import Figure, Result, Table

TITLE = "One frame, three thresholds, and ours"
TARGETS = ["landmark_svc", "rwlog", "simulator"]
FRAME = 100
METHODS = {"Thesis, threshold 0": ("--method", "thesis", "--threshold_mm_per_px", "0"),
           "Thesis, threshold 100": ("--method", "thesis", "--threshold_mm_per_px", "100"),
           "Thesis, threshold 1000": ("--method", "thesis", "--threshold_mm_per_px", "1000"),
           "Ours": ("--method", "disparity")}


def counts(bin_folder, log):
    """Edge pixels, how many of them the message lists, and landmarks of the frame."""
    row = messages.landmarks_of_frame(bin_folder, log, FRAME)
    return int(row["edge_count"]), int(row["edge_listed"]), int(row["count"])


def run(bin_folder):
    bin_folder = pathlib.Path(bin_folder)
    log = simulated.drive(bin_folder, "living_room", "loop1", "--seconds", "4")
    table = Table("The same frame of 320 x 240", ["method", "edge pixels", "landmarks"], [],
                  note="How many are right is in the next table: over many frames, by true depth.")
    pictures = []
    for name, options in METHODS.items():
        seen = simulated.replayed(bin_folder, "landmark_svc", log, *options)
        edges, listed, landmarks = counts(bin_folder, seen)
        table.rows.append([name, str(edges), str(landmarks)])
        pictures.append(Figure(
            f"{name}: {edges} edge pixels" + (f", {listed} of them" if listed < edges else "") +
            f" in light blue, {landmarks} landmarks with their distance.",
            simulated.picture(bin_folder, "landmarks-png", seen, "--frame", str(FRAME)),
            "landmarks_" + name.lower().replace(", threshold ", "_")))
    return Result([table, *pictures])
