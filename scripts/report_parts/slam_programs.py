"""Tables that slam_experiment (tests/ekf_svc/experiment) prints, as results."""
import dataclasses
import re
import subprocess

from report_parts.results import Bar, Result, Table


@dataclasses.dataclass
class Experiment:
    """One table of the program, and what it promises: it ends well if the promise holds."""

    name: str
    runs: int
    caption: str
    columns: list
    promise: str
    note_with: str = ""  # the first printed line that holds this goes below the table
    timing: bool = False


def rows_of(text, width):
    """Lines of a name, two blanks or more, and width - 1 figures."""
    rows = []
    for line in text.splitlines():
        name, _, rest = line.partition("  ")
        figures = rest.replace(" %", "").split()
        if len(figures) == width - 1 and all(re.match(r"-?[\d.]", each) for each in figures):
            rows.append([name, *figures])
    return rows


def measured(bin_folder, experiment):
    done = subprocess.run([bin_folder / "slam_experiment", experiment.name, str(experiment.runs)],
                          check=False, capture_output=True, text=True)
    rows = rows_of(done.stdout, len(experiment.columns))
    if not rows:
        raise RuntimeError(f"slam_experiment {experiment.name} printed no table: {done.stderr}")
    notes = [line for line in done.stdout.splitlines()
             if experiment.note_with and experiment.note_with in line]
    held = done.returncode == 0
    table = Table(experiment.caption, experiment.columns, rows, note=" ".join(notes[:1]),
                  timing=experiment.timing)
    return Result([table], [Bar(experiment.promise, "yes" if held else "no", held)])
