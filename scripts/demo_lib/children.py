"""The programs of the demo: started, watched by what they print, and ended by their process ids."""

import os
import re
import socket
import subprocess
import time

PATIENCE_S = 5  # how long a program may take to end when it is asked to
POLL_S = 0.02


class Trouble(Exception):
    """Something did not come. The text says what; the demo ends with it."""


def free_port():
    """Of UDP on the loopback, a moment ago."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def free_tcp_port():
    """Of TCP on the loopback, a moment ago."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def environment():
    """Ours without GODWIT_*: what the demo sets shall be all that is set."""
    return {name: value for name, value in os.environ.items() if not name.startswith("GODWIT_")}


class Child:
    """One program. What it prints goes to a file, after what it printed before it was started again."""

    def __init__(self, name, command, folder):
        self.name = name
        self.command = [str(word) for word in command]
        self.log = folder / f"{name}.log"
        self.process = None
        self.start()

    def start(self):
        with open(self.log, "ab") as out:
            try:
                # A session of its own: Ctrl-C is for the demo, which then ends its children in order.
                self.process = subprocess.Popen(
                    self.command,
                    stdin=subprocess.DEVNULL,
                    stdout=out,
                    stderr=subprocess.STDOUT,
                    start_new_session=True,
                    env=environment(),
                )
            except OSError as error:
                raise Trouble(f"{self.name} can not be started: {error}") from error

    def text(self):
        return self.log.read_text(encoding="utf-8", errors="replace")

    def is_running(self):
        return self.process.poll() is None

    def said_last(self, lines=8):
        return "\n".join(f"    {line}" for line in self.text().splitlines()[-lines:])

    def check(self):
        if not self.is_running():
            raise Trouble(f"{self.name} has ended with {self.process.returncode}; it said last:\n{self.said_last()}")

    def wait_for(self, pattern, seconds):
        """The first match of PATTERN in what it has printed."""
        until = time.monotonic() + seconds
        while True:
            is_running = self.is_running()
            if found := re.search(pattern, self.text()):
                return found
            if not is_running:
                self.check()
            if time.monotonic() > until:
                raise Trouble(f"{self.name} did not say '{pattern}' within {seconds} s:\n{self.said_last()}")
            time.sleep(POLL_S)

    def kill(self):
        self.process.kill()
        self.process.wait()

    def end(self):
        """Returns its exit code."""
        if self.is_running():
            self.process.terminate()
            try:
                self.process.wait(PATIENCE_S)
            except subprocess.TimeoutExpired:
                self.kill()
        return self.process.returncode
