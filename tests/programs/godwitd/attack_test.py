#!/usr/bin/python3
"""What was done to godwitd to break it, done again: attack_test.py PATH_TO_GODWITD."""
import http.server
import json
import os
import pathlib
import resource
import signal
import socket
import stat
import subprocess
import threading
import time
import unittest

from service_test import FAILED, MISSION, OK, PATIENCE_S, PROGRAM, World

NOTICED_WITHIN_S = 5
TOKEN = "s3cr3t-token.of/the=service"


class Journal(World):
    def begin(self):
        godwitd = self.start()
        self.until_it_says(godwitd, "mission ")
        time.sleep(1.5)  # its files have been looked at as they are now
        return godwitd

    def run_other(self, journal, *more):
        return subprocess.run([PROGRAM, "--mission", MISSION, "--vehicle", "udpin://127.0.0.1:0", "--journal", journal,
                               "--trace", self.path("other"), "--ground-run", *more], capture_output=True, text=True,
                              timeout=PATIENCE_S, env=self.environment())

    def test_a_second_daemon_is_refused_under_every_name_of_the_journal(self):
        godwitd = self.begin()
        journal = self.path("godwit.db")
        os.symlink(journal, self.path("link.db"))
        other = ["--control", self.path("other"), "--map", self.path("other.map")]
        ended = self.run_other(self.path("link.db"), *other)
        self.assertEqual(ended.returncode, FAILED, ended.stderr)
        self.assertIn("another process writes this journal", ended.stderr)
        os.remove(journal + ".lock")
        ended = self.run_it(*other)
        self.assertEqual(ended.returncode, FAILED, ended.stderr)
        self.assertIn("another process writes this journal", ended.stderr)
        os.link(journal, self.path("hard.db"))
        ended = self.run_other(self.path("hard.db"), *other)
        self.assertEqual(ended.returncode, FAILED, ended.stderr)
        self.assertIn("2 names", ended.stderr)
        self.end(godwitd)

    def lose(self, harm):
        godwitd = self.begin()
        harm(self.path("godwit.db"))
        began = time.monotonic()
        said = self.until_it_says(godwitd, "journal is red")
        self.assertLess(time.monotonic() - began, NOTICED_WITHIN_S)
        self.assertIn("rescue-journal", said)
        ctl = subprocess.run([PROGRAM, "ctl", "rescue-journal", "--journal", self.path("godwit.db")],
                             capture_output=True, text=True, timeout=PATIENCE_S, env=self.environment())
        self.assertEqual((ctl.returncode, ctl.stdout),
                         (OK, "the journal is written to " + self.path("godwit.db.rescued") + "\n"), ctl.stderr)
        self.end(godwitd)
        again = self.start()  # with what was saved
        said = self.until_it_says(again, "mission ")
        self.end(again)

    def test_a_journal_that_is_deleted_is_noticed_and_goes_on_elsewhere(self):
        self.lose(os.remove)

    def test_a_journal_that_is_cut_is_noticed_and_goes_on_elsewhere(self):
        self.lose(lambda file: os.truncate(file, 4096))

    def test_a_cut_index_of_the_log_is_no_bus_error(self):
        self.lose(lambda file: os.truncate(file + "-shm", 0))

    def test_a_cut_log_is_noticed_and_goes_on_elsewhere(self):
        self.lose(lambda file: os.truncate(file + "-wal", 0))


def is_served(path):
    with socket.socket(socket.AF_UNIX) as client:
        return client.connect_ex(path) == 0


class Control(World):
    def test_a_stopped_daemon_with_a_full_backlog_keeps_its_socket(self):
        godwitd = self.start()
        self.until_it_says(godwitd, "mission ")
        path = self.path("godwit.control")
        self.until(lambda: is_served(path), "nobody serves the control socket")
        godwitd.send_signal(signal.SIGSTOP)
        waiting = []
        for _ in range(64):
            client = socket.socket(socket.AF_UNIX)
            client.setblocking(False)
            self.addCleanup(client.close)
            try:
                client.connect(path)
            except BlockingIOError:
                break
            waiting.append(client)
        ended = subprocess.run([PROGRAM, "--mission", MISSION, "--vehicle", "udpin://127.0.0.1:0", "--journal",
                                self.path("other.db"), "--trace", self.path("other"), "--control", path,
                                "--ground-run"], capture_output=True, text=True, timeout=PATIENCE_S,
                               env=self.environment())
        self.assertEqual(ended.returncode, FAILED, ended.stderr)
        self.assertIn("another godwitd listens there", ended.stderr)
        for client in waiting:
            client.close()
        godwitd.send_signal(signal.SIGCONT)
        self.assertTrue(stat.S_ISSOCK(os.stat(path).st_mode))
        self.end(godwitd)


class Limits(World):
    def test_too_little_memory_is_said(self):
        for limit, most in ((resource.RLIMIT_AS, 150 << 20), (resource.RLIMIT_AS, 300 << 20),
                            (resource.RLIMIT_AS, 600 << 20), (resource.RLIMIT_NOFILE, 16),
                            (resource.RLIMIT_NOFILE, 24)):
            ended = subprocess.run(self.words(), capture_output=True, text=True, timeout=PATIENCE_S,
                                   env=self.environment(),
                                   preexec_fn=lambda what=limit, bound=most: resource.setrlimit(what, (bound, bound)))
            self.assertEqual(ended.returncode, FAILED, (most, ended.stderr))
            self.assertIn("the limit of", ended.stderr)


class Echo(http.server.BaseHTTPRequestHandler):
    """A service that sends back what it was sent, and what a terminal would obey."""

    def do_GET(self):
        detail = f"you said {self.headers['Authorization']}\x1b[2J\nerror: godwitd: fake line"
        body = json.dumps({"type": "about:blank", "title": "no", "status": 422, "detail": detail}).encode()
        self.send_response(422)
        self.send_header("Content-Type", "application/problem+json")
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    do_POST = do_GET

    def log_message(self, *_):
        pass


class UnsignedCopter:
    """An ArduPilot copter on the ground that signs nothing: heartbeats to PORT, and what comes back."""
    SETUP_SIGNING = 256

    def __init__(self, port):
        self.port = port
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.settimeout(0.2)
        self.sequence = 0
        self.keys = []  # payloads of SETUP_SIGNING
        self.ends = threading.Event()
        self.thread = threading.Thread(target=self.live, daemon=True)
        self.thread.start()

    @staticmethod
    def crc(data):
        result = 0xFFFF
        for each in data:
            each ^= result & 0xFF
            each = (each ^ (each << 4)) & 0xFF
            result = ((result >> 8) ^ (each << 8) ^ (each << 3) ^ (each >> 4)) & 0xFFFF
        return result

    def heartbeat(self):
        crc_extra = 50
        payload = bytes([0, 0, 0, 0, 2, 3, 1, 3, 3])  # STABILIZE, quadrotor, ArduPilot, disarmed, standby
        body = bytes([len(payload), 0, 0, self.sequence, 1, 1, 0, 0, 0]) + payload
        self.sequence = (self.sequence + 1) % 256
        return b"\xfd" + body + self.crc(body + bytes([crc_extra])).to_bytes(2, "little")

    def live(self):
        while not self.ends.is_set():
            self.socket.sendto(self.heartbeat(), ("127.0.0.1", self.port))
            try:
                frame = self.socket.recv(512)
            except (TimeoutError, ConnectionError):
                continue
            if frame[0] == 0xFD and int.from_bytes(frame[7:10], "little") == self.SETUP_SIGNING:
                self.keys.append(frame[10:10 + frame[1]])

    def end(self):
        self.ends.set()
        self.thread.join()
        self.socket.close()


class Secrets(World):
    def free_port(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
            other.bind(("127.0.0.1", 0))
            return other.getsockname()[1]

    def ctl(self, *words):
        return subprocess.run([PROGRAM, "ctl", *words, "--journal", self.path("godwit.db")], capture_output=True,
                              text=True, timeout=PATIENCE_S, env=self.environment())

    def test_the_signing_key_goes_to_the_vehicle_at_a_persons_word_and_into_no_file(self):
        key = bytes(range(100, 132))
        pathlib.Path(self.path("signing.key")).write_text(key.hex() + "\n", encoding="ascii")
        os.chmod(self.path("signing.key"), 0o600)
        pathlib.Path(self.path("godwit.json")).write_text('{"vehicle": {"secure": true}}', encoding="ascii")
        port = self.free_port()
        godwitd = subprocess.Popen(
            [PROGRAM, "--config", self.path("godwit.json"), "--mission", MISSION, "--vehicle",
             f"udpin://127.0.0.1:{port}", "--signing-key", self.path("signing.key"), "--journal",
             self.path("godwit.db"), "--trace", self.path("trace"), "--log-file", self.path("log")],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=self.environment())
        self.running.append(godwitd)
        self.until(lambda: is_served(self.path("godwit.control")), "nobody serves the control socket")
        early = self.ctl("sign")
        self.assertEqual((early.returncode, early.stdout), (FAILED, ""))
        self.assertIn("not heard", early.stderr)
        copter = UnsignedCopter(port)
        self.addCleanup(copter.end)
        self.until(lambda: "its frames are not signed" in self.ctl("status").stdout, "the vehicle is not heard")
        self.assertEqual(copter.keys, [], "not by itself")
        done = self.ctl("sign")
        self.assertEqual(done.returncode, OK, done.stderr)
        self.until(lambda: copter.keys, "no key came to the vehicle")
        self.assertIn(key, copter.keys[0])
        audit = self.ctl("audit")
        self.assertIn("give the signing key", audit.stdout)
        self.end(godwitd)
        said = early.stderr + done.stdout + done.stderr + audit.stdout
        self.assertNotIn(key.hex(), said)
        for file in self.folder.rglob("*"):
            if file.is_file() and file.name != "signing.key":
                self.assertNotIn(key, file.read_bytes(), file)
                self.assertNotIn(key.hex().encode(), file.read_bytes().lower(), file)

    def test_a_token_that_the_service_echoes_is_in_no_file_and_its_words_are_no_line_of_ours(self):
        service = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Echo)
        self.addCleanup(service.server_close)
        threading.Thread(target=service.serve_forever, daemon=True).start()
        self.addCleanup(service.shutdown)
        pathlib.Path(self.path("token")).write_text(TOKEN + "\n", encoding="utf-8")
        os.chmod(self.path("token"), 0o600)
        ended = subprocess.run(
            [PROGRAM, "--service", f"http://127.0.0.1:{service.server_port}", "--token-file", self.path("token"),
             "--mission-id", "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42", "--vehicle", "udpin://127.0.0.1:0", "--journal",
             self.path("godwit.db"), "--trace", self.path("trace"), "--ground-run", "--once"],
            capture_output=True, text=True, timeout=PATIENCE_S, env=self.environment())
        said = ended.stdout + ended.stderr
        self.assertIn("Bearer (token)", said)
        self.assertNotIn(TOKEN, said)
        self.assertNotIn("\x1b", said)
        self.assertNotIn("\nerror: godwitd: fake line", said)
        for file in self.folder.rglob("*"):
            if file.is_file() and file.name != "token":
                self.assertNotIn(TOKEN.encode(), file.read_bytes(), file)

    def test_what_it_makes_is_for_its_user_alone_and_no_core_is_dumped(self):
        godwitd = self.start()
        self.until_it_says(godwitd, "mission ")
        for file in self.folder.rglob("*"):
            self.assertEqual(stat.S_IMODE(file.stat().st_mode) & 0o077, 0, file)
        limits = pathlib.Path(f"/proc/{godwitd.pid}/limits").read_text(encoding="ascii")
        self.assertRegex(limits, r"Max core file size +0 +0 ")
        self.end(godwitd)


if __name__ == "__main__":
    unittest.main()
