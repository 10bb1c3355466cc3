"""What the viewer must refuse, by raw bytes on its socket: other hosts and origins, wrong tokens,
paths that lead out, WebSocket frames no page sends. Nothing of it may reach the bus."""
import base64
import os
import pathlib
import re
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scripts"))
import private_network  # noqa: E402: found by the line above

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = pathlib.Path(os.environ.get("ROOMWISE_PROGRAMS", ROOT / "build/release/bin"))
URL = "udpm://239.255.76.67:27691?ttl=0"
PORT = 8091
OWN = f"127.0.0.1:{PORT}"
PATIENCE_s = 20.0
COMMANDS = {"VEL_REQUEST", "ESTOP", "SAFETY_RESET", "PILOT_GOAL", "SEGMENT_TRAIN", "VEL_CMD"}


def exchange(text, wait_s=2.0):
    """Sends bytes, and returns what came back until the server closed or the time was up."""
    answer, end = b"", time.monotonic() + wait_s
    with socket.create_connection(("127.0.0.1", PORT), timeout=PATIENCE_s) as connection:
        connection.sendall(text if isinstance(text, bytes) else text.encode())
        try:
            while (left_s := end - time.monotonic()) > 0:
                connection.settimeout(left_s)
                piece = connection.recv(65536)
                if not piece:
                    break
                answer += piece
        except (TimeoutError, ConnectionResetError):
            pass
        return answer


def get(path, host=OWN):
    return exchange(f"GET {path} HTTP/1.1\r\nHost: {host}\r\n\r\n")


def handshake(origin=f"http://{OWN}", host=OWN, token=""):
    key = base64.b64encode(os.urandom(16)).decode()
    return (f"GET /bus?token={token} HTTP/1.1\r\nHost: {host}\r\nUpgrade: websocket\r\n"
            f"Connection: Upgrade\r\nSec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n"
            f"Origin: {origin}\r\n\r\n").encode()


def frame(payload, opcode=2, final=True, size=None):
    """A masked WebSocket frame; `size` lies about its length."""
    size = len(payload) if size is None else size
    head = bytes([(0x80 if final else 0) | opcode])
    if size < 126:
        head += bytes([0x80 | size])
    elif size < 65536:
        head += bytes([0x80 | 126]) + struct.pack(">H", size)
    else:
        head += bytes([0x80 | 127]) + struct.pack(">Q", size)
    return head + bytes(4) + payload


class Refusal(unittest.TestCase):
    options = ()

    def setUp(self):
        if not (PROGRAMS / "viewer").exists():
            self.skipTest("viewer is not built")
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        (self.folder / "tokens").write_text("view look-but-do-not-touch\ncontrol steer-wherever-you-want\n")
        (self.folder / "tokens").chmod(0o600)
        self.log = self.folder / "bus.lcmlog"
        self.run_beside(["lcm-logger", "-q", f"--lcm-url={URL}", self.log])
        self.said = open(self.folder / "said", "w+")
        self.addCleanup(self.said.close)
        arguments = [option.format(folder=self.folder) for option in self.options]
        self.viewer = self.run_beside([PROGRAMS / "viewer", "--url", URL, "--listen",
                                       f"127.0.0.1:{PORT}", "--logs_path", self.folder, *arguments],
                                      stderr=self.said)
        self.until_it_answers()

    def run_beside(self, command, stderr=subprocess.DEVNULL):
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=stderr)

        def stop():
            process.send_signal(signal.SIGTERM)
            process.wait(timeout=PATIENCE_s)
        self.addCleanup(stop)
        return process

    def until_it_answers(self):
        end = time.monotonic() + PATIENCE_s
        while time.monotonic() < end:
            try:
                if get("/").startswith(b"HTTP/1.1 200"):
                    return
            except OSError:
                time.sleep(0.05)
        self.fail("viewer does not answer")

    def complaints(self):
        self.said.flush()
        return (self.folder / "said").read_text()

    def assert_refused(self, answer, complaint):
        """By an answer that says so, or by hanging up: what became of a WebSocket."""
        self.assertRegex(answer.split(b"\r\n")[0], rb"^$|^HTTP/1.1 (403|404|400)")
        self.assertIn(complaint, self.complaints())

    def channels(self):
        table = subprocess.run([PROGRAMS / "rwlog", "info", self.log], capture_output=True, text=True)
        return set(re.findall(r"^([A-Z_]+) ", table.stdout, re.MULTILINE))

    def assert_nothing_commanded(self):
        self.assertEqual(self.viewer.poll(), None)
        self.assertTrue(get("/").startswith(b"HTTP/1.1 200"))
        end = time.monotonic() + PATIENCE_s
        while "HEALTH" not in self.channels():
            self.assertLess(time.monotonic(), end, "the bus heard nothing of the viewer")
            time.sleep(0.1)
        self.assertFalse(self.channels() & COMMANDS)


class FromThisMachine(Refusal):
    def test_another_host_is_refused(self):
        self.assert_refused(get("/", host="evil.example"), "a request for another host")
        self.assert_refused(exchange(handshake(host="evil.example")), "for another host")
        self.assert_nothing_commanded()

    def test_a_page_of_another_origin_gets_no_websocket(self):
        for origin in ("http://evil.example", "http://127.0.0.1:1", "null"):
            self.assert_refused(exchange(handshake(origin=origin)), "a WebSocket of a foreign origin")
        self.assert_nothing_commanded()

    def test_paths_lead_nowhere_but_to_the_page(self):
        for path in ("/../../../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/..%2f..%2fetc/passwd",
                     "//etc/passwd", "/main.js/../../said", "/tokens"):
            answer = get(path)
            self.assertNotIn(b"root:", answer)
            self.assertNotIn(b"steer-", answer)
            self.assertRegex(answer.split(b"\r\n")[0], rb"HTTP/1.1 (403|404|400)")

    def test_a_log_outside_its_folder_is_not_opened(self):
        answer = exchange(handshake() + frame(b"open ../../etc/passwd", opcode=1))
        self.assertIn(b"101 ", answer.split(b"\r\n")[0])
        self.assertNotIn(b"root:", answer)
        self.assertNotIn(b'"mode":"replay"', answer)
        self.assert_nothing_commanded()

    def test_frames_no_page_sends_end_the_connection(self):
        odd = {"frame in pieces": frame(b"\x06HEALTH", final=False),
               "order too long": frame(b"x" * 5000, opcode=1),
               "no message": frame(b"\x0bVEL_REQUEST" + os.urandom(40)),
               "empty": frame(b""),
               "not to be sent": frame(b"\x07VEL_CMD" + bytes(80)),
               "unknown kind": frame(b"abc", opcode=5),
               "longer than there is memory": frame(b"abc", size=1 << 62)}
        for name, bytes_sent in odd.items():
            with self.subTest(name):
                answer = exchange(handshake() + bytes_sent, wait_s=1.0)
                self.assertIn(b"101 ", answer.split(b"\r\n")[0])
        self.assert_nothing_commanded()

    def test_half_a_handshake_and_noise_do_no_harm(self):
        for noise in (handshake()[:40], os.urandom(4000), b"GET / HTTP/1.1\r\n" + b"X: y\r\n" * 5000):
            exchange(noise, wait_s=0.3)
        self.assert_nothing_commanded()


class WithTokens(Refusal):
    options = ("--tokens_path", "{folder}/tokens")

    def test_a_wrong_token_gets_no_websocket(self):
        for token in ("", "wrong", "look-but-do-not-touch%20", "steer-wherever-you-wan"):
            self.assert_refused(exchange(handshake(token=token)), "a wrong token")
        answer = exchange(handshake(token="look-but-do-not-touch"), wait_s=0.5)
        self.assertIn(b"101 ", answer.split(b"\r\n")[0])
        self.assert_nothing_commanded()

    def test_who_may_look_may_not_steer(self):
        answer = exchange(handshake(token="look-but-do-not-touch") + frame(b"\x05ESTOP" + bytes(60)), wait_s=1.0)
        self.assertIn(b"101 ", answer.split(b"\r\n")[0])
        self.assertIn("a command without the right to control", self.complaints())
        self.assert_nothing_commanded()


if __name__ == "__main__":
    private_network.enter()
    unittest.main()
