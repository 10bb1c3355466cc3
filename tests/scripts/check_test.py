"""scripts/check as a person runs it, clang-tidy with its memory, and that no rule goes untested."""
import importlib
import json
import pathlib
import subprocess
import unittest

from rule_case import ROOT, RuleCase

from checks import tidy

CHECK = ROOT / "scripts" / "check"


class Command(RuleCase):
    clean = {"common/channels.h": "// kAllChannels\n",
             "README.md": "<!-- channel-table:begin -->\n<!-- channel-table:end -->\n"
                          "<!-- channel-diagram:begin -->\n<!-- channel-diagram:end -->\n"}

    def run_on(self, files, *options):
        tree = self.tree(files)
        subprocess.run(["git", "init", "-q"], cwd=tree.root, check=True)
        return subprocess.run([CHECK, "--quick", *options, "--root", tree.root], capture_output=True,
                              text=True)

    def test_a_violation_fails_and_is_named(self):
        done = self.run_on({**self.clean, "common/utils.h": "int x;\n"}, "--fix-readme")
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("common/utils.h:1: 'utils' says nothing", done.stdout)

    def test_an_old_readme_fails_and_its_remedy_passes(self):
        self.assertEqual(self.run_on(self.clean).returncode, 1)
        done = self.run_on(self.clean, "--fix-readme")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("check: everything holds", done.stdout)

    def test_a_file_not_yet_added_is_judged_and_an_ignored_one_is_not(self):
        done = self.run_on({".gitignore": "build/\n", "build/misc.h": "", "a/misc.h": ""})
        self.assertIn("a/misc.h:1:", done.stdout)
        self.assertNotIn("build/misc.h", done.stdout)


class Tidy(RuleCase):
    rule = tidy

    def project(self, source, **others):
        """A tree whose release build has compiled a.cpp, which includes a.h, and the other files."""
        sources = {"a.cpp": source, **{f"{name}.cpp": text for name, text in others.items()}}
        tree = self.tree({".clang-tidy": (ROOT / ".clang-tidy").read_text(), **sources,
                          "a.h": "#pragma once\ninline int one() { return 1; }\n"})
        build = tree.root / tidy.BUILD
        build.mkdir(parents=True)
        command = "c++ -std=c++20 -I{0} -MD -MF {1}.d -c {0}/{1} -o {1}.o"
        (build / "build.ninja").write_text(
            f"rule cc\n  command = {command.format(tree.root, '$name')}\n"
            "  depfile = $name.d\n  deps = gcc\n"
            + "".join(f"build {name}.o: cc {tree.root}/{name}\n  name = {name}\n"
                      for name in sources))
        (build / "compile_commands.json").write_text(json.dumps(
            [{"directory": str(build), "command": command.format(tree.root, name),
              "file": f"{tree.root}/{name}"} for name in sources]))
        subprocess.run(["ninja", "-C", build], check=True, capture_output=True)
        return tree

    def test_a_bad_name_and_a_use_after_move_are_refused(self):
        found = tidy.check(self.project(
            '#include <string>\n#include <utility>\nclass bad_name {};\n'
            "std::string f(std::string s) {\n  std::string t = std::move(s);\n  return t + s;\n}\n"))
        self.assertTrue(any(line.startswith("a.cpp:3: invalid case style") for line in found), found)
        self.assertTrue(any(line.startswith("a.cpp:6:") and "use-after-move" in line
                            for line in found), found)

    def test_clean_code_is_judged_once_until_it_or_its_header_changes(self):
        tree = self.project('#include "a.h"\nint two() { return one() + 1; }\n')
        self.assertEqual(tidy.check(tree), [])
        memory = tree.root / tidy.BUILD / "tidy"
        def remembered():
            return [path for path in memory.iterdir() if path.suffix != ".cpp"]

        self.assertEqual(len(remembered()), 1)
        before = [(p.name, p.stat().st_mtime_ns) for p in remembered()]
        self.assertEqual(tidy.check(tree), [])
        self.assertEqual([(p.name, p.stat().st_mtime_ns) for p in remembered()], before)
        (tree.root / "a.h").write_text("#pragma once\ninline int one() { return 1 ; }\n")
        tidy.file_hash.cache_clear()
        self.assertEqual(tidy.check(tree), [])
        self.assertEqual(len(remembered()), 2)

    def test_two_files_of_a_folder_are_judged_together(self):
        same = "namespace {\nint count() { return 1; }\n}  // namespace\n"
        found = tidy.check(self.project(same + "int f() { return count(); }\n",
                                        b=same + "int g() { return count(); }\n"))
        self.assertTrue(any("redefinition of 'count'" in line for line in found), found)

    def test_a_file_no_target_compiles_is_refused(self):
        tree = self.project('#include "a.h"\nint f() { return one(); }\n')
        (tree.root / "b.cpp").write_text("int x;\n")
        tree.paths.append("b.cpp")
        self.assertEqual(tidy.check(tree), ["b.cpp:1: no target compiles this file"])


class Rules(unittest.TestCase):
    def test_every_rule_is_run_and_tested(self):
        runner = CHECK.read_text()
        tested = "".join(path.read_text() for path in pathlib.Path(__file__).parent.glob("*_test.py"))
        for path in sorted((ROOT / "scripts" / "checks").glob("*.py")):
            if not hasattr(importlib.import_module(f"checks.{path.stem}"), "check"):
                continue
            with self.subTest(path.stem):
                self.assertRegex(runner, rf"\b{path.stem}\b")
                self.assertRegex(tested, rf"rule = {path.stem}\b")


if __name__ == "__main__":
    unittest.main()
