#!/usr/bin/env python3
"""Says which tests of a ctest --output-junit file were skipped, and why; then what ctest counted.

usage: skipped.py tests.xml
"""
import collections
import re
import sys
import xml.etree.ElementTree


def reason(output):
    """What GTEST_SKIP() << ... said: the lines after '...: Skipped'."""
    match = re.search(r": Skipped\n(.*?)\n*^\[  SKIPPED \]", output, flags=re.S | re.M)
    return " ".join(match.group(1).split()) if match else "gives no reason"


def report(suite):
    """Lines to print: skipped tests by reason, then one like ctest's own last line."""
    by_reason = collections.defaultdict(list)
    for case in suite.iter("testcase"):
        if case.find("skipped") is not None or case.get("status") in ("notrun", "disabled"):
            by_reason[reason(case.findtext("system-out", ""))].append(case.get("name"))
    lines = []
    for why, names in sorted(by_reason.items()):
        lines += [f"skipped: {why}", *(f"  {name}" for name in names)]
    total, failed = int(suite.get("tests")), int(suite.get("failures"))
    skipped = sum(map(len, by_reason.values()))
    lines.append(f"skipped {skipped} of {total} tests" + (" (why: above)" if skipped else ""))
    lines.append(f"{100 * (total - failed) // max(total, 1)}% tests passed, {failed} tests failed "
                 f"out of {total}")
    return lines


if __name__ == "__main__":
    print("\n".join(report(xml.etree.ElementTree.parse(sys.argv[1]).getroot())))
