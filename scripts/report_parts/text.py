"""Results as text for a terminal."""
from report_parts.results import Bar, Figure, Note, Printed, Table


def _is_number(cell):
    return cell.replace("%", "").replace(",", "").strip().replace(".", "").lstrip("-").isdigit()


def table_text(table):
    lines = [[str(column) for column in table.columns], *table.texts()]
    widths = [max(map(len, cells)) for cells in zip(*lines)]
    right = [False] + [any(_is_number(row[i]) for row in lines[1:]) for i in range(1, len(widths))]
    rows = ["  ".join(cell.rjust(width) if to_right else cell.ljust(width)
                      for cell, width, to_right in zip(line, widths, right)).rstrip()
            for line in lines]
    return "\n".join([table.caption, *("  " + row for row in rows)]
                     + ([f"  {table.note}"] if table.note else []))


def block_text(block):
    if isinstance(block, Table):
        return table_text(block)
    if isinstance(block, Figure):
        return f"picture: {block.caption}"
    if isinstance(block, (Printed, Note)):
        return block.text.rstrip()
    if isinstance(block, Bar):
        return f"bar {'held' if block.held else 'MISSED'}: {block.what}: {block.measured}"
    raise TypeError(f"no block of a result: {block!r}")


def result_text(result):
    parts = [block_text(block) for block in result.blocks]
    if result.bars:
        parts.append("\n".join(map(block_text, result.bars)))
    if result.left_out:
        parts.append(f"left out: {result.left_out}")
    return "\n\n".join(parts)
