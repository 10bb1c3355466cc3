"""Real Create robots of UTIAS MRCLAM (Leung et al., IJRR 2011) set 7, and the best batch estimate.

The folder is ROOMWISE_DATA/mrclam7, by default ../shared/data/mrclam7.
"""
import os
import pathlib
import subprocess
import tempfile

TITLE = "SLAM: MRCLAM set 7, one parameter set"
TARGETS = ["ekf_svc", "rwlog"]
ROBOTS = (2, 5)
WHAT = ("ate_aligned_m", "heading_rmse_rad", "map_aligned_m")


def score(rwlog, log):
    out = subprocess.run([rwlog, "score", log], check=True, capture_output=True, text=True).stdout
    values = dict(line.split()[:2] for line in out.splitlines() if len(line.split()) >= 2)
    return [float(values[what]) for what in WHAT]


def run(bin_folder):
    root = pathlib.Path(__file__).resolve().parents[2]
    shared = pathlib.Path(os.environ.get("ROOMWISE_DATA", root.parent / "shared" / "data"))
    if not (shared / "mrclam7").is_dir():
        print(f"skipped: no {shared / 'mrclam7'}")
        return True
    print(f"{'run':32} {'trajectory m':>13} {'heading rad':>12} {'map m':>8}")
    met = True
    with tempfile.TemporaryDirectory() as folder:
        run_log, out, best = (pathlib.Path(folder) / n for n in ("run", "out", "best"))
        for robot in ROBOTS:
            for identities in ("known", "unknown"):
                extra = ["--unknown-identities"] if identities == "unknown" else []
                quiet = {"check": True, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
                subprocess.run([bin_folder / "rwlog", "import", "mrclam", shared / "mrclam7",
                                "--robot", str(robot), "-o", run_log, *extra], **quiet)
                subprocess.run([bin_folder / "ekf_svc", "--replay", run_log, "--record", out],
                               **quiet)
                online = score(bin_folder / "rwlog", out)
                rows = [("online", online)]
                if identities == "known":
                    subprocess.run([bin_folder / "rwlog", "smooth", out, "-o", best], **quiet)
                    batch = score(bin_folder / "rwlog", best)
                    rows.append(("best in hindsight", batch))
                    met = met and online[0] <= 1.6 * batch[0]
                for what, values in rows:
                    print(f"robot {robot}, {identities} identities, {what:18}"[:44].ljust(44),
                          *(f"{value:8.3f}" for value in values))
    return met
