"""Line plots as SVG, with nothing but text."""
import dataclasses
import math
from xml.sax.saxutils import escape

# Told apart by colour-blind readers too (Okabe and Ito 2008).
COLORS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#3a3a3a"]
WIDTH, HEIGHT = 760, 460
LEFT, RIGHT, TOP, BOTTOM = 78, 200, 56, 58
DOTS_MOST = 40  # a line of more points is drawn without them


@dataclasses.dataclass
class Axis:
    label: str
    log: bool = False
    least: float | None = None
    largest: float | None = None


def _log_ticks(least, largest):
    decades = range(math.floor(math.log10(least)), math.ceil(math.log10(largest)) + 1)
    few = len(decades) <= 3
    ticks = [m * 10.0 ** d for d in decades for m in ((1, 2, 5) if few else (1,))]
    return [t for t in ticks if least * 0.999 <= t <= largest * 1.001]


def _linear_ticks(least, largest):
    step = 10.0 ** math.floor(math.log10((largest - least) / 4 or 1.0))
    step *= next(m for m in (1, 2, 5, 10) if (largest - least) / (step * m) <= 6)
    first = math.ceil(least / step - 1e-9)
    return [i * step for i in range(first, math.floor(largest / step + 1e-9) + 1)]


class _Scale:
    def __init__(self, axis, values, begin, end):
        self.map = math.log10 if axis.log else float
        least = min(values) if axis.least is None else axis.least
        largest = max(values) if axis.largest is None else axis.largest
        if largest <= least:
            largest = least * 2 if axis.log else least + 1
        self.ticks = (_log_ticks if axis.log else _linear_ticks)(least, largest)
        self.least, self.largest, self.begin, self.end = least, largest, begin, end

    def __call__(self, value):
        low, high = self.map(self.least), self.map(self.largest)
        return self.begin + (self.end - self.begin) * (self.map(value) - low) / (high - low)


def _text(x, y, text, anchor="middle", size=13, extra=""):
    return (f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}" {extra}>'
            f"{escape(text)}</text>")


def _grid(x, y, x_axis, y_axis):
    parts = []
    for tick in x.ticks:
        parts.append(f'<line x1="{x(tick):.1f}" x2="{x(tick):.1f}" y1="{TOP}"'
                     f' y2="{HEIGHT - BOTTOM}" stroke="#e4e4e4"/>')
        parts.append(_text(x(tick), HEIGHT - BOTTOM + 18, f"{tick:g}"))
    for tick in y.ticks:
        parts.append(f'<line y1="{y(tick):.1f}" y2="{y(tick):.1f}" x1="{LEFT}"'
                     f' x2="{WIDTH - RIGHT}" stroke="#e4e4e4"/>')
        parts.append(_text(LEFT - 8, y(tick) + 4, f"{tick:g}", "end"))
    middle = (TOP + HEIGHT - BOTTOM) / 2
    parts.append(_text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 16, x_axis.label))
    parts.append(_text(20, middle, y_axis.label, extra=f'transform="rotate(-90 20 {middle})"'))
    return parts


def _unbroken(points):
    """Pieces between points without a value."""
    pieces = [[]]
    for u, v in points:
        if v is None:
            pieces.append([])
        else:
            pieces[-1].append((u, v))
    return [piece for piece in pieces if piece]


def _line(points, x, y, color):
    parts = []
    for piece in _unbroken(points):
        path = " ".join(f"{x(u):.1f},{y(v):.1f}" for u, v in piece)
        parts.append(f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="2"'
                     ' stroke-linejoin="round"/>')
    if len(points) <= DOTS_MOST:
        parts += [f'<circle cx="{x(u):.1f}" cy="{y(v):.1f}" r="3.5" fill="{color}"/>'
                  for u, v in points if v is not None]
    return parts


def line_plot(title, x_axis, y_axis, series):
    """The SVG of {name: [(x, y), ...]}; points of a series are joined in their order, but not over
    one whose y is None."""
    points = [p for line in series.values() for p in line if p[1] is not None]
    x = _Scale(x_axis, [u for u, _ in points], LEFT, WIDTH - RIGHT)
    y = _Scale(y_axis, [v for _, v in points], HEIGHT - BOTTOM, TOP)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}"'
             ' font-family="sans-serif" fill="#222">',
             f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
             _text(LEFT, 30, title, "start", 17), *_grid(x, y, x_axis, y_axis)]
    for i, (name, line) in enumerate(series.items()):
        color = COLORS[i % len(COLORS)]
        parts += _line(line, x, y, color)
        legend_y = TOP + 12 + 24 * i
        parts.append(f'<line x1="{WIDTH - RIGHT + 16}" x2="{WIDTH - RIGHT + 40}" y1="{legend_y}"'
                     f' y2="{legend_y}" stroke="{color}" stroke-width="3"/>')
        parts.append(_text(WIDTH - RIGHT + 48, legend_y + 4, name, "start"))
    return "\n".join([*parts, "</svg>\n"])
