#!/usr/bin/env python3
"""The page's decoders, bundled as the page has them, against the bytes of the programs.

usage: decoders_test.py FOLDER DEPTH_IMAGES     FOLDER keeps what npm fetched; DEPTH_IMAGES writes images
"""
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
    lock = (PAGE / "package-lock.json").read_bytes()
    stamp = build / "installed-lock.json"
    if not stamp.is_file() or stamp.read_bytes() != lock:
        for name in ("package.json", "package-lock.json", ".npmrc"):
            shutil.copyfile(PAGE / name, build / name)
        subprocess.run(["npm", "ci", "--silent"], cwd=build, check=True)
        stamp.write_bytes(lock)
    return build / "node_modules" / ".bin" / "esbuild"


def bundled(build, module):
    sources = build / "src"
    shutil.copytree(PAGE / "src", sources, dirs_exist_ok=True)
    types = sorted((ROOT / "lcmtypes").glob("*.lcm"))
    subprocess.run([PAGE / "generate_messages", sources / "messages.ts", *types], check=True)
    bundle = build / f"{module}.mjs"
    subprocess.run([installed(build), sources / f"{module}.ts", "--bundle", "--format=esm",
                    "--log-level=warning", f"--outfile={bundle}"], check=True)
    return bundle


def main(build, depth_images):
    for program in ("node", "npm"):
        if not shutil.which(program):
            print(f"skipped: no {program}; scripts/setup installs it")
            return SKIPPED
    images = build / "depth_images"
    build.mkdir(parents=True, exist_ok=True)
    images.write_bytes(subprocess.run([depth_images], check=True, capture_output=True).stdout)
    environment = dict(os.environ, ROOMWISE_MESSAGES=str(bundled(build, "messages")),
                       ROOMWISE_FRAMES=str(bundled(build, "frames")),
                       ROOMWISE_PDZ16=str(bundled(build, "pdz16")), ROOMWISE_DEPTH_IMAGES=str(images))
    tests = [HERE / f"{name}_test.mjs" for name in ("messages", "depth_images", "frame_depths")]
    return subprocess.run(["node", "--test", *tests], env=environment).returncode


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()))
