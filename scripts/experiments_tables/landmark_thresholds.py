"""The thesis's Table 5.1 again: its slope-difference detector at 0, 100 and 1000 mm per pixel, and
landmark_svc's own method, on the same simulated frames.

Edge pixels are judged by the same drive recorded without the camera's failings: an edge pixel is
right if a jump of depth lies within 2 px of it, and a jump found if an edge pixel does. Landmarks
are judged by rwlog score. The thesis itself, by eye and on its own rooms, counts 14.5, 7.7 and 3.7
landmarks a frame, of which 62, 70 and 84 % are good.
"""
import pathlib
import subprocess
import tempfile

TITLE = "Landmarks: thresholds of the thesis, and ours"
TARGETS = ["landmark_edges", "landmark_svc", "rwlog", "simulator"]
SCENARIOS = ("living_room", "apartment")
SECONDS = "20"
NO_FAILINGS = ["--depth_noise_quanta", "0", "--depth_pattern_quanta", "0", "--ragged_px", "0",
               "--depth_far_m", "20", "--light_needed_ratio", "0", "--depth_dropout_ratio", "0"]
METHODS = [("thesis", threshold) for threshold in ("0", "100", "1000")] + [("disparity", "4")]
PRECISION_LEAST = 0.95


def run_quietly(*command):
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def record(bin_folder, log, scenario, failings):
    run_quietly(bin_folder / "simulator", "--record", log, "--scenario", scenario, "--path",
                "loop1", "--seconds", SECONDS, "--camera_size", "640x480", *failings)


def edge_pixels(bin_folder, seen, true):
    """{(method, threshold): (a frame, precision, recall)}"""
    out = subprocess.run([bin_folder.parent / "bench" / "landmark_edges", seen, true], check=True,
                         capture_output=True, text=True).stdout
    lines = [line.split() for line in out.splitlines()]
    return {(method, threshold): tuple(map(float, rest)) for method, threshold, *rest in lines}


def landmarks(bin_folder, seen, out, method, threshold):
    """(a frame, precision)"""
    options = ["--threshold_mm_per_px", threshold] if method == "thesis" else []
    run_quietly(bin_folder / "landmark_svc", "--replay", seen, "--record", out, "--method", method,
                *options)
    text = subprocess.run([bin_folder / "rwlog", "score", out], check=True, capture_output=True,
                          text=True).stdout
    scores = dict(line.split() for line in text.splitlines())
    return (float(scores["landmarks_at_rest_per_frame"]),
            float(scores.get("landmarks_precision", "nan")))


def run(bin_folder):
    met = True
    print(f"{'scenario, method, threshold':32} {'edge px':>9} {'precision':>10} {'recall':>8}"
          f" {'landmarks':>10} {'precision':>10}")
    with tempfile.TemporaryDirectory() as folder:
        seen, true, out = (pathlib.Path(folder) / name for name in ("seen", "true", "out"))
        for scenario in SCENARIOS:
            record(bin_folder, seen, scenario, [])
            record(bin_folder, true, scenario, NO_FAILINGS)
            edges = edge_pixels(bin_folder, seen, true)
            for method, threshold in METHODS:
                per_frame, precision, recall = edges[(method, threshold)]
                count, of_landmarks = landmarks(bin_folder, seen, out, method, threshold)
                print(f"{scenario}, {method}, {threshold}".ljust(32) + f" {per_frame:9.1f}"
                      f" {precision:10.4f} {recall:8.4f} {count:10.2f} {of_landmarks:10.4f}")
                if method == "disparity":
                    met = met and min(precision, of_landmarks) >= PRECISION_LEAST
    return met
