"""What the viewer must refuse, by raw bytes on its socket: other hosts and origins, wrong tokens,
paths that lead out, WebSocket frames no page sends. Nothing of it may reach the bus."""
import os
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scripts"))
import private_network  # noqa: E402: found by the line above
from raw_page import frame
from running_viewer import PAGE, RunningViewer

COMMANDS = {"VEL_REQUEST", "ESTOP", "SAFETY_RESET", "PILOT_GOAL", "SEGMENT_TRAIN", "VEL_CMD"}



class Refusal(RunningViewer):
    def assert_refused(self, answer, complaint):
        """By an answer that says so, or by hanging up: what became of a WebSocket."""
        self.assertRegex(answer.split(b"\r\n")[0], rb"^$|^HTTP/1.1 (403|404|400)")
        self.assertIn(complaint, self.complaints())

    def assert_nothing_commanded(self):
        self.assertEqual(self.viewer.poll(), None)
        self.assertTrue(self.answers())
        self.until(lambda: "HEALTH" in self.messages(), "the bus heard nothing of the viewer")
        self.assertFalse(self.messages().keys() & COMMANDS)


class FromThisMachine(Refusal):
    def test_another_host_is_refused(self):
        self.assert_refused(PAGE.get("/", host="evil.example"), "a request for another host")
        self.assert_refused(PAGE.exchange(PAGE.handshake(host="evil.example")), "for another host")
        self.assert_nothing_commanded()

    def test_a_page_of_another_origin_gets_no_websocket(self):
        for origin in ("http://evil.example", "http://127.0.0.1:1", "null"):
            self.assert_refused(PAGE.exchange(PAGE.handshake(origin=origin)), "a WebSocket of a foreign origin")
        self.assert_nothing_commanded()

    def test_paths_lead_nowhere_but_to_the_page(self):
        for path in ("/../../../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/..%2f..%2fetc/passwd",
                     "//etc/passwd", "/main.js/../../said", "/tokens"):
            answer = PAGE.get(path)
            self.assertNotIn(b"root:", answer)
            self.assertNotIn(b"steer-", answer)
            self.assertRegex(answer.split(b"\r\n")[0], rb"HTTP/1.1 (403|404|400)")

    def test_a_log_outside_its_folder_is_not_opened(self):
        answer = PAGE.exchange(PAGE.handshake() + frame(b"open ../../etc/passwd", opcode=1))
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
                answer = PAGE.exchange(PAGE.handshake() + bytes_sent, wait_s=1.0)
                self.assertIn(b"101 ", answer.split(b"\r\n")[0])
        self.assert_nothing_commanded()

    def test_half_a_handshake_and_noise_do_no_harm(self):
        for noise in (PAGE.handshake()[:40], os.urandom(4000), b"GET / HTTP/1.1\r\n" + b"X: y\r\n" * 5000):
            PAGE.exchange(noise, wait_s=0.3)
        self.assert_nothing_commanded()


class WithTokens(Refusal):
    options = ("--tokens_path", "{folder}/tokens")

    def test_a_wrong_token_gets_no_websocket(self):
        for token in ("", "wrong", "look-but-do-not-touch%20", "steer-wherever-you-wan"):
            self.assert_refused(PAGE.exchange(PAGE.handshake(token=token)), "a wrong token")
        answer = PAGE.exchange(PAGE.handshake(token="look-but-do-not-touch"), wait_s=0.5)
        self.assertIn(b"101 ", answer.split(b"\r\n")[0])
        self.assert_nothing_commanded()

    def test_who_may_look_may_not_steer(self):
        answer = PAGE.exchange(PAGE.handshake(token="look-but-do-not-touch") + frame(b"\x05ESTOP" + bytes(60)), wait_s=1.0)
        self.assertIn(b"101 ", answer.split(b"\r\n")[0])
        self.assertIn("a command without the right to control", self.complaints())
        self.assert_nothing_commanded()


if __name__ == "__main__":
    private_network.enter()
    unittest.main()
