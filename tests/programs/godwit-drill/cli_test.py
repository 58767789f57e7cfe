#!/usr/bin/python3
"""The command line of godwit-drill, tried as a person or a script would: cli_test.py PATH_TO_GODWIT_DRILL."""
import json
import pathlib
import sqlite3
import subprocess
import sys
import tempfile
import unittest

PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
USAGE = 2


def run(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=120)


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

    def test_what_it_does_not_know_is_answered_with_the_usage(self):
        for arguments in ([], ["fly"], ["runtime", "--massages", "5"], ["runtime", "--messages", "many"],
                          ["runtime", "--messages", "0"], ["runtime", "--messages"], ["runtime", "extra"]):
            with self.subTest(arguments):
                self.assert_usage(run(*arguments), "Usage:", "runtime")

    def test_help_goes_to_stdout_and_is_no_error(self):
        for arguments in (["--help"], ["runtime", "--help"]):
            with self.subTest(arguments):
                result = run(*arguments)
                self.assertEqual(result.returncode, 0)
                self.assertIn("Usage:", result.stdout)
                self.assertEqual(result.stderr, "")
        for option in ("--messages", "--crashes", "--seed", "--json", "--journal"):
            self.assertIn(option, run("runtime", "--help").stdout)

    def test_all_errors_of_a_configuration_are_told_at_once(self):
        config = self.folder / "bad.json"
        config.write_text('{"trace": {"segment_mib": 99, "flush_ms": "soon"}, "sheduler": {}}')
        result = run("runtime", "--config", config)
        self.assert_usage(result, str(config), "segment_mib", "flush_ms", "sheduler")

    def test_a_configuration_that_is_not_there_is_named(self):
        self.assert_usage(run("runtime", "--config", self.folder / "missing.json"), str(self.folder / "missing.json"))

    def test_a_journal_that_is_there_already_is_refused(self):
        journal = self.folder / "kept.db"
        journal.write_text("precious")
        result = run("runtime", "--messages", "100", "--crashes", "0", "--journal", journal)
        self.assertEqual(result.returncode, 1)
        self.assertIn(str(journal), result.stderr)
        self.assertEqual(journal.read_text(), "precious")

    def test_a_journal_that_can_not_be_made_is_named(self):
        (self.folder / "file").write_text("not a folder")
        journal = self.folder / "file" / "drill.db"
        result = run("runtime", "--messages", "100", "--crashes", "0", "--journal", journal)
        self.assertEqual(result.returncode, 1)
        self.assertIn(str(journal), result.stderr)

    def test_a_json_file_that_can_not_be_written_is_told(self):
        result = run("runtime", "--messages", "100", "--crashes", "0", "--json", self.folder / "missing" / "out.json")
        self.assertEqual(result.returncode, 1)
        self.assertIn("out.json", result.stderr)

    def test_a_drill_leaves_a_table_a_json_file_and_a_journal_that_agree(self):
        journal, report, trace = self.folder / "drill.db", self.folder / "out.json", self.folder / "trace"
        result = run("runtime", "--messages", "5000", "--crashes", "20", "--seed", "3", "--journal", journal, "--json",
                     report, "--trace", trace)
        self.assertEqual(result.returncode, 0, result)
        for row in ("sent", "handled", "dead-lettered", "lost", "doubled", "restarts", "passed"):
            self.assertIn(row, result.stdout)
        counts = json.loads(report.read_text())
        self.assertEqual(counts["sent"], 5000)
        self.assertEqual(counts["sent"], counts["handled"] + counts["dead_lettered"] + counts["lost"])
        self.assertEqual((counts["lost"], counts["doubled"]), (0, 0))
        with sqlite3.connect(journal) as database:
            rows = database.execute("SELECT count(*), count(DISTINCT seq) FROM drill_effect").fetchone()
        self.assertEqual(rows, (500, 500))
        self.assertTrue(list(trace.glob("*.mcap")))

    def test_nothing_is_left_behind_that_nobody_asked_for(self):
        result = subprocess.run([PROGRAM, "runtime", "--messages", "100", "--crashes", "1"], capture_output=True,
                                text=True, timeout=120, cwd=self.folder, env={"TMPDIR": str(self.folder)})
        self.assertEqual(result.returncode, 0, result)
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
