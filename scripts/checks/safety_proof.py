"""Coverage of services/safety_svc/core by its tests, and a mutation test over it.

A mutant is one place of one source changed: a comparison flipped or made to include or exclude its
end, an arithmetic sign swapped, && and || swapped, a negation dropped, min for max. It is killed if
it does not compile or if a test fails; one that lives shows what no test looks at. A comment
`equivalent:` behind a line, or on the line before it, says why no change of it can be seen; such
lines are left out. A comment `either bound:` says why it is all one whether the end of a range of
real numbers belongs to it: of such a line those changes alone are left out.

Test programs are built once, and so are the headers of libraries. Per mutant the changed source
alone is compiled, and the core is linked anew as a shared library: the examples run first, the
laws, which take longer, on what survives them.
"""
import argparse
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
CORE = ROOT / "services/safety_svc/core"
WORK = ROOT / "build/safety_proof"
SUPPORT = ROOT / "tests/safety_svc/support/driven_world.cpp"
LAWS = ROOT / "tests/safety_svc/core/safety_law_test.cpp"
EXAMPLES = [ROOT / f"tests/safety_svc/core/{stem}_test.cpp"
            for stem in ("knowing", "ground", "world", "asking", "driving", "stopping")]
FLAGS = ["-std=c++20", "-fPIC", "-ffp-contract=off", "-I", str(ROOT),
         "-isystem", "/usr/include/eigen3"]
GTEST = ["-lgtest", "-lgtest_main", "-lpthread"]
PATIENCE_S = 60
LIBRARY_HEADERS = ("Eigen/Geometry", "algorithm", "array", "chrono", "cmath", "optional", "vector")
BOUNDS = [(r" < ", " <= "), (r" <= ", " < "), (r" > ", " >= "), (r" >= ", " > ")]
CHANGES = [
    (r" < ", " > "), (r" > ", " < "), (r" <= ", " > "), (r" >= ", " < "),
    (r" == ", " != "), (r" != ", " == "), (r" && ", " || "), (r" \|\| ", " && "),
    (r" \+ ", " - "), (r" - ", " + "), (r" \* ", " / "), (r" / ", " * "),
    (r"(?<=[( ])!(?=[\w(])", ""), (r"std::min\(", "std::max("), (r"std::max\(", "std::min("),
]


def run(command, **more):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True,
                          check=False, **more)


def must(command):
    done = run(command)
    if done.returncode != 0:
        sys.exit(done.stdout + done.stderr)


def compiled(source, folder, extra):
    target = folder / (source.stem + ".o")
    must(["ccache", "g++", *FLAGS, *extra, "-c", source, "-o", target])
    return target


def built_together(sources, folder, extra, jobs):
    folder.mkdir(parents=True, exist_ok=True)
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        return list(pool.map(lambda source: compiled(source, folder, extra), sources))


def core_sources():
    return sorted(CORE.glob("*.cpp"))


# ---- coverage

def coverage(jobs):
    """Examples alone must reach every line and branch: laws would by chance. True if they do."""
    folder = WORK / "coverage"
    for old in folder.glob("*.gcda"):
        old.unlink()
    core = built_together(core_sources(), folder, ["--coverage", "-O0"], jobs)
    tests = built_together([SUPPORT, *EXAMPLES], folder, ["--coverage", "-O0"], jobs)
    must(["g++", *core, *tests, "--coverage", *GTEST, "-o", folder / "tests"])
    must([folder / "tests", "--gtest_brief=1"])
    report = ["gcovr", "--root", ROOT, "--filter", "services/safety_svc/core/",
              "--exclude-throw-branches", "--exclude-unreachable-branches", folder]
    print(run([*report]).stdout)
    print(run([*report, "--branches"]).stdout)
    complete = run([*report, "--fail-under-line", "100", "--fail-under-branch", "100"])
    return complete.returncode == 0


# ---- mutants

def mutants_of(text):
    """(line number, from, to, changed text) of every mutant."""
    lines = text.split("\n")
    for number, line in enumerate(lines):
        code = line.split("//")[0]
        before = lines[number - 1] if number > 0 else ""
        def says(word, line=line, before=before):
            return f"// {word}:" in line or before.lstrip().startswith(f"// {word}:")

        if says("equivalent") or code.lstrip().startswith("#") or "static_assert" in code:
            continue
        for pattern, becomes in CHANGES if says("either bound") else BOUNDS + CHANGES:
            for found in re.finditer(pattern, code):
                changed = line[:found.start()] + becomes + line[found.end():]
                yield (number + 1, line.strip(), changed.strip(),
                       "\n".join(lines[:number] + [changed] + lines[number + 1:]))


class Bench:
    """The test programs, and one place to try a mutant in for each worker."""

    def __init__(self, jobs):
        self.objects = built_together(core_sources(), WORK / "core", ["-O1"], jobs)
        self.headers = WORK / "core/library_headers.h"
        self.headers.write_text("".join(f"#include <{name}>\n" for name in LIBRARY_HEADERS))
        must(["g++", *FLAGS, "-O1", "-x", "c++-header", self.headers, "-o",
              f"{self.headers}.gch"])
        tests = built_together([SUPPORT, *EXAMPLES, LAWS], WORK / "tests", ["-O1"], jobs)
        self.link(self.objects, WORK / "core")
        self.programs = [WORK / "examples", WORK / "laws"]
        core = ["-L", WORK / "core", "-lsafety_core_under_test", *GTEST]
        must(["g++", *tests[:-1], *core, "-o", self.programs[0]])
        must(["g++", tests[0], tests[-1], *core, "-lrapidcheck", "-o", self.programs[1]])

    @staticmethod
    def link(objects, folder):
        return run(["g++", "-shared", *objects, "-o",
                    folder / "libsafety_core_under_test.so"]).returncode == 0

    def passes(self, folder):
        """Which program fails with the core in `folder`; None if both pass."""
        environment = {**os.environ, "LD_LIBRARY_PATH": str(folder),
                       "RC_PARAMS": "seed=2012 max_success=20"}
        for program in self.programs:
            try:
                done = run([program, "--gtest_fail_fast", "--gtest_brief=1"], env=environment,
                           timeout=PATIENCE_S)
            except subprocess.TimeoutExpired:
                return f"{program.name} for ever"
            if done.returncode != 0:
                return program.name
        return None

    def fate(self, source, text, folder):
        """What killed the mutant; None if it lives."""
        folder.mkdir(parents=True, exist_ok=True)
        changed = folder / source.name
        changed.write_text(text)
        target = folder / "changed.o"
        if run(["g++", *FLAGS, "-O1", "-include", self.headers, "-c", changed, "-o",
                target]).returncode != 0:
            return "the compiler"
        others = [o for o in self.objects if o.stem != source.stem]
        return self.passes(folder) if self.link([*others, target], folder) else "the linker"


def mutants(names, jobs):
    """True if every mutant is killed."""
    bench = Bench(jobs)
    if bench.passes(WORK / "core") is not None:
        sys.exit("the tests do not pass as they are")
    work = [(source, *mutant) for source in core_sources() if not names or source.stem in names
            for mutant in mutants_of(source.read_text())]
    places = {}

    def tried(item):
        index, (source, number, before, after, text) = item
        fate = bench.fate(source, text, WORK / "mutants" / str(index))
        if fate is None:
            print(f"lives: {source.name}:{number}: {before}  ->  {after}", flush=True)
        return source.stem, fate

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for stem, fate in pool.map(tried, enumerate(work)):
            places.setdefault(stem, []).append(fate)
    print_table(places)
    return not any(fate is None for fates in places.values() for fate in fates)


def print_table(places):
    columns = ["the compiler", "examples", "laws"]
    print(f"{'source':<18}{'mutants':>8}{'killed':>8}" + "".join(f"{c:>14}" for c in columns)
          + f"{'live':>6}")
    rows = {**places, "all": [fate for fates in places.values() for fate in fates]}
    for stem, fates in rows.items():
        live = sum(fate is None for fate in fates)
        by = "".join(f"{sum(f is not None and f.startswith(c) for f in fates):>14}" for c in columns)
        print(f"{stem:<18}{len(fates):>8}{len(fates) - live:>8}{by}{live:>6}")


def main():
    parser = argparse.ArgumentParser(prog="scripts/safety_proof", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", nargs="?", choices=["all", "coverage", "mutants"], default="all")
    parser.add_argument("sources", nargs="*", help="of the core, without .cpp; none: all")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    good = True
    if options.what in ("all", "coverage"):
        good = coverage(options.jobs) and good
    if options.what in ("all", "mutants"):
        good = mutants(options.sources, options.jobs) and good
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
