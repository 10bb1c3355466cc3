"""Whether each service alone, given what it heard in a drive, says again what it said then."""
import pathlib
import subprocess
import tempfile

from demo_parts.log_events import contents

ANSWERS = {"landmark_svc": "LANDMARKS", "segment_svc": "SEGMENTS", "ekf_svc": "POSE",
           "pilot_svc": "VEL_REQUEST"}


def same_ratio(bin_folder, log, service):
    """Share of its live messages that are in its replay, byte for byte but for their numbers."""
    with tempfile.TemporaryDirectory() as folder:
        again = pathlib.Path(folder) / "again.lcmlog"
        subprocess.run([bin_folder / service, "--replay", log, "--record", again,
                        "--outputs-only"], check=True, capture_output=True)
        live, replayed = contents(log, ANSWERS[service]), set(contents(again, ANSWERS[service]))
    return sum(message in replayed for message in live) / max(len(live), 1)
