"""Parameters of a service: units in names, one name everywhere, none forgotten.

A parameter struct names its members in visit_fields by lines like
    field("range_noise_m", range_noise_m, 1e-3, 1.0);
"""
import re

from checks.tree import line_of, strip_comments
from checks.units import has_unit

FIELD_CALL = re.compile(r'\bfield\s*\(\s*"([^"]*)"\s*,\s*([\w.]+)')
STRUCT = re.compile(r"\bstruct\s+(\w+)[^;{()]*\{")
MEMBER = re.compile(r"^\s*(double|float|int|bool|std::string)\s+(\w+)\s*(?:=[^;]*|\{[^;]*\})?;",
                    flags=re.M)


def check(tree):
    found = []
    for path in tree.match(r"services/.*\.h"):
        text = strip_comments(tree.text(path))
        for match in STRUCT.finditer(text):
            body = body_from(text, match.end() - 1)
            if re.search(r"\bvisit_fields\s*\(", body):
                found += check_struct(path, match.group(1), body, text, match.end() - 1)
    return found


def body_from(text, brace):
    """The text from an opening brace to its closing one."""
    depth = 0
    for offset in range(brace, len(text)):
        depth += {"{": 1, "}": -1}.get(text[offset], 0)
        if depth == 0:
            return text[brace:offset + 1]
    return text[brace:]


def check_struct(path, struct, body, text, start):
    found = []

    def say(match, what):
        found.append(f"{path}:{line_of(text, start + match.start(1))}: {what}")

    visited = {match.group(2) for match in FIELD_CALL.finditer(body)}
    for match in FIELD_CALL.finditer(body):
        name, member = match.groups()
        if name not in (member, member.replace(".", "_")):
            say(match, f'field "{name}" must be named as its member {member}')
    for match in MEMBER.finditer(body):
        kind, name = match.groups()
        if kind in ("double", "float") and not has_unit(name):
            say(match, f"{name} does not end in a known unit (scripts/checks/units.py)")
        if name not in visited:
            say(match, f"{name} is not in visit_fields of {struct}: nobody can set it")
    return found
