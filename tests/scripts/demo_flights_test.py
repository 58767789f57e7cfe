#!/usr/bin/python3
"""The demo flies: demo_flights_test.py FOLDER_OF_PROGRAMS [TIMES_REAL_TIME].

Three combinations of vehicle and mission, and QGroundControl's plan; with TEST_FULL=1 each shipped mission with each
vehicle, and the search with a camera, in real time. Mission progress has to come whole over another tail, a crash and a kill; executor and failsafe, run again from
the trace, do the same; what is exported of a flight can be opened by others."""

import json
import os
import re
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
PROGRAMS = Path(sys.argv.pop(1)).resolve()
SPEED = sys.argv.pop(1) if len(sys.argv) > 1 else "20"
PATIENCE_S = 400
FEW = [("px4", "survey.json"), ("ardupilot", "delivery.json"), ("rover", "patrol.json"), ("px4", "qgc_survey.plan")]
SHIPPED = sorted(each.name for each in (ROOT / "missions").iterdir() if each.suffix in (".json", ".plan"))
ALL = [(who, what) for who in ("px4", "ardupilot", "rover") for what in SHIPPED]
KEYS = {"outcome", "items_flown", "reports_delivered", "reports_doubled", "reports_lost", "observations_pushed"}
KEYS |= {"actor_restarts", "process_kills", "seconds"}


def command(*words):
    return ["/usr/bin/python3", "-B", str(ROOT / "scripts/demo"), "--bin", str(PROGRAMS), "--speed", SPEED, *words]


def processes_of(folder):
    """The command lines that name FOLDER."""
    found = []
    for each in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            words = each.read_bytes().decode(errors="replace")
        except OSError:
            continue  # it has ended meanwhile
        if folder in words:
            found.append(words)
    return found


class Flights(unittest.TestCase):
    def fly(self, *words, look=None):
        """Returns the summary. LOOK: at the trace, while it is there."""
        with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as apart:
            summary = Path(folder) / "summary.json"
            kept = Path(apart) / "kept"
            environment = {**os.environ, "TMPDIR": folder}
            result = subprocess.run(
                command("--summary", str(summary), "--keep", str(kept), *words),
                capture_output=True,
                text=True,
                timeout=PATIENCE_S,
                check=False,
                env=environment,
            )
            self.assertEqual(result.returncode, 0, f"{words}\n{result.stdout}{result.stderr}")
            self.assertEqual([each.name for each in Path(folder).iterdir()], ["summary.json"])
            self.replay(kept / "trace")
            if look:
                look(kept / "trace")
            return json.loads(summary.read_text(encoding="utf-8"))

    def replay(self, trace):
        """What was recorded is done again. At the very edge of a time limit a flight in real time may come out
        differently (docs/decisions/trace-and-simulation.md); those in virtual time may not (test_flight_replay)."""
        for actor in ("executor", "failsafe"):
            result = subprocess.run(
                [PROGRAMS / "godwit-trace", "replay", actor, trace, "--all"],
                capture_output=True,
                text=True,
                timeout=PATIENCE_S,
                check=False,
            )
            said = f"{result.stdout}{result.stderr}"
            runs = re.findall(r"(\d+) messages? compared.*; (?:(no deviation)|(it deviates)|(\d+) deviations)", said)
            self.assertTrue(runs, said)
            for compared, none, one, many in runs:
                self.assertGreater(int(compared), 20, said)
                differing = 0 if none else 1 if one else int(many)
                self.assertLessEqual(differing, max(4, int(compared) // 50), said)

    def read_exports(self, trace):
        """Browser, Mermaid and a reader of trace events open what is exported."""
        result = subprocess.run(
            ["node", ROOT / "tests/peers/export_check.mjs", PROGRAMS / "godwit-trace", trace],
            capture_output=True,
            text=True,
            timeout=PATIENCE_S,
            check=False,
        )
        self.assertEqual(result.returncode, 0, f"{result.stdout}{result.stderr}")

    def test_each_report_is_delivered_once_over_another_tail_a_crash_and_a_kill(self):
        for personality, mission in ALL if os.environ.get("TEST_FULL") else FEW:
            with self.subTest(personality=personality, mission=mission):
                summary = self.fly("--personality", personality, "--mission", str(ROOT / "missions" / mission))
                self.assertEqual(set(summary), KEYS)
                self.assertEqual(summary["outcome"], "complete")
                self.assertEqual((summary["reports_doubled"], summary["reports_lost"]), (0, 0))
                self.assertEqual(summary["process_kills"], 1)
                self.assertGreaterEqual(summary["actor_restarts"], 1)
                self.assertGreater(summary["observations_pushed"], 0)

    @unittest.skipUnless(os.environ.get("TEST_FULL") and (PROGRAMS / "godwit-eyes").exists(), "real time: TEST_FULL=1")
    def test_a_search_finds_two_things_and_the_vehicle_flies_to_one_and_back(self):
        summary = self.fly("--camera", "--speed", "1")  # the last --speed counts
        self.assertEqual(set(summary), KEYS | {"eyes_kills", "decided", "visited", "pictures_delivered"})
        self.assertEqual((summary["outcome"], summary["reports_lost"]), ("complete", 0))
        self.assertEqual((summary["eyes_kills"], summary["decided"], summary["visited"]), (2, 2, 1))
        self.assertGreaterEqual(summary["pictures_delivered"], 2)

    def test_without_faults_nothing_is_restarted(self):
        summary = self.fly("--no-faults", look=self.read_exports)
        self.assertEqual((summary["actor_restarts"], summary["process_kills"]), (0, 0))


class Ends(unittest.TestCase):
    def test_ctrl_c_ends_all_that_it_has_started_and_leaves_no_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            environment = {**os.environ, "TMPDIR": folder}
            demo = subprocess.Popen(
                command(), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment
            )
            for line in demo.stdout:
                if "godwitd is started" in line:
                    break
            time.sleep(1)  # any moment of the flight will do
            demo.send_signal(2)
            demo.communicate(timeout=PATIENCE_S)
            self.assertEqual(demo.returncode, 1)
            self.assertEqual(os.listdir(folder), [])
            self.assertEqual(processes_of(folder), [])


if __name__ == "__main__":
    unittest.main()
