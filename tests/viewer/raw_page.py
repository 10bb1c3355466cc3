"""What a page sends to the viewer, as raw bytes."""
import base64
import os
import socket
import struct
import time

PATIENCE_s = 20.0


class RawPage:
    def __init__(self, port):
        self.port = port
        self.own = f"127.0.0.1:{port}"

    def connected(self, text):
        """A socket on which `text` was sent."""
        connection = socket.create_connection(("127.0.0.1", self.port), timeout=PATIENCE_s)
        connection.sendall(text if isinstance(text, bytes) else text.encode())
        return connection

    def exchange(self, text, wait_s=2.0):
        """Sends bytes, and returns what came back until the server closed or the time was up."""
        answer, end = b"", time.monotonic() + wait_s
        with self.connected(text) as connection:
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

    def get(self, path, host=None):
        return self.exchange(f"GET {path} HTTP/1.1\r\nHost: {host or self.own}\r\n\r\n")

    def handshake(self, origin=None, host=None, token=""):
        key = base64.b64encode(os.urandom(16)).decode()
        return (f"GET /bus?token={token} HTTP/1.1\r\nHost: {host or self.own}\r\n"
                f"Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: {key}\r\n"
                f"Sec-WebSocket-Version: 13\r\nOrigin: {origin or f'http://{self.own}'}\r\n"
                f"\r\n").encode()


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


def frames_in(stream):
    """Payloads of the whole WebSocket frames a server sent, as they come from `stream`."""
    while head := stream.read(2):
        size = head[1] & 0x7F
        if size == 126:
            size = struct.unpack(">H", stream.read(2))[0]
        elif size == 127:
            size = struct.unpack(">Q", stream.read(8))[0]
        payload = stream.read(size)
        if len(payload) < size:
            return
        yield payload
