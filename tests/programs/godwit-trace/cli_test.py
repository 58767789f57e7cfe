#!/usr/bin/python3
"""The command line of godwit-trace, tried as a person or a script would: cli_test.py PATH_TO_GODWIT_TRACE CAPTURES."""
import json
import os
import pathlib
import pty
import signal
import socket
import subprocess
import sys
import tempfile
import unittest

CAPTURES = pathlib.Path(sys.argv.pop(2)).resolve()
PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
FAILED, USAGE = 1, 2
PATIENCE_S = 60
HEARTBEAT = bytes.fromhex("fd09000000ffbe000000000000001208000403211a")


def run(*arguments, **more):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=PATIENCE_S, **more)


class Cli(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory(prefix="godwit-cli-")
        self.folder = pathlib.Path(self.scratch.name)

    def tearDown(self):
        self.scratch.cleanup()

    def assert_usage(self, result, *words):
        self.assertEqual(result.returncode, USAGE, result)
        self.assertEqual(result.stdout, "")
        for word in words:
            self.assertIn(word, result.stderr)


class Usage(Cli):
    def test_what_it_does_not_know_is_answered_with_the_usage(self):
        for arguments in ([], ["fly"], ["tlog"], ["tlog", "a", "b"], ["tlog", "a", "--jason"], ["tlog", "a", "--system", "256"],
                          ["tlog", "a", "--system", "x"], ["link"], ["link", "udpin://:1", "--seconds", "0"],
                          ["link", "udpin://:1", "--count", "0"],
                          ["link", "udpin://:1", "--heartbeat", "--no-heartbeat"]):
            with self.subTest(arguments):
                self.assert_usage(run(*arguments), "Usage:", "godwit-trace")

    def test_values_that_mean_nothing_are_named_with_what_is_meant(self):
        log = CAPTURES / "mavsdk_client_vs_passive.tlog"
        self.assert_usage(run("tlog", log, "--name", "heartbaet"), "HEARTBAET", "the nearest is HEARTBEAT")
        self.assert_usage(run("tlog", log, "--from", "soon"), "--from", "soon", "12.5")
        self.assert_usage(run("tlog", log, "--to", "2026-99-01T00:00:00Z"), "--to")
        self.assert_usage(run("link", "udp:/host:1"), "udpin://HOST:PORT", "serial://", "tcp://")
        self.assert_usage(run("link", "udpin://:1", "--as", "1"), "--as", "1/191")

    def test_help_goes_to_stdout_with_examples(self):
        for arguments in (["--help"], ["tlog", "--help"], ["link", "--help"]):
            with self.subTest(arguments):
                result = run(*arguments)
                self.assertEqual(result.returncode, 0)
                self.assertIn("Usage:", result.stdout)
                self.assertEqual(result.stderr, "")
        for command in ("tlog", "link"):
            self.assertIn(f"Examples:\n  godwit-trace {command} ", run(command, "--help").stdout)


class Tlog(Cli):
    def test_a_log_is_printed_a_line_a_message(self):
        result = run("tlog", CAPTURES / "mavsdk_client_vs_passive.tlog", "--name", "PING")
        self.assertEqual(result.returncode, 0, result)
        self.assertEqual(result.stdout, "2026-11-21T05:55:36.128114Z 245/190 PING                 "
                                        "time_usec=4658766484 seq=0 target_system=0 target_component=0\n")
        self.assertEqual(result.stderr, "")

    def test_options_may_be_repeated_and_name_several(self):
        log = CAPTURES / "mavsdk_client_vs_passive.tlog"
        result = run("tlog", log, "--json", "--name", "ping,heartbeat", "--name", "MISSION_C*", "--system", "245",
                     "--system", "7", "--component", "190")
        names = [json.loads(line)["name"] for line in result.stdout.splitlines()]
        self.assertEqual({name: names.count(name) for name in names}, {"HEARTBEAT": 7, "PING": 1, "MISSION_COUNT": 5})

    def test_a_reader_that_goes_away_is_no_error(self):
        result = subprocess.run(["bash", "-c", '"$0" tlog "$1" | head -n 1; echo "${PIPESTATUS[0]}"', PROGRAM,
                                 str(CAPTURES / "px4_quad_mission.tlog")], capture_output=True, text=True,
                                timeout=PATIENCE_S)
        self.assertEqual(result.stdout.splitlines()[1:], ["0"])
        self.assertEqual(result.stderr, "")

    def test_a_full_disk_is_told(self):
        with open("/dev/full", "w", encoding="ascii") as full:
            result = subprocess.run([PROGRAM, "tlog", str(CAPTURES / "px4_quad_mission.tlog")], stdout=full,
                                    stderr=subprocess.PIPE, text=True, timeout=PATIENCE_S)
        self.assertEqual(result.returncode, FAILED)
        self.assertIn("No space left on device", result.stderr)

    def test_what_is_no_log_fails_with_a_sentence(self):
        for path, words in ((self.folder / "missing", "no such file"), (self.folder, "it is a folder"),
                            (CAPTURES / "README.md", "this is no .tlog")):
            result = run("tlog", path)
            self.assertEqual((result.returncode, result.stdout), (FAILED, ""))
            self.assertIn(f"godwit-trace: {path}: {words}", result.stderr)

    def test_a_file_that_may_not_be_read_is_told(self):
        if os.geteuid() == 0:
            self.skipTest("root may read everything")
        path = self.folder / "secret.tlog"
        path.write_bytes(b"x")
        path.chmod(0)
        result = run("tlog", path)
        self.assertEqual(result.returncode, FAILED)
        self.assertIn("Permission denied", result.stderr)


class Link(Cli):
    def start(self, *arguments, **more):
        process = subprocess.Popen([PROGRAM, "link", *arguments], stderr=subprocess.PIPE, text=True,
                                   **{"stdout": subprocess.PIPE, **more})
        self.addCleanup(process.stderr.close)
        if process.stdout:
            self.addCleanup(process.stdout.close)
        self.addCleanup(process.kill)
        return process

    def port_of(self, process):
        mark = "up: listening on udpin://127.0.0.1:"
        for line in process.stderr:
            if mark in line:
                return int(line.split(mark)[1])
        self.fail("it did not come up")

    def send(self, port, *datagrams):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as peer:
            for each in datagrams:
                peer.sendto(each, ("127.0.0.1", port))

    def test_it_shows_what_arrives_and_ends_at_the_count(self):
        process = self.start("udpin://127.0.0.1:0", "--count", "2")
        self.send(self.port_of(process), HEARTBEAT, HEARTBEAT)
        out, words = process.communicate(timeout=PATIENCE_S)
        self.assertEqual(process.returncode, 0)
        self.assertEqual(len(out.splitlines()), 2)
        self.assertIn(" 255/190 HEARTBEAT            type=18(ONBOARD_CONTROLLER) ", out)
        self.assertIn("2 frames, 42 bytes", words)

    def test_ctrl_c_ends_it_with_a_summary(self):
        for stop in (signal.SIGINT, signal.SIGTERM):
            process = self.start("udpin://127.0.0.1:0")
            self.send(self.port_of(process), HEARTBEAT)
            self.assertIn("HEARTBEAT", process.stdout.readline())
            process.send_signal(stop)
            _, words = process.communicate(timeout=PATIENCE_S)
            self.assertEqual(process.returncode, 0)
            self.assertIn("1 frames, 21 bytes", words)
            self.assertIn("passed over: nothing", words)

    def test_silence_until_the_end_is_a_failure(self):
        result = run("link", "udpin://127.0.0.1:0", "--seconds", "0.05")
        self.assertEqual(result.returncode, FAILED)
        self.assertIn("not one MAVLink 2 frame was heard", result.stderr)

    def test_a_heartbeat_goes_out_to_udpout_and_not_without_being_told(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as peer:
            peer.bind(("127.0.0.1", 0))
            peer.settimeout(PATIENCE_S)
            process = self.start(f"udpout://127.0.0.1:{peer.getsockname()[1]}", "--as", "1/192")
            frame, _ = peer.recvfrom(300)
            self.assertEqual((frame[0], frame[5], frame[6], frame[7:10]), (0xFD, 1, 192, b"\0\0\0"))
            process.send_signal(signal.SIGINT)
            _, words = process.communicate(timeout=PATIENCE_S)
            self.assertIn("sending a heartbeat each second as 1/192", words)

    def test_a_key_that_others_can_read_is_refused(self):
        key = self.folder / "key"
        key.write_text("01" * 32)
        key.chmod(0o644)
        result = run("link", "udpin://127.0.0.1:0", "--key", key)
        self.assertEqual(result.returncode, FAILED)
        self.assertIn("chmod 600", result.stderr)

    def test_a_terminal_shows_the_table_while_it_changes(self):
        ours, theirs = pty.openpty()
        self.addCleanup(os.close, ours)
        process = self.start("udpin://127.0.0.1:0", "--stats", stdout=theirs)
        os.close(theirs)
        self.send(self.port_of(process), HEARTBEAT)
        shown = b""
        while b"HEARTBEAT" not in shown:
            shown += os.read(ours, 4096)
        self.assertIn(b"\x1b[H\x1b[2J", shown)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=PATIENCE_S), 0)


if __name__ == "__main__":
    unittest.main()
