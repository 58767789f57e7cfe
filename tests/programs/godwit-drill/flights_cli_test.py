#!/usr/bin/python3
"""The drills of flights, tried as a person or a script would: flights_cli_test.py PATH_TO_GODWIT_DRILL."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
FAILED, USAGE = 1, 2


def run(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=200)


class Flights(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory(prefix="godwit-cli-")
        self.folder = pathlib.Path(self.scratch.name)

    def tearDown(self):
        self.scratch.cleanup()

    def test_what_it_does_not_know_is_answered_with_the_usage(self):
        for arguments in (["simulate", "--seeds", "9..3"], ["simulate", "--seeds", "many"], ["actors", "--seeds", "3"],
                          ["simulate", "--personality", "zeppelin"], ["actors", "--jobs", "0"],
                          ["people", "--plant", "bombs"], ["actors", "--sample", "0"]):
            with self.subTest(arguments):
                result = run(*arguments)
                self.assertEqual(result.returncode, USAGE, result)
                self.assertEqual(result.stdout, "")

    def test_a_case_that_is_not_there_is_named(self):
        result = run("actors", "--only", "px4/flying/cook/after_handler")
        self.assertEqual(result.returncode, USAGE, result)
        self.assertIn("px4/flying/cook/after_handler", result.stderr)

    def test_flights_by_seed_end_with_a_table_and_a_document_that_agree(self):
        report = self.folder / "out.json"
        result = run("simulate", "--seeds", "1..6", "--jobs", "2", "--json", report)
        self.assertEqual(result.returncode, 0, result)
        for word in ("times real time", "takeovers", "lost", "doubled", "passed"):
            self.assertIn(word, result.stdout)
        document = json.loads(report.read_text())
        self.assertEqual(document["drill"], "simulate")
        self.assertEqual(document["total"]["flights"], 6)
        self.assertEqual(sum(each["flights"] for each in document["groups"]), 6)
        self.assertEqual((document["total"]["failed"], document["total"]["lost"], document["total"]["doubled"]),
                         (0, 0, 0))
        self.assertEqual(document["flights"], [])

    def test_how_many_fly_at_a_time_changes_nothing(self):
        totals = []
        for jobs in (1, 3):
            report = self.folder / f"{jobs}.json"
            self.assertEqual(run("simulate", "--seeds", "20..24", "--jobs", jobs, "--json", report).returncode, 0)
            totals.append(json.loads(report.read_text())["total"])
        totals = [{key: value for key, value in each.items() if key != "flown_s"} for each in totals]
        self.assertEqual(totals[0], totals[1])

    def test_a_flaw_is_told_with_its_story_and_the_command_that_finds_it_again(self):
        result = run("simulate", "--seeds", "1..2", "--plant", "lose_report")
        self.assertEqual(result.returncode, FAILED, result)
        self.assertIn("FAILED seed 1", result.stdout)
        self.assertIn("process 1", result.stdout)
        again = re.search(r"again: godwit-drill (.*)", result.stdout).group(1).split()
        repeated = run(*again)
        self.assertEqual(repeated.returncode, FAILED, repeated)
        self.assertIn("stands where 3 should", repeated.stdout)

    def test_a_failing_flight_is_flown_again_with_the_fewest_faults_that_it_needs(self):
        for plant in ("lose_report", "end_process"):
            with self.subTest(plant):
                result = run("simulate", "--seeds", "3", "--plant", plant)
                self.assertEqual(result.returncode, FAILED, result)
                shrunk = re.search(r"seed 3 fails with 0 of \d faults: godwit-drill (.*)", result.stdout)
                again = run(*shrunk.group(1).split())
                self.assertEqual(again.returncode, FAILED, again)
                self.assertNotIn("fails with", again.stdout)
                self.assertNotIn("killed at", again.stdout)

    def test_a_failing_flight_leaves_the_trace_of_its_actors(self):
        folder = self.folder / "traces"
        result = run("simulate", "--seeds", "1..2", "--plant", "lose_report", "--trace", folder)
        self.assertEqual(result.returncode, FAILED, result)
        self.assertIn(f"seed 1 has left its trace: godwit-trace log {folder}/seed_1", result.stdout)
        self.assertTrue(list((folder / "seed_1").glob("godwit-*.mcap")))

    def test_one_flight_leaves_its_trace_where_it_is_asked_for(self):
        folder = self.folder / "trace"
        result = run("simulate", "--seeds", "7", "--trace", folder)
        self.assertEqual(result.returncode, 0, result)
        self.assertTrue(list(folder.glob("godwit-*.mcap")))

    def test_each_drill_of_cases_flies_a_sample(self):
        for drill in ("actors", "process", "disk", "links", "people", "clock"):
            with self.subTest(drill):
                report = self.folder / f"{drill}.json"
                result = run(drill, "--personality", "rover", "--sample", "3", "--sample-seed", "5", "--json", report)
                self.assertEqual(result.returncode, 0, result)
                document = json.loads(report.read_text())
                self.assertEqual((document["drill"], document["total"]["flights"]), (drill, 3))

    def test_a_flight_that_ends_its_process_is_a_finding_of_that_flight(self):
        result = run("simulate", "--seeds", "1..3", "--jobs", "1", "--plant", "end_process")
        self.assertEqual(result.returncode, FAILED, result)
        for seed in (1, 2, 3):
            self.assertIn(f"FAILED seed {seed}", result.stdout)
        self.assertIn("its process was ended by signal 6", result.stdout)

    def test_one_case_tells_its_story_also_when_it_holds(self):
        result = run("people", "--only", "rover/flying/MANUAL")
        self.assertEqual(result.returncode, 0, result)
        self.assertIn("a pilot switches to mode 0", result.stdout)

    def test_a_sample_is_drawn_by_its_seed_and_says_so(self):
        names = []
        for seed in (3, 3, 4):
            report = self.folder / "sample.json"
            result = run("actors", "--personality", "rover", "--sample", "4", "--sample-seed", seed, "--json", report)
            self.assertEqual(result.returncode, 0, result)
            self.assertIn(f"--sample 4 --sample-seed {seed}", result.stdout)
            names.append(sorted(each["name"] for each in json.loads(report.read_text())["flights"]))
        self.assertEqual(names[0], names[1])
        self.assertNotEqual(names[0], names[2])

    def test_a_json_file_that_can_not_be_written_is_told(self):
        result = run("simulate", "--seeds", "1", "--json", self.folder / "missing" / "out.json")
        self.assertEqual(result.returncode, FAILED)
        self.assertIn("out.json", result.stderr)


if __name__ == "__main__":
    unittest.main()
