"""PNG pictures, 8 bits of red, green and blue, with nothing but zlib."""
import struct
import zlib


def _chunk(kind, data):
    return (struct.pack(">I", len(data)) + kind + data
            + struct.pack(">I", zlib.crc32(kind + data)))


def png(width, height, rgb):
    """The file's bytes. rgb: bytes, 3 * width * height, row by row from the top."""
    step = 3 * width
    rows = b"".join(b"\0" + bytes(rgb[step * y:step * (y + 1)]) for y in range(height))
    return (b"\x89PNG\r\n\x1a\n" + _chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2,
                                                              0, 0, 0))
            + _chunk(b"IDAT", zlib.compress(rows, 9)) + _chunk(b"IEND", b""))
