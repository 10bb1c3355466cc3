"""The files a rule looks at."""
import functools
import pathlib
import re
import subprocess


class Tree:
    """A source tree: its root and the paths, relative to it, that count as part of the project."""

    def __init__(self, root, paths):
        self.root = pathlib.Path(root)
        self.paths = sorted(paths)

    @classmethod
    def tracked(cls, root):
        """What git tracks or would track: new files are judged before they are added."""
        listed = subprocess.run(
            ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
            cwd=root, check=True, capture_output=True, text=True).stdout
        return cls(root, {p for p in listed.split("\0") if p and pathlib.Path(root, p).is_file()})

    @functools.cache
    def text(self, path):
        """Contents of a file; bytes that are no UTF-8 become replacement characters."""
        return pathlib.Path(self.root, path).read_text(encoding="utf-8", errors="replace")

    def lines(self, path):
        """(line number, line) pairs, from 1."""
        return enumerate(self.text(path).splitlines(), start=1)

    def match(self, pattern):
        """Paths that a regular expression matches as a whole."""
        return [path for path in self.paths if re.fullmatch(pattern, path)]

    def code(self, path):
        """C++ text without comments and without what stands in string literals; same lines."""
        return strip_comments(self.text(path), keep_strings=False)


_TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', flags=re.S)


def strip_comments(text, keep_strings=True):
    """Blanks C++ comments, and what string literals hold unless they are kept; lines stay."""
    def blank(match):
        token = match.group()
        if token.startswith('"'):
            return token if keep_strings else '""'
        return "\n" * token.count("\n") or " "
    return _TOKEN.sub(blank, text)


def line_of(text, offset):
    """Line number of a character, from 1."""
    return text.count("\n", 0, offset) + 1
