"""clang-format has the last word on layout (.clang-format: Google, 100 columns)."""
import concurrent.futures
import re
import subprocess

BATCH = 20


def check(tree):
    paths = tree.match(r".*\.(h|cpp)")
    batches = [paths[first:first + BATCH] for first in range(0, len(paths), BATCH)]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        return [line for lines in pool.map(lambda batch: complaints(tree.root, batch), batches)
                for line in lines]


def complaints(root, paths):
    """The first complaint of each file: the rest is mended with it."""
    done = subprocess.run(["clang-format", "--dry-run", "-Werror", *paths], cwd=root,
                          capture_output=True, text=True)
    found = {}
    for match in re.finditer(r"^(\S+?):(\d+):\d+: error: ", done.stderr, flags=re.M):
        found.setdefault(match.group(1), f"{match.group(1)}:{match.group(2)}: not as clang-format "
                                         f"has it; run clang-format -i {match.group(1)}")
    if done.returncode != 0 and not found:
        return [f"{paths[0]}:1: clang-format: {done.stderr.strip()}"]
    return list(found.values())
