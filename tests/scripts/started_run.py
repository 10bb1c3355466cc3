"""A scripts/start in a scratch folder, with real programs or with stand-ins."""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import xmlrpc.client

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

from supervision.control import Control  # noqa: E402: found by the line above
from supervision.run_folder import RunFolder  # noqa: E402

PROGRAMS = pathlib.Path(os.environ.get("ROOMWISE_PROGRAMS", ROOT / "build/release/bin"))
PATIENCE_s = 30.0
STAND_IN = "#!/bin/sh\necho started with \"$@\"\nexec sleep 1000\n"


class StartedRun(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.scratch = pathlib.Path(scratch.name)
        self.folder = RunFolder(self.scratch / "run")
        self.output = self.scratch / "output"
        self.process = None

    def stand_ins(self, *names, text=STAND_IN):
        """A folder of little programs that stay up; to be given as --programs."""
        folder = self.scratch / "bin"
        folder.mkdir(exist_ok=True)
        for name in names:
            (folder / name).write_text(text)
            (folder / name).chmod(0o755)
        return folder

    def start(self, *arguments, programs=PROGRAMS):
        with open(self.output, "ab") as output:
            self.process = subprocess.Popen(
                [ROOT / "scripts/start", "--run-dir", self.folder.path, "--programs", programs,
                 *arguments], stdout=output, stderr=output)
        self.addCleanup(self.end)

    def end(self):
        if self.process.poll() is None:
            self.process.terminate()
        return self.process.wait(timeout=PATIENCE_s)

    def said(self):
        return self.output.read_text()

    def processes(self):
        """name -> what supervisor says of it."""
        try:
            return {p["name"]: p for p in Control(self.folder).processes()}
        except (OSError, xmlrpc.client.Error):
            return {}

    def until(self, what, condition):
        end = time.monotonic() + PATIENCE_s
        while not (found := condition()):
            self.assertLess(time.monotonic(), end, f"{what} did not come; output:\n{self.said()}")
            time.sleep(0.05)
        return found

    def all_up(self):
        states = self.processes()
        return states if states and all(p["statename"] == "RUNNING" for p in states.values()) else {}

    def run_script(self, name, *arguments):
        return subprocess.run([ROOT / "scripts" / name, "--run-dir", self.folder.path, *arguments],
                              capture_output=True, text=True, timeout=PATIENCE_s)

    @staticmethod
    def is_alive(pid):
        try:
            state = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0]
        except FileNotFoundError:
            return False
        return state != "Z"

    @staticmethod
    def kill(pid):
        os.kill(pid, signal.SIGKILL)
