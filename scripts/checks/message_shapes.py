"""No two messages may have the same members.

LCM's fingerprint covers the names, types and dimensions of members but not the name of the type:
two types of one shape decode as each other.
"""
from checks import messages


def check(tree):
    types = {path.split("/")[-1][:-len(".lcm")]: messages.fields(tree, path)
             for path in messages.message_paths(tree)}
    first_with = {}
    found = []
    for name in sorted(types):
        other = first_with.setdefault(shape(name, types), name)
        if other != name:
            found.append(f"lcmtypes/{name}.lcm:1: has the same members as {other}.lcm")
    return found


def shape(name, types):
    """What the fingerprint sees: a member's own type counts by its members, not by its name."""
    return tuple((member, shape(kind, types) if kind in types else kind, tuple(dimensions))
                 for kind, member, dimensions in types[name])
