"""clang-tidy over our .cpp files but the tests', with the list in .clang-tidy; needs a finished
release build. Tests are left out for time: gtest's macros cost it minutes.

A file is judged again only if its command, its text, a header it includes or the list changed:
what was clean is remembered by hash in build/release/tidy.
"""
import concurrent.futures
import functools
import hashlib
import json
import os
import pathlib
import re
import subprocess

BUILD = pathlib.Path("build", "release")
LISTS = r"(.*/)?\.clang-tidy"
SOURCES = r"(?!tests/).*\.cpp"
WARNING = re.compile(r"^(/\S+?):(\d+):\d+: (?:warning|error): (.*)$", flags=re.M)


def check(tree):
    build = tree.root / BUILD
    commands = {entry["file"]: entry for entry in
                json.loads((build / "compile_commands.json").read_text())}
    headers = dependencies(build)
    version = subprocess.run(["clang-tidy", "--version"], capture_output=True, text=True).stdout
    lists = version + "".join(tree.text(path) for path in tree.match(LISTS))
    remembered = build / "tidy"
    remembered.mkdir(exist_ok=True)

    def judge(path):
        entry = commands.get(str(tree.root / path))
        if entry is None:
            return [f"{path}:1: no target compiles this file"]
        key = remembered / digest(lists, entry, headers.get(object_of(entry), ()))
        if key.exists():
            return []
        found = complaints(tree.root, path)
        if not found:
            key.touch()
        return found

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return sorted({line for lines in pool.map(judge, tree.match(SOURCES)) for line in lines})


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


def digest(lists, entry, files):
    parts = [lists, entry["command"], file_hash(pathlib.Path(entry["file"]))]
    parts += [file_hash(path) for path in files]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def complaints(root, path):
    done = subprocess.run(["clang-tidy", "--quiet", "-p", BUILD, path], cwd=root,
                          capture_output=True, text=True)
    found = [f"{pathlib.Path(place).relative_to(root) if place.startswith(str(root)) else place}:"
             f"{line}: {what}" for place, line, what in WARNING.findall(done.stdout)]
    if done.returncode != 0 and not found:
        return [f"{path}:1: clang-tidy: {(done.stdout + done.stderr).strip()[-500:]}"]
    return found
