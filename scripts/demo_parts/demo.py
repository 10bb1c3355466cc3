"""A simulated robot wanders through a room by itself, live, and maps it: all services, real time.

Then it says how that went, by the simulator's truth. Exit status 0 only if every bar held. Log,
pictures, path and summary.json are in logs/demo-TIME/.
"""
import argparse
import datetime
import pathlib
import shutil
import subprocess
import sys
import webbrowser

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "scripts"
sys.path.insert(0, str(SCRIPTS))

from demo_parts import figures, summary  # noqa: E402: found by the line above
from demo_parts.running_system import RunningSystem, Trouble  # noqa: E402

BIN = ROOT / "build/release/bin"
PAGE = "http://127.0.0.1:8090/"


def parse():
    parser = argparse.ArgumentParser(description=__doc__, prog="scripts/demo",
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenario", default="living_room", metavar="NAME",
                        help="a room of services/simulator/scenarios (living_room)")
    parser.add_argument("--minutes", type=float, default=1.5, metavar="M", help="of driving (1.5)")
    parser.add_argument("--camera", default="320x240", metavar="WxH",
                        help="320x240; the simulator needs a core of its own for 640x480")
    parser.add_argument("--headless", action="store_true", help="open no browser")
    parser.add_argument("--stay", action="store_true", help="keep it running until Ctrl-C")
    parser.add_argument("--out", type=pathlib.Path, metavar="DIR", help="for log and pictures")
    parser.add_argument("--data", metavar="DIR",
                        help="with recordings of real cameras and robots too: scripts/demo_recordings")
    return parser.parse_args()


def main():
    options = parse()
    now = datetime.datetime.now().strftime("%Y%m%d-%H%M%S")
    out = options.out or ROOT / f"logs/demo-{now}"
    subprocess.run([SCRIPTS / "build"], check=True, stdout=sys.stderr)
    out.mkdir(parents=True, exist_ok=True)
    with RunningSystem(out, options.scenario, options.camera) as system:
        system.begin_wandering()
        print(f"{options.scenario}: it wanders and maps for {options.minutes:g} minutes; see {PAGE}",
              flush=True)
        if not options.headless and shutil.which("xdg-open"):
            webbrowser.open(PAGE)
        system.drive_for(60.0 * options.minutes)
        log = system.end_recording()
        held = tell(log, out, f"{options.scenario}, {options.minutes:g} minutes of wandering")
        if options.stay:
            system.stay()
    if options.data:
        subprocess.run([SCRIPTS / "demo_recordings", "--data", options.data, "--out", out / "recorded"],
                       check=True)
    return 0 if held else 1


def tell(log, out, title):
    found = figures.of_log(BIN, log)
    summary.write(found, out / "summary.json")
    print(summary.table(found))
    summary.draw(BIN / "rwlog", log, out, title)
    print(f"\nIn {out}:")
    for path in sorted(out.glob("*.*")):
        print(f"  {path.name}")
    return all(figure.held() for figure in found)


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Trouble as trouble:
        sys.exit(f"demo: {trouble}")
    except KeyboardInterrupt:
        sys.exit(130)
