"""Plays a log to replayed services."""
import re

from supervision.services import COMMANDS, ROOT

NAME = "player"
ROW = re.compile(r'Channel<\w+>\s+\w+\s*\{"([^"]*)",\s*"[^"]*",\s*"([^"]*)"')
WARM_UP_s = 1.0  # services must listen before the first message


def channels():
    """(channel, its publisher) of common/channels.h."""
    return ROW.findall((ROOT / "common/channels.h").read_text())


def played_channels(replayed):
    """Every channel but commands and what the `replayed` services publish anew."""
    return [name for name, publisher in channels()
            if name not in COMMANDS and publisher not in replayed and name not in ("HEALTH", "PARAMS")]


def job(log, speed, replayed):
    if not log.is_file():
        raise ValueError(f"there is no log {log}")
    if not speed > 0:
        raise ValueError("--speed must be greater than 0")
    play = ["lcm-logplayer", f"--speed={speed:g}", "-e",
            f"^({'|'.join(played_channels(replayed))})$", str(log.resolve())]
    return (NAME, ["sh", "-c", f'sleep {WARM_UP_s:g}; exec "$@"', NAME, *play], [], False)
