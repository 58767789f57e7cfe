#!/usr/bin/python3
"""An essential actor that can not be kept up in flight, with real processes: fast_end_test.py GODWITD GODWIT_SIM."""
import json
import os
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import unittest

SIMULATOR = str(pathlib.Path(sys.argv.pop(2)).resolve())
PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
MISSION = str(pathlib.Path(__file__).resolve().parents[3] / "missions" / "survey.json")
PATIENCE_S = 60
PART_HOLDS_S = 5  # supervision::part_holds_ns
FAST_END_S = 0.5
SLACK_S = 0.5  # of a busy machine
ESSENTIAL_GIVEN_UP = 70


class FastEnd(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="godwitd-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.running = []
        self.addCleanup(self.kill_all)
        home = json.loads(pathlib.Path(MISSION).read_text(encoding="utf-8"))["return_point"]
        vehicle = self.start([SIMULATOR, "vehicle", "--personality", "px4", "--link", "udpin://127.0.0.1:0", "--home",
                              f"{home['latitude']},{home['longitude']},480"])
        for line in vehicle.stdout:
            if found := re.search(r"udpin://127\.0\.0\.1:(\d+)", line):
                self.vehicle = f"udpout://127.0.0.1:{found.group(1)}"
                break

    def kill_all(self):
        for each in self.running:
            each.kill()
            each.communicate()

    def start(self, words):
        clean = {name: text for name, text in os.environ.items() if not name.startswith(("GODWIT_", "NOTIFY_"))}
        started = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=clean)
        self.running.append(started)
        return started

    def path(self, name):
        return str(self.folder / name)

    def start_godwitd(self):
        return self.start([PROGRAM, "--mission", MISSION, "--vehicle", self.vehicle, "--journal", self.path("godwit.db"),
                           "--trace", self.path("trace"), "--log-file", self.path("log"), "--allow-crash",
                           "--arm-on-start", "--start", "automatic"])

    def say(self, request):
        try:
            with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as connection:
                connection.settimeout(5)
                connection.connect(self.path("godwit.control"))
                connection.sendall(json.dumps(request).encode() + b"\n")
                return json.loads(connection.makefile().readline())
        except (OSError, ValueError):
            return {}

    def until(self, condition, what):
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            if condition():
                return
            time.sleep(0.02)
        self.fail(what + "\n" + pathlib.Path(self.path("log")).read_text(encoding="utf-8"))

    def actor(self, name):
        found = [each for each in self.say({"do": "status"}).get("actors", {}).get("list", []) if each["name"] == name]
        return found[0] if found else {}

    def in_flight(self):
        return self.say({"do": "status"}).get("flight", {}).get("in_flight", False)

    def crash_until(self, name, condition):
        """Returns when the last crash was."""
        last = 0.0

        def once_more():
            nonlocal last
            if self.say({"do": "crash", "actor": name}).get("ok"):
                last = time.monotonic()
            return condition()

        self.until(once_more, f"{name} is crashed again and again")
        return last

    def test_the_first_time_the_process_ends_at_once_and_the_second_time_it_stays(self):
        godwitd = self.start_godwitd()
        self.until(self.in_flight, "it flies")
        time.sleep(PART_HOLDS_S + 0.5)
        last_crash = self.crash_until("failsafe", lambda: godwitd.poll() is not None)
        self.assertLess(time.monotonic() - last_crash, FAST_END_S + SLACK_S)
        self.assertEqual(godwitd.returncode, ESSENTIAL_GIVEN_UP)
        again = self.start_godwitd()
        self.until(self.in_flight, "the next process flies on")
        self.crash_until("failsafe", lambda: self.actor("failsafe").get("phase") == "given_up")
        self.until(lambda: "returns because the failsafe is gone" in
                   pathlib.Path(self.path("log")).read_text(encoding="utf-8"), "the vehicle returns")
        self.assertIsNone(again.poll())


if __name__ == "__main__":
    unittest.main()
