"""clang-tidy over our .cpp files but the tests', with the list in .clang-tidy; needs a finished
release build. Tests are left out for time: gtest's macros cost it minutes.

The files of a folder that are compiled alike are judged as one: most of the time goes into the
headers they share. So no two of them may give different things the same private name.

A group is judged again only if a command, a text, a header it includes or the list changed: what
was clean is remembered by hash in build/release/tidy.
"""
import collections
import concurrent.futures
import functools
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess

BUILD = pathlib.Path("build", "release")
LISTS = r"(.*/)?\.clang-tidy"
SOURCES = r"(?!tests/).*\.cpp"
WARNING = re.compile(r"^(/\S+?):(\d+):\d+: (?:warning|error): (.*)$", flags=re.M)


def check(tree):
    build = tree.root / BUILD
    commands = commands_of(tree.root, json.loads((build / "compile_commands.json").read_text()))
    headers = dependencies(build)
    version = subprocess.run(["clang-tidy", "--version"], capture_output=True, text=True).stdout
    lists = version + "".join(tree.text(path) for path in tree.match(LISTS))
    remembered = build / "tidy"
    remembered.mkdir(exist_ok=True)

    def judge(group):
        entries = [commands[str(tree.root / path)] for path in group]
        made_of = {file for entry in entries for file in headers.get(object_of(entry), ())}
        key = remembered / digest(lists, entries, made_of)
        if key.exists():
            return []
        found = complaints(tree.root, group, entries[0])
        if not found:
            key.touch()
        return found

    sources = tree.match(SOURCES)
    stray = [path for path in sources if str(tree.root / path) not in commands]
    groups = alike([path for path in sources if path not in stray], tree.root, commands)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = {line for lines in pool.map(judge, groups) for line in lines}
    return sorted(found | {f"{path}:1: no target compiles this file" for path in stray})


def commands_of(root, entries):
    """Source -> how it is compiled, alone or together with others."""
    found = {}
    for entry in entries:
        found[entry["file"]] = entry
        if re.search(r"_together_\d+\.cpp$", entry["file"]):
            included = re.findall(r'#include "(.*)"', pathlib.Path(entry["file"]).read_text())
            found |= {str(root / path): entry for path in included}
    return found


def alike(paths, root, commands):
    """Groups of files in one folder whose flags are the same, the largest first; each main alone."""
    groups = collections.defaultdict(list)
    for path in paths:
        group = (pathlib.Path(path).parent, flags_of(commands[str(root / path)]))
        groups[(*group, path if path.endswith("main.cpp") else "")].append(path)
    return sorted(groups.values(), key=len, reverse=True)


def flags_of(entry):
    """The compiler's arguments but the program (and ccache before it) and the files it names."""
    arguments = re.sub(r"\s-(c|o|MT|MF)\s+\S+", "", entry["command"])
    return arguments.split("c++ ", 1)[1].replace(" -MD", "")


def object_of(entry):
    return re.search(r"\s-o\s+(\S+)", entry["command"]).group(1)


def dependencies(build):
    """Object file -> the files it was made of, as the compiler told ninja."""
    listed = subprocess.run(["ninja", "-C", build, "-t", "deps"], check=True, capture_output=True,
                            text=True).stdout
    found = {}
    for block in listed.split("\n\n"):
        head, *rest = block.strip().split("\n")
        found[head.split(":")[0]] = [build / line.strip() for line in rest]
    return found


@functools.cache
def file_hash(path):
    return hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else ""


def digest(lists, entries, files):
    parts = [lists, *(entry["command"] for entry in entries)]
    parts += [file_hash(pathlib.Path(entry["file"])) for entry in entries]
    parts += [file_hash(path) for path in sorted(files)]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def complaints(root, group, entry):
    together = root / BUILD / "tidy" / (re.sub(r"\W", "_", group[0]) + "_and_others.cpp")
    together.write_text("".join(f'#include "{root / path}"\n' for path in group))
    done = subprocess.run(["clang-tidy", "--quiet", f"--header-filter=^{re.escape(str(root))}/",
                           "--checks=-bugprone-suspicious-include", together, "--",
                           *shlex.split(flags_of(entry))],
                          cwd=root / BUILD, capture_output=True, text=True)
    found = [f"{pathlib.Path(place).relative_to(root) if place.startswith(str(root)) else place}:"
             f"{line}: {what}" for place, line, what in WARNING.findall(done.stdout)]
    if done.returncode != 0 and not found:
        return [f"{group[0]}:1: clang-tidy: {(done.stdout + done.stderr).strip()[-500:]}"]
    return found
