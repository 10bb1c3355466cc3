"""Finds the tables in what a program printed: columns stand two blanks or more apart."""
import itertools
import re

from report_parts.results import Printed, Table


def _cells(line):
    return re.split(r"\s{2,}", line.strip())


def _is_number(cell):
    return re.fullmatch(r"-?[\d.]+", cell) is not None


def _runs(lines):
    """Neighbouring lines of as many cells, together."""
    return [(width, list(group)) for width, group in
            itertools.groupby(lines, key=lambda line: len(_cells(line)))]


def blocks_of(text):
    """Tables where three or more columns stand under a line of names, none a number; the rest as printed."""
    blocks, plain = [], []

    def end_plain():
        if "".join(plain).strip():
            blocks.append(Printed("\n".join(plain)))
        plain.clear()

    for width, lines in _runs(text.splitlines()):
        if width < 3 or len(lines) < 2 or any(map(_is_number, _cells(lines[0]))):
            plain += lines
            continue
        caption = plain.pop().strip(" :") if plain and plain[-1].strip() else ""
        end_plain()
        head, *rows = map(_cells, lines)
        blocks.append(Table(caption, head, rows))
    end_plain()
    return blocks
