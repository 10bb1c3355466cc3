"""What an experiment found, as data: the text on the terminal and the page are both made from it."""
import dataclasses
import pathlib


@dataclasses.dataclass
class Table:
    """Rows of cells under named columns. A cell is text, or a number with `digits` after the point."""

    caption: str
    columns: list
    rows: list
    digits: int = 3
    note: str = ""
    timing: bool = False  # its figures are times: they differ from run to run

    def texts(self):
        return [[f"{cell:.{self.digits}f}" if isinstance(cell, float) else str(cell)
                 for cell in row] for row in self.rows]


@dataclasses.dataclass
class Figure:
    """A picture: the SVG's text, or the PNG's bytes."""

    caption: str
    image: str | bytes
    name: str = ""  # written to report/NAME.svg or .png when the experiment is run by name

    @classmethod
    def of_file(cls, caption, path, name=""):
        path = pathlib.Path(path)
        return cls(caption, path.read_text(encoding="utf-8") if path.suffix == ".svg"
                   else path.read_bytes(), name)

    def suffix(self):
        return ".svg" if isinstance(self.image, str) else ".png"


@dataclasses.dataclass
class Printed:
    """What a program printed, as it stands."""

    text: str


@dataclasses.dataclass
class Note:
    """A paragraph of plain words."""

    text: str


@dataclasses.dataclass
class Bar:
    """Something promised beforehand, and whether it held."""

    what: str  # with its limit: "precision >= 0.95"
    measured: str
    held: bool


def at_most(what, value, limit, digits=3):
    return Bar(f"{what} <= {limit:g}", f"{value:.{digits}f}", value <= limit)


def at_least(what, value, limit, digits=3):
    return Bar(f"{what} >= {limit:g}", f"{value:.{digits}f}", value >= limit)


@dataclasses.dataclass
class Result:
    """Everything one experiment has to say, in the order to be read."""

    blocks: list = dataclasses.field(default_factory=list)
    bars: list = dataclasses.field(default_factory=list)
    left_out: str = ""  # why nothing, or not all of it, was measured

    def held(self):
        return all(bar.held for bar in self.bars)


def left_out(reason):
    return Result(left_out=reason)
