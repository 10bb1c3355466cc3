"""The thesis's segmentation experiments again, with true labels: its grey Gaussians beside mixtures
of colours, regions between edges, and depth and colour fused. In the order of the thesis: mean and
sigma of the training sets (Tables 5.8, 5.9) and their histograms, difference rates by training set
(Tables 5.5-5.7), other light than taught in and the dark (Figure 5.12), Gaussians with depth (Figures
5.13, 5.14: "fused"), and a recorded kitchen with masks of its floor where the recording is there.

Rectangles are the largest ones of each class, as a person would drag them.
"""
import csv
import io
import os
import pathlib
import subprocess

from plotting.line_plot import Axis, line_plot
from report_parts.results import Figure, Result, Table, at_least, at_most

ROOT = pathlib.Path(__file__).resolve().parents[2]

TITLE = "Segmentation: models, training and light"
TARGETS = ["segment_models"]
CLASSES = {"0": "obstacle", "100": "wall", "200": "floor"}
FLOOR_IOU_LEAST = {"simulated": 0.95, "recorded": 0.90}
LIGHT_COSTS_MOST = 0.01
CALLED_FLOOR_MOST = 0.005
DATA = pathlib.Path(os.environ.get("ROOMWISE_DATA", ROOT / ".." / "shared" / "data"))


def rows_of(bin_folder, table):
    out = subprocess.run([bin_folder / "segment_models", table], check=True, capture_output=True,
                         text=True).stdout
    return list(csv.DictReader(io.StringIO(out)))


def percent(ratio):
    return f"{100.0 * float(ratio):.2f} %"


def statistics(rows):
    return Table("Grey levels of the training sets (Table 5.8)",
                 ["taught on", "class", "mean", "sigma", "mean, thresholded", "sigma, thresholded",
                  "pixels"],
                 [[r["taught_on"], CLASSES[r["class"]], r["average_mean"], r["average_sigma"],
                   r["threshold_mean"], r["threshold_sigma"], r["pixels"]] for r in rows])


def histograms(rows):
    lines = {}
    for row in rows:
        lines.setdefault(CLASSES[row["class"]], []).append(
            (int(row["level"]), 100.0 * float(row["share"])))
    plot = line_plot("Grey levels of the training sets", Axis("grey level, 0 to 255"),
                     Axis("% of the class's pixels"), lines)
    return Figure("Histograms of the three classes' training sets, five views (Figures 5.10, 5.11)."
                  " Where they overlap, grey cannot tell them apart.", plot, "segment_histograms")


def training(rows):
    return Table("Difference rate in the living room, by what was taught on (Tables 5.5 to 5.7, 5.9)",
                 ["taught on", "model", "all", "obstacle", "wall", "floor"],
                 [[r["taught_on"],
                   r["model"] + (", thresholded" if r["statistics"] == "threshold" else ""),
                   *(percent(r[c]) for c in ("difference", "difference_obstacle",
                                             "difference_wall", "difference_floor"))]
                  for r in rows],
                 note="Share of pixels whose label is not the true one; gaussian is the thesis's.")


def by_light(rows, light):
    """{(room, model): {light in %: row}}"""
    lines = {}
    for row in rows:
        key = (row.get("room", "kitchen"), row["model"])
        lines.setdefault(key, {})[int(row[light])] = row
    return lines


def light_tables(lines, where):
    levels = list(next(iter(lines.values())))
    columns = ["room", "model", *(f"{level} % light" for level in levels)]
    return [Table(f"Floor IoU by light, taught in full light, {where}", columns,
                  [[room, model, *(row[level]["floor_iou"] for level in levels)]
                   for (room, model), row in lines.items()]),
            Table(f"Obstacle and wall called floor, {where}", columns,
                  [[room, model, *(percent(row[level]["called_floor"]) for level in levels)]
                   for (room, model), row in lines.items()])]


def light_plot(lines):
    rooms = sorted({room for room, _ in lines})
    # Geometry, and fused untaught, would lie on the line of fused.
    models = [model for model in dict.fromkeys(model for _, model in lines)
              if model not in ("geometry", "fused untaught")]
    means = {model: sorted(
        (level, sum(float(lines[room, model][level]["floor_iou"]) for room in rooms) / len(rooms))
        for level in lines[rooms[0], model]) for model in models}
    plot = line_plot("Floor found in other light than taught in (mean of three rooms)",
                     Axis("lamps, % of the light taught in"),
                     Axis("floor IoU", least=0.0, largest=1.0), means)
    return Figure("Other light than taught in (Figure 5.12): colour fails where depth does not.",
                  plot, "segment_light")


def light_bars(lines, kind):
    """Of the models that use depth and colour, in all rooms and lights."""
    fused = {key: by_level for key, by_level in lines.items() if key[1].startswith("fused")}
    ious = {key: [float(row["floor_iou"]) for row in by_level.values()]
            for key, by_level in fused.items()}
    wrong = max(float(row["called_floor"]) for by_level in fused.values()
                for row in by_level.values())
    return [at_least(f"{kind}, fused: least floor IoU", min(map(min, ious.values())),
                     FLOOR_IOU_LEAST[kind]),
            at_most(f"{kind}, fused: most called floor that is not", wrong, CALLED_FLOOR_MOST, 4),
            at_most(f"{kind}, fused: floor IoU that other light costs",
                    max(max(each) - min(each) for each in ious.values()), LIGHT_COSTS_MOST, 4)]


def run(bin_folder):
    bin_folder = pathlib.Path(bin_folder)
    simulated = by_light(rows_of(bin_folder, "light"), "lamp_percent")
    result = Result([statistics(rows_of(bin_folder, "statistics")),
                     histograms(rows_of(bin_folder, "histograms")),
                     training(rows_of(bin_folder, "training")),
                     *light_tables(simulated, "simulated rooms"), light_plot(simulated)],
                    light_bars(simulated, "simulated"))
    if not (DATA / "rgbd_7scenes_redkitchen_000_119").exists():
        result.left_out = "the recorded kitchen: rgbd_7scenes_redkitchen_000_119 in ROOMWISE_DATA"
        return result
    recorded = by_light(rows_of(bin_folder, "recorded"), "light_percent")
    result.blocks += light_tables(recorded, "recorded kitchen (7-Scenes)")
    result.bars += light_bars(recorded, "recorded")
    return result
