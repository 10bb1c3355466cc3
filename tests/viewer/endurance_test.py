"""The viewer under what a day brings: pages loaded again and again, pages that do not read what
they asked for. It must not grow, and the bus must not notice."""
import os
import pathlib
import subprocess
import sys
import threading
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scripts"))
import private_network  # noqa: E402: found by the line above
from raw_page import frames_in
from running_viewer import PAGE, PROGRAMS, ROOT, RunningViewer, URL

SAMPLE = ROOT / "logs/samples/living_room.lcmlog"
SAMPLE_FRAMES = 81
RELOADS = 200
SLOW_PAGES = 5
GROWTH_MAX_KB = 4096


class Player:
    """The sample log on the bus, over and over, from one process after the other."""

    def __init__(self):
        self.passes = 0
        self.is_wanted = True
        self.thread = threading.Thread(target=self.play)
        self.thread.start()

    def play(self):
        while self.is_wanted:
            subprocess.run(["lcm-logplayer", f"--lcm-url={URL}", SAMPLE], check=True,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            self.passes += 1

    def end(self):
        self.is_wanted = False
        self.thread.join()


class Endurance(RunningViewer):
    def setUp(self):
        super().setUp()
        self.player = Player()
        self.addCleanup(self.player.end)

    def size(self):
        """(resident memory [kB], file handles, threads) of the viewer."""
        folder = pathlib.Path(f"/proc/{self.viewer.pid}")
        status = dict(line.split(":", 1) for line in (folder / "status").read_text().splitlines())
        handles = len(os.listdir(folder / "fd"))
        return int(status["VmRSS"].split()[0]), handles, int(status["Threads"])

    def assert_as_before(self, before):
        """What pages left behind goes away once the viewer has noticed that they are gone."""
        self.until(lambda: self.size()[1] <= before[1] and self.size()[2] <= before[2],
                   f"more handles or threads than {before[1:]} stay")
        self.assertLess(self.size()[0], before[0] + GROWTH_MAX_KB)

    def size_after_a_while(self):
        time.sleep(0.3)
        return self.size()

    def size_at_rest(self):
        """When no page is open, and the viewer has noticed that."""
        self.until(lambda: self.size()[1:] == self.size_after_a_while()[1:], "never at rest")
        return self.size()

    def look_at_page(self):
        """As a browser does: the files, then the bus until a camera frame is there."""
        for path in ("/", "/main.js", "/page.css"):
            self.assertTrue(PAGE.get(path).startswith(b"HTTP/1.1 200"), path)
        with PAGE.connected(PAGE.handshake()) as connection, connection.makefile("rb") as stream:
            while stream.readline() != b"\r\n":
                pass
            for payload in frames_in(stream):
                if payload.startswith(b"\x0cKINECT_FRAME"):
                    return
        self.fail("no camera frame came")

    def test_reloads_leave_nothing_behind(self):
        for _ in range(RELOADS // 10):
            self.look_at_page()
        before = self.size_at_rest()
        for _ in range(RELOADS):
            self.look_at_page()
        self.assert_as_before(before)

    def test_pages_that_do_not_read_delay_nobody(self):
        self.look_at_page()
        before = self.size_at_rest()
        slow = [PAGE.connected(PAGE.handshake()) for _ in range(SLOW_PAGES)]
        first_pass = self.player.passes
        self.until(lambda: self.player.passes >= first_pass + 4, "the log is not played")
        self.look_at_page()  # who reads is served beside those who do not
        for connection in slow:
            connection.close()
        self.assert_as_before(before)
        self.player.end()
        time.sleep(0.5)  # the logger writes what it heard last
        # Datagrams: on a busy machine one in hundreds is lost, whoever listens.
        played = SAMPLE_FRAMES * self.player.passes
        self.assertGreater(self.messages()["KINECT_FRAME"], 0.99 * played)


if __name__ == "__main__":
    private_network.enter()
    unittest.main()
