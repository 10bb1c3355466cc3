"""Dependencies point one way: lcmtypes <- common <- services. Services never include each other.

Processes meet on the bus and nowhere else, so any one of them can be changed, replayed and
tested alone. The log tool may call the cores, which know nothing of processes.
"""
import re

INCLUDE = re.compile(r'\s*#\s*include\s*"([^"]+)"')


def check(tree):
    found = []
    for path in tree.match(r"(common|services|logs)/.*\.(h|cpp)"):
        for number, line in tree.lines(path):
            match = INCLUDE.match(line)
            if match and not allowed(path, match.group(1)):
                found.append(f"{path}:{number}: {owner(path)} must not include {match.group(1)}")
    return found


def owner(path):
    parts = path.split("/")
    return "/".join(parts[:2]) if parts[0] == "services" else parts[0]


def allowed(path, included):
    if included.startswith(("logs/", "tests/")):
        return included.startswith(owner(path) + "/")
    if not included.startswith("services/"):
        return True
    if owner(path) == "logs":
        return included.split("/")[2] == "core"
    return owner(included) == owner(path)
