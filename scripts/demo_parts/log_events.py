"""Events of an LCM log: when the logger heard them, and the stamp every message begins with."""
import dataclasses
import struct

#: Sync word, number, time, length of the channel's name, length of the message.
HEADER = struct.Struct(">IQQII")
SYNC = 0xEDA1DA01
#: Fingerprint, utime, seq: how every message of this project begins.
BEGINNING = struct.Struct(">8xqq")


@dataclasses.dataclass
class Event:
    channel: str
    heard_us: int
    utime: int
    seq: int


def events(log, channels):
    """Those on these channels, in the log's order; the log is not held in memory."""
    wanted = {name.encode(): name for name in channels}
    with open(log, "rb") as file:
        while len(header := file.read(HEADER.size)) == HEADER.size:
            sync, _, heard_us, name_size, size = HEADER.unpack(header)
            if sync != SYNC:
                raise ValueError(f"{log}: no event at byte {file.tell() - HEADER.size}")
            name = file.read(name_size)
            if name not in wanted:
                file.seek(size, 1)
                continue
            data = file.read(size)
            if len(data) < BEGINNING.size:
                return  # cut off
            utime, seq = BEGINNING.unpack_from(data)
            yield Event(wanted[name], heard_us, utime, seq)
