"""The folder of one run: lock, socket and process id of its supervisor, logs of its services."""
import fcntl
import os
import pathlib
import zlib


def default_run_folder():
    return pathlib.Path(os.environ.get("ROOMWISE_RUN_DIR", f"/tmp/roomwise-{os.getuid()}/run"))


class RunFolder:
    def __init__(self, path):
        self.path = pathlib.Path(path).absolute()
        self.socket = self.path / "supervisor.sock"
        self.supervisor_pid = self.path / "supervisord.pid"
        self.configuration = self.path / "supervisord.conf"
        self.logs = self.path / "logs"
        self.create_port = self.path / "create"
        self._pid = self.path / "start.pid"
        self._lock = None

    def take(self):
        """Makes the folder and holds it until this process ends; False if another run does.

        Raises PermissionError if it is somebody else's: what stands in it is started.
        """
        self.path.mkdir(parents=True, exist_ok=True, mode=0o700)
        if self.path.stat().st_uid != os.getuid():
            raise PermissionError(f"{self.path} belongs to somebody else; take --run-dir DIR")
        self.path.chmod(0o700)
        self.logs.mkdir(exist_ok=True)
        self._lock = open(self._pid, "a+", encoding="ascii")
        try:
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        self._lock.truncate(0)
        self._lock.write(f"{os.getpid()}\n")
        self._lock.flush()
        return True

    def holder(self):
        """Process id of the scripts/start that holds the folder; None if nobody does."""
        try:
            with open(self._pid, encoding="ascii") as file:
                fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
            return None
        except FileNotFoundError:
            return None
        except BlockingIOError:
            return int(self._pid.read_text() or 0) or None

    def kinect_door(self):
        """Where simulated frames go: shared memory, whatever disk this folder is on."""
        name = f"kinect-{zlib.crc32(str(self.path).encode()):08x}"
        return pathlib.Path(f"/dev/shm/roomwise-{os.getuid()}") / name

    def log(self, service):
        return self.logs / f"{service}.log"
