"""Which LCM bus a run is on."""
import os
import pathlib
import re

GROUP = "239.255.76.67"
LIVE_PORT = 7667
WANTED_bytes = 2_097_152  # some camera frames; as common/bus/lcm_url.cpp has it
UDP = pathlib.Path("/proc/net/udp")
RMEM_MAX = pathlib.Path("/proc/sys/net/core/rmem_max")


def local_url(on_port):
    """This machine only, with as large a receive buffer as the kernel allows."""
    allowed = int(RMEM_MAX.read_text()) if RMEM_MAX.exists() else 212_992
    return f"udpm://{GROUP}:{on_port}?ttl=0&recv_buf_size={min(WANTED_bytes, allowed)}"


def default_url(mode):
    """A replay gets a bus of its own: a recorded message must never reach a live service. A port
    of its own, that is, for LCM 1.3.1 hears every multicast group on its port."""
    if mode == "replay":
        return local_url(free_port())
    return os.environ.get("LCM_DEFAULT_URL") or local_url(LIVE_PORT)


def free_port():
    """The first port after the live one that nobody on this machine listens on."""
    taken = {int(line.split()[1].split(":")[1], 16) for line in UDP.read_text().splitlines()[1:]}
    return next(p for p in range(LIVE_PORT + 1, 65536) if p not in taken)


def port(url):
    found = re.match(r"udpm://[^:/?]*:(\d+)", url)
    return int(found.group(1)) if found else LIVE_PORT
