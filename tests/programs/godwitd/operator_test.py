#!/usr/bin/python3
"""Operators as godwitd knows them: accounts, control and the audit: operator_test.py PATH_TO_GODWITD."""
import http.client
import json
import os
import pathlib
import re
import shutil
import socket
import stat
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
MISSION = str(pathlib.Path(__file__).resolve().parents[2] / "data" / "missions" / "every_kind.json")
PATIENCE_S = 60
OK, FAILED, USAGE = 0, 1, 2
PASSWORD = "correct horse battery"


class World(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="godwitd-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.accounts = self.folder / "operators"

    def run_it(self, *words, user="anna", given=""):
        environment = {name: text for name, text in os.environ.items() if not name.startswith(("GODWIT_", "SUDO_"))}
        return subprocess.run([PROGRAM, *words], input=given, capture_output=True, text=True, timeout=PATIENCE_S,
                              env={**environment, "USER": user})

    def operator(self, *words, given=""):
        return self.run_it("operator", *words, "--accounts", str(self.accounts), given=given)


class Accounts(World):
    def test_an_account_is_made_changed_shown_and_removed(self):
        self.assertEqual(self.operator("list").stdout, "")
        added = self.operator("add", "anna", "--role", "operator", given=PASSWORD + "\n")
        self.assertEqual(added.returncode, OK, added.stderr)
        self.assertEqual(stat.S_IMODE(self.accounts.stat().st_mode), 0o600)
        before = self.accounts.read_text(encoding="utf-8")
        self.assertNotIn(PASSWORD, before)
        self.assertEqual(self.operator("passwd", "anna", given="another horse\n").returncode, OK)
        self.assertNotEqual(self.accounts.read_text(encoding="utf-8"), before)
        token = self.operator("token", "anna").stdout.strip()
        self.assertEqual(len(token), 43)
        self.assertNotIn(token, self.accounts.read_text(encoding="utf-8"))
        self.assertEqual(self.operator("list").stdout, "anna  operator  with a token\n")
        self.assertEqual(self.operator("remove", "anna").returncode, OK)
        self.assertEqual(self.operator("list").stdout, "")

    def test_what_can_not_be_is_refused_and_changes_nothing(self):
        self.operator("add", "anna", "--role", "viewer", given=PASSWORD + "\n")
        before = self.accounts.read_text(encoding="utf-8")
        for words, given, code in ((("add", "anna", "--role", "viewer"), PASSWORD, FAILED),
                                   (("add", "bob", "--role", "viewer"), "short", FAILED),
                                   (("add", "bob", "--role", "viewer"), "x" * 300, FAILED),
                                   (("add", "Bob", "--role", "viewer"), PASSWORD, USAGE),
                                   (("add", "bob", "--role", "king"), PASSWORD, USAGE),
                                   (("add", "bob", PASSWORD, "--role", "viewer"), "", USAGE),
                                   (("passwd", "bob"), PASSWORD, FAILED), (("remove", "bob"), "", FAILED),
                                   (("token", "bob"), "", FAILED)):
            done = self.operator(*words, given=given + "\n")
            self.assertEqual(done.returncode, code, f"{words}: {done.stdout}{done.stderr}")
            self.assertEqual(self.accounts.read_text(encoding="utf-8"), before, words)

    def test_a_file_that_others_can_read_is_refused_with_the_remedy(self):
        self.operator("add", "anna", "--role", "viewer", given=PASSWORD + "\n")
        self.accounts.chmod(0o644)
        refused = self.operator("list")
        self.assertEqual(refused.returncode, FAILED)
        self.assertIn("chmod 600", refused.stderr)


class Daemon(World):
    def start(self, *more):
        started = subprocess.Popen(
            [PROGRAM, "--mission", MISSION, "--vehicle", "udpin://127.0.0.1:0", "--journal",
             str(self.folder / "godwit.db"), "--trace", str(self.folder / "trace"), "--accounts", str(self.accounts),
             *more], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.addCleanup(self.kill, started)
        self.until(lambda: self.ctl("status").returncode == OK)
        return started

    def kill(self, started):
        started.kill()
        if not started.stdout.closed:
            started.communicate()

    def say(self, **line):
        with socket.socket(socket.AF_UNIX) as way_in:
            way_in.settimeout(PATIENCE_S)
            way_in.connect(str(self.folder / "godwit.control"))
            way_in.sendall((json.dumps(line) + "\n").encode())
            return json.loads(way_in.makefile().readline())

    def ctl(self, *words, user="anna"):
        return self.run_it("ctl", *words, "--journal", str(self.folder / "godwit.db"), user=user)

    def until(self, condition):
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            if condition():
                return
            time.sleep(0.05)
        self.fail("it did not come")

    def audit(self):
        return json.loads(self.ctl("audit", "--json").stdout)["rows"]


class Running(Daemon):
    def test_one_has_control_and_all_that_is_said_stands_in_the_audit_after_a_kill_too(self):
        godwitd = self.start()
        self.assertEqual(self.ctl("control", "take").stdout, "anna has control\n")
        refused = self.ctl("resume", user="bob")
        self.assertEqual(refused.returncode, FAILED)
        self.assertIn("anna has control", refused.stderr)
        self.assertIn("no flight is under way", self.ctl("pause", user="bob").stderr, "a hold is the executor's to refuse")
        self.assertEqual(self.ctl("control", "take", user="bob").returncode, FAILED)
        self.assertEqual(self.ctl("control", "take-over", user="bob").stdout, "bob has control\n")
        self.assertEqual(self.ctl("control", "give", user="bob").stdout, "control is free\n")
        rows = [(each["who"]["name"], each["what"], each["outcome"]) for each in self.audit()]
        self.assertEqual(rows, [("anna", "take control", "done"), ("bob", "resume", "no_control"),
                                ("bob", "pause", "refused"), ("bob", "take control", "refused"),
                                ("bob", "take over control from anna", "done"), ("bob", "give control", "done")])
        self.ctl("control", "take")
        self.kill(godwitd)
        self.start()
        self.assertIn("anna has control", self.ctl("status").stdout, "behind a kill its holder has 10 s")
        self.assertEqual(len(self.audit()), len(rows) + 1)
        self.until(lambda: "control is free" in self.ctl("status").stdout)
        self.assertEqual(self.audit()[-1]["outcome"], "silent")

    def test_a_command_that_is_said_again_is_answered_the_same_after_a_kill_too(self):
        godwitd = self.start()
        line = {"do": "start", "by": "anna", "id": "anna-1"}
        first = self.say(**line)
        self.assertEqual(first["verdict"], "refused")
        self.assertEqual(self.say(**line), first)
        self.assertEqual(self.say(**{**line, "do": "resume"})["verdict"], "id_used")
        self.kill(godwitd)
        self.start()
        self.assertEqual(self.say(**line), first)
        self.assertEqual([each["outcome"] for each in self.audit()], ["refused", "repeated", "id_used", "repeated"])

    def test_a_command_that_is_late_or_was_meant_for_another_state_is_refused(self):
        self.start()
        line = {"do": "check", "by": "anna"}
        self.assertEqual(self.say(**line, valid_until_ns=1)["verdict"], "late")
        stale = self.say(**line, state="flying/none")
        self.assertEqual(stale["verdict"], "stale")
        self.assertEqual(stale["state"], json.loads(self.ctl("status", "--json").stdout)["flight"]["state"])
        self.assertEqual(self.say(**line, state=stale["state"])["verdict"], "taken")

    def test_a_link_to_log_in_is_in_no_file(self):
        self.start()
        link = self.ctl("login").stdout.strip()
        self.assertEqual(len(link), 43)
        time.sleep(0.3)  # the trace is flushed each 0.1 s
        for file in self.folder.rglob("*"):
            if file.is_file():
                self.assertNotIn(link.encode(), file.read_bytes(), file)


class OverHttp(Daemon):
    def open_port(self):
        self.operator("add", "anna", "--role", "operator", given=PASSWORD + "\n")
        godwitd = self.start("--operator-listen", "127.0.0.1:0")
        for line in godwitd.stdout:
            if found := re.search(r"http://127\.0\.0\.1:(\d+)/", line):
                self.port = int(found[1])
                return godwitd
        return self.fail("it opens no port")

    def ask(self, method, path, body=None, **headers):
        way = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE_S)
        if body is not None:
            headers["Content-Type"] = "application/json"
        way.request(method, "/api/v1/" + path, None if body is None else json.dumps(body), headers)
        answer = way.getresponse()
        text = answer.read()
        way.close()
        cookie = (answer.getheader("Set-Cookie") or "").split(";")[0]
        return answer.status, json.loads(text) if text else None, cookie

    def test_an_operator_logs_in_takes_control_and_is_heard_and_the_session_survives_a_kill(self):
        godwitd = self.open_port()
        status, who, cookie = self.ask("POST", "session", {"name": "anna", "password": PASSWORD})
        self.assertEqual((status, who["role"]), (201, "operator"))
        self.assertEqual(self.ask("POST", "control", {"act": "take"}, Cookie=cookie)[:2], (200, {"holder": "anna"}))
        self.assertIn("anna has control", self.ctl("resume", user="bob").stderr)
        self.assertEqual(self.ask("POST", "commands", {"id": "a1", "command": "pause"}, Cookie=cookie)[0], 409)
        self.kill(godwitd)
        self.open_port()
        self.assertEqual(self.ask("GET", "session", Cookie=cookie)[1]["name"], "anna")
        self.assertTrue(self.ask("GET", "control", Cookie=cookie)[1]["is_yours"])
        self.operator("passwd", "anna", given="another horse\n")
        self.until(lambda: self.ask("GET", "session", Cookie=cookie)[0] == 401)

    def test_a_wrong_password_is_answered_as_an_unknown_name_is(self):
        self.open_port()
        wrong = self.ask("POST", "session", {"name": "anna", "password": "wrong horse"})
        unknown = self.ask("POST", "session", {"name": "nobody", "password": "wrong horse"})
        self.assertEqual(wrong, unknown)
        self.assertEqual(wrong[0], 401)
        self.until(lambda: [each["outcome"] for each in self.audit()] == ["wrong_password"] * 2)
        self.assertEqual([each["who"]["name"] for each in self.audit()], ["anna", "nobody"])

    def test_a_link_and_the_token_of_a_program_are_ways_in_and_in_no_file(self):
        self.open_port()
        link = self.ctl("login").stdout.strip()
        status, who, cookie = self.ask("POST", "session", {"link": link})
        self.assertEqual((status, who["role"]), (201, "engineer"))
        self.assertEqual(self.ask("POST", "session", {"link": link})[0], 401)
        token = self.operator("token", "anna").stdout.strip()
        self.until(lambda: self.ask("GET", "session", Authorization="Bearer " + token)[0] == 200)
        self.assertEqual(self.ask("DELETE", "session", Cookie=cookie)[0], 204)
        time.sleep(0.3)  # the trace is flushed each 0.1 s
        secrets = [link.encode(), token.encode(), cookie.split("=")[1].encode(), PASSWORD.encode()]
        for file in self.folder.rglob("*"):
            if file.is_file():
                content = file.read_bytes()
                for secret in secrets:
                    self.assertNotIn(secret, content, file)


if __name__ == "__main__":
    unittest.main(verbosity=2)
