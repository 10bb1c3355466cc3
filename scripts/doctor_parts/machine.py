"""What the checks ask the machine; a test gives them another one."""
import os
import pathlib
import shutil
import subprocess
import time


class Machine:
    """`root` stands before /proc, /sys and /dev."""

    def __init__(self, tree, root="/"):
        self.tree = pathlib.Path(tree)
        self.root = pathlib.Path(root)

    def path(self, absolute):
        return self.root / absolute.lstrip("/")

    def read(self, absolute):
        """Its text without blanks around it; None if it cannot be read."""
        try:
            return self.path(absolute).read_text(errors="replace").strip()
        except OSError:
            return None

    def may_use(self, absolute):
        return os.access(self.path(absolute), os.R_OK | os.W_OK)

    def output_of(self, *words):
        """What a command prints, both ways; None if it is not there, fails or hangs."""
        try:
            ended = subprocess.run(words, text=True, stdout=subprocess.PIPE, timeout=20,
                                   stderr=subprocess.STDOUT)
        except (OSError, subprocess.TimeoutExpired):
            return None
        return ended.stdout if ended.returncode == 0 else None

    def exists(self, absolute):
        return self.path(absolute).exists()

    def free_bytes(self, folder):
        return shutil.disk_usage(folder).free

    def now(self):
        return time.time()
