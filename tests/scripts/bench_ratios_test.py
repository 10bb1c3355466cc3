"""scripts/bench: the closing table of ratios, from made-up measurements."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/bench"))

import ratios  # noqa: E402: found by the line above


def run(name, cpu_time, unit="ms", **counters):
    return {"name": name, "cpu_time": cpu_time, "time_unit": unit, **counters}


def detector(per_pixel_of_1280=1.1):
    return [run(f"whole_tiled/{width}", 1.0, ns_per_pixel=ns) for width, ns in
            ((160, 1.0), (320, 1.02), (640, 1.05), (1280, per_pixel_of_1280))] + [
        run("whole_room/640", 900, "us"), run("edges_room/640", 400, "us"),
        run("canny_room/640", 1000, "us"), run("orb_room/640", 3600, "us")]


def ekf(peers=("mrpt_naive", "mrpt_davison")):
    frames = [run("landmarks_300/roomwise/frame", 50, "us")]
    frames += [run(f"landmarks_300/{peer}/frame", 20.0 - i) for i, peer in enumerate(peers)]
    return frames + [run("sweep_1000/roomwise/pass", 1.0, GB_per_s=6.0),
                     run("memory/in_place/pass", 1.0, GB_per_s=10.0)]


class Ratios(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def rows(self, program, runs):
        (self.folder / f"{program}.json").write_text(json.dumps({"benchmarks": runs}))
        return {row.what: row for row in ratios.rows(self.folder)}

    def filter_row(self, runs):
        """The one with a bar."""
        self.rows("ekf_bench", runs)
        return next(row for row in ratios.rows(self.folder)
                    if row.what == "SLAM frame, 300 landmarks" and row.bar())

    def test_a_ratio_is_how_many_times_faster_whatever_the_units(self):
        row = self.rows("detector_bench", detector())["all of it, against ORB and matching"]
        self.assertAlmostEqual(row.value, 4.0)
        self.assertEqual(row.cells(), ["all of it, against ORB and matching", "0.9 ms",
                                       "3.6 ms, orb_room/640", "4", ">= 5", "MISSED"])

    def test_a_share_of_a_limit_holds_up_to_one(self):
        rows = self.rows("detector_bench", detector())
        self.assertAlmostEqual(rows["landmarks of a VGA frame"].value, 0.6)
        self.assertEqual(rows["landmarks of a VGA frame"].verdict(), "held")
        self.assertEqual(ratios.share_of("x", [1.0, 0.6], 1.5, "ms").verdict(), "MISSED")

    def test_time_per_pixel_may_differ_by_15_per_cent(self):
        what = "its ns a pixel, 160x120 to 1280x960: most"
        self.assertEqual(self.rows("detector_bench", detector(1.14))[what].verdict(), "held")
        self.assertEqual(self.rows("detector_bench", detector(1.16))[what].verdict(), "MISSED")

    def test_the_fastest_of_several_peers_counts(self):
        runs = ratios.Runs({"benchmarks": [run("ours", 0.5), run("slow", 20.0), run("fast", 19.0)]})
        row = ratios.times_faster(runs, "x", "ours", ["slow", "fast", "absent"], least=39.0)
        self.assertEqual((row.value, row.peer, row.verdict()), (38.0, "19 ms, fast", "MISSED"))

    def test_the_bar_of_the_filter_is_that_of_mrpt_as_it_comes(self):
        self.rows("ekf_bench", ekf())
        judged = {row.peer: row.verdict() for row in ratios.rows(self.folder)
                  if row.what == "SLAM frame, 300 landmarks"}
        self.assertEqual(judged, {"20 ms, landmarks_300/mrpt_naive/frame": "held",
                                  "19 ms, landmarks_300/mrpt_davison/frame": ""})

    def test_a_peer_that_is_absent_or_failed_is_not_installed_and_nothing_holds(self):
        row = self.filter_row(ekf(peers=()))
        self.assertEqual((row.peer, row.value, row.verdict()),
                         ("not installed", None, "not installed"))
        broken = [run("landmarks_300/mrpt_naive/frame", 0.1) | {"error_occurred": True,
                                                                "error_message": "map differs"}]
        self.assertEqual(self.filter_row(ekf(peers=()) + broken).verdict(), "not installed")

    def test_what_ours_did_not_measure_does_not_hold(self):
        rows = self.rows("ekf_bench", ekf())
        self.assertEqual(rows["covariance sweep, 1000 landmarks"].verdict(), "MISSED")
        self.assertEqual(rows["covariance sweep, 2000 landmarks"].verdict(), "not measured")

    def test_recorded_frames_are_judged_where_there_are_any(self):
        def codec(source, encode_ms):
            return [run(f"{source}/pdz16/{do}", time_ms, bytes=60_000.0)
                    for do, time_ms in (("encode", encode_ms), ("decode", 1.0))]
        simulated = codec("simulated_640x480", 2.0)
        rows = self.rows("depth_codec_bench", simulated)
        self.assertAlmostEqual(rows["depth codec, encode and decode"].value, 0.75)
        rows = self.rows("depth_codec_bench", simulated + codec("kinect_v1_640x480", 4.0))
        self.assertAlmostEqual(rows["depth codec, encode and decode"].value, 1.25)
        self.assertAlmostEqual(rows["depth codec, bytes of kinect_v1_640x480"].value, 60 / 70)

    def test_the_table_has_what_ran_and_no_more(self):
        self.rows("detector_bench", detector())
        printed = subprocess.run([ROOT / "tests/bench/ratios.py", self.folder], check=True,
                                 capture_output=True, text=True).stdout.splitlines()
        self.assertEqual(len(printed), 2 + 4)
        self.assertRegex(printed[2], r"landmarks of a VGA frame +0.9 ms +limit 1.5 ms +0.6 +<= 1 +held")


if __name__ == "__main__":
    unittest.main()
