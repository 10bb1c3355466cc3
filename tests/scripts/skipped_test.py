"""The end of scripts/test: what was skipped and why, then the line ctest counts in."""
import unittest
import xml.etree.ElementTree as ElementTree

from rule_case import ROOT  # noqa: F401: makes checks importable

from checks import skipped

SKIP = ("[ RUN      ] A.B\n/a/b_test.cpp:7: Skipped\nno recording x;\nput it there\n\n\n"
        "[  SKIPPED ] A.B (0 ms)\n")


def suite(*cases, failures=0):
    body = "".join(f'<testcase name="{name}" status="{status}">{mark}<system-out>{out}</system-out>'
                   "</testcase>" for name, status, mark, out in cases)
    return ElementTree.fromstring(f'<testsuite tests="{len(cases)}" failures="{failures}">{body}'
                                  "</testsuite>")


class Skipped(unittest.TestCase):
    def test_nothing_skipped(self):
        self.assertEqual(skipped.report(suite(("a", "run", "", ""))),
                         ["skipped 0 of 1 tests", "100% tests passed, 0 tests failed out of 1"])

    def test_skipped_tests_stand_under_their_reason(self):
        mark = '<skipped message=""/>'
        lines = skipped.report(suite(("a", "run", "", ""), ("b", "notrun", mark, SKIP),
                                     ("c", "notrun", mark, SKIP), ("d", "disabled", "", "")))
        self.assertEqual(lines[:-2], ["skipped: gives no reason", "  d",
                                      "skipped: no recording x; put it there", "  b", "  c"])
        self.assertEqual(lines[-2], "skipped 3 of 4 tests (why: above)")

    def test_failures_are_counted(self):
        lines = skipped.report(suite(("a", "run", "", ""), ("b", "fail", "<failure/>", ""), failures=1))
        self.assertEqual(lines[-1], "50% tests passed, 1 tests failed out of 2")

    def test_one_failure_in_a_thousand_is_not_all_passed(self):
        cases = [(str(i), "run", "", "") for i in range(1000)]
        self.assertTrue(skipped.report(suite(*cases, failures=1))[-1].startswith("99%"))


if __name__ == "__main__":
    unittest.main()
