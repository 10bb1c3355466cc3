"""scripts/record keeps what is on the bus, a few files of it, and leaves room on the disk."""
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import private_network  # noqa: E402: found by the line above

ROOT = pathlib.Path(__file__).resolve().parents[2]
SAMPLE = ROOT / "logs/samples/living_room.lcmlog"
URL = "udpm://239.255.76.67:27668?ttl=0"


class Record(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.log = pathlib.Path(folder.name) / "run.lcmlog"

    def record(self, *options):
        process = subprocess.Popen([ROOT / "scripts/record", self.log, "--url", URL, *options],
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.kill)
        return process

    def play(self, process):
        end = time.monotonic() + 20
        while not self.files() and time.monotonic() < end and process.poll() is None:
            time.sleep(0.05)
        time.sleep(0.3)  # the logger makes its file before it listens
        subprocess.run(["lcm-logplayer", "-s", "4", "-l", URL, SAMPLE], check=True,
                       capture_output=True)
        time.sleep(0.3)

    def files(self):
        return sorted(self.log.parent.glob("run.lcmlog*"))

    def test_everything_is_kept_until_ctrl_c(self):
        process = self.record()
        self.play(process)
        process.send_signal(signal.SIGINT)
        said, _ = process.communicate(timeout=20)
        self.assertEqual(process.returncode, 0, said)
        # lcm-logger numbers its events itself; all else is as it was played.
        self.assertEqual(sum(file.stat().st_size for file in self.files()), SAMPLE.stat().st_size)

    def test_only_the_newest_files_stay(self):
        process = self.record("--keep", "2", "--split-mb", "0.2")
        self.play(process)
        process.send_signal(signal.SIGTERM)
        said, _ = process.communicate(timeout=20)
        self.assertEqual(process.returncode, 0, said)
        self.assertEqual([file.name for file in self.files()],
                         ["run.lcmlog.0", "run.lcmlog.1"])

    def test_a_disk_without_room_is_left_alone(self):
        process = self.record("--min-free-gb", "1e9")
        said, _ = process.communicate(timeout=20)
        self.assertEqual(process.returncode, 1)
        self.assertIn("less than 1e+09 GB free", said)
        self.assertEqual(self.files(), [])


if __name__ == "__main__":
    private_network.enter()
    unittest.main()
