"""lcmtypes/generate refuses what lcm-gen lets through, and says which file is at fault."""
import os
import pathlib
import subprocess
import tempfile
import unittest

GENERATE = pathlib.Path(__file__).resolve().parents[2] / "lcmtypes" / "generate"


class Generate(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.out = self.folder / "out"

    def generate(self, **types):
        """Runs it on TYPE.lcm files with these texts."""
        paths = [self.folder / f"{name}.lcm" for name in types]
        for path, text in zip(paths, types.values()):
            path.write_text(text)
        return subprocess.run([GENERATE, self.out, *paths], capture_output=True, text=True)

    def assert_refused(self, done, *words):
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def test_a_good_type_makes_its_class_guard_visitor_and_the_lists(self):
        done = self.generate(
            part_t="package roomwise; struct part_t { double x_m; }",
            whole_t="package roomwise; struct whole_t { const int8_t A = 1; int32_t n; part_t p[n]; }")
        self.assertEqual(done.returncode, 0, done.stderr)
        made = {path.name for path in (self.out / "roomwise").iterdir()}
        self.assertEqual(made, {"part_t.hpp", "part_t_guard.hpp", "part_t_fields.hpp", "whole_t.hpp",
                                "whole_t_guard.hpp", "whole_t_fields.hpp", "all_messages.hpp",
                                "all_fields.hpp"})
        self.assertIn("std::tuple<part_t, whole_t>",
                      (self.out / "roomwise" / "all_messages.hpp").read_text())

    def test_the_same_input_makes_the_same_bytes(self):
        text = {"a_t": "package roomwise; struct a_t { int8_t n; byte data[n]; string s; }"}
        first = self.generate(**text), self.made_bytes()
        second = self.generate(**text), self.made_bytes()
        self.assertEqual(first[1], second[1])

    def made_bytes(self):
        return {path.name: path.read_bytes() for path in (self.out / "roomwise").iterdir()}

    def test_an_enum_is_refused(self):
        self.assert_refused(self.generate(a_t="package roomwise; enum a_t { ONE, TWO }"),
                            "a_t.lcm", "enum")

    def test_an_unknown_member_type_is_refused(self):
        self.assert_refused(self.generate(a_t="package roomwise; struct a_t { missing_t x; }"),
                            "a_t.lcm", "missing_t")

    def test_another_package_is_refused(self):
        self.assert_refused(self.generate(a_t="package other; struct a_t { int8_t x; }"),
                            "a_t.lcm", "package roomwise")

    def test_two_structs_in_a_file_are_refused(self):
        self.assert_refused(self.generate(
            a_t="package roomwise; struct a_t { int8_t x; } struct b_t { int8_t y; }"), "a_t.lcm")

    def test_a_struct_named_unlike_its_file_is_refused(self):
        self.assert_refused(self.generate(a_t="package roomwise; struct b_t { int8_t x; }"),
                            "a_t.lcm", "b_t")

    def test_a_count_after_its_array_is_refused(self):
        self.assert_refused(self.generate(a_t="package roomwise; struct a_t { byte x[n]; int32_t n; }"),
                            "a_t.lcm", "x[n]")

    def test_a_count_that_is_no_integer_is_refused(self):
        self.assert_refused(self.generate(a_t="package roomwise; struct a_t { double n; byte x[n]; }"),
                            "a_t.lcm", "x[n]")

    def test_a_line_it_cannot_read_is_refused(self):
        self.assert_refused(self.generate(a_t="package roomwise; struct a_t { int8_t; }"), "a_t.lcm")

    def test_a_folder_that_cannot_be_made_is_refused(self):
        self.out.write_text("a file stands where the folder should be")
        self.assert_refused(self.generate(a_t="package roomwise; struct a_t { int8_t x; }"), "out")

    def test_a_header_that_cannot_be_written_is_refused(self):
        (self.out / "roomwise" / "a_t.hpp").mkdir(parents=True)
        self.assert_refused(self.generate(a_t="package roomwise; struct a_t { int8_t x; }"), "a_t.hpp")

    def test_an_lcm_gen_that_writes_nothing_is_refused(self):
        """As lcm-gen 1.3.1 does for an enum: exit 0, no file."""
        (self.folder / "lcm-gen").write_text("#!/bin/sh\nexit 0\n")
        (self.folder / "lcm-gen").chmod(0o755)
        path = self.folder / "a_t.lcm"
        path.write_text("package roomwise; struct a_t { int8_t x; }")
        done = subprocess.run([GENERATE, self.out, path], capture_output=True, text=True,
                              env={**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}"})
        self.assert_refused(done, "a_t.lcm", "wrote no a_t.hpp")


if __name__ == "__main__":
    unittest.main()
