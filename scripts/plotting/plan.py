"""A floor from above as SVG: points and lines in metres, the same scale both ways."""
import dataclasses
from xml.sax.saxutils import escape

WIDTH, LEFT, RIGHT, TOP, BOTTOM = 900, 16, 280, 56, 40


@dataclasses.dataclass
class Marks:
    """Points drawn as dots, or as one line if `joined`."""

    name: str
    points_m: list  # (x, y)
    color: str
    joined: bool = False
    radius_px: float = 3.0
    dashed: bool = False


class _Place:
    def __init__(self, layers):
        points = [point for layer in layers for point in layer.points_m]
        self.left_m = min(x for x, _ in points) - 0.3
        self.top_m = max(y for _, y in points) + 0.3
        across_m = max(x for x, _ in points) + 0.3 - self.left_m
        self.px_per_m = (WIDTH - LEFT - RIGHT) / across_m
        self.height = TOP + BOTTOM + (self.top_m - min(y for _, y in points) + 0.3) * self.px_per_m

    def __call__(self, point):
        return (LEFT + (point[0] - self.left_m) * self.px_per_m,
                TOP + (self.top_m - point[1]) * self.px_per_m)


def _drawn(layer, place):
    pixels = [place(point) for point in layer.points_m]
    if layer.joined:
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in pixels)
        dash = ' stroke-dasharray="6 5"' if layer.dashed else ""
        return [f'<polyline points="{path}" fill="none" stroke="{layer.color}" stroke-width="2"'
                f"{dash}/>"]
    dots = "".join(f"M{x:.1f} {y:.1f}h0" for x, y in pixels)
    return [f'<path d="{dots}" fill="none" stroke="{layer.color}" stroke-linecap="round"'
            f' stroke-width="{2 * layer.radius_px}"/>']


def _legend(layers):
    parts = []
    for i, layer in enumerate(layers):
        x, y = WIDTH - RIGHT + 18, TOP + 14 + 24 * i
        parts.append(f'<line x1="{x}" x2="{x + 22}" y1="{y}" y2="{y}" stroke="{layer.color}"'
                     ' stroke-width="3"/>' if layer.joined else
                     f'<circle cx="{x + 11}" cy="{y}" r="5" fill="{layer.color}"/>')
        parts.append(f'<text x="{x + 30}" y="{y + 4}" font-size="13">{escape(layer.name)}</text>')
    return parts


def plan(title, layers):
    """The SVG; later layers lie above earlier ones."""
    layers = [layer for layer in layers if layer.points_m]
    place = _Place(layers)
    bottom = place.height - 14
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {place.height:.0f}"'
             ' font-family="sans-serif" fill="#222">',
             f'<rect width="{WIDTH}" height="{place.height:.0f}" fill="white"/>',
             f'<text x="{LEFT}" y="30" font-size="17">{escape(title)}</text>']
    for layer in layers:
        parts += _drawn(layer, place)
    parts.append(f'<line x1="{LEFT}" x2="{LEFT + place.px_per_m:.1f}" y1="{bottom:.1f}"'
                 f' y2="{bottom:.1f}" stroke="#222" stroke-width="3"/>'
                 f'<text x="{LEFT + place.px_per_m + 8:.1f}" y="{bottom + 5:.1f}" font-size="13">'
                 "1 m</text>")
    return "\n".join([*parts, *_legend(layers), "</svg>\n"])
