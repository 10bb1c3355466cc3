"""One frame labelled by the thesis's grey Gaussians, by a mixture of colours, and by depth and colour
fused, all taught on the same rectangles of that frame.
"""
import pathlib

from recordings import simulated
from recordings.programs import run_quietly
from report_parts.results import Figure, Result, Table, at_least

TITLE = "One frame, labelled by grey, by colour, and with depth"
TARGETS = ["rwlog", "segment_svc", "simulator"]
FRAME = 100
RECTANGLES = ("accessible,190,165,100,60", "wall,60,5,65,25", "wall,230,5,40,80",
              "obstacle,5,55,42,70", "obstacle,146,48,28,38")
MODELS = {"gaussian": "Thesis: a grey Gaussian a class", "mixture": "A mixture of colours a class",
          "fused": "Ours: depth and colour"}
FLOOR_IOU_LEAST = 0.95


def taught(bin_folder, log):
    model = simulated.scratch("model.toml")
    rectangles = [word for each in RECTANGLES for word in ("--rect", each)]
    run_quietly(bin_folder / "rwlog", "train", log, *rectangles, "--frame", str(FRAME),
                          "-o", model)
    return model


def run(bin_folder):
    bin_folder = pathlib.Path(bin_folder)
    log = simulated.drive(bin_folder, "living_room", "loop1", "--seconds", "8", "--true_labels",
                          "true")
    model_path = taught(bin_folder, log)
    table = Table("Floor in the first 8 s of the drive, against the true labels",
                  ["model", "floor IoU", "precision", "recall", "other called floor"], [])
    pictures = []
    for model, what in MODELS.items():
        out = simulated.replayed(bin_folder, "segment_svc", log, "--model", model, "--model_path",
                                 str(model_path))
        score = simulated.scores(bin_folder, out)
        table.rows.append([what, *(score[name] for name in (
            "floor_iou", "floor_precision", "floor_recall", "nonfloor_called_floor"))])
        pictures.append(Figure(
            f"{what}. Green: accessible, red: obstacle, blue: wall, grey: unknown.",
            simulated.picture(bin_folder, "labels-png", out, "--frame", str(FRAME)),
            f"labels_{model}"))
    bar = at_least("ours: floor IoU", score["floor_iou"], FLOOR_IOU_LEAST)
    return Result([table, *pictures], [bar])
