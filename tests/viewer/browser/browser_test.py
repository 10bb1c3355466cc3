"""The viewer's page in a real browser, against the real programs and the simulator, in a private
network. usage: browser_test.py [--keep FOLDER] [WALK...]   FOLDER gets the screenshots."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
import private_network  # noqa: E402: found by the line above
from started_run import PROGRAMS, ROOT, StartedRun  # noqa: E402

URL = "udpm://239.255.76.67:27690?ttl=0&recv_buf_size=2097152"
PAGE = "http://127.0.0.1:8090/"
NODE_MODULES = PROGRAMS.parent / "services/viewer/page/node_modules"
WALK = pathlib.Path(__file__).with_name("walk.mjs")
# Teaching first: where the robot starts it has a wall before it.
WALKS = ["train", "drive", "look", "stick", "goal", "replay"]
KEEP = os.environ.get("ROOMWISE_SCREENSHOTS")


class Browser(StartedRun):
    def setUp(self):
        super().setUp()
        for what, is_there in (("chromium", shutil.which("chromium")), ("node", shutil.which("node")),
                               ("playwright-core", (NODE_MODULES / "playwright-core").is_dir()),
                               ("viewer", (PROGRAMS / "viewer").exists())):
            if not is_there:
                self.skipTest(f"{what} is not here; scripts/setup installs what is missing")

    def walk(self, *walks):
        folder = pathlib.Path(KEEP or self.scratch)
        command = ["node", WALK, NODE_MODULES, PAGE, folder, *walks]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as walking:
            for line in walking.stdout:
                yield json.loads(line)
        self.assertEqual(walking.returncode, 0)

    def findings(self, *walks):
        """(walk, name) -> (whether it is so, detail)"""
        found = {}
        for line in self.walk(*walks):
            print("ok    " if line["ok"] else "FAIL  ", line["name"], line["detail"], flush=True)
            found[line["walk"], line["name"]] = line["ok"], line["detail"]
        return found

    def test_a_person_sees_drives_stops_trains_and_replays(self):
        self.start("--sim", "living_room", "--url", URL)
        self.until("all", self.all_up)
        found = self.findings(*(sys.argv[1:] or WALKS))
        # Browser, simulator and all services share two cores: what failed once is walked again.
        again = {walk for (walk, _), (ok, _) in found.items() if not ok}
        if again:
            found.update(self.findings(*(walk for walk in WALKS if walk in again)))
        for (walk, name), (ok, detail) in found.items():
            with self.subTest(f"{walk}: {name}"):
                self.assertTrue(ok, detail)
        self.assertEqual(self.end(), 0)


if __name__ == "__main__":
    private_network.enter()
    unittest.main(argv=sys.argv[:1])
