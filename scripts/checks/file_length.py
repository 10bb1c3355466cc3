"""A file holds one idea; past 400 lines it holds two."""

MOST_LINES = 400
CODE = r".*\.(h|cpp|py|lcm|cmake)|(.*/)?CMakeLists\.txt|scripts/[^/.]+|lcmtypes/generate|\.ci/run"


def check(tree):
    found = []
    for path in tree.match(CODE):
        count = len(tree.text(path).splitlines())
        if count > MOST_LINES:
            found.append(f"{path}:{MOST_LINES + 1}: {count} lines, more than {MOST_LINES}; "
                         "split it by idea")
    return found
