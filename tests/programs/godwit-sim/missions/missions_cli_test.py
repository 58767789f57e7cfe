#!/usr/bin/python3
"""godwit-sim missions, tried as a person or a script would: missions_cli_test.py PATH_TO_GODWIT_SIM MISSION_FILE."""
import json
import os
import pathlib
import re
import signal
import socket
import subprocess
import sys
import tempfile
import unittest
import urllib.error
import urllib.request

MISSION = pathlib.Path(sys.argv.pop(2)).resolve()
PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
OK, FAILED, USAGE = 0, 1, 2
PATIENCE_S = 60


class Missions(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="godwit-sim-missions-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.token = self.write("token", "secret")
        self.mission_id = json.loads(MISSION.read_text())["mission_id"]

    def write(self, name, text):
        file = self.folder / name
        file.write_text(text)
        file.chmod(0o600)
        return file

    def arguments(self, *more):
        return [PROGRAM, "missions", "--token-file", str(self.token), "--mission", str(MISSION), "--db",
                str(self.folder / "missions.db"), *more]

    def start(self, *more):
        """Starts it, and reads what it says until it says how to end it."""
        process = subprocess.Popen(self.arguments(*more), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.end, process)
        lines = []
        while not lines or "Ctrl-C" not in lines[-1]:
            line = process.stdout.readline()
            self.assertNotEqual(line, "", "it has ended: " + "".join(lines))
            lines.append(line)
        return process, lines

    @staticmethod
    def end(process):
        if process.poll() is None:
            process.kill()
        process.wait(PATIENCE_S)
        process.stdout.close()
        process.stderr.close()

    def ask(self, lines, rest="", body=None):
        url = re.fullmatch(r"listening on (http://127\.0\.0\.1:\d+)\n", lines[0])[1]
        headers = {"Authorization": "Bearer secret", "Content-Type": "application/json"}
        request = urllib.request.Request(f"{url}/missions/{self.mission_id}{rest}", body, headers)
        with urllib.request.urlopen(request, timeout=PATIENCE_S) as answer:
            return json.load(answer)

    def test_it_serves_the_mission_and_its_map_and_ends_on_a_signal(self):
        process, lines = self.start("--map-objects", "3")
        self.assertIn(self.mission_id, lines[1])
        self.assertEqual(self.ask(lines), json.loads(MISSION.read_text()))
        self.assertEqual(len(self.ask(lines, "/mapobjects")["map_objects"]), 3)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(PATIENCE_S), OK)

    def test_what_it_was_told_is_there_when_it_starts_again_even_after_a_kill(self):
        process, lines = self.start()
        report = {"mission_id": self.mission_id, "revision": 1, "generation": 1, "report_no": 1, "kind": "started",
                  "at": "2026-05-04T10:15:30Z", "inferred": False}
        body = json.dumps({"idempotency_key": "f2b7a9d4-52c6-4d3e-9b1a-6f0c2f4f7d10", "reports": [report]}).encode()
        self.assertEqual(self.ask(lines, "/progress", body), {"stored": 1, "repeated": 0})
        process.kill()
        process.wait(PATIENCE_S)
        _, lines = self.start()
        self.assertEqual(self.ask(lines, "/progress", body), {"stored": 1, "repeated": 0})
        other = body.replace(b"7d10", b"7d11")
        self.assertEqual(self.ask(lines, "/progress", other), {"stored": 0, "repeated": 1})

    def test_faults_come_from_the_command_line_and_from_the_control_port(self):
        process, lines = self.start("--fault", "status 503 times 1", "--control", "127.0.0.1:0")
        with self.assertRaises(urllib.error.HTTPError) as failed:
            self.ask(lines)
        self.assertEqual(failed.exception.code, 503)
        failed.exception.close()
        port = int(re.search(r"control port 127\.0\.0\.1:(\d+)", "".join(lines))[1])
        with socket.create_connection(("127.0.0.1", port), PATIENCE_S) as control:
            answers = control.makefile()
            for request in ({"do": "fault truncate times 1"}, {"do": "quit"}):
                control.sendall(json.dumps(request).encode() + b"\n")
                self.assertTrue(json.loads(answers.readline())["ok"])
            answers.close()
        self.assertEqual(process.wait(PATIENCE_S), OK)

    def test_mistakes_are_answered_with_what_to_do(self):
        os.chmod(self.token, 0o644)
        result = subprocess.run(self.arguments(), capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual((result.returncode, result.stdout), (USAGE, ""))
        self.assertIn("chmod 600", result.stderr)
        os.chmod(self.token, 0o600)
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            taken.listen()
            result = subprocess.run(self.arguments("--listen", f"127.0.0.1:{taken.getsockname()[1]}"),
                                    capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual((result.returncode, result.stdout), (FAILED, ""))
        self.assertIn("another program listens", result.stderr)

    def test_help_has_examples(self):
        result = subprocess.run([PROGRAM, "missions", "--help"], capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual((result.returncode, result.stderr), (OK, ""))
        self.assertIn("Examples:\n  godwit-sim missions ", result.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv)
