"""scripts/doctor finds each fault and prints what mends it."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

from doctor_parts import devices, network, software  # noqa: E402: found by the line above
from doctor_parts.machine import Machine  # noqa: E402


class Provoked(Machine):
    """A machine of files in a scratch folder, with commands that say what they are told to."""

    def __init__(self, folder):
        super().__init__(folder / "tree", folder / "root")
        self.commands = {}
        self.free = 10**10
        self.time = 4e9
        self.openable = set()
        (self.tree / "logs").mkdir(parents=True)
        (self.tree / "README.md").write_text("")

    def give(self, absolute, text=""):
        self.path(absolute).parent.mkdir(parents=True, exist_ok=True)
        self.path(absolute).write_text(text)

    def may_use(self, absolute):
        return absolute in self.openable

    def output_of(self, *words):
        return self.commands.get(pathlib.Path(words[0]).name)

    def free_bytes(self, _folder):
        return self.free

    def now(self):
        return self.time


class Doctor(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.machine = Provoked(pathlib.Path(folder.name))

    def assert_fault(self, finding, says, mend):
        self.assertEqual(finding.verdict, "FAULT", finding)
        self.assertIn(says, finding.says)
        self.assertIn(mend, finding.mend)

    def assert_ok(self, finding):
        self.assertEqual((finding.verdict, finding.mend), ("ok", ""), finding)

    def test_socket_buffers(self):
        self.machine.give("/proc/sys/net/core/rmem_max", "212992\n")
        self.assert_fault(network.socket_buffers(self.machine), "212992", "net.core.rmem_max=2097152")
        self.machine.give("/proc/sys/net/core/rmem_max", "2097152\n")
        self.assert_ok(network.socket_buffers(self.machine))

    def test_a_camera_without_rights(self):
        self.assertEqual(devices.camera(self.machine).verdict, "none")
        usb = "/sys/bus/usb/devices/1-2"
        for file, text in (("idVendor", "045e"), ("idProduct", "02ae"), ("busnum", "1"), ("devnum", "7")):
            self.machine.give(f"{usb}/{file}", text + "\n")
        self.assert_fault(devices.camera(self.machine), "Kinect v1 on /dev/bus/usb/001/007", "udevadm")
        self.machine.openable = {"/dev/bus/usb/001/007"}
        self.assert_ok(devices.camera(self.machine))

    def test_a_serial_port_without_rights(self):
        self.assertEqual(devices.serial(self.machine).verdict, "none")
        self.machine.give("/dev/ttyUSB0")
        self.assert_fault(devices.serial(self.machine), "/dev/ttyUSB0", "usermod -aG dialout")
        self.machine.openable = {"/dev/ttyUSB0"}
        self.assert_ok(devices.serial(self.machine))

    def test_java_and_its_jars(self):
        self.assert_fault(software.java(self.machine), "none", "openjdk-17")
        self.machine.commands["java"] = 'openjdk version "11.0.2"'
        self.assert_fault(software.java(self.machine), "version 11", "openjdk-17")
        self.machine.commands["java"] = 'openjdk version "17.0.2"'
        self.assert_fault(software.java(self.machine), "jchart2d", "libjchart2d-java")
        for jar in software.JARS:
            self.machine.give(f"/usr/share/java/{jar}.jar")
        self.assert_ok(software.java(self.machine))

    def test_packages(self):
        self.machine.commands["setup"] = "xvfb supervisor\n"
        self.assert_fault(software.packages(self.machine), "xvfb supervisor", "scripts/setup")
        self.machine.commands["setup"] = ""
        self.assert_ok(software.packages(self.machine))

    def test_programs(self):
        self.assert_fault(software.programs(self.machine), "viewer", "scripts/build")
        folder = self.machine.tree / "build/release/bin"
        folder.mkdir(parents=True)
        for program in software.PROGRAMS:
            (folder / program).touch()
        self.assert_ok(software.programs(self.machine))

    def test_clock(self):
        self.assert_ok(software.clock(self.machine))
        self.machine.commands["timedatectl"] = "no\n"
        self.assert_fault(software.clock(self.machine), "not set by the network", "set-ntp true")
        self.machine.time = 0
        self.assert_fault(software.clock(self.machine), "behind the files", "set-ntp true")

    def test_disk(self):
        self.assert_ok(software.disk(self.machine))
        self.machine.free = 10**9
        self.assert_fault(software.disk(self.machine), "1.0 GB free", "ls -lhS")

    def test_a_real_network_without_a_multicast_route(self):
        user = [] if os.getuid() == 0 else ["--user", "--map-root-user"]

        def doctor(route):
            return subprocess.run(
                ["unshare", *user, "--net", "sh", "-c", f"ip link set lo up; {route} exec \"$@\"",
                 "sh", ROOT / "scripts/doctor"], capture_output=True, text=True)
        without = doctor("")
        self.assertEqual(without.returncode, 1)
        self.assertRegex(without.stdout,
                         r"FAULT +multicast .*\n.*ip route add 224.0.0.0/4 dev lo")
        self.assertRegex(doctor("ip route add 224.0.0.0/4 dev lo;").stdout, r"ok +multicast")


if __name__ == "__main__":
    unittest.main()
