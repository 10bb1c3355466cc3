"""Real Create robots of UTIAS MRCLAM (Leung et al., IJRR 2011) set 7: ekf_svc with one parameter
set, the same with the logged speeds believed, the best batch estimate, and MRPT's kf-slam on the
same log (the better of four settings by trajectory) where it is installed (scripts/setup --peers).

Errors are taken where landmarks were just seen: MRPT tells no pose in between.
"""
import pathlib
import subprocess
import tempfile

from recordings import mrclam
from recordings.programs import run_quietly
from report_parts.results import Bar, Result, Table, at_most, left_out

TITLE = "SLAM: MRCLAM set 7, one parameter set"
TARGETS = ["ekf_svc", "rwlog"]
OPTIONAL_TARGETS = ["mrpt_slam"]
WHAT = ("ate_aligned_at_sightings_m", "heading_rmse_at_sightings_rad", "map_aligned_m",
        "ate_aligned_m", "heading_rmse_rad")
MRPT_SETTINGS = [("0.1", "0.03"), ("0.1", "0.06"), ("0.2", "0.03"), ("0.2", "0.06")]
HINDSIGHT_RATIO_MAX = 1.6


def score(rwlog, log):
    out = subprocess.run([rwlog, "score", log], check=True, capture_output=True, text=True).stdout
    values = dict(line.split()[:2] for line in out.splitlines() if len(line.split()) >= 2)
    return [float(values.get(what, "nan")) for what in WHAT]


def best_of_mrpt(bin_folder, log, out):
    """Scores of MRPT with the settings that bring the best trajectory."""
    scores = []
    for range_m, bearing_rad in MRPT_SETTINGS:
        run_quietly(bin_folder / "mrpt_slam", "--replay", log, "--record", out,
                           "--range_sigma_m", range_m, "--bearing_sigma_rad", bearing_rad)
        scores.append(score(bin_folder / "rwlog", out))
    return min(scores)


def rows_of(bin_folder, folder, data, robot, identities):
    log, out, best, believing = (pathlib.Path(folder) / name
                                 for name in ("run", "out", "best", "believing"))
    mrclam.mapped_run(bin_folder, data, robot, log, out, identities == "unknown")
    rows = {"ekf_svc": score(bin_folder / "rwlog", out)}
    run_quietly(bin_folder / "ekf_svc", "--replay", log, "--record", believing,
                "--self_calibration", "false")
    rows["ekf_svc, speeds believed"] = score(bin_folder / "rwlog", believing)
    if identities == "known":
        run_quietly(bin_folder / "rwlog", "smooth", out, "-o", best)
        rows["in hindsight"] = score(bin_folder / "rwlog", best)
    if (bin_folder / "mrpt_slam").exists():
        rows["MRPT"] = best_of_mrpt(bin_folder, log, out)
    return rows


def bars_of(where, rows):
    bars = []
    path_m = rows["ekf_svc"][0]
    believed_m = rows["ekf_svc, speeds believed"][0]
    bars.append(Bar(f"{where}: path better than with the speeds believed",
                    f"{path_m:.3f} against {believed_m:.3f} m", path_m < believed_m))
    if "MRPT" in rows:
        bars.append(Bar(f"{where}: path better than MRPT's", f"{path_m:.3f} against"
                        f" {rows['MRPT'][0]:.3f} m", path_m < rows["MRPT"][0]))
    if "in hindsight" in rows:
        bars.append(at_most(f"{where}: path / path in hindsight", path_m / rows["in hindsight"][0],
                            HINDSIGHT_RATIO_MAX, 2))
    return bars


def run(bin_folder):
    data = mrclam.folder()
    if data is None:
        return left_out(mrclam.MISSING)
    table = Table("Errors after the best alignment, RMS, where landmarks were just seen, and of all"
                  " poses", ["robot", "identities", "estimate", "path m", "heading rad", "map m",
                             "path m, all", "heading rad, all"], [])
    bars = []
    with tempfile.TemporaryDirectory() as folder:
        for robot in mrclam.ROBOTS:
            for identities in ("known", "unknown"):
                rows = rows_of(bin_folder, folder, data, robot, identities)
                table.rows += [[str(robot), identities, what, *values]
                               for what, values in rows.items()]
                bars += bars_of(f"robot {robot}, identities {identities}", rows)
    missing = "" if (bin_folder / "mrpt_slam").exists() else "MRPT is not installed here"
    return Result([table], bars, missing)
