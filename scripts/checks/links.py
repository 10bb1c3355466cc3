"""What a README points to inside this tree is there."""
import posixpath
import re

LINK = re.compile(r"\]\(([^)\s#]+)(?:#[^)\s]*)?\)")
ELSEWHERE = re.compile(r"[a-z]+:")


def check(tree):
    present = set(tree.paths)
    for path in tree.paths:
        while path := posixpath.dirname(path):
            present.add(path)
    found = []
    for path in tree.match(r".*\.md"):
        for number, line in tree.lines(path):
            for target in LINK.findall(line):
                place = posixpath.normpath(posixpath.join(posixpath.dirname(path), target))
                if not ELSEWHERE.match(target) and place not in present:
                    found.append(f"{path}:{number}: {target} is not there")
    return found
