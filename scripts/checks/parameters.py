"""Parameters of a service: units in names, one name everywhere, none forgotten.

A parameter struct (its name ends in Params) names its members in visit_fields by lines like
    field("range_noise_m", range_noise_m, 1e-3, 1.0);
    field("thesis_range_min_m", slope.range_min_m, 0.0, 4.0);
The second reaches into a group, a member that is a parameter struct itself: there a word before the
member's name may tell the groups apart. A group may also name its own members: slope.visit_fields(field);
"""
import collections
import re

from checks.tree import line_of, strip_comments
from checks.units import has_unit

FIELD_CALL = re.compile(r'\bfield\s*\(\s*"([^"]*)"\s*,\s*([\w.]+)')
STRUCT = re.compile(r"\bstruct\s+(\w*Params)\b[^;{()]*\{")
MEMBER = re.compile(r"^\s*(double|float|int|bool|std::string)\s+(\w+)\s*(?:=[^;]*|\{[^;]*\})?;",
                    flags=re.M)
GROUP_CALL = re.compile(r"\b(\w+)\.visit_fields\s*\(\s*field\s*\)")
GROUP = re.compile(r"^\s*(\w+Params)\s+(\w+)\s*(?:\{\s*\})?;", flags=re.M)

Struct = collections.namedtuple("Struct", "path line body")


def check(tree):
    by_service = collections.defaultdict(dict)
    for path in tree.match(r"services/[^/]+/.*\.h"):
        by_service[path.split("/")[1]].update(structs_of(path, strip_comments(tree.text(path))))
    found = []
    for structs in by_service.values():
        for name, struct in structs.items():
            found += check_units(struct)
            if re.search(r"\bvisit_fields\s*\(", struct.body):
                found += check_names(struct) + check_visits(name, struct, structs)
    return found


def structs_of(path, text):
    return {match.group(1): Struct(path, line_of(text, match.end() - 1),
                                   body_from(text, match.end() - 1))
            for match in STRUCT.finditer(text)}


def body_from(text, brace):
    """The text from an opening brace to its closing one."""
    depth = 0
    for offset in range(brace, len(text)):
        depth += {"{": 1, "}": -1}.get(text[offset], 0)
        if depth == 0:
            return text[brace:offset + 1]
    return text[brace:]


def say(struct, match, what):
    return f"{struct.path}:{struct.line + line_of(struct.body, match.start(1)) - 1}: {what}"


def check_units(struct):
    return [say(struct, match, f"{match.group(2)} does not end in a known unit "
                               "(scripts/checks/units.py)")
            for match in MEMBER.finditer(struct.body)
            if match.group(1) in ("double", "float") and not has_unit(match.group(2))]


def check_names(struct):
    found = []
    for match in FIELD_CALL.finditer(struct.body):
        name, place = match.groups()
        member = place.split(".")[-1]
        if name != member and not ("." in place and name.endswith("_" + member)):
            found.append(say(struct, match, f'field "{name}" must be named as its member {member}'))
    return found


def check_visits(name, struct, structs):
    visited = {match.group(2) for match in FIELD_CALL.finditer(struct.body)}
    by_themselves = set(GROUP_CALL.findall(struct.body))
    groups = [("", struct)] + [(match.group(2) + ".", structs[match.group(1)])
                               for match in GROUP.finditer(struct.body)
                               if match.group(1) in structs and match.group(2) not in by_themselves]
    return [say(group, match, f"{prefix}{match.group(2)} is not in visit_fields of {name}: "
                              "nobody can set it")
            for prefix, group in groups for match in MEMBER.finditer(group.body)
            if prefix + match.group(2) not in visited]
