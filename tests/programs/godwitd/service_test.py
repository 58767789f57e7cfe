#!/usr/bin/python3
"""godwitd as a service manager, an operator and logrotate see it: service_test.py PATH_TO_GODWITD."""
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
MISSION = str(pathlib.Path(__file__).resolve().parents[2] / "data" / "missions" / "every_kind.json")
PATIENCE_S = 60
OK, FAILED, USAGE, UNKNOWN_STATE = 0, 1, 2, 72
STAMP = r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z"


class World(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="godwitd-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.running = []
        self.addCleanup(self.kill_all)

    def kill_all(self):
        for each in self.running:
            each.kill()
            each.communicate()

    def path(self, name):
        return str(self.folder / name)

    def words(self, *more):
        return [PROGRAM, "--mission", MISSION, "--vehicle", "udpin://127.0.0.1:0", "--journal", self.path("godwit.db"),
                "--trace", self.path("trace"), "--ground-run", *more]

    def environment(self, **more):
        clean = {name: text for name, text in os.environ.items() if not name.startswith(("GODWIT_", "NOTIFY_"))}
        return {**clean, **more}

    def start(self, *more, **variables):
        started = subprocess.Popen(self.words(*more), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                   env=self.environment(**variables))
        self.running.append(started)
        return started

    def run_it(self, *more):
        return subprocess.run(self.words(*more), capture_output=True, text=True, timeout=PATIENCE_S,
                              env=self.environment())

    def until(self, condition, what):
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            if condition():
                return
            time.sleep(0.005)
        self.fail(what)

    def until_it_says(self, running, text):
        said = []
        for line in running.stdout:
            said.append(line)
            if text in line:
                return "".join(said)
        self.fail(f"it ended without: {text}\n{''.join(said)}")

    def end(self, running):
        running.send_signal(signal.SIGTERM)
        rest, _ = running.communicate(timeout=PATIENCE_S)
        self.assertEqual(running.returncode, OK, rest)
        return rest


class Manager(World):
    def setUp(self):
        super().setUp()
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.socket.bind(self.path("notify"))
        self.socket.settimeout(PATIENCE_S)
        self.addCleanup(self.socket.close)

    def hears(self, wanted):
        heard = []
        while not heard or not heard[-1].startswith(wanted):
            heard.append(self.socket.recv(4096).decode())
        return heard

    def test_it_hears_ready_status_watchdog_reload_and_stop(self):
        godwitd = self.start("--log-file", self.path("log"), NOTIFY_SOCKET=self.path("notify"),
                             WATCHDOG_USEC="400000")
        self.assertEqual([line for line in self.hears("READY=1") if line.startswith("STATUS")], [])
        self.assertRegex(self.hears("STATUS=")[-1], r"^STATUS=mission [0-9a-f-]{36}: ")
        began = time.monotonic()
        for _ in range(5):
            self.hears("WATCHDOG=1")
        self.assertGreater(time.monotonic() - began, 0.5, "twice in the period, and not without a pause")
        godwitd.send_signal(signal.SIGHUP)
        self.assertRegex(self.hears("RELOADING=1")[-1], r"^RELOADING=1\nMONOTONIC_USEC=\d+$")
        self.hears("READY=1")
        self.end(godwitd)
        heard = self.hears("STOPPING=1")
        self.socket.setblocking(False)
        with self.assertRaises(BlockingIOError):
            self.socket.recv(4096)
        self.assertNotIn("READY=1", heard)

    def test_a_process_that_stands_still_is_not_called_alive(self):
        godwitd = self.start("--log-file", self.path("log"), NOTIFY_SOCKET=self.path("notify"),
                             WATCHDOG_USEC="100000")
        self.hears("WATCHDOG=1")
        godwitd.send_signal(signal.SIGSTOP)
        os.waitid(os.P_PID, godwitd.pid, os.WSTOPPED)
        self.socket.setblocking(False)
        with self.assertRaises(BlockingIOError):
            while True:
                self.socket.recv(4096)
        self.socket.settimeout(0.5)
        with self.assertRaises(TimeoutError):
            self.socket.recv(4096)
        self.socket.settimeout(PATIENCE_S)
        godwitd.send_signal(signal.SIGCONT)
        self.hears("WATCHDOG=1")
        self.end(godwitd)

    def test_a_start_that_fails_is_never_ready(self):
        pathlib.Path(self.path("godwit.map.db")).write_text("these are my notes", encoding="utf-8")
        godwitd = self.start(NOTIFY_SOCKET=self.path("notify"))
        godwitd.communicate(timeout=PATIENCE_S)
        self.assertEqual(godwitd.returncode, UNKNOWN_STATE)
        self.assertEqual(self.hears("STOPPING=1"), ["STOPPING=1"])

    def test_an_address_that_means_nothing_is_said_and_no_reason_not_to_start(self):
        godwitd = self.start(NOTIFY_SOCKET="vsock:2:99")
        self.until_it_says(godwitd, "NOTIFY_SOCKET")
        self.until_it_says(godwitd, "vehicle")
        self.end(godwitd)


class Log(World):
    def test_text_on_standard_output_has_bare_lines(self):
        godwitd = self.start()
        said = self.until_it_says(godwitd, "mission ")
        self.assertTrue(said.startswith("mission "), said)
        self.assertIn("ends: SIGTERM", self.end(godwitd))

    def test_json_is_one_object_a_line(self):
        godwitd = self.start("--log-format", "json")
        self.until_it_says(godwitd, "vehicle")
        lines = [json.loads(line) for line in self.end(godwitd).splitlines()]
        self.assertIn("ends: SIGTERM", [line["message"] for line in lines])
        for line in lines:
            self.assertEqual(list(line), ["time", "level", "part", "message"])
            self.assertRegex(line["time"], f"^{STAMP}$")

    def test_sighup_goes_on_in_a_new_file_of_the_same_name(self):
        log = pathlib.Path(self.path("godwitd.log"))
        godwitd = self.start("--log-file", str(log), "--log-format", "text")
        self.until(lambda: log.exists() and "mission_file: mission " in log.read_text(encoding="utf-8"), "no log")
        moved = log.rename(self.path("godwitd.log.1"))
        godwitd.send_signal(signal.SIGHUP)
        self.until(lambda: log.exists() and "opened anew" in log.read_text(encoding="utf-8"), "no new log")
        self.assertEqual(self.end(godwitd), "", "all of it goes to the file")
        self.assertIn("ends: SIGTERM", log.read_text(encoding="utf-8"))
        for line in (moved.read_text(encoding="utf-8") + log.read_text(encoding="utf-8")).splitlines():
            self.assertRegex(line, f"^({STAMP} (info|warning|error) [a-z_]+: |    )")

    def test_sighup_without_a_file_is_no_end(self):
        godwitd = self.start()
        self.until_it_says(godwitd, "mission ")
        godwitd.send_signal(signal.SIGHUP)
        self.until_it_says(godwitd, "SIGHUP: nothing to open anew")
        self.end(godwitd)

    def test_the_level_leaves_out_what_is_better(self):
        godwitd = self.start("--log-level", "error", NOTIFY_SOCKET="")  # which it says on stderr
        self.until_it_says(godwitd, "NOTIFY_SOCKET")
        self.assertNotIn("ends:", self.end(godwitd))

    def test_what_keeps_it_from_starting_is_in_the_log_too(self):
        pathlib.Path(self.path("godwit.db")).write_text("these are my notes", encoding="utf-8")
        ended = self.run_it("--log-file", self.path("log"), "--log-format", "json")
        self.assertIn("godwit.db", ended.stderr)
        last = json.loads(pathlib.Path(self.path("log")).read_text(encoding="utf-8").splitlines()[-1])
        self.assertEqual(last["level"], "error")
        self.assertIn("godwit.db", last["message"])

    def test_a_log_that_can_not_be_opened_is_a_reason_not_to_start(self):
        ended = self.run_it("--log-file", self.path("no/log"))
        self.assertEqual(ended.returncode, FAILED)
        self.assertIn("no/log", ended.stderr)
        self.assertFalse(pathlib.Path(self.path("godwit.db")).exists())


class Check(World):
    def check(self, *more):
        return self.run_it("--check-config", *more)

    def test_a_configuration_that_can_be_used_is_said_to_be_so_and_nothing_is_made(self):
        before = sorted(self.folder.iterdir())
        checked = self.check()
        self.assertEqual((checked.returncode, checked.stdout, checked.stderr),
                         (OK, "the configuration can be used\n", ""))
        self.assertEqual(sorted(self.folder.iterdir()), before)

    def test_every_file_that_can_not_be_used_is_blamed_on_its_option(self):
        pathlib.Path(self.path("token")).write_text("secret\n", encoding="utf-8")
        os.chmod(self.path("token"), 0o644)
        checked = subprocess.run(
            [PROGRAM, "--check-config", "--service", "https://missions.example.org", "--vehicle",
             "udpin://127.0.0.1:0", "--mission-id", "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42", "--token-file",
             self.path("token"), "--ca-file", self.path("ca.pem"), "--signing-key", self.path("key"), "--sightings",
             self.path("seen"), "--journal", self.path("no/godwit.db"), "--log-file", self.path("nor/log")],
            capture_output=True, text=True, timeout=PATIENCE_S, env=self.environment())
        self.assertEqual((checked.returncode, checked.stdout), (USAGE, ""))
        blamed = re.findall(r"(?m)^godwitd: --([a-z-]+) \(", checked.stderr)
        self.assertEqual(blamed, ["token-file", "ca-file", "signing-key", "sightings", "journal", "log-file"])
        self.assertNotIn("secret", checked.stderr)

    def test_a_pipe_as_configuration_is_refused_and_not_waited_for(self):
        os.mkfifo(self.path("pipe.json"))
        for words in (["--config", self.path("pipe.json")], ["--mission", self.path("pipe.json")]):
            checked = subprocess.run([PROGRAM, "--check-config", "--vehicle", "udpin://127.0.0.1:0", "--journal",
                                      self.path("godwit.db"), *words], capture_output=True, text=True,
                                     timeout=PATIENCE_S, env=self.environment())
            self.assertEqual(checked.returncode, USAGE)
            self.assertIn("not a regular file", checked.stderr)

    def test_what_is_found_is_what_stops_a_start(self):
        pathlib.Path(self.path("file")).write_text("text", encoding="utf-8")
        for words in (["--control", self.path("no/control")], ["--control", self.path("file")],
                      ["--trace", self.path("file")], ["--map", self.path("godwit.db")]):
            checked = self.check(*words)
            self.assertEqual((checked.returncode, checked.stdout), (USAGE, ""), words)
            self.assertNotEqual(self.run_it(*words).returncode, OK, words)

    def test_a_model_of_the_camera_that_is_not_there_is_blamed(self):
        pathlib.Path(self.path("c.json")).write_text(json.dumps({"camera": {
            "uri": "test://ball", "width_px": 640, "height_px": 360, "focal_px": 550,
            "model": self.path("net.weights")}}), encoding="utf-8")
        checked = self.check("--config", self.path("c.json"))
        self.assertEqual(checked.returncode, USAGE)
        self.assertIn("camera.model: " + self.path("net.cfg") + " can not be read", checked.stderr)

    def test_a_mission_that_is_none_is_blamed(self):
        pathlib.Path(self.path("m.plan")).write_text("{}", encoding="utf-8")
        checked = subprocess.run([PROGRAM, "--check-config", "--mission", self.path("m.plan"), "--vehicle",
                                  "udpin://127.0.0.1:0", "--journal", self.path("godwit.db")], capture_output=True,
                                 text=True, timeout=PATIENCE_S, env=self.environment())
        self.assertEqual(checked.returncode, USAGE)
        self.assertIn("--mission (", checked.stderr)

    def test_all_mistakes_of_the_file_are_told_with_their_places(self):
        pathlib.Path(self.path("c.json")).write_text('{"log": {"level": "loud", "colour": 1}, "map": 3}',
                                                     encoding="utf-8")
        checked = self.check("--config", self.path("c.json"))
        self.assertEqual(checked.returncode, USAGE)
        for place in ("log.level", "log.colour", "map"):
            self.assertIn(place, checked.stderr.replace("/", "."))

    def test_state_that_can_not_be_taken_over_is_found_beside_what_is_running(self):
        godwitd = self.start()
        self.until_it_says(godwitd, "mission ")
        self.until(lambda: self.check().returncode == OK, "a journal in use is no problem")
        self.end(godwitd)
        pathlib.Path(self.path("godwit.map.db")).write_text("these are my notes", encoding="utf-8")
        checked = self.check()
        self.assertEqual(checked.returncode, USAGE)
        self.assertIn("--map (", checked.stderr)


class Restarts(World):
    def test_a_damaged_journal_is_left_alone_and_is_no_reason_to_start_again(self):
        self.end_at_once()
        journal = pathlib.Path(self.path("godwit.db"))
        content = bytearray(journal.read_bytes())
        content[4096:] = b"\xa5" * (len(content) - 4096)
        journal.write_bytes(content)
        ended = self.run_it()
        self.assertEqual(ended.returncode, UNKNOWN_STATE, ended.stderr)
        self.assertIn("damaged", ended.stderr)
        self.assertEqual(journal.read_bytes(), content)

    # After a downgrade: neither the journal's own tables nor those of a part of the program may be newer.
    def test_a_newer_journal_is_refused_with_a_sentence_left_alone_and_no_reason_to_start_again(self):
        journal = pathlib.Path(self.path("godwit.db"))
        table = "INSERT OR REPLACE INTO table_version SELECT name, 1000000 FROM table_version LIMIT 1"
        for change in ("PRAGMA user_version = 1000000", table):
            self.end_at_once()
            subprocess.run(["sqlite3", str(journal), change], check=True, timeout=PATIENCE_S)
            content = journal.read_bytes()
            ended = self.run_it()
            self.assertEqual(ended.returncode, UNKNOWN_STATE, ended.stderr)
            for part in (str(journal), "1000000", "Start the newer godwit that wrote it, or move the journal away"):
                self.assertIn(part, ended.stderr)
            self.assertEqual(journal.read_bytes(), content)
            os.remove(journal)

    def test_a_newer_map_is_refused_with_a_sentence_and_is_no_reason_to_start_again(self):
        for change in ("PRAGMA user_version = 1000000", "UPDATE schema_version SET version = 1000000"):
            self.end_at_once()
            subprocess.run(["sqlite3", self.path("godwit.map.db"), change], check=True, timeout=PATIENCE_S)
            ended = self.run_it()
            self.assertEqual(ended.returncode, UNKNOWN_STATE, ended.stderr)
            self.assertIn("godwit.map.db", ended.stderr)
            self.assertIn("1000000", ended.stderr)
            os.remove(self.path("godwit.map.db"))

    def test_after_five_kills_it_does_not_start_by_itself_and_a_person_can_start_it(self):
        pathlib.Path(self.path("godwit.json")).write_text('{"restarts": {"max_abnormal_ends": 5}}', encoding="utf-8")
        limited = ["--config", self.path("godwit.json")]
        for _ in range(5):
            godwitd = self.start(*limited)
            self.until_it_says(godwitd, "vehicle")
            godwitd.kill()
            godwitd.communicate(timeout=PATIENCE_S)
        ended = self.run_it(*limited)
        self.assertEqual(ended.returncode, UNKNOWN_STATE, ended.stderr)
        self.assertIn("5 times", ended.stderr)
        self.assertIn(self.path("godwit.starts"), ended.stderr)
        os.remove(self.path("godwit.starts"))
        self.end_at_once()

    def test_orderly_ends_do_not_count(self):
        for _ in range(7):
            self.end_at_once()
        self.assertEqual(self.starts(), 0)

    def starts(self):
        ledger = pathlib.Path(self.path("godwit.starts"))
        return len(ledger.read_text(encoding="utf-8").splitlines()) - 1 if ledger.exists() else 0

    def end_at_once(self):
        godwitd = self.start()
        self.until_it_says(godwitd, "vehicle")
        self.end(godwitd)


if __name__ == "__main__":
    unittest.main()
