"""A reader has this tree and a library: cite papers, books and data sheets, not working notes."""
import re

NOTES = re.compile(r"\b(?:ALGORITHMS|FACTS|SPEC|STYLE|DESIGN)(?:\.md\b|\s+(?:U|[A-H])?\d)"
                   r"|\b(?:SPEC|thesis notes)\s+[A-H]\d|\bissues? #?\d")


def check(tree):
    found = []
    for path in tree.match(r".*\.(h|cpp|lcm|md|py|toml|cmake)|scripts/.*|.*CMakeLists\.txt"):
        for number, line in tree.lines(path):
            if match := NOTES.search(line):
                found.append(f"{path}:{number}: '{match.group()}' is not in this tree: "
                             "write the equation or cite its source")
    return found
