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


class Secrets(World):
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
