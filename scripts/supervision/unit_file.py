"""A systemd unit for a robot that boots into its services."""
import getpass
import shlex

from supervision.services import ROOT

UNIT = """\
[Unit]
Description=Roomwise robot services
After=network.target
StartLimitIntervalSec=0

[Service]
User={user}
ExecStart={command}
# The script stops the wheels first; the others get what is left of the time.
KillMode=mixed
TimeoutStopSec=15
Restart=always
RestartSec=2

[Install]
WantedBy=multi-user.target
"""


def unit(mode, options):
    if mode == "replay":
        raise ValueError("--print-unit is for --robot or --sim")
    words = [str(ROOT / "scripts/start")]
    words += ["--robot"] if mode == "robot" else ["--sim", options.sim]
    for name in ("only", "without"):
        if getattr(options, name):
            words += [f"--{name}", ",".join(getattr(options, name))]
    for name in ("url", "run_dir", "key"):
        if getattr(options, name):
            words += [f"--{name.replace('_', '-')}", str(getattr(options, name))]
    command = shlex.join(words).replace("%", "%%")
    return UNIT.format(user=getpass.getuser(), command=command)
