"""Restarts of actors, counted in the trace of godwitd: the event that an incarnation after the first one is up.

godwit-trace reads it while it is written, as far as it is there."""

import json
import subprocess


class Restarts:
    def __init__(self, program, folder):
        self.command = [program, "log", folder, "--type", "runtime.child_event", "--text", '"kind":"up"', "--json"]
        self.found = set()  # (run, id of the event)

    def count(self):
        # What it says on stderr: that the end is missing, or that there is no trace yet.
        told = subprocess.run(self.command, capture_output=True, text=True, timeout=60, check=False).stdout
        for line in told.splitlines():
            event = json.loads(line)
            if event["message"]["incarnation"] > 1:
                self.found.add((event["run"], event["id"]))
        return len(self.found)
