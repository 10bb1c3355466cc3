"""README.md shows the channels as common/channels.h has them: a table and a diagram.

Both stand between markers and are made here; `scripts/check --fix-readme` rewrites them.
"""
import re

from checks.tree import line_of

CHANNELS = "common/channels.h"
README = "README.md"
ROW = re.compile(r"Channel<(\w+)>\s+(\w+)\s*\{" + r",\s*".join([r'"([^"]*)"'] * 4) + r"\};")
ANY_ROW = re.compile(r"\bconstexpr\s+Channel<")
BLOCK = r"<!-- {0}:begin[^>]*-->\n(.*?)<!-- {0}:end -->"
EVERYBODY = ("all", "every process")


def check(tree):
    if CHANNELS not in tree.paths or README not in tree.paths:
        return [f"{README}:1: needs {CHANNELS} and {README} to compare"]
    source, readme = tree.text(CHANNELS), tree.text(README)
    rows = list(ROW.finditer(source))
    found = unread_rows(source, rows) + unlisted(source, rows)
    for name, wanted in blocks(tree).items():
        block = re.search(BLOCK.format(name), readme, flags=re.S)
        if not block:
            found.append(f"{README}:1: no <!-- {name}:begin --> ... <!-- {name}:end -->")
        elif block.group(1) != wanted:
            found.append(f"{README}:{line_of(readme, block.start())}: {name} differ from "
                         f"{CHANNELS}; run scripts/check --fix-readme")
    return found


def fix(tree):
    """The text README.md should have."""
    readme = tree.text(README)
    for name, wanted in blocks(tree).items():
        block = re.search(BLOCK.format(name), readme, flags=re.S)
        if block:
            readme = readme[:block.start(1)] + wanted + readme[block.end(1):]
    return readme


def unread_rows(source, rows):
    read = {line_of(source, row.start()) for row in rows}
    return [f"{CHANNELS}:{line}: cannot read this channel's row"
            for match in ANY_ROW.finditer(source)
            if (line := line_of(source, match.start())) not in read]


def unlisted(source, rows):
    listed = source.split("kAllChannels", 1)[-1]
    return [f"{CHANNELS}:{line_of(source, row.start())}: {row.group(2)} is not in kAllChannels"
            for row in rows if not re.search(rf"\b{row.group(2)}\b", listed)]


def blocks(tree):
    rows = [(row.group(1), *row.groups()[2:]) for row in ROW.finditer(tree.text(CHANNELS))]
    return {"channel-table": table(tree, rows), "channel-diagram": diagram(tree, rows)}


def table(tree, rows):
    lines = ["| channel | type | rate [Hz] | publisher | readers | what it says |",
             "|---|---|---|---|---|---|"]
    for type_name, channel, rate, publisher, readers in rows:
        lines.append(f"| {channel} | [{type_name}](lcmtypes/{type_name}.lcm) | {rate} | {publisher} "
                     f"| {readers} | {summary(tree, type_name)} |")
    return "\n".join(lines) + "\n"


def summary(tree, type_name):
    """The comment over a message's struct, up to where it names its channel."""
    path = f"lcmtypes/{type_name}.lcm"
    if path not in tree.paths:
        return ""
    comment = re.findall(r"^//\s?(.*)$", tree.text(path).split("struct", 1)[0], flags=re.M)
    return re.split(r"\s*\bChannel [A-Z]", " ".join(comment))[0]


def diagram(tree, rows):
    """A mermaid flow chart; processes that have no folder yet are dashed."""
    lines = ["```mermaid", "flowchart LR"]
    processes = set()
    for _, channel, _, publisher, readers in rows:
        sources = [name for name in publisher.split(", ") if name not in EVERYBODY]
        sinks = [name for name in readers.split(", ") if name not in EVERYBODY]
        if sources:
            lines.append(f"  {' & '.join(sources)} --> {channel}([{channel}])"
                         + (f" --> {' & '.join(sinks)}" if sinks else ""))
            processes.update(sources + sinks)
    planned = sorted(name for name in processes if not exists(tree, name))
    if planned:
        lines += ["  classDef planned stroke-dasharray: 5 5, opacity: 0.6",
                  f"  class {','.join(planned)} planned"]
    return "\n".join(lines + ["```"]) + "\n"


def exists(tree, process):
    return process == "rwlog" or any(path.startswith(f"services/{process}/") for path in tree.paths)
