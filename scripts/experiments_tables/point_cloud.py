"""One frame of the simulated Kinect as coloured points, seen from above and behind the camera."""
import pathlib

from plotting.point_view import View, picture
from recordings import point_file, simulated
from report_parts.results import Figure, Result, Table

TITLE = "One frame as coloured points"
TARGETS = ["rwlog", "simulator"]
FRAME = 100
PIXELS = 640 * 480
SEEN_FROM = View(at_m=(-0.9, 1.7, 2.3), to_m=(2.6, 0.0, 0.5))


def run(bin_folder):
    bin_folder = pathlib.Path(bin_folder)
    log = simulated.drive(bin_folder, "living_room", "loop1", "--seconds", "4", "--camera_size",
                          "640x480")
    points = point_file.of_frame(bin_folder, log, FRAME)
    table = Table("Pixels of the frame", ["", "pixels", "share"],
                  [["with a reading to 5 m", str(len(points)), f"{len(points) / PIXELS:.1%}"],
                   ["without", str(PIXELS - len(points)), f"{1 - len(points) / PIXELS:.1%}"]])
    return Result([Figure("Frame 100 of the living room, from 0.9 m behind, 1.7 m left and 2.3 m up. "
                          "White is what the camera does not see: what lies behind things, and where "
                          "a mirror or glass gives no reading.", picture(points, SEEN_FROM),
                          "point_cloud"), table])
