"""Talks to the supervisor of a run over its socket."""
import http.client
import socket
import xmlrpc.client

from supervision.configuration import GROUP


class Connection(http.client.HTTPConnection):
    def connect(self):
        self.sock = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self.sock.settimeout(self.timeout)
        try:
            self.sock.connect(self.host)
        except OSError:
            self.close()
            raise


class Transport(xmlrpc.client.Transport):
    def __init__(self, path):
        super().__init__()
        self._path = path

    def make_connection(self, host):
        if not self._connection[1]:
            self._connection = host, Connection(self._path, timeout=10)
        return self._connection[1]


class Control:
    """Raises OSError where no supervisor listens, xmlrpc.client.Fault where it refuses."""

    def __init__(self, folder):
        self._path = str(folder.socket)

    def _ask(self, method, *arguments):
        with xmlrpc.client.ServerProxy("http://localhost", Transport(self._path)) as proxy:
            return getattr(proxy.supervisor, method)(*arguments)

    def processes(self):
        return sorted(self._ask("getAllProcessInfo"), key=lambda p: p["start"])

    def start(self, name):
        self._ask("startProcess", f"{GROUP}:{name}", False)

    def stop(self, name):
        """Returns when it has ended."""
        self._ask("stopProcess", f"{GROUP}:{name}", True)
