"""scripts/start, stop and status, with stand-ins for the services."""
import pathlib
import re
import signal
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from started_run import ROOT, StartedRun  # noqa: E402: found by the line above

from supervision import bus_url, log_player, services  # noqa: E402


class Start(StartedRun):
    def test_starts_what_is_built_in_order_and_names_what_is_not(self):
        self.start("--sim", "empty", programs=self.stand_ins("ekf_svc", "simulator", "create_driver"))
        states = self.until("all", self.all_up)
        self.assertEqual(sorted(states), ["create_driver", "ekf_svc", "simulator"])
        pids = [states[name]["pid"] for name in ("simulator", "create_driver", "ekf_svc")]
        self.assertEqual(pids, sorted(pids))
        self.assertIn("safety_svc is not built and left out (scripts/build release safety_svc)",
                      self.said())
        self.assertRegex(self.said(), r"simulator +\| started with .*--scenario empty")
        self.assertRegex(self.said(), r"create_driver +\| started with .*--port \S+/run/create")

    def test_ctrl_c_twice_stops_everything_once(self):
        self.start(programs=self.stand_ins("simulator", "create_driver", "viewer"))
        pids = [p["pid"] for p in self.until("all", self.all_up).values()]
        self.process.send_signal(signal.SIGINT)
        self.process.send_signal(signal.SIGINT)
        self.assertEqual(self.process.wait(timeout=15), 0)
        self.assertFalse([pid for pid in pids if self.is_alive(pid)])
        self.assertTrue(self.said().endswith("start: stopped\n"))

    def test_who_ignores_every_signal_is_stopped_all_the_same(self):
        stubborn = "#!/bin/sh\ntrap '' INT TERM\nwhile :; do sleep 1; done\n"
        self.start(programs=self.stand_ins("viewer", text=stubborn))
        pid = self.until("all", self.all_up)["viewer"]["pid"]
        self.assertEqual(self.end(), 0)
        self.assertFalse(self.is_alive(pid))

    def test_nothing_outlives_a_killed_supervisor_or_a_killed_start(self):
        for victim in ("supervisord", "start"):
            with self.subTest(victim):
                self.start(programs=self.stand_ins("simulator", "viewer"))
                pids = [p["pid"] for p in self.until("all", self.all_up).values()]
                supervisord = int(self.folder.supervisor_pid.read_text())
                self.kill(supervisord if victim == "supervisord" else self.process.pid)
                self.assertEqual(self.process.wait(timeout=15), 1 if victim == "supervisord" else -9)
                self.until("the end of all", lambda: not any(map(self.is_alive, pids)))
                self.until("its end", lambda: not self.is_alive(supervisord))

    def test_who_cannot_stay_up_is_tried_again_with_longer_pauses(self):
        self.start(programs=self.stand_ins("viewer", text="#!/bin/sh\ndate +%s.%N\nexit 1\n"))
        log = self.folder.log("viewer")
        self.until("five tries", lambda: log.exists() and len(log.read_text().split()) >= 5)
        times = [float(word) for word in log.read_text().split()]
        pauses = [later - earlier for earlier, later in zip(times, times[1:])]
        self.assertGreater(max(pauses), pauses[0] + 0.5)
        down = self.run_script("status")
        self.assertEqual(down.returncode, 1)
        self.assertRegex(down.stdout, r"viewer +(BACKOFF|STARTING|FATAL)")

    def test_a_second_start_is_refused_and_stop_works_from_anywhere(self):
        programs = self.stand_ins("simulator", "ekf_svc")
        self.start(programs=programs)
        self.until("all", self.all_up)
        second = self.run_script("start", "--programs", programs)
        self.assertEqual(second.returncode, 1)
        self.assertIn("already running", second.stderr)
        shown = self.run_script("status")
        self.assertEqual(shown.returncode, 0)
        self.assertRegex(shown.stdout, r"simulator +RUNNING +\d+ +\d+ s")
        self.assertEqual(self.run_script("stop").stdout, "stop: stopped\n")
        self.assertEqual(self.process.wait(timeout=15), 0)
        self.assertIn("nothing runs", self.run_script("stop").stdout)
        self.assertEqual(self.run_script("status").returncode, 1)

    def test_only_and_without_choose_and_foreign_names_are_refused(self):
        def names(mode, only=(), without=()):
            return [s.name for s in services.chosen(mode, only, without)]
        self.assertEqual(names("sim", only=["ekf_svc", "simulator"]), ["simulator", "ekf_svc"])
        self.assertNotIn("viewer", names("robot", without=["viewer"]))
        self.assertNotIn("simulator", names("robot"))
        for what in ({"only": ["nobody"]}, {"without": ["nobody"]}, {"only": ["simulator"]}):
            with self.assertRaises(ValueError):
                names("robot", **what)

    def test_a_key_from_a_file_goes_to_who_signs_and_to_who_checks(self):
        key = self.scratch / "drive.key"
        self.start("--key", key, programs=self.stand_ins("create_driver", "safety_svc", "ekf_svc"))
        self.until("all", self.all_up)
        self.assertRegex(self.said(), rf"create_driver +\| started with .*--key_path {key}\n")
        self.assertRegex(self.said(), rf"safety_svc +\| .*--key_path {key} --make_key false\n")
        self.assertEqual(self.said().count(str(key)), 2)
        unit = self.run_script("start", "--robot", "--key", key, "--print-unit")
        self.assertIn(f" --key {key}\n", unit.stdout)

    def test_a_replay_starts_nothing_that_drives_and_plays_no_commands(self):
        replayed = [s.name for s in services.chosen("replay", [], [])]
        self.assertFalse({"create_driver", "kinect_pub", "safety_svc", "pilot_svc", "simulator"}
                         & set(replayed))
        played = log_player.played_channels(replayed)
        self.assertIn("KINECT_FRAME", played)
        self.assertFalse({*services.COMMANDS, "LANDMARKS", "SEGMENTS", "POSE", "LANDMARK_MAP"}
                         & set(played))
        self.assertNotEqual(bus_url.port(bus_url.default_url("replay")), bus_url.LIVE_PORT)

    def test_the_systemd_unit_runs_this_script_and_is_sound(self):
        made = self.run_script("start", "--robot", "--without", "viewer", "--print-unit")
        self.assertIn(f"ExecStart={ROOT}/scripts/start --robot --without viewer --run-dir ", made.stdout)
        unit = self.scratch / "roomwise.service"
        unit.write_text(made.stdout)
        try:
            judged = subprocess.run(["systemd-analyze", "verify", "--man=no", unit], text=True,
                                    capture_output=True)
        except FileNotFoundError:
            self.skipTest("systemd-analyze is not installed")
        self.assertFalse(re.findall(r".*roomwise\.service.*", judged.stdout + judged.stderr))


if __name__ == "__main__":
    unittest.main()
