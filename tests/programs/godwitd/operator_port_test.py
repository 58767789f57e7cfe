#!/usr/bin/python3
"""The operator's port as a person, a monitor and a stranger find it: operator_port_test.py PATH_TO_GODWITD."""
import http.client
import json
import re
import socket
import subprocess
import time
import unittest

from service_test import OK, PATIENCE_S, PROGRAM, USAGE, World

PARTS_OF_STATUS = {"at_ms", "health", "flight", "missions", "failsafe", "vehicle", "ground", "service", "map", "fleet", "actors",
                   "mail", "journal", "trace", "process", "traffic", "unanswered"}


class Port(World):
    def begin(self, listen="127.0.0.1:0", *more):
        godwitd = self.start("--operator-listen", listen, *more)
        said = self.until_it_says(godwitd, "what there is to see: ")
        self.place = re.search(r"http://(127\.0\.0\.1:\d+)/", said).group(1)
        return godwitd

    def get(self, target, **headers):
        client = http.client.HTTPConnection(self.place, timeout=PATIENCE_S)
        try:
            client.request("GET", target, headers={name.title(): text for name, text in headers.items()})
            answer = client.getresponse()
            return answer.status, answer.read().decode()
        finally:
            client.close()

    def healthy_enough(self):
        """The answer of /healthz; a vehicle that is not there may make it red."""
        self.until(lambda: '"worst"' in self.get("/healthz")[1], "nobody looks at its health")
        return self.get("/healthz")

    def test_health_status_and_figures_of_a_daemon_that_runs(self):
        godwitd = self.begin()
        status, body = self.healthy_enough()
        self.assertEqual(status, 503 if json.loads(body)["worst"] == "red" else 200)
        status, body = self.get("/status")
        self.assertEqual(status, 200, body)
        now = json.loads(body)
        self.assertEqual(set(now), PARTS_OF_STATUS)
        self.assertEqual(now["unanswered"], [])
        self.assertLess(abs(now["at_ms"] - time.time() * 1000), 60_000)
        self.assertIn("health", [each["name"] for each in now["actors"] if each["phase"] == "running"])
        self.assertGreater(now["process"]["resident_bytes"], 1_000_000)
        status, body = self.get("/metrics")
        self.assertEqual(status, 200)
        for line in body.splitlines():
            self.assertRegex(line, r'^(# (HELP|TYPE) godwit_[a-z_]+ .+|godwit_[a-z_]+(\{.*\})? [0-9.e+-]+)$')
        self.assertIn('godwit_actor_up{actor="health"} 1\n', body)
        self.assertEqual(body.count("# TYPE godwit_health gauge\n"), 1)
        self.end(godwitd)

    def test_ctl_status_shows_health_too(self):
        godwitd = self.begin()
        self.healthy_enough()
        asked = subprocess.run([PROGRAM, "ctl", "status", "--journal", self.path("godwit.db")], capture_output=True,
                               text=True, timeout=PATIENCE_S, env=self.environment())
        self.assertEqual(asked.returncode, OK, asked.stderr)
        self.assertRegex(asked.stdout, r"^health     (all is well|yellow: .+|red: .+)\n")
        self.end(godwitd)

    def test_without_its_setting_there_is_no_port(self):
        godwitd = self.start()
        self.until_it_says(godwitd, "mission ")
        rest = self.end(godwitd)
        self.assertNotIn("operator", rest)

    def test_a_port_that_is_taken_is_named_with_the_remedy_and_godwitd_goes_on(self):
        taken = socket.create_server(("127.0.0.1", 0))
        self.addCleanup(taken.close)
        place = f"127.0.0.1:{taken.getsockname()[1]}"
        godwitd = self.start("--operator-listen", place)
        said = self.until_it_says(godwitd, "goes on without it")
        self.assertIn(place, said)
        self.assertIn("another program listens there", said)
        asked = subprocess.run([PROGRAM, "ctl", "status", "--journal", self.path("godwit.db")], capture_output=True,
                               text=True, timeout=PATIENCE_S, env=self.environment())
        self.assertEqual(asked.returncode, OK, asked.stderr)
        self.assertRegex(asked.stdout, r"health +(yellow: |red: .*)operator_port")
        self.end(godwitd)

    def test_a_run_on_the_ground_does_not_listen_beyond_this_computer(self):
        for place in ("0.0.0.0:8088", "[::]:8088", "192.168.7.7:8088"):
            ended = self.run_it("--operator-listen", place)
            self.assertEqual(ended.returncode, USAGE, ended.stderr)
            self.assertIn("--operator-listen (GODWIT_OPERATOR_LISTEN, operator.listen)", ended.stderr)
            self.assertIn("127.0.0.1", ended.stderr)

    def test_other_names_and_other_sites_are_refused(self):
        godwitd = self.begin()
        self.assertEqual(self.get("/status", host="evil.example")[0], 421)
        self.assertEqual(self.get("/status", origin="http://evil.example")[0], 403)
        self.assertEqual(self.get("/status", host="localhost", origin="http://localhost")[0], 200)
        self.assertEqual(self.get("/nothing")[0], 404)
        self.end(godwitd)

    def open_stream(self, topics, **headers):
        """A WebSocket by hand (RFC 6455), and the first line of the answer."""
        host, port = self.place.split(":")
        line = socket.create_connection((host, int(port)), timeout=PATIENCE_S)
        self.addCleanup(line.close)
        said = {"Host": self.place, "Connection": "Upgrade", "Upgrade": "websocket", "Sec-WebSocket-Version": "13",
                "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ==", **headers}
        line.sendall((f"GET /api/v1/stream?topics={topics} HTTP/1.1\r\n" +
                      "".join(f"{name}: {text}\r\n" for name, text in said.items()) + "\r\n").encode())
        stream = line.makefile("rb")
        first = stream.readline().decode().strip()
        while stream.readline() not in (b"\r\n", b""):
            pass
        return stream, first

    def next_text(self, stream):
        kind, size = stream.read(2)
        self.assertEqual(kind, 0x81, "a whole text")
        if size == 126:
            size = int.from_bytes(stream.read(2), "big")
        return json.loads(stream.read(size))

    def test_a_stream_shows_what_is_and_beats_each_second(self):
        godwitd = self.begin()
        stream, first = self.open_stream("health,log")
        self.assertEqual(first, "HTTP/1.1 101 Switching Protocols")
        self.assertIn("session", self.next_text(stream)["data"])
        beats = []
        while len(beats) < 3:
            said = self.next_text(stream)
            self.assertIn(said["topic"], ("health", "log", "clock"))
            if said["topic"] == "clock":
                beats.append(said["data"]["beat"])
        self.assertEqual(beats, list(range(beats[0], beats[0] + 3)))
        self.assertIn("godwit_stream_subscribers 1\n", self.get("/metrics")[1])
        self.end(godwitd)
        while stream.read(1):
            pass

    def test_a_page_of_another_site_gets_no_stream(self):
        godwitd = self.begin()
        self.assertIn("403", self.open_stream("log", Origin="http://evil.example")[1])
        self.assertIn("421", self.open_stream("log", Host="evil.example")[1])
        self.assertIn("400", self.open_stream("logs")[1])
        self.end(godwitd)

    def test_forty_strangers_that_say_nothing_keep_nobody_out_for_long(self):
        godwitd = self.begin()
        host, port = self.place.split(":")
        idle = []
        for _ in range(40):
            idle.append(socket.create_connection((host, int(port))))
        for each in idle:
            each.close()
        self.until(lambda: self.get_or_none("/healthz") in (200, 503), "nobody is let in any more")
        self.end(godwitd)

    def get_or_none(self, target):
        try:
            return self.get(target)[0]
        except (OSError, http.client.HTTPException):
            return None


if __name__ == "__main__":
    unittest.main()
