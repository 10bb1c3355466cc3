#!/usr/bin/env python3
"""Prints one table of what one run of the benchmarks measured against its peers and its limits.

usage: ratios.py FOLDER     in it: PROGRAM.json, the JSON output of each benchmark that ran

The ratio says how many times better than the peer, or what share of the limit. A peer that is not
installed says so; benchmarks that did not run are left out.
"""
import dataclasses
import json
import pathlib
import sys

sys.dont_write_bytecode = True
from table import MILLISECONDS, text  # noqa: E402

NOT_INSTALLED = "not installed"
NOT_MEASURED = "not measured"


@dataclasses.dataclass(frozen=True)
class Row:
    """`value`: of the ratio, None if there is none; the bar: `least` or `most` of it, or neither."""
    what: str
    ours: str
    peer: str
    value: float | None = None
    least: float | None = None
    most: float | None = None

    def bar(self):
        if self.least is not None:
            return f">= {self.least:g}"
        return f"<= {self.most:g}" if self.most is not None else ""

    def verdict(self):
        if not self.bar():
            return ""
        if self.value is None:
            return NOT_INSTALLED if self.peer == NOT_INSTALLED else NOT_MEASURED
        held = self.value >= self.least if self.least is not None else self.value <= self.most
        return "held" if held else "MISSED"

    def cells(self):
        value = "" if self.value is None else f"{self.value:.3g}"
        return [self.what, self.ours, self.peer, value, self.bar(), self.verdict()]


class Runs:
    """What a benchmark program measured, by the benchmark's name."""

    def __init__(self, results):
        self._runs = {run["name"]: run for run in results["benchmarks"]
                      if not run.get("error_occurred")}

    def ms(self, name):
        run = self._runs.get(name)
        return run and run["cpu_time"] * MILLISECONDS[run["time_unit"]]

    def counter(self, name, key):
        return self._runs.get(name, {}).get(key)


def shown(value, unit):
    return NOT_MEASURED if value is None else f"{value:.3g} {unit}"


def times_faster(runs, what, ours, peers, least=None):
    """Than the fastest of the `peers` that are there."""
    own_ms = runs.ms(ours)
    found = [(runs.ms(name), name) for name in peers if runs.ms(name) is not None]
    peer_ms, name = min(found, default=(None, ""))
    peer = f"{shown(peer_ms, 'ms')}, {name}" if found else NOT_INSTALLED
    value = peer_ms / own_ms if own_ms and found else None
    return Row(what, shown(own_ms, "ms"), peer, value, least=least)


def share_of(what, values, limit, unit):
    """What `values` come to, of the `limit`; there is none if one of them is missing."""
    total = None if None in values else sum(values)
    return Row(what, shown(total, unit), f"limit {limit:g} {unit}",
               None if total is None else total / limit, most=1.0)


def landmark_rows(runs):
    per_pixel = [runs.counter(f"whole_tiled/{width}", "ns_per_pixel")
                 for width in (160, 320, 640, 1280)]
    least, most = (None, None) if None in per_pixel else (min(per_pixel), max(per_pixel))
    return [
        share_of("landmarks of a VGA frame", [runs.ms("whole_room/640")], 1.5, "ms"),
        Row("its ns a pixel, 160x120 to 1280x960: most", shown(most, "ns"),
            f"{shown(least, 'ns')}, least", most and most / least, most=1.15),
        times_faster(runs, "its edges, on depth", "edges_room/640", ["canny_room/640"], 1.0),
        times_faster(runs, "all of it, against ORB and matching", "whole_room/640",
                     ["orb_room/640"], 5.0)]


def segment_rows(runs):
    return [
        share_of("labels of a VGA frame, fused", [runs.ms("frame/fused/vga")], 3.0, "ms"),
        times_faster(runs, "its colours, against cv::ml::EM", "classes/roomwise/vga",
                     ["classes/opencv/vga"], 50.0),
        times_faster(runs, "its training, against cv::ml::EM", "mixture/roomwise/train",
                     ["mixture/opencv/train"])]


def ekf_rows(runs):
    """The bar is MRPT's filter as it comes; Davison's way of updating is a choice of its own."""
    rows = [times_faster(runs, f"SLAM frame, {count} landmarks", f"landmarks_{count}/roomwise/frame",
                         [f"landmarks_{count}/{peer}/frame"],
                         100.0 if (count, peer) == (300, "mrpt_naive") else None)
            for peer in ("mrpt_naive", "mrpt_davison") for count in (30, 300, 1000)]
    for count in (1000, 2000):
        ours = runs.counter(f"sweep_{count}/roomwise/pass", "GB_per_s")
        memory = runs.counter("memory/in_place/pass", "GB_per_s")
        rows.append(Row(f"covariance sweep, {count} landmarks", shown(ours, "GB/s"),
                        f"{shown(memory, 'GB/s')}, memory",
                        ours / memory if ours and memory else None, least=0.7))
    return rows


def codec_rows(runs):
    recorded = runs.ms("kinect_v1_640x480/pdz16/encode") is not None
    source = "kinect_v1_640x480" if recorded else "simulated_640x480"
    ours, both = f"{source}/pdz16", ("encode", "decode")
    size = runs.counter(f"{ours}/encode", "bytes")
    rows = [share_of(f"depth codec, bytes of {source}",
                     [None if size is None else size / 1e3], 70.0, "KB"),
            share_of("depth codec, encode and decode", [runs.ms(f"{ours}/{do}") for do in both],
                     4.0, "ms")]
    return rows + [times_faster(runs, f"depth codec, {do}", f"{ours}/{do}",
                                [f"{source}/{peer}/{do}" for peer in ("zstd-1", "png-1")])
                   for do in both]


def render_rows(runs):
    return [times_faster(runs, f"simulated {what}, against bare rays", f"vga/{what}/frame",
                         ["vga/bare_embree/frame"])
            for what in ("ideal_view", "kinect_registered", "kinect_two_cameras")]


ROWS = {"detector_bench": landmark_rows, "segment_bench": segment_rows, "ekf_bench": ekf_rows,
        "depth_codec_bench": codec_rows, "render_bench": render_rows}


def rows(folder):
    found = []
    for program, rows_of in ROWS.items():
        path = pathlib.Path(folder) / f"{program}.json"
        if path.exists():
            found += rows_of(Runs(json.loads(path.read_text())))
    return found


def main(arguments):
    if len(arguments) != 1:
        sys.exit(__doc__)
    found = rows(arguments[0])
    if found:
        heading = ["what", "ours", "peer or limit", "ratio", "bar", ""]
        print("== against peers and limits", *text([heading, *(row.cells() for row in found)]),
              sep="\n")


if __name__ == "__main__":
    main(sys.argv[1:])
