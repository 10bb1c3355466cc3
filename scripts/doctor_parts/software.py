"""Packages, Java, programs, clock and disk."""
import re

from doctor_parts.finding import fault, fine

JAVA_LEAST = 17
JARS = ("lcm", "jchart2d", "jide-oss", "xmlgraphics-commons")
FREE_LEAST_bytes = 2 * 10**9
PROGRAMS = ("kinect_pub", "landmark_svc", "segment_svc", "ekf_svc", "create_driver", "safety_svc",
            "pilot_svc", "viewer", "simulator", "rwlog")


def packages(machine):
    name = "packages"
    missing = machine.output_of(str(machine.tree / "scripts/setup"), "--missing")
    if missing is None:
        return fault(name, "scripts/setup --missing failed: is this Debian?", "scripts/setup")
    if missing.strip():
        return fault(name, f"not installed: {missing.strip()}", "scripts/setup")
    return fine(name, "all installed")


def java(machine):
    name = "Java"
    found = re.search(r'version "(\d+)', machine.output_of("java", "-version") or "")
    if not found or int(found.group(1)) < JAVA_LEAST:
        has = f"version {found.group(1)}" if found else "none"
        return fault(name, f"{has}; scripts/spy needs {JAVA_LEAST}",
                     "sudo apt-get install openjdk-17-jdk")
    missing = [jar for jar in JARS if not machine.exists(f"/usr/share/java/{jar}.jar")]
    if missing:
        return fault(name, f"scripts/spy lacks {', '.join(missing)}.jar",
                     "sudo apt-get install liblcm-java libjchart2d-java")
    return fine(name, f"version {found.group(1)}, with lcm-spy's jars")


def programs(machine):
    name = "programs"
    folder = machine.tree / "build/release/bin"
    missing = [program for program in PROGRAMS if not (folder / program).exists()]
    if missing:
        return fault(name, f"not built: {', '.join(missing)}", "scripts/build")
    return fine(name, f"all built in {folder}")


def clock(machine):
    """Messages carry wall-clock times: a clock that is off spoils logs of several machines."""
    name = "clock"
    mend = "sudo timedatectl set-ntp true"
    if machine.now() < (machine.tree / "README.md").stat().st_mtime - 86400:
        return fault(name, "it is behind the files of this tree", mend)
    says = machine.output_of("timedatectl", "show", "-p", "NTPSynchronized", "--value")
    if says is not None and says.strip() == "no":
        return fault(name, "it is not set by the network", mend)
    return fine(name, "set by the network" if says else "later than this tree's files")


def disk(machine):
    name = "disk"
    logs = machine.tree / "logs"
    free = machine.free_bytes(logs)
    if free < FREE_LEAST_bytes:
        return fault(name, f"{free / 1e9:.1f} GB free for logs; scripts/record wants 2",
                     f"ls -lhS {logs}/*.lcmlog*  # and remove what you can spare")
    return fine(name, f"{free / 1e9:.1f} GB free for logs")
