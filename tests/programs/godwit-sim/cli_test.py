#!/usr/bin/python3
"""The command line of godwit-sim, tried as a person or a script would: cli_test.py PATH_TO_GODWIT_SIM."""
import json
import pathlib
import re
import signal
import socket
import subprocess
import sys
import tempfile
import unittest

PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
OK, FAILED, USAGE = 0, 1, 2
PATIENCE_S = 60
HEARTBEAT = bytes.fromhex("fd09000000ffbe000000000000001208000403211a")
MAVLINK_2 = 0xFD


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=PATIENCE_S)


class Usage(unittest.TestCase):
    def assert_usage(self, arguments, *words):
        with self.subTest(arguments):
            result = run(*arguments)
            self.assertEqual(result.returncode, USAGE, result)
            self.assertEqual(result.stdout, "")
            for word in words:
                self.assertIn(word, result.stderr)

    def test_what_it_does_not_know_is_answered_with_the_usage(self):
        for arguments in ([], ["fly"], ["vehicle"], ["vehicle", "--personality"],
                          ["vehicle", "--personality", "px4", "--sped", "2"],
                          ["vehicle", "--personality", "px4", "--speed", "0"],
                          ["vehicle", "--personality", "px4", "--system", "251"],
                          ["vehicle", "--personality", "px4", "--count", "0"],
                          ["vehicle", "--personality", "px4", "--battery", "101"]):
            self.assert_usage(arguments, "Usage:", "godwit-sim")

    def test_values_that_mean_nothing_are_named_with_the_form(self):
        self.assert_usage(["vehicle", "--personality", "glider"], "glider", "rover, px4, ardupilot, plane, ardurover, quadplane or px4_vtol")
        for option, value, words in (("--link", "udp:1", ("udp:1", "udpin://HOST:PORT", "tcpin://HOST:PORT")),
                                     ("--home", "here", ("here", "LATITUDE,LONGITUDE,ALTITUDE")),
                                     ("--faults", "loss=2", ("loss=2", "a share from 0 to 1")),
                                     ("--fault-at", "soon=reboot", ("soon=reboot", "30s=gps lost")),
                                     ("--refuse", "FLY", ("FLY", "MISSION_START")),
                                     ("--control", "0.0.0.0:1", ("0.0.0.0:1", "127.0.0.1:14600"))):
            self.assert_usage(["vehicle", "--personality", "px4", option, value], option, *words)

    def test_help_goes_to_stdout_with_examples(self):
        for arguments in (["--help"], ["vehicle", "--help"]):
            result = run(*arguments)
            self.assertEqual((result.returncode, result.stderr), (OK, ""))
            self.assertIn("Usage:", result.stdout)
        self.assertIn("Examples:\n  godwit-sim vehicle ", run("vehicle", "--help").stdout)


class Vehicle(unittest.TestCase):
    def start(self, *arguments):
        """Starts it, and reads what it says until it says how to end it."""
        process = subprocess.Popen([PROGRAM, "vehicle", *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True)
        self.addCleanup(self.end, process)
        lines = []
        while not lines or "Ctrl-C" not in lines[-1]:
            line = process.stdout.readline()
            self.assertNotEqual(line, "", "it has ended: " + "".join(lines))
            lines.append(line)
        return process, "".join(lines)

    @staticmethod
    def end(process):
        if process.poll() is None:
            process.kill()
        process.wait(PATIENCE_S)
        process.stdout.close()
        process.stderr.close()

    def ports(self, text, kind):
        return [int(port) for port in re.findall(kind + r"://127\.0\.0\.1:(\d+)", text)]

    def ask(self, text, request):
        port = int(re.search(r"control port 127\.0\.0\.1:(\d+)", text)[1])
        with socket.create_connection(("127.0.0.1", port), PATIENCE_S) as connection:
            connection.sendall(json.dumps(request).encode() + b"\n")
            return json.loads(connection.makefile().readline())

    def hear_over_udp(self, port):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as station:
            station.settimeout(PATIENCE_S)
            station.connect(("127.0.0.1", port))  # nobody else is heard
            station.send(HEARTBEAT)
            return station.recv(2048)

    def test_each_personality_speaks_over_udp_and_ends_when_the_control_port_says_quit(self):
        for personality in ("rover", "px4", "ardupilot", "plane"):
            with self.subTest(personality):
                process, text = self.start("--personality", personality, "--link", "udpin://127.0.0.1:0",
                                           "--control", "127.0.0.1:0")
                self.assertEqual(self.hear_over_udp(self.ports(text, "udpin")[0])[0], MAVLINK_2)
                state = self.ask(text, {"do": "status"})["vehicles"][0]
                self.assertEqual((state["personality"], state["armed"]), (personality, False))
                self.assertTrue(self.ask(text, {"do": "quit"})["ok"])
                self.assertEqual(process.wait(PATIENCE_S), OK)

    def test_it_speaks_over_tcp_and_ends_on_a_signal(self):
        for name in (signal.SIGINT, signal.SIGTERM):
            process, text = self.start("--personality", "ardupilot", "--link", "tcpin://127.0.0.1:0")
            with socket.create_connection(("127.0.0.1", self.ports(text, "tcpin")[0]), PATIENCE_S) as station:
                self.assertEqual(station.recv(1)[0], MAVLINK_2)
                process.send_signal(name)
                self.assertEqual(process.wait(PATIENCE_S), OK)

    def test_it_calls_a_station_that_listens(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as station:
            station.settimeout(PATIENCE_S)
            station.bind(("127.0.0.1", 0))
            self.start("--personality", "px4", "--link", f"udpout://127.0.0.1:{station.getsockname()[1]}")
            self.assertEqual(station.recv(2048)[0], MAVLINK_2)

    def test_several_vehicles_have_ports_and_systems_of_their_own(self):
        _, text = self.start("--personality", "rover", "--link", "udpin://127.0.0.1:0", "--count", "3", "--system",
                             "249")
        systems = [self.hear_over_udp(port)[5] for port in self.ports(text, "udpin")[:3]]
        self.assertEqual(systems, [249, 250, 1])

    def test_it_tells_how_to_connect_and_what_happens(self):
        process, text = self.start("--personality", "px4", "--link", "udpin://127.0.0.1:0", "--fault-at",
                                   "10ms=battery 30")
        for word in ("QGroundControl", "MAVProxy", "MAVSDK", "udpout:127.0.0.1:"):
            self.assertIn(word, text)
        while "the battery is set to 30 %" not in text:  # it may have come before the last of the first words
            line = process.stdout.readline()
            self.assertNotEqual(line, "", "it has ended: " + text)
            text += line

    def test_a_port_that_is_taken_is_a_failure_with_a_reason(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
            taken.bind(("127.0.0.1", 0))
            result = run("vehicle", "--personality", "px4", "--link", f"udpin://127.0.0.1:{taken.getsockname()[1]}")
        self.assertEqual((result.returncode, result.stdout), (FAILED, ""))
        self.assertIn("another program listens on this port", result.stderr)

    def test_what_went_over_the_link_is_recorded(self):
        with tempfile.TemporaryDirectory(prefix="godwit-sim-") as folder:
            file = pathlib.Path(folder) / "a.tlog"
            process, text = self.start("--personality", "px4", "--link", "udpin://127.0.0.1:0", "--tlog", str(file))
            self.hear_over_udp(self.ports(text, "udpin")[0])
            process.send_signal(signal.SIGTERM)
            self.assertEqual(process.wait(PATIENCE_S), OK)
            self.assertIn(HEARTBEAT, file.read_bytes())

    def test_a_recording_that_can_not_be_made_is_a_failure(self):
        result = run("vehicle", "--personality", "px4", "--link", "udpin://127.0.0.1:0", "--tlog", "/no/such/a.tlog")
        self.assertEqual(result.returncode, FAILED)
        self.assertIn("/no/such", result.stderr)

    def test_quiet_means_no_events(self):
        process, text = self.start("--personality", "rover", "--link", "udpin://127.0.0.1:0", "--quiet", "--control",
                                   "127.0.0.1:0")
        self.hear_over_udp(self.ports(text, "udpin")[0])
        self.ask(text, {"do": "quit"})
        self.assertEqual(process.communicate(timeout=PATIENCE_S), ("", ""))


if __name__ == "__main__":
    unittest.main(argv=sys.argv)
