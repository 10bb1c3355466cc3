"""scripts/experiments makes one page of what its modules find, that needs nothing beside it."""
import contextlib
import io
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import types
import unittest

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))

from plotting.line_plot import Axis, line_plot  # noqa: E402
from plotting.plan import Marks, plan  # noqa: E402
from plotting.png import png  # noqa: E402
from recordings import simulated  # noqa: E402
from report_parts import page, printed_tables, run, slam_programs, text, thesis  # noqa: E402
from report_parts.results import (Bar, Figure, Note, Result, Table, at_least,  # noqa: E402
                                  at_most, left_out)

# What slam_experiment prints, from a stand-in.
STAND_IN = """#!/bin/sh
echo "ANEES/3 of the pose, 4 runs; an honest filter is within [0.365, 1.945]"
echo "world               invariant      plain invariant RMSE m plain RMSE m"
echo "full view               1.587      1.549            0.015        0.014"
echo "57 degree view          0.862      4.033            0.053        0.070"
exit $STAND_IN_EXIT
"""


# A simulator that records nothing but that it was asked to.
STAND_IN_SIMULATOR = """#!/bin/sh
echo recorded > "$2"
"""


def some_result():
    svg = line_plot("A plot", Axis("x"), Axis("y"), {"one": [(0, 1.0), (1, None), (2, 3.0)]})
    return Result([Table("A <table>", ["what", "m"], [["a & b", 0.5]]), Note("A word."),
                   Figure("a plot", svg), Figure("a picture", png(2, 1, bytes(range(6))))],
                  [at_most("error", 0.5, 0.4), at_least("share", 0.99, 0.95)])


class SimulatedDrive(unittest.TestCase):
    def test_a_scenario_may_be_one_of_the_simulators_or_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder, "simulator")
            program.write_text(STAND_IN_SIMULATOR)
            program.chmod(0o755)
            for scenario in ("living_room", pathlib.Path(folder, "darker.toml")):
                log = simulated.drive(pathlib.Path(folder), scenario)
                self.assertEqual(log.read_text(), "recorded\n")


class Page(unittest.TestCase):
    def setUp(self):
        self.html = page.page({"map_2d": "A map", "slam_speed": "Speed"},
                              {"map_2d": some_result(), "slam_speed": left_out("no <peer>")})

    def test_it_needs_no_other_file_and_no_network(self):
        sources = re.findall(r'(?:src|srcset|poster)="([^"]*)"', self.html)
        self.assertTrue(sources)
        self.assertTrue(all(source.startswith("data:image/png;base64,") for source in sources))
        self.assertTrue(all(link.startswith("#") for link in re.findall(r'href="([^"]*)"',
                                                                        self.html)))
        without_names = self.html.replace("http://www.w3.org/2000/svg", "")
        self.assertNotRegex(without_names, r"https?:|@import|url\(|<script|<link|<iframe")

    def test_it_says_which_bars_held_and_which_did_not(self):
        self.assertIn("1 of 2 bars held", self.html)
        self.assertRegex(self.html, r"error &lt;= 0.4</td><td>0.500</td><td>.*missed")
        self.assertRegex(self.html, r"share &gt;= 0.95</td><td>0.990</td><td>.*held")

    def test_it_says_what_was_left_out_and_what_was_not_measured(self):
        self.assertIn("Left out: no &lt;peer&gt;", self.html)
        self.assertEqual(self.html.count("Not measured in this run."), len(
            [part for part, names in thesis.parts_with(["map_2d", "slam_speed"])
             if not names and not part.elsewhere and part is not thesis.REST]))

    def test_each_experiment_has_its_command(self):
        for name in ("map_2d", "slam_speed"):
            self.assertIn(f"<code>scripts/experiments {name}</code>", self.html)

    def test_text_of_cells_is_escaped(self):
        self.assertIn("a &amp; b", self.html)
        self.assertIn("A &lt;table&gt;", self.html)

    def test_the_same_results_give_the_same_page(self):
        again = page.page({"map_2d": "A map", "slam_speed": "Speed"},
                          {"map_2d": some_result(), "slam_speed": left_out("no <peer>")})
        self.assertEqual(again, self.html)


class Chapter(unittest.TestCase):
    names = sorted(path.stem for path in (SCRIPTS / "experiments_tables").glob("*.py"))

    def test_every_experiment_stands_in_one_part(self):
        placed = [name for _, names in thesis.parts_with(self.names) for name in names]
        self.assertEqual(sorted(placed), self.names)

    def test_every_part_has_an_experiment_or_says_where_it_is_shown(self):
        empty = {part.numbers for part, names in thesis.parts_with(self.names)
                 if not names and not part.elsewhere}
        self.assertLessEqual(empty, {"Figure 5.5"})  # filled by any other landmark_*


class Running(unittest.TestCase):
    def of(self, function):
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            return run.run(types.SimpleNamespace(run=function), None)

    def test_a_result_is_handed_on_and_not_yet_printed(self):
        result = some_result()
        self.assertEqual(self.of(lambda _: result), (result, False))

    def test_what_an_experiment_and_its_programs_print_becomes_tables(self):
        def printing(_):
            subprocess.run(["printf", "robot   path m   map m\\n1   0.5   0.2\\n"], check=True)
            return False
        result, is_printed = self.of(printing)
        self.assertTrue(is_printed)
        self.assertEqual(result.blocks, [Table("", ["robot", "path m", "map m"],
                                               [["1", "0.5", "0.2"]])])
        self.assertFalse(result.held())

    def test_an_experiment_that_breaks_off_is_a_bar_missed(self):
        def broken(_):
            raise RuntimeError("no simulator")
        result, _ = self.of(broken)
        self.assertEqual(result.bars, [Bar("the experiment runs to its end", "no simulator",
                                           False)])


class PrintedTables(unittest.TestCase):
    def test_words_around_a_table_stay_words(self):
        blocks = printed_tables.blocks_of("Errors:\na   b   c\n1   2   3\nand so on\n")
        self.assertEqual(blocks[0], Table("Errors", ["a", "b", "c"], [["1", "2", "3"]]))
        self.assertEqual(blocks[1].text, "and so on")

    def test_rows_without_names_above_them_stay_as_printed(self):
        said = "1   2   3\n4   5   6"
        self.assertEqual([block.text for block in printed_tables.blocks_of(said)], [said])

    def test_rows_of_a_program_are_found_by_their_width(self):
        rows = slam_programs.rows_of("name   a   b\nup to 10 %, x   75.0 %   0/1\nelse\n", 3)
        self.assertEqual(rows, [["up to 10 %, x", "75.0", "0/1"]])

    def test_a_table_reads_well_on_a_terminal(self):
        self.assertEqual(text.table_text(Table("T", ["a", "m"], [["x", 1.0], ["long", 22.5]])),
                         "T\n  a          m\n  x      1.000\n  long  22.500")


class Pictures(unittest.TestCase):
    def test_a_line_is_not_drawn_over_a_gap(self):
        svg = line_plot("", Axis("x"), Axis("y"), {"one": [(0, 1), (1, None), (2, 3)]})
        self.assertEqual(svg.count("<polyline"), 2)

    def test_a_plan_has_one_scale_both_ways(self):
        svg = plan("", [Marks("way", [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0)], "#000", joined=True)])
        (ax, ay), (bx, by), (cx, cy) = (map(float, point.split(",")) for point in
                                        re.search(r'points="([^"]*)"', svg)[1].split())
        self.assertAlmostEqual(bx - ax, by - cy, delta=0.2)
        self.assertAlmostEqual(ay, by)
        self.assertAlmostEqual(bx, cx)

    def test_a_picture_holds_its_pixels(self):
        data = png(2, 1, bytes([255, 0, 0, 0, 0, 255]))
        self.assertTrue(data.startswith(b"\x89PNG\r\n\x1a\n"))
        self.assertTrue(data.endswith(b"IEND\xaeB`\x82"))


class Command(unittest.TestCase):
    def experiments(self, *words, **environment):
        return subprocess.run([SCRIPTS / "experiments", *words], check=False, text=True,
                              capture_output=True, env={**os.environ, **environment})

    def test_an_unknown_name_is_refused_with_those_there_are(self):
        done = self.experiments("nonsense")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("no nonsense; there are: ", done.stderr)
        self.assertIn("slam_rounds", done.stderr)

    def with_stand_in(self, ends_with):
        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder, "slam_experiment")
            program.write_text(STAND_IN, encoding="utf-8")
            program.chmod(0o755)
            out = pathlib.Path(folder, "page.html")
            done = self.experiments("slam_consistency", "--bin", folder, "--page", out,
                                    STAND_IN_EXIT=ends_with)
            return done, out.read_text(encoding="utf-8")

    def test_a_page_is_made_of_what_was_named(self):
        done, html = self.with_stand_in("0")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("<td>57 degree view</td><td class=number>0.862</td>", html)
        self.assertIn("1 of 1 bars held", html)

    def test_a_missed_bar_is_said_and_ends_badly(self):
        done, html = self.with_stand_in("1")
        self.assertIn("bars missed: slam_consistency", done.stderr)
        self.assertEqual(done.returncode, 1)
        self.assertIn("0 of 1 bars held", html)


if __name__ == "__main__":
    unittest.main()
