"""scripts/spy knows every message and draws KINECT_FRAME, on a screen nobody sees."""
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import private_network  # noqa: E402: found by the line above

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Spy(unittest.TestCase):
    def test_all_types_are_found_and_the_picture_is_drawn(self):
        absent = [name for name in ("javac", "Xvfb") if not shutil.which(name)]
        if absent:
            self.skipTest(f"{', '.join(absent)} not installed")
        with tempfile.TemporaryDirectory() as folder:
            screenshot = pathlib.Path(folder) / "spy.png"
            check = subprocess.run([ROOT / "scripts/spy", "--check", screenshot], text=True,
                                   capture_output=True, timeout=100)
            self.assertEqual(check.returncode, 0, check.stdout + check.stderr)
            head = screenshot.read_bytes()[:24]
        types = len(list((ROOT / "lcmtypes").glob("*.lcm")))
        self.assertIn(f"Found {types} LCM types", check.stdout)
        self.assertRegex(check.stdout, r"KINECT_FRAME drawn in \d+ colours")
        self.assertNotIn("ClassDiscoverer", check.stdout)
        self.assertEqual(struct.unpack(">II", head[16:24]), (1280, 960))


if __name__ == "__main__":
    private_network.enter()
    unittest.main()
