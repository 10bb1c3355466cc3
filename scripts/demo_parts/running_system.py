"""Everything scripts/start starts, with a logger beside it, for as long as a drive lasts."""
import pathlib
import signal
import subprocess
import tempfile
import time

from supervision import bus_url

SCRIPTS = pathlib.Path(__file__).resolve().parents[1]
BIN = SCRIPTS.parent / "build/release/bin"
BEGIN_MOST_s = 60


class Trouble(Exception):
    """What keeps the demo from going on, in words for who runs it."""


class RunningSystem:
    def __init__(self, out, scenario, camera):
        self.log = out / "drive.lcmlog"
        self.said = out / "services.txt"
        self.url = bus_url.default_url("sim")
        self.scenario, self.camera = scenario, camera
        self.run_folder = tempfile.TemporaryDirectory()  # a socket's path must be short
        self.logger = self.system = None

    def __enter__(self):
        self.logger = subprocess.Popen(
            ["lcm-logger", "--quiet", "--force", f"--lcm-url={self.url}", self.log],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        with self.said.open("w") as said:
            self.system = subprocess.Popen(
                [SCRIPTS / "start", "--sim", self.scenario, "--camera", self.camera, "--url",
                 self.url, "--run-dir", self.run_folder.name],
                stdout=said, stderr=subprocess.STDOUT, start_new_session=True)
        return self

    def __exit__(self, *_):
        for process, how in ((self.system, signal.SIGINT), (self.logger, signal.SIGTERM)):
            if process.poll() is None:
                process.send_signal(how)
        for process in (self.system, self.logger):
            process.wait(timeout=60)
        self.run_folder.cleanup()

    def goal(self, behaviour):
        return subprocess.run([BIN / "pilot_goal", behaviour, "--url", self.url],
                              capture_output=True, text=True)

    def check(self):
        if self.system.poll() is not None:
            raise Trouble(f"scripts/start ended:\n{self.said.read_text()}")

    def begin_wandering(self):
        """Returns once pilot_svc has the goal. Raises Trouble if it does not take it."""
        end = time.monotonic() + BEGIN_MOST_s
        while (answer := self.goal("wander")).returncode != 0:
            self.check()
            if time.monotonic() > end:
                raise Trouble(f"{answer.stderr}{self.said.read_text()}")

    def drive_for(self, duration_s):
        end = time.monotonic() + duration_s
        while time.monotonic() < end:
            self.check()
            time.sleep(0.5)

    def end_recording(self):
        """Stops the robot, then the logger. The log."""
        answer = self.goal("stop")
        if answer.returncode != 0:
            raise Trouble(answer.stderr)
        time.sleep(1)  # it comes to a stand
        self.logger.send_signal(signal.SIGTERM)
        self.logger.wait(timeout=20)
        return self.log

    def stay(self):
        print("\nIt stays until Ctrl-C.", flush=True)
        try:
            self.system.wait()
        except KeyboardInterrupt:
            pass
