#!/usr/bin/python3
"""The demo as its user runs it: whole missions with a replan, a crash and a kill in flight. Three combinations of
vehicle and mission; with GODWIT_FULL all of them.

usage: demo_test.py FOLDER_OF_PROGRAMS"""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PATIENCE_S = 180
SOME = [("px4", "survey.json"), ("ardupilot", "delivery.json"), ("rover", "patrol.json")]
ALL = [
    (who, what) for who in ("px4", "ardupilot", "rover") for what in ("survey.json", "delivery.json", "patrol.json")
] + [("px4", "qgc_survey.plan")]
PROGRAMS = sys.argv.pop(1)


class Demo(unittest.TestCase):
    def fly(self, who, what):
        with tempfile.TemporaryDirectory() as folder:
            summary = Path(folder, "summary.json")
            words = ["--bin", PROGRAMS, "--personality", who, "--mission", str(ROOT / "missions" / what)]
            run = subprocess.run(
                [str(ROOT / "scripts" / "demo"), *words, "--summary", str(summary)],
                capture_output=True,
                text=True,
                timeout=PATIENCE_S,
            )
            self.assertEqual(run.returncode, 0, f"{who} {what}\n{run.stdout}\n{run.stderr}")
            return json.loads(summary.read_text(encoding="utf-8"))

    def test_a_mission_is_flown_through_a_replan_a_crash_and_a_kill_and_each_report_is_delivered_once(self):
        for who, what in ALL if os.environ.get("GODWIT_FULL") else SOME:
            with self.subTest(vehicle=who, mission=what):
                told = self.fly(who, what)
                self.assertEqual(told["outcome"], "complete")
                self.assertGreater(told["items_flown"], 0)
                self.assertEqual((told["reports_doubled"], told["reports_lost"]), (0, 0))
                self.assertEqual((told["actor_restarts"], told["process_kills"]), (1, 1))
                self.assertGreater(told["observations_pushed"], 0)


if __name__ == "__main__":
    unittest.main()
