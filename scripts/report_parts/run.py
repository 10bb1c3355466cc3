"""Runs experiments: those that return a Result, and those that print and return True or False."""
import contextlib
import importlib.util
import os
import subprocess
import sys
import threading
import traceback

from report_parts.printed_tables import blocks_of
from report_parts.results import Bar, Result


def load(path):
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@contextlib.contextmanager
def overheard(chunks):
    """What this process and its children print goes to stdout as ever, and into `chunks`."""
    sys.stdout.flush()
    out = os.dup(1)
    read, write = os.pipe()
    os.dup2(write, 1)
    os.close(write)

    def pass_on():
        while chunk := os.read(read, 65536):
            chunks.append(chunk)
            os.write(out, chunk)

    thread = threading.Thread(target=pass_on)
    thread.start()
    try:
        yield
    finally:
        sys.stdout.flush()
        os.dup2(out, 1)
        thread.join()
        os.close(out)
        os.close(read)


def run(module, bin_folder):
    """The module's Result, and whether it has printed itself already."""
    chunks = []
    try:
        with overheard(chunks):
            result = module.run(bin_folder)
    except Exception as error:  # the others shall be measured all the same
        traceback.print_exc()
        return Result(bars=[Bar("the experiment runs to its end", str(error), False)]), False
    if isinstance(result, Result):
        return result, False
    text = b"".join(chunks).decode("utf-8", "replace")
    bar = Bar("what the table promises", "as printed", bool(result))
    return Result(blocks_of(text), [bar]), True


def build(script, modules):
    """Builds what the modules need. What a peer's library is missing for is left out."""
    targets = sorted({target for module in modules for target in module.TARGETS})
    if targets:
        subprocess.run([script, "release", *targets], check=True, stdout=sys.stderr)
    for peer in sorted({p for module in modules for p in getattr(module, "OPTIONAL_TARGETS", [])}):
        subprocess.run([script, "release", peer], check=False, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)
