"""scripts/record keeps what is on the bus, a few files of it, and leaves room on the disk."""
import pathlib
import signal
import struct
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


def events(log):
    """Channel and content of each event; the logger numbers and stamps them itself."""
    data, at, found = log.read_bytes(), 0, []
    while at < len(data):
        channel_size, size = struct.unpack_from(">II", data, at + 20)
        start, at = at + 28, at + 28 + channel_size + size
        found.append((data[start:start + channel_size], data[start + channel_size:at]))
    return found


def player(*options):
    subprocess.run(["lcm-logplayer", *options, "-l", URL, SAMPLE], check=True, capture_output=True)


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
        """Once, after the logger, which listens a while after its file is there, has heard some."""
        end = time.monotonic() + 30
        while not self.has_heard() and time.monotonic() < end and process.poll() is None:
            player("-s", "4")
        player()
        time.sleep(1)  # what is under way arrives

    def has_heard(self):
        return any(file.stat().st_size for file in self.files())

    def files(self):
        return sorted(self.log.parent.glob("run.lcmlog*"))

    def test_everything_is_kept_until_ctrl_c(self):
        process = self.record()
        self.play(process)
        process.send_signal(signal.SIGINT)
        said, _ = process.communicate(timeout=20)
        self.assertEqual(process.returncode, 0, said)
        played = events(SAMPLE)
        kept = [event for file in self.files() for event in events(file)]
        self.assertGreater(len(kept), len(played))
        self.assertTrue(kept[-len(played):] == played, f"of {len(played)} events some are missing")

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
