"""What the kernel says of a running process."""
import dataclasses
import os
import pathlib


@dataclasses.dataclass(frozen=True)
class Sample:
    at_s: float
    memory_bytes: int  # resident
    files: int         # open descriptors
    threads: int


def sample(pid, at_s):
    """None if the process is gone."""
    folder = pathlib.Path(f"/proc/{pid}")
    try:
        fields = dict(line.split(":", 1) for line in (folder / "status").read_text().splitlines())
        return Sample(at_s, 1024 * int(fields["VmRSS"].split()[0]), len(os.listdir(folder / "fd")),
                      int(fields["Threads"]))
    except (FileNotFoundError, ProcessLookupError, KeyError):  # a zombie has no memory
        return None
