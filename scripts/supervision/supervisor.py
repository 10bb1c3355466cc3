"""One run under supervisord, from its start to the end of its last service."""
import os
import shutil
import signal
import subprocess
import sys
import time
import xmlrpc.client

from supervision.configuration import STOP_s, configuration
from supervision.control import Control
from supervision.log_follower import LogFollower

LOOK_s = 0.2
REVIVE_s = 10.0
SUPERVISORD = shutil.which("supervisord", path=os.environ.get("PATH", "") + ":/usr/bin") or ""


def say(text):
    print(f"start: {text}", flush=True)


class Run:
    """`once`: name of the job whose end is the end of the run; None: it runs until told to stop."""

    def __init__(self, folder, jobs, environment, once=None):
        self._folder = folder
        self._jobs = jobs
        self._environment = environment
        self._once = once
        self._control = Control(folder)
        self._followers = {}
        self._stop_asked = 0
        self._next_revival = time.monotonic() + REVIVE_s

    def run(self):
        """Exit status: 0 after a stop, 1 if the supervisor ended by itself."""
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, self._on_signal)
        self._folder.configuration.write_text(configuration(self._folder, self._jobs))
        self._folder.socket.unlink(missing_ok=True)
        names = [name for name, *_ in self._jobs]
        self._followers = {name: LogFollower(self._folder.log(name)) for name in names}
        # A session of its own: Ctrl-C reaches this script alone, which then stops things in order.
        supervisor = subprocess.Popen(
            ["setpriv", "--pdeathsig", "TERM", "--", SUPERVISORD, "-n", "-c",
             str(self._folder.configuration)],
            env=self._environment, start_new_session=True, stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL, stderr=subprocess.STDOUT)
        while supervisor.poll() is None and not self._stop_asked and not self._is_over():
            self._show_lines()
            self._revive()
            time.sleep(LOOK_s)
        died = supervisor.poll() is not None
        self._stop(supervisor)
        self._show_lines()
        if died:
            say(f"supervisord ended by itself; see {self._folder.log('supervisord')}")
        return 1 if died else 0

    def _on_signal(self, _number, _frame):
        self._stop_asked += 1
        if self._stop_asked > 1:
            os.write(sys.stdout.fileno(), b"start: already stopping\n")

    def _show_lines(self):
        width = max(map(len, self._followers))
        for name, follower in self._followers.items():
            for line in follower.new_lines():
                print(f"{name:<{width}} | {line}", flush=True)

    def _states(self):
        try:
            return {p["name"]: p["statename"] for p in self._control.processes()}
        except (OSError, xmlrpc.client.Error):
            return {}

    def _is_over(self):
        return self._once is not None and self._states().get(self._once) in ("EXITED", "FATAL")

    def _revive(self):
        """What supervisord gave up is tried again: cables come back."""
        if time.monotonic() < self._next_revival:
            return
        self._next_revival = time.monotonic() + REVIVE_s
        for name, state in self._states().items():
            if state == "FATAL" and name != self._once:
                say(f"{name} does not stay up; trying again (see {self._folder.log(name)})")
                self._ask(self._control.start, name)

    def _stop(self, supervisor):
        """The wheels first, then the others, last started first."""
        if supervisor.poll() is None:
            say("stopping")
            self._ask(self._control.stop, "create_driver")
            supervisor.terminate()
        try:
            supervisor.wait(timeout=4 * STOP_s)
        except subprocess.TimeoutExpired:
            supervisor.kill()
            supervisor.wait()
        say("stopped")

    @staticmethod
    def _ask(method, name):
        try:
            method(name)
        except (OSError, xmlrpc.client.Error):
            pass  # not part of this run, gone, or just changing its state
