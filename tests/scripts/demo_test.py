"""scripts/demo: how it judges a drive, and one short drive of the real system in a private network."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import private_network  # noqa: E402: found by the line above

ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "scripts"))
from demo_parts import log_events, summary  # noqa: E402
from demo_parts.figures import Figure, driven  # noqa: E402

SAMPLE = ROOT / "logs/samples/living_room.lcmlog"


def truth(*rows):
    return [{"utime": f"{100_000 * i}", "true_x_m": f"{x_m}", "true_y_m": "0", "contacts": f"{touches}"}
            for i, (x_m, touches) in enumerate(rows)]


class Log(unittest.TestCase):
    def test_events_are_those_of_the_channel_in_order(self):
        frames = list(log_events.events(SAMPLE, ("KINECT_FRAME",)))
        self.assertEqual([frame.seq for frame in frames],
                         list(range(frames[0].seq, frames[0].seq + 81)))
        self.assertEqual(sorted(frame.utime for frame in frames),
                         [frame.utime for frame in frames])

    def test_a_cut_off_message_is_left_out_and_no_log_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            cut = pathlib.Path(folder) / "cut.lcmlog"
            cut.write_bytes(SAMPLE.read_bytes()[:-10])
            whole = sum(1 for _ in log_events.messages(SAMPLE, ("TRUTH", "ODOMETRY", "CREATE_STATE",
                                                                "KINECT_FRAME", "TRUE_SEGMENTS")))
            kept = sum(1 for _ in log_events.messages(cut, ("TRUTH", "ODOMETRY", "CREATE_STATE",
                                                            "KINECT_FRAME", "TRUE_SEGMENTS")))
            self.assertEqual(kept, whole - 1)
            cut.write_bytes(b"x" * 100)
            with self.assertRaisesRegex(ValueError, "no event at byte 0"):
                list(log_events.events(cut, ("TRUTH",)))


class Judgement(unittest.TestCase):
    def test_a_contact_counts_once_and_only_at_speed(self):
        way_m, contacts = driven(truth((0.0, 0), (0.02, 1), (0.04, 1), (0.04, 0), (0.045, 1)))
        self.assertAlmostEqual(way_m, 0.045)
        self.assertEqual(contacts, 1)

    def test_a_bar_that_does_not_hold_is_told(self):
        missed = Figure("path, RMSE", 0.06, "m", most=0.05)
        nothing = Figure("path, RMSE", float("nan"), "m", most=0.05)
        self.assertFalse(missed.held())
        self.assertFalse(nothing.held())
        self.assertIn("MISSED", summary.table([Figure("driven", 3.0), missed]))
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "summary.json"
            summary.write([Figure("driven", 3.0, least=1.0), missed], path)
            told = json.loads(path.read_text())
        self.assertFalse(told["held"])
        self.assertEqual([figure["held"] for figure in told["figures"]], [True, False])


class Drive(unittest.TestCase):
    def test_a_short_drive_is_recorded_judged_and_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "out"
            run = subprocess.run([ROOT / "scripts/demo", "--headless", "--minutes", "0.2", "--out",
                                  out], capture_output=True, text=True)
            self.assertTrue((out / "summary.json").exists(), run.stdout + run.stderr)
            told = json.loads((out / "summary.json").read_text())
            self.assertEqual(run.returncode, 0 if told["held"] else 1, run.stderr)
            figures = {figure["name"]: figure for figure in told["figures"]}
            self.assertGreater(figures["driven"]["value"], 0.1)
            self.assertEqual(figures["contacts faster than 0.1 m/s"]["value"], 0)
            for name in ("landmark_svc", "segment_svc", "ekf_svc", "pilot_svc"):
                self.assertGreater(figures[f"{name} says the same replayed"]["value"], 0)
            for name in ("drive.lcmlog", "map.png", "landmarks.png", "labels.png", "path.txt"):
                self.assertGreater((out / name).stat().st_size, 100)
            self.assertIn("exposure to command, 99 %", run.stdout)


if __name__ == "__main__":
    private_network.enter()
    unittest.main()
