"""A shell script stops at its first failure, and what a person runs can be run."""
import os
import re

STRICT = re.compile(r"^set -euo pipefail$", flags=re.M)


def check(tree):
    found = []
    for path in tree.match(r"scripts/[^.]+|\.ci/.*|.*\.sh"):
        text = tree.text(path)
        first = text.split("\n", 1)[0]
        if not first.startswith("#!"):
            found.append(f"{path}:1: no #! line")
        if re.search(r"\b(ba)?sh\b", first) and not STRICT.search(text):
            found.append(f"{path}:1: no 'set -euo pipefail'")
        if not os.access(tree.root / path, os.X_OK):
            found.append(f"{path}:1: not executable")
    return found
