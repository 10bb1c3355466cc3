"""scripts/start and scripts/replay with the real programs, in a private network."""
import csv
import math
import pathlib
import random
import signal
import struct
import subprocess
import sys
import threading
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "viewer")]
import private_network  # noqa: E402: found by the line above
from raw_page import RawPage, frame
from started_run import PROGRAMS, ROOT, StartedRun  # noqa: E402

from supervision.control import Control  # noqa: E402

URL = "udpm://239.255.76.67:27667?ttl=0"
SAMPLE = ROOT / "logs/samples/living_room.lcmlog"
SERVICES = ("simulator", "create_driver", "kinect_pub", "landmark_svc", "segment_svc", "ekf_svc")
ANSWERS = {"TRUTH", "CREATE_STATE", "KINECT_FRAME", "LANDMARKS", "SEGMENTS", "POSE"}


class Driver:
    """Asks for a motion through the viewer, as a page whose key is held, until nobody listens."""
    GOLDEN = HERE.parent / "lcmtypes/golden/velocity_request_t.hex"

    def __init__(self, speed_mps):
        fingerprint = bytes.fromhex(self.GOLDEN.read_text())[:8]
        source, priority, valid_for_us = b"test\0", 50, 300_000
        message = fingerprint + struct.pack(f">qqi{len(source)}siqdd", 0, 0, len(source), source,
                                            priority, valid_for_us, speed_mps, 0.0)
        self.request = frame(b"\x0bVEL_REQUEST" + message)
        page = RawPage(8090)
        self.connection = page.connected(page.handshake())
        self.over = threading.Event()
        self.threads = [threading.Thread(target=work) for work in (self.ask, self.read)]
        for thread in self.threads:
            thread.start()

    def ask(self):
        try:
            while not self.over.wait(0.1):
                self.connection.sendall(self.request)
        except OSError:
            pass

    def read(self):
        try:
            while not self.over.is_set() and self.connection.recv(1 << 20):
                pass
        except OSError:
            pass

    def end(self):
        self.over.set()
        self.connection.close()
        for thread in self.threads:
            thread.join()


class RunningSystem(StartedRun):
    def setUp(self):
        super().setUp()
        absent = [name for name in (*SERVICES, "rwlog") if not (PROGRAMS / name).exists()]
        if absent:
            self.skipTest(f"{', '.join(absent)} not built")

    def record(self, url=URL):
        log = self.scratch / f"{random.getrandbits(32)}.lcmlog"
        recorder = subprocess.Popen(["lcm-logger", "-q", f"--lcm-url={url}", log],
                                    stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

        def stop():
            recorder.send_signal(signal.SIGTERM)
            recorder.wait(timeout=10)
        self.addCleanup(stop)
        return log

    @staticmethod
    def channels(log):
        """Channels that hold something; a log still written to may end in half a message."""
        if not log.exists():
            return set()
        table = subprocess.run([PROGRAMS / "rwlog", "info", log], capture_output=True, text=True).stdout
        return {line.split()[0] for line in table.splitlines() if line}

    def assert_works(self, when):
        log = self.record()
        self.until(f"all messages {when}", lambda: ANSWERS <= self.channels(log))

    def test_it_works_again_after_any_of_them_is_killed_and_in_any_order(self):
        self.start("--sim", "empty", "--url", URL, "--only", ",".join(SERVICES))
        before = self.until("all", self.all_up)
        self.assert_works("at first")
        for name in SERVICES:
            self.kill(before[name]["pid"])
        after = self.until("all again", lambda: self.restarted(before))
        self.assert_works("after kill -9 of each")

        control, order = Control(self.folder), list(SERVICES)
        random.Random(2012).shuffle(order)
        for name in after:
            control.stop(name)
        for name in order:
            control.start(name)
        self.until("all", self.all_up)
        self.assert_works(f"started as {order}")
        self.assertEqual(self.end(), 0)
        self.assertFalse(self.processes())

    @staticmethod
    def moved_lately_m(log, lately_s=0.3):
        """How far the robot truly came in the log's last part."""
        table = subprocess.run([PROGRAMS / "rwlog", "csv", log, "TRUTH"], capture_output=True, text=True)
        places = [(1e-6 * int(row["utime"]), float(row["true_x_m"]), float(row["true_y_m"]))
                  for row in csv.DictReader(table.stdout.splitlines()) if row["true_y_m"]]
        last = [place for time_s, *place in places if time_s > places[-1][0] - lately_s]
        return math.dist(last[0], last[-1]) if last else 0.0

    def simulated_robot(self):
        """A robot and a room that outlive the services, as real ones do."""
        simulator = subprocess.Popen(
            [PROGRAMS / "simulator", "--url", URL, "--scenario", "empty", "--create_port",
             self.folder.create_port, "--kinect_door", self.folder.kinect_door()],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

        def stop():
            simulator.terminate()
            simulator.wait(timeout=10)
        self.addCleanup(stop)

    def test_ctrl_c_leaves_a_driving_robot_standing(self):
        log = self.record()
        self.start("--sim", "empty", "--without", "simulator", "--url", URL)
        self.until("all", self.all_up)
        self.simulated_robot()
        driver = Driver(speed_mps=0.2)
        self.addCleanup(driver.end)
        self.until("a driving robot", lambda: self.moved_lately_m(log) > 0.05)
        self.process.send_signal(signal.SIGINT)
        self.assertEqual(self.process.wait(timeout=30), 0)
        self.until("a robot that stands", lambda: self.moved_lately_m(log) < 0.002)

    def restarted(self, before):
        now = self.all_up()
        return now if now and all(now[n]["pid"] != before[n]["pid"] for n in now) else {}

    def test_a_replay_answers_on_its_own_bus_and_ends_with_the_log(self):
        log = self.record()
        replay = subprocess.run(
            [ROOT / "scripts/replay", SAMPLE, "landmark_svc", "--", "--run-dir", self.folder.path,
             "--url", URL, "--programs", PROGRAMS], capture_output=True, text=True, timeout=60)
        self.assertEqual(replay.returncode, 0, replay.stdout + replay.stderr)
        self.assertIn("landmark_svc, player on", replay.stdout)
        self.assertTrue({"KINECT_FRAME", "TRUTH", "LANDMARKS"} <= self.channels(log), replay.stdout)


if __name__ == "__main__":
    private_network.enter()
    unittest.main()
