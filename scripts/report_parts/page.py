"""The report as one HTML file that needs no other: pictures inside, no script, no network."""
import base64
import pathlib
import re
from html import escape

from report_parts import thesis
from report_parts.results import Bar, Figure, Note, Printed, Table

STYLE = pathlib.Path(__file__).with_name("page.css")


def _is_number(text):
    return re.fullmatch(r"-?[\d.,]+(e-?\d+)?( ?%)?|-|nan", text.strip()) is not None


def _cells(tag, texts, numeric):
    return "<tr>" + "".join(f'<{tag}{" class=number" if right else ""}>{escape(text)}</{tag}>'
                            for text, right in zip(texts, numeric)) + "</tr>"


def _table(table):
    rows = table.texts()
    numeric = [i > 0 and all(_is_number(row[i]) for row in rows) for i in range(len(table.columns))]
    note = " ".join(([table.note] if table.note else []) +
                    (["Times: they differ from run to run."] if table.timing else []))
    return "".join([
        '<div class="wide"><table>',
        f"<caption>{escape(table.caption)}</caption><thead>" if table.caption else "<thead>",
        _cells("th", map(str, table.columns), numeric), "</thead><tbody>",
        *(_cells("td", row, numeric) for row in rows), "</tbody></table></div>",
        f'<p class="remark">{escape(note)}</p>' if note else ""])


def _figure(figure):
    caption = escape(figure.caption)
    if isinstance(figure.image, str):
        picture = figure.image[figure.image.index("<svg"):]
    else:
        data = base64.b64encode(figure.image).decode("ascii")
        picture = f'<img alt="{caption}" src="data:image/png;base64,{data}">'
    return (f'<figure><div class="picture">{picture}</div>'
            f"<figcaption>{caption}</figcaption></figure>")


def _block(block):
    if isinstance(block, Table):
        return _table(block)
    if isinstance(block, Figure):
        return _figure(block)
    if isinstance(block, Printed):
        return f"<pre>{escape(block.text.strip())}</pre>"
    if isinstance(block, Note):
        return f"<p>{escape(block.text)}</p>"
    raise TypeError(f"no block of a result: {block!r}")


def _mark(bar):
    return ('<span class="held">&#10003; held</span>' if bar.held
            else '<span class="missed">&#10007; missed</span>')


def _bars(bars):
    if not bars:
        return '<p class="open">No bar was set.</p>'
    rows = "".join(f'<tr><td class="what">{escape(bar.what)}</td><td>{escape(bar.measured)}</td>'
                   f"<td>{_mark(bar)}</td></tr>" for bar in bars)
    return ('<div class="wide"><table class="bars"><caption>Bars</caption><thead><tr><th>bar</th>'
            f"<th>measured</th><th></th></tr></thead><tbody>{rows}</tbody></table></div>")


def _experiment(name, title, result):
    parts = [f'<h3 id="{name}">{escape(title)}</h3>', *map(_block, result.blocks)]
    if result.left_out:
        parts.append(f'<p class="open">Left out: {escape(result.left_out)}</p>')
    parts += [_bars(result.bars), f"<p>Made by <code>scripts/experiments {name}</code></p>"]
    return "\n".join(parts)


def _section(number, part, names, titles, results):
    parts = [f'<section id="part{number}"><h2><small>{escape(part.numbers)}</small>'
             f"{escape(part.name)}</h2>",
             f'<div class="thesis"><p><b>The thesis.</b> {escape(part.showed)}</p></div>']
    parts += [_experiment(name, titles[name], results[name]) for name in names]
    if part.elsewhere:
        parts.append(f"<p>{escape(part.elsewhere)}</p>")
    elif not names:
        parts.append('<p class="open">Not measured in this run.</p>')
    return "\n".join([*parts, "</section>"])


def _state(bars, part, names):
    if part.elsewhere:
        return '<span class="open">tests</span>'
    if not names:
        return '<span class="open">not measured</span>'
    if not bars:
        return '<span class="open">no bar</span>'
    held = sum(bar.held for bar in bars)
    style = "held" if held == len(bars) else "missed"
    return f'<span class="{style}">{held} of {len(bars)}</span>'


def _contents(parts, results):
    rows = []
    for number, (part, names) in enumerate(parts, start=1):
        bars: list[Bar] = [bar for name in names for bar in results[name].bars]
        rows.append(f'<tr><td>{escape(part.numbers)}</td><td class="what">'
                    f'<a href="#part{number}">{escape(part.name)}</a></td>'
                    f"<td>{_state(bars, part, names)}</td></tr>")
    return ('<div class="wide"><table><thead><tr><th>thesis</th><th>what</th><th>bars held</th>'
            f'</tr></thead><tbody>{"".join(rows)}</tbody></table></div>')


def page(titles, results):
    """The HTML. titles, results: {name of the experiment: its title, its Result}."""
    parts = [(part, names) for part, names in thesis.parts_with(list(results))
             if names or part is not thesis.REST]
    bars = [bar for result in results.values() for bar in result.bars]
    held = sum(bar.held for bar in bars)
    return "\n".join([
        '<!DOCTYPE html><html lang="en"><head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f"<title>Roomwise: the thesis again</title><style>{STYLE.read_text(encoding='utf-8')}"
        "</style></head><body>",
        "<h1>The thesis's results again, measured now</h1>",
        "<p>A thesis taught a Kinect-class camera to find landmarks, to tell floor from obstacles "
        "and, on paper, to map a room. This page goes through its results chapter in its order: "
        "what each table and figure showed, then the same measured with this project's programs, "
        "the thesis's own methods beside ours and, where there are any, beside others'. Every "
        "number was computed when the page was made, from simulated drives whose truth is known, "
        "and from recordings where they are there.</p>",
        f"<p>A bar is what was promised beforehand. {held} of {len(bars)} bars held.</p>",
        _contents(parts, results),
        *(_section(number, part, names, titles, results)
          for number, (part, names) in enumerate(parts, start=1)),
        "</body></html>\n"])
