#!/usr/bin/env python3
"""The page's generated decoders, bundled as the page has them, against the golden bytes."""
import os
import pathlib
import shutil
import subprocess
import sys

SKIPPED = 77
HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PAGE = ROOT / "services" / "viewer" / "page"


def installed(build):
    """esbuild as package-lock.json pins it, in the build folder; fetched once for each lock."""
    build.mkdir(parents=True, exist_ok=True)
    lock = (PAGE / "package-lock.json").read_bytes()
    stamp = build / "installed-lock.json"
    if not stamp.is_file() or stamp.read_bytes() != lock:
        for name in ("package.json", "package-lock.json", ".npmrc"):
            shutil.copyfile(PAGE / name, build / name)
        subprocess.run(["npm", "ci", "--silent"], cwd=build, check=True)
        stamp.write_bytes(lock)
    return build / "node_modules" / ".bin" / "esbuild"


def bundled(build):
    esbuild = installed(build)
    sources = build / "src"
    sources.mkdir(exist_ok=True)
    shutil.copyfile(PAGE / "src" / "wire.ts", sources / "wire.ts")
    types = sorted((ROOT / "lcmtypes").glob("*.lcm"))
    subprocess.run([PAGE / "generate_messages", sources / "messages.ts", *types], check=True)
    bundle = build / "messages.mjs"
    subprocess.run([esbuild, sources / "messages.ts", "--bundle", "--format=esm",
                    "--log-level=warning", f"--outfile={bundle}"], check=True)
    return bundle


def main(build):
    for program in ("node", "npm"):
        if not shutil.which(program):
            print(f"skipped: no {program}; scripts/setup installs it")
            return SKIPPED
    environment = dict(os.environ, ROOMWISE_MESSAGES=str(bundled(build)))
    return subprocess.run(["node", "--test", HERE / "messages_test.mjs"], env=environment).returncode


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
