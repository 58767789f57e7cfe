"""Restarts of actors, counted in the trace of godwitd: the event that an incarnation behind the first one is up.

The trace is read on while it is written, as far as it is there. Its records are JSON within MCAP, not compressed."""

import re

UP = re.compile(rb'"message":\{"name":"(\w+)","kind":"up","incarnation":(\d+)')
MAX_EVENT = 256  # bytes: an event that is not all there yet is looked at again


class Restarts:
    def __init__(self, folder):
        self.folder = folder
        self.seen_to = {}  # by file
        self.found = set()  # (file, place in it)

    def count(self):
        for file in sorted(self.folder.glob("*.mcap")):
            begin = max(0, self.seen_to.get(file, 0) - MAX_EVENT)
            try:
                with open(file, "rb") as record:
                    record.seek(begin)
                    piece = record.read()
            except FileNotFoundError:
                continue  # the oldest files go first
            self.seen_to[file] = begin + len(piece)
            places = (begin + up.start() for up in UP.finditer(piece) if int(up.group(2)) > 1)
            self.found.update((file, place) for place in places)
        return len(self.found)
