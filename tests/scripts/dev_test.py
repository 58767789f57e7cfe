#!/usr/bin/python3
"""`./dev` refuses what it does not know: usage on stderr, exit 2, before it installs or builds anything."""

import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent


def dev(*words):
    return subprocess.run(["./dev", *words], cwd=ROOT, capture_output=True, text=True, timeout=30, check=False)


class Dev(unittest.TestCase):
    def test_help_is_on_stdout(self):
        result = dev("help")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for command in ("demo", "test", "build", "drill", "bench", "lint", "fuzz", "format"):
            self.assertIn(f"\n  {command}", result.stdout)

    def test_unknown_words_are_refused_with_the_usage(self):
        for words in (
            (),
            ("tset",),
            ("--version",),
            ("build", "relase"),
            ("build", "release", "dev"),
            ("test", "--ful"),
            ("test", "nightly"),
            ("lint", "--fast"),
            ("lint", "--full", "x"),
            ("demo", "now"),
            ("format", "x.cpp"),
            ("fuzz", "long"),
            ("fuzz", "0"),
            ("fuzz", "5", "6"),
        ):
            result = dev(*words)
            self.assertEqual(result.returncode, 2, words)
            self.assertEqual(result.stdout, "", words)
            self.assertIn("usage: ./dev COMMAND", result.stderr, words)

    def test_the_unknown_word_is_named(self):
        self.assertIn("'tset'", dev("tset").stderr)
        self.assertIn("there are: dev release asan", dev("test", "nightly").stderr)


CASES = """<testsuites><testsuite name="odometer">
  <testcase name="counts" result="completed" time="0.1" classname="odometer"/>
  <testcase name="stops" result="completed" time="31.2" classname="odometer"><failure message="not stopped"/></testcase>
  <testcase name="is_off" result="suppressed" time="0" classname="odometer"/>
</testsuite></testsuites>"""
TESTS = """<testsuite>
  <testcase name="test_odometer.0" time="31.5" status="fail"/>
  <testcase name="test_odometer.1" time="2" status="fail"/>
  <testcase name="scripts.dev" time="3" status="run"/>
</testsuite>"""


class ReportOfTests(unittest.TestCase):
    def report(self):
        with tempfile.TemporaryDirectory() as folder:
            results = Path(folder, "test_results")
            results.mkdir()
            (results / "test_odometer.0.xml").write_text(CASES)
            junit = Path(folder, "test.xml")
            junit.write_text(TESTS)
            run = subprocess.run(["scripts/report_tests", folder, junit], cwd=ROOT, capture_output=True, text=True, check=True)
        return run.stdout.splitlines()

    def test_each_case_of_a_program_counts_and_is_named_when_it_fails(self):
        lines = self.report()
        self.assertIn("   FAILED: odometer.stops", lines)
        self.assertEqual(lines[-1], "   2 of 4 tests passed")

    def test_a_program_that_crashes_is_named_as_a_whole(self):
        self.assertIn("   FAILED: test_odometer.1", self.report())

    def test_a_slow_test_that_is_not_listed_is_named(self):
        self.assertIn("   31 s: odometer.stops (not listed in tests/slow_tests.txt)", self.report())


if __name__ == "__main__":
    unittest.main()
