"""What an LCM log holds: messages, when the logger heard them, and the stamp each begins with."""
import dataclasses
import struct

#: Sync word, number, time, length of the channel's name, length of the message.
HEADER = struct.Struct(">IQQII")
SYNC = 0xEDA1DA01
#: Fingerprint, utime, seq: how every message of this project begins.
BEGINNING = struct.Struct(">8xqq")
SEQ = slice(16, 24)


@dataclasses.dataclass
class Event:
    channel: str
    heard_us: int
    utime: int
    seq: int


def messages(log, channels):
    """(channel, heard_us, bytes) of these channels, in the log's order; a cut off end is left out.
    Raises ValueError where there is no event."""
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
            if len(data) == size >= BEGINNING.size:
                yield wanted[name], heard_us, data


def events(log, channels):
    for channel, heard_us, data in messages(log, channels):
        yield Event(channel, heard_us, *BEGINNING.unpack_from(data))


def contents(log, channel):
    """Messages without their numbers, which count from the start of who sent them."""
    return [data[:SEQ.start] + data[SEQ.stop:] for _, _, data in messages(log, (channel,))]
