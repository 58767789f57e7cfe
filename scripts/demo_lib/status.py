"""What a running godwitd tells of itself over its control socket."""

import json
import socket

ANSWER_S = 5


def ask(path):
    """Its status; empty while it does not answer."""
    try:
        with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as connection:
            connection.settimeout(ANSWER_S)
            connection.connect(str(path))
            connection.sendall(b'{"do": "status"}\n')
            return json.loads(connection.makefile().readline())
    except (OSError, ValueError):
        return {}
