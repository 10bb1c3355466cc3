"""How long services took, from the log of what was said."""
import csv
import subprocess

from demo_parts.log_events import events

#: Answer: its question, which has the same stamp.
QUESTIONS = {"LANDMARKS": "KINECT_FRAME", "SEGMENTS": "KINECT_FRAME", "POSE": "ODOMETRY"}


def replayed(log, answer):
    """[(s, ms)]: when an answer was heard, and how long after its question. The first of each stamp."""
    asked, found = {}, []
    for event in events(log, (QUESTIONS[answer], answer)):
        if event.channel == answer:
            asked_us = asked.pop(event.utime, None)
            if asked_us is not None:
                found.append((1e-6 * event.heard_us, 1e-3 * (event.heard_us - asked_us)))
        else:
            asked[event.utime] = event.heard_us
    return found


def live(log, answer):
    """The same from the instant that the answer is about: stamps are of this machine's clock."""
    return [(1e-6 * event.heard_us, 1e-3 * (event.heard_us - event.utime))
            for event in events(log, (answer,))]


def handler_means_ms(rwlog, log):
    """{service: [(s, ms)]}: mean cost of a message between one HEALTH and the next."""
    out = subprocess.run([rwlog, "csv", log, "HEALTH"], check=True, capture_output=True, text=True)
    before, found = {}, {}
    for row in csv.DictReader(out.stdout.splitlines()):
        received = [int(count) for count in row["channels.received"].split(";") if count]
        means_s = [float(mean) for mean in row["channels.handler_mean_s"].split(";") if mean]
        count, total_s = sum(received), sum(n * s for n, s in zip(received, means_s))
        old_count, old_total_s = before.get(row["service"], (0, 0.0))
        if count > old_count:
            found.setdefault(row["service"], []).append(
                (1e-6 * int(row["utime"]), 1e3 * (total_s - old_total_s) / (count - old_count)))
        before[row["service"]] = count, total_s
    return found
