"""What a camera would see: sightings that come one after the other through a named pipe while the vehicle flies."""

import json
import os
import threading
import time
import uuid

COUNT = 20
PERIOD_S = 0.4
APART_DEG = 0.0006  # of latitude: 67 m, so that each one is a thing of its own (map.match_within_m)
IN_A_ROW = 5


def sighting(number, middle):
    row, column = divmod(number, IN_A_ROW)
    return {
        "id": str(uuid.uuid4()),
        "class_group": ("vehicle", "person", "building")[number % 3],
        "latitude": round(middle["latitude"] + (row - COUNT / IN_A_ROW / 2) * APART_DEG, 7),
        "longitude": round(middle["longitude"] + (column - IN_A_ROW / 2) * APART_DEG * 1.5, 7),
        "altitude_m": 441.5,
        "confidence": 0.9,
        "at": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()),
    }


class Sightings:
    """The pipe has one end with us all the time: it is never at its end, and nobody waits who opens it."""

    def __init__(self, path, middle):
        self.path = path
        self.middle = middle
        os.mkfifo(path, 0o600)
        self.pipe = os.open(path, os.O_RDWR | os.O_NONBLOCK)
        self.lines = []
        self.lock = threading.Lock()
        self.stopping = threading.Event()
        self.thread = threading.Thread(target=self.run, daemon=True)

    def begin(self):
        self.thread.start()

    def run(self):
        while len(self.lines) < COUNT and not self.stopping.wait(PERIOD_S):
            line = json.dumps(sighting(len(self.lines), self.middle)).encode() + b"\n"
            with self.lock:
                self.lines.append(line)
                os.write(self.pipe, line)

    def again(self):
        """For a reader that was killed, and may have read what it could not keep: all lines, as a file would."""
        with self.lock:
            os.write(self.pipe, b"".join(self.lines))  # 20 lines of 250 bytes: a pipe has room for 64 KiB

    def stop(self):
        """Returns how many there were."""
        self.stopping.set()
        if self.thread.is_alive():
            self.thread.join()
        if self.pipe is not None:
            os.close(self.pipe)
            self.pipe = None
        return len(self.lines)
