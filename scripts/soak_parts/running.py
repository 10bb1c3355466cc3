"""Services under scripts/start with a logger beside them, looked at once a second until the end."""
import pathlib
import signal
import subprocess
import time
import xmlrpc.client

from soak_parts.process_samples import sample
from supervision.control import Control
from supervision.log_player import NAME as PLAYER
from supervision.run_folder import RunFolder

SCRIPTS = pathlib.Path(__file__).resolve().parents[1]
LOOK_s = 1.0
UP_MOST_s = 30.0
END_MOST_s = 60.0


class Trouble(Exception):
    """What keeps a soak from its end, in words for who runs it."""


class Running:
    """`arguments` of scripts/start; `channels`: a regular expression of what is logged."""

    def __init__(self, folder, programs, url, arguments, channels):
        self.log = folder / "answers.lcmlog"
        self.samples = {}   # service -> [Sample]
        self.restarts = {}  # service -> how often it had another process id than before
        self._pids = {}
        self._said = folder / "services.txt"
        self._run = RunFolder(folder / "run")
        self._commands = {
            "logger": ["lcm-logger", "--quiet", f"--lcm-url={url}", f"--channel={channels}", self.log],
            "start": [SCRIPTS / "start", "--run-dir", self._run.path, "--programs", programs,
                      "--url", url, *arguments]}
        self._processes = {}

    def __enter__(self):
        with self._said.open("w") as said:
            for name, command in self._commands.items():
                self._processes[name] = subprocess.Popen(command, stdout=said, stderr=said,
                                                         start_new_session=True)
        return self

    def __exit__(self, *_):
        for name in ("start", "logger"):
            if self._processes[name].poll() is None:
                self._processes[name].send_signal(signal.SIGTERM)
            self._processes[name].wait(timeout=END_MOST_s)

    def services(self):
        try:
            return {p["name"]: p for p in Control(self._run).processes() if p["name"] != PLAYER}
        except (OSError, xmlrpc.client.Error):
            return {}

    def wait_until_up(self):
        end = time.monotonic() + UP_MOST_s
        while not (states := self.services()) or any(p["statename"] != "RUNNING"
                                                     for p in states.values()):
            if time.monotonic() > end or not self.is_on():
                raise Trouble(f"not all services came up:\n{self._said.read_text()}")
            time.sleep(0.1)

    def is_on(self):
        return self._processes["start"].poll() is None

    def look(self):
        for name, state in self.services().items():
            if not state["pid"] or not (seen := sample(state["pid"], time.time())):
                continue
            known = self._pids.setdefault(name, state["pid"])
            self.restarts[name] = self.restarts.get(name, 0) + (known != state["pid"])
            self._pids[name] = state["pid"]
            self.samples.setdefault(name, []).append(seen)

    def watch(self, until_s=float("inf")):
        """Until then, or the end of the log that is played."""
        while self.is_on() and time.time() < until_s:
            self.look()
            time.sleep(LOOK_s)
