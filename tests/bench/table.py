#!/usr/bin/env python3
"""Prints the JSON output of one Google Benchmark program as a table.

usage: table.py TITLE RESULTS.json

Benchmarks named SUBJECT/IMPLEMENTATION/OPERATION are compared: the last column says how many times
as long each takes as the first implementation listed for that subject and operation.
"""
import json
import pathlib
import sys

MILLISECONDS = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}
OWN_KEYS = {"name", "run_name", "run_type", "repetitions", "repetition_index", "threads",
            "iterations", "real_time", "cpu_time", "time_unit", "family_index",
            "per_family_instance_index", "error_occurred", "error_message", "label"}


def compared(name):
    """What a benchmark may be compared with: the same subject and operation, or None."""
    parts = name.split("/")
    return (parts[0], parts[-1]) if len(parts) == 3 else None


def rows(benchmarks):
    counters = sorted({key for run in benchmarks for key in run if key not in OWN_KEYS})
    table = [["benchmark", "CPU ms", *counters, "times the first"]]
    first = {}
    for run in benchmarks:
        if run.get("error_occurred"):
            table.append([run["name"], "failed: " + run["error_message"]])
            continue
        time_ms = run["cpu_time"] * MILLISECONDS[run["time_unit"]]
        group = compared(run["name"])
        ratio = f"{time_ms / first.setdefault(group, time_ms):.2f}" if group else ""
        table.append([run["name"], f"{time_ms:.4g}",
                      *(f"{run[key]:.6g}" if key in run else "" for key in counters), ratio])
    return table


def text(table):
    widths = [max(len(row[i]) for row in table if i < len(row)) for i in range(len(table[0]))]
    return [row[0].ljust(widths[0]) + "".join(
        "  " + cell.rjust(width) for cell, width in zip(row[1:], widths[1:])) for row in table]


def main(arguments):
    if len(arguments) != 2:
        sys.exit(__doc__)
    results = json.loads(pathlib.Path(arguments[1]).read_text())
    print(f"== {arguments[0]}", *text(rows(results["benchmarks"])), sep="\n")


if __name__ == "__main__":
    main(sys.argv[1:])
