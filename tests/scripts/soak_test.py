"""scripts/soak: what it calls a leak, and one short run of each kind in a private network."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import private_network  # noqa: E402: found by the line above
from started_run import PROGRAMS, ROOT  # noqa: E402: makes what scripts/ holds importable

from soak_parts import quarters  # noqa: E402
from soak_parts.process_samples import Sample, sample  # noqa: E402

MB = 1_000_000
RUN = quarters.Run(begin_s=1000.0, end_s=1400.0, speed=10.0)
REPLAYED = {"landmark_svc", "segment_svc", "ekf_svc", "viewer"}
LIVE = REPLAYED | {"simulator", "create_driver", "kinect_pub", "safety_svc", "pilot_svc"}


def every_second(value_at):
    return [(float(at_s), value_at(at_s - 1000)) for at_s in range(1000, 1401)]


def samples(memory_bytes=lambda _: 50 * MB, files=lambda _: 10):
    return [Sample(at_s, memory, files(at_s - 1000), 3)
            for at_s, memory in every_second(memory_bytes)]


def missed(seen, handlers_ms=lambda _: 1.0, answers_ms=lambda _: 5.0, restarts=0):
    """What is not as it was, by name."""
    found = quarters.rows(RUN, {"a_svc": seen}, {"a_svc": restarts},
                          {"a_svc": every_second(handlers_ms)}, {"ANSWER": every_second(answers_ms)})
    return [row.what for row in found if not row.held]


class Quarters(unittest.TestCase):
    def test_what_stays_as_it_was_holds(self):
        self.assertEqual(missed(samples()), [])

    def test_what_is_taken_once_at_the_start_is_no_leak(self):
        self.assertEqual(missed(samples(lambda since_s: min(since_s, 40) * MB)), [])

    def test_memory_may_grow_by_a_megabyte_or_two_per_cent_and_no_more(self):
        grown = {100 * MB: 2 * MB, 10 * MB: MB}
        for before, by in grown.items():
            with self.subTest(before):
                def memory(since_s, more=0, before=before, by=by):
                    return before + (by + more if since_s >= 300 else 0)
                self.assertEqual(missed(samples(memory)), [])
                self.assertEqual(missed(samples(lambda s, more=memory: more(s, 4096))),
                                 ["a_svc memory"])

    def test_the_slope_is_in_an_hour_of_the_robots_life(self):
        row = quarters.memory_row(RUN, "a_svc", samples(lambda since_s: (50 + 0.01 * since_s) * MB))
        self.assertAlmostEqual(row.per_hour, 0.01 * 3600 / 10)
        self.assertFalse(row.held)

    def test_one_more_open_file_is_told(self):
        leak = samples(files=lambda since_s: 10 + (since_s > 390))
        self.assertEqual(missed(leak), ["a_svc open files"])

    def test_half_as_slow_again_holds_and_slower_does_not(self):
        def slower(by):
            return lambda since_s: by if since_s >= 300 else 1.0
        self.assertEqual(missed(samples(), slower(1.5), slower(1.5)), [])
        self.assertEqual(missed(samples(), slower(1.51), slower(1.51)),
                         ["a_svc handlers, mean", "ANSWER after its question, 99 %"])

    def test_who_was_started_again_or_says_nothing_does_not_hold(self):
        self.assertEqual(missed(samples(), restarts=1), ["a_svc started again, 1 times"])
        silent = quarters.rows(RUN, {"a_svc": samples()}, {"a_svc": 0}, {}, {"ANSWER": []})
        self.assertEqual([row.what for row in silent if not row.held],
                         ["a_svc handlers, mean", "ANSWER after its question, 99 %"])
        self.assertIn("MISSED", quarters.text(silent))


class OneProcess(unittest.TestCase):
    def test_an_open_file_and_a_thread_are_counted(self):
        before, over = sample(os.getpid(), 0.0), threading.Event()
        thread = threading.Thread(target=over.wait)
        thread.start()
        with tempfile.TemporaryFile():
            after = sample(os.getpid(), 1.0)
        over.set()
        thread.join()
        self.assertEqual((after.files, after.threads), (before.files + 1, before.threads + 1))
        self.assertGreater(after.memory_bytes, MB)

    def test_who_is_gone_has_no_sample(self):
        process = subprocess.Popen(["true"])
        process.wait()
        self.assertIsNone(sample(process.pid, 0.0))


class RealRun(unittest.TestCase):
    """Of a minute: caches still fill and the map still grows, so memory and times are not judged."""

    def rows(self, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "rows.json"
            done = subprocess.run([ROOT / "scripts/soak", "--programs", PROGRAMS, "--json", out,
                                   *arguments], capture_output=True, text=True, timeout=100)
            self.assertIn(done.returncode, (0, 1), done.stdout + done.stderr)
            found = json.loads(out.read_text()) if out.exists() else []
        self.assertTrue(found, done.stdout + done.stderr)
        self.assertEqual(done.returncode, 0 if all(row["held"] for row in found) else 1)
        return {row["what"]: row for row in found}

    def judge(self, rows, services):
        self.assertEqual({what.removesuffix(" memory") for what in rows if what.endswith(" memory")},
                         services)
        for service in services:
            for what in ("open files", "threads"):
                self.assertTrue(rows[f"{service} {what}"]["held"], rows[f"{service} {what}"])
            self.assertGreater(rows[f"{service} memory"]["quarters"][0], 1.0)
        for channel in ("LANDMARKS", "SEGMENTS", "POSE"):
            times_ms = rows[f"{channel} after its question, 99 %"]["quarters"]
            self.assertEqual(len(times_ms), 4)
            self.assertGreater(min(times_ms), 0.0)
            self.assertLess(max(times_ms), 1000.0)
        self.assertFalse([what for what in rows if "started again" in what])

    def test_a_minute_replayed(self):
        self.judge(self.rows("--minutes", "1", "--speed", "6"), REPLAYED)

    def test_half_a_minute_live(self):
        self.judge(self.rows("--live", "--minutes", "0.4"), LIVE)


if __name__ == "__main__":
    private_network.enter()
    unittest.main()
