"""The camera in the demo: what goes wrong with it and with godwit-eyes, and a scripted operator who decides, and who
sends the vehicle to what was confirmed."""

import json
import os
import signal
import socket
import time
from pathlib import Path

from demo_lib.children import Trouble

CUT_S = 10
SETTLES_S = 6  # from the start of the survey, and between two troubles
VISIT_M = 40  # above the place of take-off
VISIT_S = 120  # there from anywhere over the meadow, and back


def free_tcp_port():
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Camera:
    """Where the vehicle serves it, and the control port of the vehicle, which can cut it."""

    def __init__(self):
        self.control = free_tcp_port()
        self.uri = f"rtsp://127.0.0.1:{free_tcp_port()}/camera"
        self.kills = 0

    def vehicle_options(self):
        # The meadow of missions/search.json lies 30 to 90 m north and 0 to 80 m east of home.
        scene = "?width=640&height=360&fps=10&seed=7&movers=6&north=60&east=40&spread=26"
        return ["--camera", self.uri + scene, "--control", f"127.0.0.1:{self.control}"]

    def do(self, words):
        with socket.create_connection(("127.0.0.1", self.control), timeout=5) as connection:
            connection.sendall(json.dumps({"do": words}).encode() + b"\n")
            answer = json.loads(connection.makefile().readline())
        if not answer.get("ok"):
            raise Trouble(f"the vehicle refuses '{words}': {answer}")

    def kill_eyes(self, parent):
        """The helper process of the process PARENT. It may be away just then, and is waited for."""
        until = time.monotonic() + 10
        while time.monotonic() < until:
            for each in Path("/proc").glob("[0-9]*/stat"):
                try:
                    number, rest = each.read_text(encoding="utf-8", errors="replace").split(" (godwit-eyes) ", 1)
                except (OSError, ValueError):
                    continue
                if int(rest.split()[1]) == parent and rest[0] != "Z":
                    os.kill(int(number), signal.SIGKILL)
                    self.kills += 1
                    return
            time.sleep(0.1)
        raise Trouble("there is no godwit-eyes that could be killed")


class Operator:
    """Confirms the first thing that is shown, and declines the second; the third is passed over.

    WAITS_S: so long somebody at the page has to decide before; who has control there is not disturbed."""

    def __init__(self, daemon, line, waits_s=0):
        self.daemon = daemon
        self.line = line
        self.waits_s = waits_s
        self.seen_at = {}
        self.decided = {}
        self.visited = []

    def confirmed(self):
        """The number of a point that was confirmed, by the script or by somebody at the page; None: there is none."""
        points = self.daemon.status().get("points") or {}
        return next((point["number"] for point in points.get("confirmed", [])), None)

    def send(self, number):
        """The same words as a person's. False: somebody at the page has the vehicle in hand."""
        try:
            self.daemon.ctl("insert", "--point", str(number), "--altitude", str(VISIT_M))
        except Trouble as trouble:
            if self.waits_s == 0:
                raise
            self.line.tell(f"operator: point {number} is not flown to: {trouble}")
            return False
        self.line.tell(f"operator: fly to point {number}, at {VISIT_M} m, and then on with the survey")
        return True

    def look(self):
        points = self.daemon.status().get("points") or {}
        for point in points.get("shown", []):
            number = point["number"]
            if number in self.decided or len(self.decided) >= 2:
                continue
            if time.monotonic() - self.seen_at.setdefault(number, time.monotonic()) < self.waits_s:
                continue
            word = "decline" if self.decided else "confirm"
            try:
                self.daemon.ctl(word, str(number))
            except Trouble:
                if self.waits_s == 0:
                    raise
                continue  # it is decided, or theirs who has control
            self.decided[number] = word
            self.line.tell(f"operator: {word} {number}, {point['class_group']} seen by the camera")


def trouble(watch, camera, operator, seconds):
    """While the survey is flown: godwit-eyes is killed twice, and the camera is cut."""

    def flown_for(wanted_s):
        began = time.monotonic()

        def is_over(_):
            operator.look()
            return time.monotonic() - began >= wanted_s

        return is_over

    def is_survey(flight):
        operator.look()
        eyes = watch.daemon.status().get("eyes") or {}
        return flight["phase"] == "flying" and eyes.get("is_seeing", False)

    watch.wait_for("the eyes", is_survey, seconds)
    watch.line.tell("the eyes see the ground")
    for number in (1, 2):
        watch.wait_for("some of the survey", flown_for(SETTLES_S), seconds)
        camera.kill_eyes(watch.daemon.child.process.pid)
        watch.line.tell(f"fault: godwit-eyes is killed, for the {('first', 'second')[number - 1]} time")
    watch.wait_for("some of the survey", flown_for(SETTLES_S), seconds)
    camera.do("camera cut")
    watch.line.tell(f"fault: the camera is cut for {CUT_S} s")
    watch.wait_for("the end of the cut", flown_for(CUT_S), seconds)
    camera.do("camera back")
    watch.line.tell("the camera is back")


def visit(watch, service, operator, seconds):
    """The vehicle is sent to what was confirmed, and from there back to the survey that it was flying."""

    def item_of(flight):
        return service.mission()["items"][min(flight["items_done"], flight["items"] - 1)]

    def is_moment(flight):
        operator.look()
        is_survey = flight["phase"] == "flying" and item_of(flight)["kind"] == "survey"
        return is_survey and operator.confirmed() is not None

    flight = watch.wait_for("something to fly to in the survey", is_moment, seconds)
    survey, number, done = item_of(flight), operator.confirmed(), flight["items_done"]
    if not operator.send(number):
        return

    def is_on_its_way(now):
        operator.look()
        return now["phase"] == "flying" and now["items"] > flight["items"] and service.has_item(done, "waypoint")

    there = item_of(watch.wait_for("the way to the point", is_on_its_way, VISIT_S))

    def is_there(now):
        operator.look()
        return service.is_reached(there["id"]) and now["items_done"] == done + 1

    watch.wait_for("the vehicle at the point", is_there, VISIT_S)
    place = there["at"]
    watch.line.tell(f"the vehicle is at point {number}: {place['latitude']:.5f},{place['longitude']:.5f}")

    def is_back(now):
        operator.look()
        return now["phase"] == "flying" and now["items_done"] > done and item_of(now)["id"] == survey["id"]

    watch.wait_for("the survey again", is_back, VISIT_S)
    operator.visited.append(number)
    watch.line.tell(f"the vehicle goes on with '{survey['id']}'")
