"""scripts/mission_corpus says what became of each file, and counts what differs from the table. Argument: the folder of
the programs."""

import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "scripts" / "mission_corpus"
MISSIONS = ROOT / "tests" / "data" / "missions"
FILES = ("simple.plan", "structure.plan", "cut_off.plan")
ROWS = ("simple.plan\tpx4-multicopter\ttaken\tyes\t", "cut_off.plan\tpx4-multicopter\tbroken\t-\tit is cut off")
BIN = sys.argv.pop(1)


class Corpus(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        for name in FILES:
            shutil.copy(MISSIONS / name, self.folder)

    def run_with(self, rows=None):
        command = [sys.executable, str(SCRIPT), str(self.folder), "--bin", BIN]
        if rows is not None:
            table = self.folder / "expected.tsv"
            table.write_text("file\tvehicle\toutcome\tstarts\twhy\n" + "".join(row + "\n" for row in rows))
            command += ["--expected", str(table)]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def test_each_file_has_a_line_with_the_first_reason(self):
        done = self.run_with()
        self.assertEqual(done.returncode, 0)
        self.assertIn("taken    simple.plan\n", done.stdout)
        self.assertIn("in part  structure.plan  item ", done.stdout)
        self.assertIn("refused  cut_off.plan  ", done.stdout)
        self.assertTrue(done.stdout.endswith("1 in part, 1 refused, 1 taken\n"), done.stdout)

    def test_a_table_that_holds_has_no_differences(self):
        (self.folder / "structure.plan").unlink()
        done = self.run_with(ROWS)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertTrue(done.stdout.endswith("0 differences of 2\n"), done.stdout)

    def test_another_outcome_a_file_without_a_row_and_a_row_without_a_file_are_differences(self):
        rows = (ROWS[0].replace("taken", "fence"), ROWS[1], "gone.plan\tardurover\ttaken\tyes\t")
        done = self.run_with(rows)
        self.assertEqual(done.returncode, 1)
        self.assertIn("difference: simple.plan: taken, expected fence\n", done.stdout)
        self.assertIn("difference: structure.plan: has no row\n", done.stdout)
        self.assertIn("difference: gone.plan: has a row and is not there\n", done.stdout)
        self.assertTrue(done.stdout.endswith("3 differences of 4\n"), done.stdout)

    def test_a_guarded_command_is_to_be_refused_by_its_setting(self):
        (self.folder / "simple.plan").unlink()
        rows = ("structure.plan\tarducopter\tguarded\tyes\t", ROWS[1])
        done = self.run_with(rows)
        self.assertIn("difference: structure.plan: in part, expected guarded\n", done.stdout)


if __name__ == "__main__":
    unittest.main()
