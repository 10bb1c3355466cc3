"""Messages of a log as rwlog tells them."""
import csv
import io

from recordings.programs import run_quietly


def rows_of(bin_folder, log, channel, *options):
    """The messages of a channel, {column: text} each."""
    text = run_quietly(bin_folder / "rwlog", "csv", log, channel, *options)
    return csv.DictReader(io.StringIO(text))


def landmarks_of_frame(bin_folder, log, frame):
    """The LANDMARKS message of one frame, {column: text}."""
    return next(row for row in rows_of(bin_folder, log, "LANDMARKS")
                if int(row["frame_seq"]) == frame + 1)
