"""godwitd in the demo: started with the demo's configuration, asked over its control socket."""

import subprocess

from demo_lib.children import Child, Trouble, environment
from demo_lib.restarts import Restarts
from demo_lib.status import ANSWER_S, ask


class Daemon:
    def __init__(self, programs, folder, config, service, vehicle_uri, options):
        self.program = programs / "godwitd"
        self.socket = folder / "godwit.control"
        self.child = Child(
            "godwitd",
            [self.program, "--config", config, "--allow-crash", "--vehicle", vehicle_uri]
            + ["--service", service.url, "--token-file", service.token, "--mission-id", service.mission_id]
            + [*options, "--journal", folder / "godwit.db", "--trace", folder / "trace"]
            + ["--control", self.socket],
            folder,
        )
        self.kills = 0
        self.restarts = Restarts(programs / "godwit-trace", folder / "trace")

    def status(self):
        """What it tells of itself; empty while it does not answer."""
        return ask(self.socket)

    def kill_and_start(self):
        self.child.kill()
        self.kills += 1
        self.child.start()

    def ctl(self, *words):
        """A word of `godwitd ctl`, and what it prints."""
        command = [self.program, "ctl", *words, "--control", self.socket]
        result = subprocess.run(
            command, capture_output=True, text=True, timeout=4 * ANSWER_S, check=False, env=environment()
        )
        if result.returncode != 0:
            raise Trouble(f"'godwitd ctl {' '.join(words)}' is refused: {(result.stderr or result.stdout).strip()}")
        return result.stdout.strip()
