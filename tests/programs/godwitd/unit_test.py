#!/usr/bin/python3
"""packaging/godwitd.service against the godwitd and the systemd that are here: unit_test.py PATH_TO_GODWITD."""
import configparser
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
ROOT = pathlib.Path(__file__).resolve().parents[3]
UNIT = ROOT / "packaging" / "godwitd.service"
PATIENCE_S = 60
INSTALLED = "/usr/bin/godwitd"
# Those of systemd.unit(5), systemd.service(5), systemd.exec(5) and systemd.resource-control(5), version 252, that may
# stand in the unit: a mistyped one is only a line in the log of systemd, and protects nothing.
KNOWN = {
    "Unit": "Description Documentation After StartLimitIntervalSec StartLimitBurst",
    "Service": """Type NotifyAccess ExecStart ExecReload WatchdogSec TimeoutStartSec TimeoutStopSec Restart RestartSec
        RestartPreventExitStatus User Group SupplementaryGroups StateDirectory StateDirectoryMode WorkingDirectory Environment
        LogsDirectory CacheDirectory ConfigurationDirectory UMask CapabilityBoundingSet NoNewPrivileges ProtectSystem ProtectHome
        PrivateTmp ProtectControlGroups ProtectKernelLogs ProtectKernelModules ProtectKernelTunables ProtectClock
        ProtectHostname DevicePolicy DeviceAllow RestrictAddressFamilies RestrictNamespaces RestrictRealtime
        RestrictSUIDSGID LockPersonality MemoryDenyWriteExecute SystemCallArchitectures SystemCallFilter
        SystemCallErrorNumber PrivateUsers PrivateMounts ProtectProc RemoveIPC MemoryMax MemorySwapMax TasksMax
        LimitNOFILE LimitCORE OOMPolicy""",
    "Install": "WantedBy",
}


def parsed():
    unit = configparser.ConfigParser(strict=False, interpolation=None, delimiters=("=",))
    unit.optionxform = str
    unit.read_string(UNIT.read_text(encoding="utf-8"))
    return unit


class Unit(unittest.TestCase):
    def test_every_setting_is_one_of_systemd(self):
        unit = parsed()
        self.assertEqual(set(unit.sections()), set(KNOWN))
        for section in unit.sections():
            self.assertLessEqual(set(unit[section]), set(KNOWN[section].split()), section)

    @unittest.skipUnless(shutil.which("systemd-analyze"), "systemd is not installed")
    def test_systemd_itself_finds_nothing_wrong_with_it(self):
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder, "godwitd.service")
            copy.write_text(UNIT.read_text(encoding="utf-8").replace(INSTALLED, PROGRAM), encoding="utf-8")
            said = subprocess.run(["systemd-analyze", "verify", "--man=no", "--recursive-errors=no", str(copy)],
                                  capture_output=True, text=True, timeout=PATIENCE_S, check=False)
        self.assertNotIn(copy.name, said.stderr)
        self.assertEqual(said.returncode, 0, said.stderr)

    @unittest.skipUnless(shutil.which("systemd-analyze"), "systemd is not installed")
    def test_it_is_exposed_by_no_more_than_14_tenths(self):
        judged = subprocess.run(["systemd-analyze", "security", "--offline=true", "--no-pager", "--threshold=14",
                                 str(UNIT)], capture_output=True, text=True, timeout=PATIENCE_S, check=False)
        self.assertEqual(judged.returncode, 0, judged.stdout + judged.stderr)
        level = float(re.search(r"Overall exposure level for \S+: ([0-9.]+)", judged.stdout).group(1))
        self.assertLessEqual(level, 1.5)

    def test_its_memory_threads_and_core_dumps_are_bounded(self):
        service = parsed()["Service"]
        self.assertEqual(service["LimitCORE"], "0")
        self.assertIn("MemoryMax", service)
        self.assertIn("TasksMax", service)
        self.assertEqual(service["SystemCallErrorNumber"], "EPERM")

    def test_a_helper_that_takes_too_much_memory_does_not_end_the_unit(self):
        self.assertEqual(parsed()["Service"]["OOMPolicy"], "continue")

    def test_the_helper_may_make_itself_less_urgent_and_shut_itself_in_and_nobody_may_become_more_urgent(self):
        # configparser keeps the last line of a name; here all count, in their order.
        lines = re.findall(r"(?m)^SystemCallFilter=(.*)$", UNIT.read_text(encoding="utf-8"))
        self.assertEqual(lines, ["@system-service", "~@privileged @resources",
                                 "setpriority landlock_create_ruleset landlock_add_rule landlock_restrict_self"])
        self.assertEqual(parsed()["Service"]["CapabilityBoundingSet"], "")

    def test_every_option_of_its_command_line_is_one_of_godwitd(self):
        command = parsed()["Service"]["ExecStart"]
        self.assertTrue(command.startswith(INSTALLED + " "))
        known = subprocess.run([PROGRAM, "--help"], capture_output=True, text=True, timeout=PATIENCE_S).stdout
        for option in re.findall(r"--[a-z-]+", command):
            self.assertRegex(known, rf"(?m)^  {option}\b", option)

    def test_the_exit_codes_that_prevent_a_restart_are_documented_to_do_so(self):
        table = (ROOT / "docs" / "operations.md").read_text(encoding="utf-8")
        for code in parsed()["Service"]["RestartPreventExitStatus"].split():
            row = re.search(rf"(?m)^\| {code} \|.*$", table)
            self.assertIsNotNone(row, code)
            self.assertIn("not started again", row.group(0))

    def test_what_restarts_it_leaves_the_last_word_to_godwitd(self):
        # A limit of the service manager would count in flight too, where godwitd starts in any case.
        self.assertEqual(parsed()["Unit"]["StartLimitIntervalSec"], "0")

    def test_it_is_started_again_within_a_tenth_of_a_second(self):
        self.assertEqual(parsed()["Service"]["RestartSec"], "50ms")


if __name__ == "__main__":
    unittest.main()
