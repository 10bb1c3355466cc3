"""Runs the test program again inside a network of its own, where multicast works and nobody listens."""
import os
import subprocess
import sys

INSIDE = "ROOMWISE_TEST_NETWORK"
SET_UP = 'ip link set lo up && ip route add 224.0.0.0/4 dev lo && exec "$@"'


def enter():
    """Returns inside the private network; to be called first in a test program."""
    if os.environ.get(INSIDE):
        return
    user = [] if os.getuid() == 0 else ["--user", "--map-root-user"]
    command = ["unshare", *user, "--net", "sh", "-c", SET_UP, "sh", sys.executable, "-B", *sys.argv]
    sys.exit(subprocess.run(command, env={**os.environ, INSIDE: "1"}).returncode)
