#!/usr/bin/python3
"""The commands of godwit-trace about the actors, tried as a person would: trace_cli_test.py GODWIT_TRACE WRITE_TRACE DOC.

The examples of each --help are run as they stand there, and what `export` writes is read by other readers."""
import csv
import html.parser
import io
import json
import os
import pathlib
import pty
import random
import re
import resource
import shlex
import subprocess
import sys
import tempfile
import time
import unittest

DOC = pathlib.Path(sys.argv.pop(3)).resolve()
WRITE_TRACE = str(pathlib.Path(sys.argv.pop(2)).resolve())
PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
MESSAGES = 3000
COMMANDS = ("ls", "log", "show", "flow", "stats", "crashes", "flight", "verify", "export", "bundle")


class Trace(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="godwit-trace-")
        cls.folder = pathlib.Path(cls.scratch.name)
        subprocess.run([WRITE_TRACE, cls.folder / "trace", str(MESSAGES)], check=True, timeout=60)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def run_tool(self, *arguments, code=0):
        result = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=60, cwd=self.folder)
        self.assertEqual(result.returncode, code, result)
        return result.stdout

    def on_terminal(self, pager, *arguments):
        """What a person sees who runs it on a terminal, and how it ended."""
        ours, its = pty.openpty()
        environment = {**os.environ, "PAGER": pager}
        tool = subprocess.Popen([PROGRAM, *arguments], stdout=its, stderr=subprocess.DEVNULL, cwd=self.folder, env=environment)
        os.close(its)
        seen = b""
        try:
            while some := os.read(ours, 65536):
                seen += some
        except OSError:
            pass  # nobody writes to the terminal any more
        os.close(ours)
        return seen.decode().splitlines(), tool.wait(timeout=60)

    def test_on_a_terminal_a_pager_shows_what_is_long(self):
        plain, _ = self.on_terminal("sed s/^/shown:/", "--no-pager", "ls", "trace")
        self.assertGreater(len(plain), 3)
        shown, code = self.on_terminal("sed s/^/shown:/", "ls", "trace")
        self.assertEqual((shown, code), (["shown:" + line for line in plain], 0))
        self.assertEqual(self.on_terminal("cat", "ls", "trace"), (plain, 0))
        left, code = self.on_terminal("head -n 2", "log", "trace")
        self.assertEqual((len(left), code), (2, 0), "a person who leaves the pager is no error")

    def test_every_line_of_json_is_an_object(self):
        for command in ("ls", "log", "stats", "flight", "verify"):
            for line in self.run_tool(command, "trace", "--json").splitlines():
                self.assertIsInstance(json.loads(line), dict)
        self.assertEqual(len(self.run_tool("log", "trace", "--json").splitlines()), json.loads(
            self.run_tool("ls", "trace", "--json"))["runs"][0]["messages"])

    def test_perfetto_takes_each_slice_and_each_arrow_begins_in_one(self):
        events = json.loads(self.run_tool("export", "trace"))["traceEvents"]
        slices = {(each["tid"], each["ts"]) for each in events if each["ph"] == "X"}
        self.assertGreaterEqual(len(slices), MESSAGES)
        starts = [each for each in events if each["ph"] == "s"]
        ends = {each["id"] for each in events if each["ph"] == "f"}
        self.assertTrue(starts)
        for each in starts:
            self.assertIn((each["tid"], each["ts"]), slices)
            self.assertIn(each["id"], ends)

    def test_a_bound_is_kept_and_what_is_left_out_is_said(self):
        result = subprocess.run([PROGRAM, "export", "trace", "--limit", "10"], capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(sum(each["ph"] == "X" for each in json.loads(result.stdout)["traceEvents"]), 10)
        self.assertRegex(result.stderr, r"left out, because 10 is the bound of perfetto: \d+; --from")

    def test_csv_is_read_by_another_reader(self):
        rows = list(csv.DictReader(io.StringIO(self.run_tool("export", "trace", "--format", "csv"))))
        self.assertGreaterEqual(len(rows), MESSAGES)
        self.assertEqual(json.loads(rows[1]["message"])["lat"], 473977420)

    def test_mermaid_and_graphviz_have_the_form_of_their_languages(self):
        lines = self.run_tool("export", "trace", "--format", "mermaid", "--limit", "20").splitlines()
        self.assertEqual(lines[0], "sequenceDiagram")
        for line in lines[1:]:
            self.assertRegex(line, r"^  (participant a\d+ as [\w. ]+|a\d+(->>|-x)a\d+: [\w. ]+)$")
        graph = self.run_tool("export", "trace", "--format", "graphviz")
        self.assertTrue(graph.startswith("digraph actors {") and graph.endswith("}\n"))
        self.assertIn('"vehicle_link" -> "executor" [label=', graph)

    def test_the_report_is_one_page_that_asks_for_nothing(self):
        self.run_tool("export", "trace", "--format", "html", "-o", "flight.html")
        page = (self.folder / "flight.html").read_text(encoding="utf-8")
        self.assertEqual(os.stat(self.folder / "flight.html").st_mode & 0o777, 0o600)
        seen, open_tags = set(), []

        class Reader(html.parser.HTMLParser):
            def handle_starttag(self, tag, attrs):
                seen.add(tag)
                if tag != "meta":
                    open_tags.append(tag)
                for name, value in attrs:
                    assert name not in ("src", "href"), (name, value)

            def handle_startendtag(self, tag, attrs):
                seen.add(tag)

            def handle_endtag(self, tag):
                assert open_tags.pop() == tag, tag

        Reader().feed(page)
        self.assertEqual(open_tags, [])
        self.assertIn("polyline", seen)
        self.assertNotIn("script", seen)
        self.assertNotIn("http://", page)

    def test_what_is_added_is_followed_and_a_reader_that_goes_away_ends_it(self):
        folder = self.folder / "growing"
        folder.mkdir()
        follower = subprocess.Popen([PROGRAM, "log", folder, "--follow", "--json"], stdout=subprocess.PIPE)
        try:
            time.sleep(0.2)  # it looks from now on
            subprocess.run([WRITE_TRACE, folder, "1000", "now"], check=True, timeout=60)
            for _ in range(500):
                json.loads(follower.stdout.readline())
            follower.stdout.close()
            self.assertEqual(follower.wait(timeout=60), 0)
        finally:
            follower.kill()
            follower.wait()

    def test_after_a_kill_at_any_moment_all_that_was_flushed_is_read_and_the_cut_is_named(self):
        rounds = 100 if os.environ.get("TEST_FULL") else 10
        for n in range(rounds):
            folder = self.folder / f"killed{n}"
            folder.mkdir()
            writer = subprocess.Popen([WRITE_TRACE, folder, "1000000000"])
            time.sleep(0.02 + 0.1 * random.random())
            writer.kill()
            writer.wait()
            if not list(folder.iterdir()):
                continue  # killed before its first file
            seen = json.loads(self.run_tool("ls", folder, "--json"))
            self.assertTrue({each["kind"] for each in seen["losses"]} <= {"cut"}, seen["losses"])
            self.assertFalse(any(each["is_hole"] for each in seen["losses"]))
            numbers = [int(row["time_ns"]) for row in csv.DictReader(io.StringIO(
                self.run_tool("export", folder, "--format", "csv", "--limit", "100000")))]
            self.assertEqual(numbers, list(range(numbers[0], numbers[0] + 20_000 * len(numbers), 20_000)) if numbers else [])

    def test_a_promise_that_is_broken_is_exit_code_1(self):
        self.run_tool("verify", "trace")
        self.assertEqual(len(self.run_tool("verify", "--list").splitlines()), 18)

    def test_a_replay_without_settings_says_what_is_missing_and_is_exit_code_1(self):
        result = subprocess.run([PROGRAM, "replay", "executor", "trace"], capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("name its configuration with --settings", result.stderr)

    def test_memory_does_not_grow_with_the_trace(self):
        for command in (["ls"], ["stats"], ["verify"], ["log", "--outcome", "crashed"]):
            self.run_tool(*command, "trace")
        self.assertLess(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, 200 * 1024)

    def test_the_examples_of_each_help_run(self):
        for command in COMMANDS:
            text = self.run_tool(command, "--help")
            examples = re.findall(r"^  (godwit-trace .*)$", text, re.MULTILINE)
            self.assertTrue(examples, command)
            for example in examples:
                self.run_example(example)

    def test_bash_completes_what_help_knows(self):
        script = self.run_tool("completion", "bash") + """
complete_with() { COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _godwit_trace; echo "${COMPREPLY[*]}"; }
complete_with godwit-trace fl
complete_with godwit-trace log --fo
"""
        done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.stdout.split("\n")[:2], ["flow flight", "--follow"], done)
        self.assertTrue(self.run_tool("completion", "zsh").startswith("#compdef godwit-trace\n"))

    def test_the_manual_page_has_all_commands_and_options(self):
        page = self.run_tool("man").replace("\\-", "-")
        self.assertTrue(page.startswith(".TH GODWIT-TRACE 1"))
        for command in (*COMMANDS, "diff", "replay", "tlog", "link"):
            self.assertIn(f"\n.SS {command}\n", page)
            for option in re.findall(r"--[a-z]+", self.run_tool(command, "--help").split("Examples:")[0]):
                self.assertIn(option, page)

    def test_the_commands_of_the_document_are_those_of_the_program(self):
        named = set(re.findall(r"^\| `(\w+) [^|]*(?:TRACE|B)` \|", DOC.read_text(encoding="utf-8"), re.MULTILINE))
        self.assertEqual(named, set(COMMANDS) - {"bundle"} | {"diff", "replay"})

    def run_example(self, example):
        words = shlex.split(example.split("|")[0].split("#")[0].split(">")[0])[1:]
        words = ["trace" if "trace/" in word or word.endswith("/trace") else word for word in words]
        if words[0] in ("show", "flow"):
            words[1] = str((12 << 41) + 1)
        result = subprocess.run([PROGRAM, *words], capture_output=True, text=True, timeout=60, cwd=self.folder)
        self.assertEqual(result.returncode, 0, (example, result.stderr))


if __name__ == "__main__":
    unittest.main()
