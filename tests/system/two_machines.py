"""Two network namespaces joined by a cable (a veth pair), as a robot and a workstation are."""
import os
import subprocess
import time

ADDRESSES = {"robot": "10.77.0.1/24", "workstation": "10.77.0.2/24"}
CABLE = "cable"
MULTICAST = "224.0.0.0/4"
UP_MOST_s = 5.0


def why_impossible():
    """What this kernel or container says to who makes a network and a cable; empty if it lets us."""
    user = [] if os.getuid() == 0 else ["--user", "--map-root-user"]
    tried = subprocess.run(["unshare", *user, "--net", "ip", "link", "add", CABLE, "type", "veth"],
                           capture_output=True, text=True)
    return tried.stderr.strip() if tried.returncode else ""


class Machine:
    """Lives as long as the process that holds its namespace."""

    def __init__(self, name):
        self.name = name
        self._holder = subprocess.Popen(["unshare", "--net", "setpriv", "--pdeathsig", "KILL",
                                         "sleep", "infinity"])
        self._wait_for_namespace()

    def _wait_for_namespace(self):
        """unshare becomes sleep once it has made the namespace."""
        end = time.monotonic() + UP_MOST_s
        comm = f"/proc/{self._holder.pid}/comm"
        while time.monotonic() < end:
            with open(comm, encoding="ascii") as file:
                if file.read() == "sleep\n":
                    return
            time.sleep(0.01)
        self.close()
        raise TimeoutError(f"no network namespace for the {self.name}")

    @property
    def pid(self):
        return self._holder.pid

    def words(self, *command):
        """The command that runs `command` on this machine."""
        return ["nsenter", f"--target={self.pid}", "--net", "--", *map(str, command)]

    def ip(self, *arguments):
        subprocess.run(self.words("ip", *arguments), check=True)

    def plug_in(self):
        """What a network manager does when the cable gets a carrier."""
        self.ip("link", "set", CABLE, "up")
        self.ip("route", "replace", MULTICAST, "dev", CABLE)

    def unplug(self):
        """The other end loses its carrier and keeps its routes."""
        self.ip("link", "set", CABLE, "down")

    def close(self):
        self._holder.kill()
        self._holder.wait()


def joined_machines():
    """{name: Machine}"""
    machines = {name: Machine(name) for name in ADDRESSES}
    one, other = machines.values()
    subprocess.run(["ip", "link", "add", CABLE, "netns", str(one.pid), "type", "veth",
                    "peer", "name", CABLE, "netns", str(other.pid)], check=True)
    for name, machine in machines.items():
        machine.ip("link", "set", "lo", "up")
        machine.ip("address", "add", ADDRESSES[name], "dev", CABLE)
        machine.plug_in()
    return machines
