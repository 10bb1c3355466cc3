"""Every real number in a message says its unit: range_m, turn_rad, score_ratio.

utime, and whatever ends in _utime, is microseconds since the epoch in an int64_t.
"""
from checks import messages
from checks.units import has_unit


def check(tree):
    found = []
    for path in messages.message_paths(tree):
        for type_name, name, _ in messages.fields(tree, path):
            where = f"{path}:{messages.field_line(tree, path, name)}"
            if type_name in ("double", "float") and not has_unit(name):
                found.append(f"{where}: {name} does not end in a known unit (scripts/checks/units.py)")
            if (name == "utime" or name.endswith("_utime")) and type_name != "int64_t":
                found.append(f"{where}: {name} must be int64_t")
    return found
