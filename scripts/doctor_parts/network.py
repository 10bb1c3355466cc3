"""Can processes on this machine hear each other, camera frames and all?"""
import socket
import struct

from doctor_parts.finding import fault, fine

GROUP = "239.255.76.67"
WANTED_bytes = 2_097_152
WAIT_s = 1.0


def multicast(_machine):
    """Sends a datagram to LCM's group and hears it, on a port nobody else has."""
    name = "multicast"
    mend = "sudo ip link set lo up multicast on && sudo ip route add 224.0.0.0/4 dev lo"
    try:
        heard = loops_back()
    except OSError as error:
        return fault(name, f"no way to {GROUP}: {error.strerror or error}", mend)
    if not heard:
        return fault(name, f"what is sent to {GROUP} does not come back", mend)
    return fine(name, f"what is sent to {GROUP} comes back")


def loops_back():
    membership = struct.pack("4sI", socket.inet_aton(GROUP), socket.INADDR_ANY)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver, \
            socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        receiver.bind(("", 0))
        receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, membership)
        receiver.settimeout(WAIT_s)
        sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
        sender.sendto(b"roomwise", (GROUP, receiver.getsockname()[1]))
        try:
            return receiver.recv(64) == b"roomwise"
        except TimeoutError:
            return False


def socket_buffers(machine):
    name = "socket buffers"
    text = machine.read("/proc/sys/net/core/rmem_max")
    if text is None:  # a network of its own, such as a container's, has no such file
        text = "212992"
    if int(text) < WANTED_bytes:
        return fault(name, f"rmem_max is {text}: camera frames may be lost when the machine is busy",
                     f"echo net.core.rmem_max={WANTED_bytes} | sudo tee /etc/sysctl.d/60-roomwise.conf"
                     " && sudo sysctl --system")
    return fine(name, f"rmem_max is {text}")
