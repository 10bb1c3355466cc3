"""A test case that shows a rule a little tree and looks at what it says."""
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

from checks.tree import Tree  # noqa: E402: found by the line above


class RuleCase(unittest.TestCase):
    rule = None  # set by each test class

    def tree(self, files, executable=True):
        """A tree on disk with these files: path -> text."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        for path, text in files.items():
            file = pathlib.Path(folder.name, path)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)
            file.chmod(0o755 if executable else 0o644)
        return Tree(folder.name, files)

    def assert_clean(self, files):
        self.assertEqual(self.rule.check(self.tree(files)), [])

    def assert_refused(self, files, *starts, **how):
        """The rule says exactly these, each by how its line starts or by a part of it."""
        found = self.rule.check(self.tree(files, **how))
        self.assertEqual(len(found), len(starts), found)
        for start in starts:
            self.assertTrue(any(start in line for line in found), f"{start} not in {found}")
