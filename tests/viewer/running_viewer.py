"""The real viewer on a bus of its own, and what was said on that bus."""
import os
import pathlib
import re
import signal
import subprocess
import tempfile
import time
import unittest

from raw_page import PATIENCE_s, RawPage

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = pathlib.Path(os.environ.get("ROOMWISE_PROGRAMS", ROOT / "build/release/bin"))
URL = "udpm://239.255.76.67:27691?ttl=0&recv_buf_size=2097152"
PAGE = RawPage(8091)


class RunningViewer(unittest.TestCase):
    options = ()

    def setUp(self):
        if not (PROGRAMS / "viewer").exists():
            self.skipTest("viewer is not built")
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        (self.folder / "tokens").write_text("view look-but-do-not-touch\ncontrol steer-wherever-you-want\n")
        (self.folder / "tokens").chmod(0o600)
        self.log = self.folder / "bus.lcmlog"
        self.run_beside(["lcm-logger", "-q", f"--lcm-url={URL}", self.log])
        self.said = open(self.folder / "said", "w+")
        self.addCleanup(self.said.close)
        arguments = [option.format(folder=self.folder) for option in self.options]
        self.viewer = self.run_beside([PROGRAMS / "viewer", "--url", URL, "--listen", PAGE.own,
                                       "--logs_path", self.folder, *arguments], stderr=self.said)
        self.until(self.answers, "viewer does not answer")

    def run_beside(self, command, stderr=subprocess.DEVNULL):
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=stderr)

        def stop():
            process.send_signal(signal.SIGTERM)
            process.wait(timeout=PATIENCE_s)
        self.addCleanup(stop)
        return process

    def until(self, condition, otherwise):
        end = time.monotonic() + PATIENCE_s
        while not condition():
            self.assertLess(time.monotonic(), end, otherwise)
            time.sleep(0.05)

    @staticmethod
    def answers():
        try:
            return PAGE.get("/").startswith(b"HTTP/1.1 200")
        except OSError:
            return False

    def complaints(self):
        self.said.flush()
        return (self.folder / "said").read_text()

    def messages(self):
        """channel -> how many messages the bus has heard on it."""
        table = subprocess.run([PROGRAMS / "rwlog", "info", self.log], capture_output=True, text=True)
        rows = re.findall(r"^([A-Z_]+) +\w+ +(\d+)", table.stdout, re.MULTILINE)
        return {channel: int(count) for channel, count in rows}
