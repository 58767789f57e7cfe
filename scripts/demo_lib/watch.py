"""How the flight goes: asked ten times a second, shown in one line, and waited for with a bound."""

import shutil
import sys
import time

from demo_lib.children import Trouble

PERIOD_S = 0.1
STUCK_S = 4  # so long a pause that nobody has asked for is looked at before it is called the end
WIDTHS = (11, 17, 10, 10, 0)  # of the parts of the line, for a terminal of 80 columns
OVER = ("post_flight", "done", "aborted")


class Line:
    """The progress: rewritten in place on a terminal, else printed when it has changed."""

    def __init__(self, started):
        self.started = started
        self.is_terminal = sys.stdout.isatty()
        self.shown = ""

    def seconds(self):
        return time.monotonic() - self.started

    def show(self, text):
        if self.is_terminal:
            whole = f"{self.seconds():5.1f} s  {text}"
            print("\r\033[K" + whole[: shutil.get_terminal_size().columns - 1], end="", flush=True)
        elif text != self.shown:
            print(f"{self.seconds():5.1f} s  {text}", flush=True)
        self.shown = text

    def tell(self, text):
        """A line that stays."""
        self.clear()
        print(f"{self.seconds():5.1f} s  {text}", flush=True)

    def clear(self):
        if self.is_terminal:
            print("\r\033[K", end="", flush=True)


def text_of(flight):
    if not flight["mission_id"]:
        return f"{flight['phase']}, no mission yet"
    paused = "" if flight["cause"] in ("", "none") else f" ({flight['cause']})"
    mode = f"{flight['mode']}, {'armed' if flight['is_armed'] else 'disarmed'}" if flight["mode"] else "not heard"
    item = f"item {min(flight['items_done'] + 1, flight['items'])}/{flight['items']}"
    last = f"revision {flight['revision']}, plan {flight['generation']}"
    parts = (flight["phase"] + paused, mode, item, f"{flight['reports']} reports", last)
    return "  ".join(f"{part:<{width}}" for part, width in zip(parts, WIDTHS))


class Watch:
    def __init__(self, daemon, others, line):
        self.daemon = daemon
        self.others = others  # children that have to run all the time
        self.line = line
        self.flight = None
        self.stuck_since = None

    def look(self):
        """How the flight stands; None while the daemon or its executor does not answer."""
        flight = self.daemon.status().get("flight", {})
        if "phase" not in flight:
            return None
        self.flight = flight
        self.line.show(text_of(flight))
        return flight

    def judge(self, flight):
        """Nobody resumes or acknowledges anything in the demo: what waits for a person waits for ever."""
        is_stuck = flight is not None and flight["phase"] == "paused" and flight["cause"] != "asked"
        if not is_stuck:
            self.stuck_since = None
        elif self.stuck_since is None:
            self.stuck_since = time.monotonic()
        elif time.monotonic() - self.stuck_since > STUCK_S:
            raise Trouble(f"the flight stands still: {flight['sentence']}")
        if flight is not None and flight["phase"] == "aborted":
            raise Trouble(f"the mission was aborted: {flight['sentence']}")

    def wait_for(self, what, is_there, seconds, ends_with_flight=True):
        """Looks until IS_THERE(flight), and returns that flight."""
        until = time.monotonic() + seconds
        while time.monotonic() < until:
            flight = self.look()
            if flight is not None and is_there(flight):
                return flight
            self.judge(flight)
            for child in (*self.others, self.daemon.child):
                child.check()
            if ends_with_flight and flight is not None and flight["phase"] in OVER:
                raise Trouble(f"the mission was over before {what} came; a longer one, or --no-faults, would do")
            time.sleep(PERIOD_S)
        raise Trouble(f"{what} did not come within {seconds} s; {self.standing()}")

    def standing(self):
        if self.flight is None:
            return f"godwitd has told nothing of a flight; it said last:\n{self.daemon.child.said_last()}"
        return f"the flight stands at '{self.flight['sentence']}' ({text_of(self.flight).strip()})"
