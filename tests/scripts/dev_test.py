#!/usr/bin/python3
"""`./dev` refuses what it does not know: usage on stderr, exit 2, before it installs or builds anything."""

import subprocess
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


if __name__ == "__main__":
    unittest.main()
