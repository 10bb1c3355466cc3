"""Coloured points as they look from a place in the room."""
import math

from plotting.png import png

BACKGROUND = 255
BRIGHTER = bytes(round(255 * (level / 255) ** 0.65) for level in range(256))


class View:
    """A pinhole at `at_m`, looking at `to_m`, z up; `focal_px` of a picture `size_px` wide and high."""

    def __init__(self, at_m, to_m, focal_px=620.0, size_px=(960, 600)):
        ahead = [b - a for a, b in zip(at_m, to_m)]
        flat = math.hypot(ahead[0], ahead[1])
        length = math.hypot(flat, ahead[2])
        self.ahead = [each / length for each in ahead]
        self.right = [ahead[1] / flat, -ahead[0] / flat, 0.0]
        self.down = [self.ahead[1] * self.right[2] - self.ahead[2] * self.right[1],
                     self.ahead[2] * self.right[0] - self.ahead[0] * self.right[2],
                     self.ahead[0] * self.right[1] - self.ahead[1] * self.right[0]]
        self.at_m, self.focal_px, self.size_px = at_m, focal_px, size_px

    def pixel(self, point_m):
        """(column, row, distance ahead), or None if it is not in the picture."""
        offset = [p - a for p, a in zip(point_m, self.at_m)]
        x, y, z = (sum(o * e for o, e in zip(offset, axis))
                   for axis in (self.right, self.down, self.ahead))
        if z < 0.05:
            return None
        width, height = self.size_px
        u = int(width / 2 + self.focal_px * x / z)
        v = int(height / 2 + self.focal_px * y / z)
        return (u, v, z) if 0 <= u < width - 2 and 0 <= v < height - 2 else None


def picture(points, view):
    """The PNG of [(x, y, z, red, green, blue)]; nearer points hide farther ones.

    Colours are brightened: rooms are darker than paper."""
    width, height = view.size_px
    rgb = bytearray([BACKGROUND]) * (3 * width * height)
    nearest = [math.inf] * (width * height)
    for x, y, z, red, green, blue in points:
        place = view.pixel((x, y, z))
        if place is None:
            continue
        u, v, depth = place
        for pixel in (v * width + u, v * width + u + 1, (v + 1) * width + u,
                      (v + 1) * width + u + 1):
            if depth < nearest[pixel]:
                nearest[pixel] = depth
                rgb[3 * pixel:3 * pixel + 3] = bytes((BRIGHTER[red], BRIGHTER[green], BRIGHTER[blue]))
    return png(width, height, rgb)
