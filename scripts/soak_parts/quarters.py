"""A run's last quarter against its first; those between show whether a growth comes to an end."""
import dataclasses
import statistics

MB = 1e6
GROWTH_MOST_bytes = 1.0 * MB
GROWTH_MOST_ratio = 0.02
SLOWER_MOST_ratio = 1.5


@dataclasses.dataclass(frozen=True)
class Row:
    what: str
    quarters: list  # of the run; empty if one of them has no values
    unit: str
    held: bool
    bar: str
    per_hour: float | None = None  #: slope after the first quarter


@dataclasses.dataclass(frozen=True)
class Run:
    """When it was; `speed`: seconds of the robot's life in a second of ours."""
    begin_s: float
    end_s: float
    speed: float = 1.0

    def quarters(self, timed):
        """The values of [(s, value)] in each quarter of the run; the ends take what is beyond."""
        found = [[], [], [], []]
        for at_s, value in timed:
            share = (at_s - self.begin_s) / (self.end_s - self.begin_s)
            found[min(max(int(4 * share), 0), 3)].append(value)
        return found

    def per_hour(self, timed):
        """Slope of the straight line through what came after the first quarter."""
        late = [(at_s, value) for at_s, value in timed
                if at_s >= self.begin_s + 0.25 * (self.end_s - self.begin_s)]
        if len({at_s for at_s, _ in late}) < 2:
            return None
        return 3600.0 / self.speed * statistics.linear_regression(*zip(*late)).slope


def compared(run, what, timed, unit, middle, bar, is_held):
    """Without values in every quarter there is nothing that could hold."""
    values = run.quarters(timed)
    if not all(values):
        return Row(what, [], unit, False, "is measured")
    found = [middle(quarter) for quarter in values]
    return Row(what, found, unit, is_held(found[0], found[-1]), bar)


def memory_row(run, service, samples):
    timed = [(s.at_s, s.memory_bytes / MB) for s in samples]
    row = compared(run, f"{service} memory", timed, "MB", statistics.median, "+1 MB or +2 %",
                   lambda a, b: b - a <= max(GROWTH_MOST_bytes / MB, GROWTH_MOST_ratio * a))
    return dataclasses.replace(row, per_hour=run.per_hour(timed))


def count_row(run, what, timed):
    return compared(run, what, timed, "", max, "no more", lambda a, b: b <= a)


def time_row(run, what, timed, middle):
    return compared(run, what, timed, "ms", middle, f"x {SLOWER_MOST_ratio:g}",
                    lambda a, b: b <= SLOWER_MOST_ratio * a)


def percentile_99(values):
    return sorted(values)[99 * len(values) // 100]


def rows(run, samples, restarts, handlers_ms, answers_ms):
    """`samples`, `restarts`, `handlers_ms` by service, `answers_ms` by channel."""
    found = []
    for service, seen in samples.items():
        found += [memory_row(run, service, seen),
                  count_row(run, f"{service} open files", [(s.at_s, s.files) for s in seen]),
                  count_row(run, f"{service} threads", [(s.at_s, s.threads) for s in seen]),
                  time_row(run, f"{service} handlers, mean", handlers_ms.get(service, []),
                           statistics.mean)]
        if restarts[service]:
            found.append(Row(f"{service} started again, {restarts[service]} times", [], "", False,
                             "never"))
    return found + [time_row(run, f"{channel} after its question, 99 %", timed, percentile_99)
                    for channel, timed in answers_ms.items()]


def shown(value, unit):
    return f"{value:d}" if not unit else f"{value:.2f}" if unit == "MB" else f"{value:.3f}"


def text(found):
    heading = "".join(f"{f'quarter {i}':>11}" for i in (1, 2, 3, 4))
    lines = [f"{'':36}{heading}      {'an hour':>7}  bar"]
    for row in found:
        cells = "".join(f"{shown(value, row.unit):>11}" for value in row.quarters)
        slope = "" if row.per_hour is None else f"{row.per_hour:+.2f}"
        lines.append(f"{row.what:36}{cells:44} {row.unit:3} {slope:>7}  {row.bar:14} "
                     f"{'held' if row.held else 'MISSED'}")
    return "\n".join(lines)
