#!/usr/bin/python3
"""packaging/debian/no_exchange_in_flight, the preinst and prerm of godwit and godwit-eyes: what it refuses, and why."""

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
SCRIPT = ROOT / "packaging" / "debian" / "no_exchange_in_flight"
PATIENCE_S = 30


class Package(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory(prefix="godwit-package-")
        self.addCleanup(self.scratch.cleanup)
        self.folder = Path(self.scratch.name)
        (self.folder / "bin").mkdir()
        (self.folder / "state").mkdir()
        self.tool("deb-systemd-invoke", "exit 0")
        self.program = self.folder / "daemon" / "godwitd"
        self.program.parent.mkdir()
        shutil.copy("/bin/sleep", self.program)
        self.installed("exit 0")

    def installed(self, what):
        """A godwitd whose may-restart does WHAT; None: there is none."""
        program = self.folder / "bin" / "godwitd"
        program.unlink(missing_ok=True)
        if what is not None:
            self.tool("godwitd", f'echo "$PWD: $*" >>{self.folder}/asked\n{what}')

    def tool(self, name, what):
        program = self.folder / "bin" / name
        program.write_text(f"#!/bin/sh\n{what}\n", encoding="utf-8")
        program.chmod(0o755)

    def dpkg(self, name, *words, package="godwit"):
        text = SCRIPT.read_text(encoding="utf-8")
        for what, instead in (("programs=/usr/bin\n", f"programs={self.program.parent}\n"), ("/var/lib/godwit", self.folder / "state"),
                              ("/run/systemd/system", self.folder / "bin")):
            self.assertIn(what, text)
            text = text.replace(what, str(instead))
        tested = self.folder / name
        tested.write_text(text, encoding="utf-8")
        return subprocess.run(
            ["sh", str(tested), *words],
            capture_output=True,
            text=True,
            timeout=PATIENCE_S,
            check=False,
            env={
                "PATH": f"{self.folder}/bin:{os.environ['PATH']}",
                "DPKG_MAINTSCRIPT_NAME": name,
                "DPKG_MAINTSCRIPT_PACKAGE": package,
            },
        )

    def asked(self):
        told = self.folder / "asked"
        return told.read_text(encoding="utf-8") if told.exists() else ""

    def start_in(self, folder):
        running = subprocess.Popen([str(self.program), "60"], cwd=folder)
        self.addCleanup(running.wait)
        self.addCleanup(running.kill)
        return running

    def test_an_upgrade_in_flight_is_refused_with_a_sentence_for_the_daemon_and_for_its_helper(self):
        self.installed("echo a flight is under way: flying >&2; exit 1")
        for package in ("godwit", "godwit-eyes"):
            refused = self.dpkg("preinst", "upgrade", "0.1.0", "0.2.0", package=package)
            self.assertEqual(refused.returncode, 1)
            self.assertIn("a flight is under way: flying", refused.stderr)
            self.assertIn(f"{package}: the upgrade is refused while a flight is under way", refused.stderr)

    def test_a_removal_in_flight_is_refused_with_a_sentence(self):
        self.installed("exit 1")
        refused = self.dpkg("prerm", "remove", package="godwit-eyes")
        self.assertEqual(refused.returncode, 1)
        self.assertIn("the removal is refused while a flight is under way", refused.stderr)

    def test_a_removal_on_the_ground_stops_the_service_and_that_of_the_helper_does_not(self):
        self.tool("deb-systemd-invoke", f'echo "$*" >>{self.folder}/invoked')
        invoked = self.folder / "invoked"
        self.assertEqual(self.dpkg("prerm", "remove", package="godwit-eyes").returncode, 0)
        self.assertFalse(invoked.exists())
        self.assertEqual(self.dpkg("prerm", "remove").returncode, 0)
        self.assertEqual(invoked.read_text(encoding="utf-8"), "stop godwitd.service\n")
        self.installed("exit 1")
        self.assertEqual(self.dpkg("prerm", "remove").returncode, 1)
        self.assertEqual(invoked.read_text(encoding="utf-8"), "stop godwitd.service\n")

    def test_on_the_ground_the_service_is_asked_where_it_runs_and_nothing_is_refused(self):
        for words in (("preinst", "upgrade", "0.1.0", "0.2.0"), ("preinst", "upgrade", "0.1.0", "0.1.0"), ("prerm", "remove")):
            self.assertEqual(self.dpkg(*words).stderr, "")
            self.assertEqual(self.dpkg(*words).returncode, 0)
        question = f"{self.folder}/state: ctl may-restart --config /etc/godwit/godwit.json\n"
        self.assertEqual(self.asked(), 6 * question)

    def test_a_downgrade_is_refused_with_a_sentence_even_on_the_ground(self):
        refused = self.dpkg("preinst", "upgrade", "0.10.0", "0.9.0")
        self.assertEqual(refused.returncode, 1)
        self.assertIn("going back from 0.10.0 to 0.9.0 is refused: remove the package, move what is in", refused.stderr)

    def test_a_godwitd_that_somebody_started_in_another_folder_is_not_overlooked(self):
        other = self.start_in(self.folder)
        refused = self.dpkg("preinst", "upgrade", "0.1.0", "0.2.0")
        self.assertEqual(refused.returncode, 1)
        self.assertIn(f"process {other.pid} is a godwitd that runs in {self.folder}", refused.stderr)
        self.assertEqual(self.dpkg("prerm", "remove").returncode, 1)
        self.program.unlink()  # exchanged before, and still running
        self.assertEqual(self.dpkg("preinst", "upgrade", "0.1.0", "0.2.0").returncode, 1)

    def test_the_service_itself_is_not_another_one(self):
        self.start_in(self.folder / "state")
        self.assertEqual(self.dpkg("preinst", "upgrade", "0.1.0", "0.2.0").returncode, 0)
        self.assertNotEqual(self.asked(), "")

    def test_an_installation_and_what_undoes_a_refused_one_ask_nothing(self):
        self.installed("exit 1")
        for words in (("preinst", "install"), ("preinst", "abort-upgrade", "0.2.0"), ("prerm", "upgrade", "0.2.0"),
                      ("prerm", "failed-upgrade", "0.1.0", "0.2.0"), ("prerm", "deconfigure")):
            self.assertEqual(self.dpkg(*words).returncode, 0, words)
        self.assertEqual(self.asked(), "")

    def test_the_helper_alone_is_exchanged_where_no_daemon_is_installed(self):
        self.installed(None)
        self.assertEqual(self.dpkg("preinst", "upgrade", "0.1.0", "0.2.0", package="godwit-eyes").returncode, 0)


if __name__ == "__main__":
    unittest.main()
