"""What goes wrong in a soak, drawn from its seed: one thing after the other, and each is over before the next."""

import collections
import json
import socket

from demo_lib.children import Trouble

ANSWER_S = 5
PAUSES_S = (4, 12)  # between two of them
NEW_PLACE_S = 60
BATTERY_S = 10  # at 20 times real time it lasts for a minute
LOOKED_AFTER_S = 3  # a person has seen that it is paused
ACTORS = ("executor", "failsafe", "vehicle_link", "mission_client", "mapobjects_store", "ground_port")
SERVICE = ("status 503 times 3", "lose times 2", "drop times 2", "delay 2s times 2")


class Faults:
    def __init__(self, daemon, service, vehicle_port, drawn):
        self.daemon = daemon
        self.service = service
        self.vehicle_port = vehicle_port
        self.drawn = drawn
        self.made = collections.Counter()
        self.next_s = self.next_place_s = self.next_battery_s = None
        self.paused_s = None  # since when, and for a reason that is not ours
        self.over = []  # (when, what ends it)
        self.kinds = (self.cut, self.lossy, self.break_service, self.crash, self.pause)

    def vehicle(self, words):
        with socket.create_connection(("127.0.0.1", self.vehicle_port), ANSWER_S) as connection:
            connection.sendall(json.dumps({"do": words}).encode() + b"\n")
            answer = json.loads(connection.makefile().readline())
        if not answer.get("ok"):
            raise Trouble(f"the vehicle refuses '{words}': {answer.get('error')}")

    def go_on(self, now, flight, next_stay):
        if self.next_s is None:
            self.next_s = self.next_battery_s = now
            self.next_place_s = now + NEW_PLACE_S
        if now >= self.next_battery_s:
            self.next_battery_s = now + BATTERY_S
            self.vehicle("battery 100")
        for when, what in [each for each in self.over if each[0] <= now]:
            what()
            self.over.remove((when, what))
        if flight.get("phase") != "paused" or self.over:
            self.paused_s = None
        elif self.paused_s is None:
            self.paused_s = now
        elif now - self.paused_s >= LOOKED_AFTER_S:
            self.resume(flight)
            self.paused_s = None
        if now >= self.next_place_s:
            self.next_place_s = now + NEW_PLACE_S
            self.made["assignment"] += 1
            self.service.assign("takeoff", next_stay())
        if now >= self.next_s:
            self.next_s = now + self.drawn.uniform(*PAUSES_S)
            kind = self.drawn.choice(self.kinds)
            self.made[kind.__name__] += 1
            kind(now)

    def heal(self):
        for _, what in self.over:
            what()
        self.service.ask({"do": "faults off"})

    def cut(self, _):
        self.vehicle(f"cut {self.drawn.choice((1, 2, 5))}s")

    def lossy(self, now):
        self.vehicle(f"faults loss=0.{self.drawn.randint(1, 2)},dup=0.05")
        self.over.append((now + 3, lambda: self.vehicle("faults none")))

    def break_service(self, _):
        """What was not met is taken off, or in an hour the service has more than it takes."""
        self.service.ask({"do": "faults off"})
        self.service.ask({"do": f"fault {self.drawn.choice(SERVICE)}"})

    def crash(self, _):
        self.say("crash", self.drawn.choice(ACTORS))

    def pause(self, now):
        self.say("pause")
        self.over.append((now + 2, lambda: self.say("resume")))

    def resume(self, flight):
        """A person looks after a flight that is paused for another reason: a lost line, a failsafe."""
        self.made["paused, and resumed"] += 1
        if "hand" in (flight.get("reason") or ""):
            self.say("hand-back")
        self.say("resume")

    def say(self, *words):
        """What is refused is said again by whoever wanted it; the flight shows whether it goes on."""
        try:
            self.daemon.ctl(*words)
        except Trouble:
            self.made["refused word"] += 1
