"""Coverage of services/safety_svc/core by its tests, and a mutation test over it.

A mutant is one place of one source changed: a comparison flipped or made to include or exclude its
end, + and - swapped, && and || swapped, a negation dropped. It is killed if it does not compile or
if a test fails; one that lives shows what no test looks at. `// equivalent:` behind a line says why
no change of it can be seen; such lines are left out.
"""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
CORE = ROOT / "services/safety_svc/core"
WORK = ROOT / "build/safety_proof"
SUPPORT = [ROOT / "tests/safety_svc/support/driven_world.cpp"]
TESTS = sorted((ROOT / "tests/safety_svc/core").glob("*_test.cpp"))
TESTS = [test for test in TESTS if test.stem != "allocation_test"]  # replaces operator new
FLAGS = ["-std=c++20", "-I", str(ROOT), "-isystem", "/usr/include/eigen3"]
LIBRARIES = ["-lrapidcheck", "-lgtest", "-lgtest_main", "-lpthread"]
CHANGES = [
    (r" < ", " <= "), (r" <= ", " < "), (r" > ", " >= "), (r" >= ", " > "),
    (r" < ", " > "), (r" > ", " < "), (r" <= ", " > "), (r" >= ", " < "),
    (r" == ", " != "), (r" != ", " == "), (r" && ", " || "), (r" \|\| ", " && "),
    (r" \+ ", " - "), (r" - ", " + "), (r" \* ", " / "), (r" / ", " * "),
    (r"(?<=[( ])!(?=[\w(])", ""), (r"std::min\(", "std::max("), (r"std::max\(", "std::min("),
]


def compile_to(source, target, extra):
    command = ["ccache", "g++", *FLAGS, *extra, "-c", str(source), "-o", str(target)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def build(folder, extra):
    folder.mkdir(parents=True, exist_ok=True)
    objects = []
    for source in [*sorted(CORE.glob("*.cpp")), *SUPPORT, *TESTS]:
        target = folder / (source.stem + ".o")
        done = compile_to(source, target, extra)
        if done.returncode != 0:
            sys.exit(done.stderr)
        objects.append(target)
    return objects


def link(objects, program, extra):
    command = ["g++", *map(str, objects), *extra, *LIBRARIES, "-o", str(program)]
    return subprocess.run(command, capture_output=True, text=True, check=False).returncode == 0


def passes(program):
    environment = {"RC_PARAMS": "seed=2012 max_success=30", "PATH": "/usr/bin:/bin"}
    try:
        run = subprocess.run([str(program), "--gtest_fail_fast"], capture_output=True,
                             env=environment, timeout=300, check=False)
    except subprocess.TimeoutExpired:
        return False
    return run.returncode == 0


def coverage():
    folder = WORK / "coverage"
    for old in folder.glob("*.gcda"):
        old.unlink()
    objects = build(folder, ["--coverage", "-O0"])
    if not link(objects, folder / "tests", ["--coverage"]) or not passes(folder / "tests"):
        sys.exit("the tests do not pass")
    subprocess.run(["gcovr", "--root", str(ROOT), "--filter", "services/safety_svc/core/",
                    "--exclude-throw-branches", "--exclude-unreachable-branches", "--branches",
                    str(folder)], check=True)
    subprocess.run(["gcovr", "--root", str(ROOT), "--filter", "services/safety_svc/core/",
                    "--exclude-throw-branches", "--exclude-unreachable-branches", str(folder)],
                   check=True)


def mutants_of(text):
    """(line number, from, to, changed text) of every mutant."""
    lines = text.split("\n")
    for number, line in enumerate(lines):
        code = line.split("//")[0]
        if "// equivalent:" in line or code.lstrip().startswith("#") or "static_assert" in code:
            continue
        for pattern, becomes in CHANGES:
            for found in re.finditer(pattern, code):
                changed = line[:found.start()] + becomes + line[found.end():]
                yield (number + 1, line.strip(), changed.strip(),
                       "\n".join(lines[:number] + [changed] + lines[number + 1:]))


def mutants(names):
    folder = WORK / "mutants"
    objects = build(folder, ["-O1"])
    if not link(objects, folder / "tests", []) or not passes(folder / "tests"):
        sys.exit("the tests do not pass as they are")
    killed, living = 0, []
    for source in sorted(CORE.glob("*.cpp")):
        if names and source.stem not in names:
            continue
        for number, before, after, text in mutants_of(source.read_text()):
            changed = folder / "changed.cpp"
            changed.write_text(text)
            target = folder / "changed.o"
            others = [o for o in objects if o.stem != source.stem]
            lives = (compile_to(changed, target, ["-O1"]).returncode == 0
                     and link([*others, target], folder / "changed", [])
                     and passes(folder / "changed"))
            if lives:
                living.append(f"{source.relative_to(ROOT)}:{number}: {before}  ->  {after}")
                print("lives:", living[-1], flush=True)
            else:
                killed += 1
    print(f"{killed} mutants killed, {len(living)} live")
    return 1 if living else 0


if __name__ == "__main__":
    what = sys.argv[1:2] or ["all"]
    if what[0] in ("all", "coverage"):
        coverage()
    if what[0] in ("all", "mutants"):
        sys.exit(mutants(sys.argv[2:]))
