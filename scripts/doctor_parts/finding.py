"""What one check has found."""
import dataclasses


@dataclasses.dataclass(frozen=True)
class Finding:
    name: str
    verdict: str  # "ok", "none" (nothing there to judge) or "FAULT"
    says: str
    mend: str = ""  # a command


def fine(name, says):
    return Finding(name, "ok", says)


def nothing(name, says):
    return Finding(name, "none", says)


def fault(name, says, mend):
    return Finding(name, "FAULT", says, mend)
