"""No drawer for odds and ends: a file is named for the one idea it holds."""
import re

EMPTY_WORDS = {"util", "utils", "utility", "utilities", "helper", "helpers", "manager", "misc",
               "stuff"}


def check(tree):
    found = []
    for path in tree.paths:
        words = EMPTY_WORDS & set(re.split(r"[/_.\-]", path.lower()))
        found += [f"{path}:1: '{word}' says nothing of what is inside" for word in sorted(words)]
    return found
