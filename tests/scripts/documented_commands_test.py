#!/usr/bin/python3
"""Each command of godwit that the documents show has options and subcommands that the program knows."""

import functools
import re
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
PROGRAMS = Path(sys.argv.pop())
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
COMMAND = re.compile(r"(?:^|[`\s/(])(?P<program>godwitd|godwit-(?:sim|trace|eyes|drill))(?P<words>(?:[ \t]+[^\n`|#;&>]*)?)", re.MULTILINE)
FENCE = re.compile(r"^```[^\n]*\n(.*?)^```", re.DOTALL | re.MULTILINE)
INLINE = re.compile(r"`[^`\n]+`")
SUBCOMMAND = re.compile(r"^  ([a-z][a-z-]+) {2,}", re.MULTILINE)


@functools.cache
def help_of(*command):
    program, *words = command
    done = subprocess.run([PROGRAMS / program, *words, "--help"], capture_output=True, text=True, timeout=60, check=True)
    return done.stdout


def subcommands(*command):
    _, _, named = help_of(*command).partition("Subcommands:")
    return set(SUBCOMMAND.findall(named.partition("Examples:")[0]))


def shown_commands(text):
    code = "\n".join([*FENCE.findall(text), *INLINE.findall(FENCE.sub("", text))]).replace("\\\n", " ")
    for match in COMMAND.finditer(code):
        yield match["program"], match["words"].split()


def options_of(command):
    """The help of each part of a command, for an option of `godwitd` may stand after `ctl status`."""
    return "".join(help_of(*command[:count]) for count in range(1, len(command) + 1))


class Documents(unittest.TestCase):
    def check(self, page, program, words):
        command = [program]
        for word in words:
            if not re.fullmatch(r"[a-z][a-z-]+", word) or not subcommands(*command):
                break
            if word not in subcommands(*command):
                if program != "godwitd" and len(command) == 1:
                    return  # prose: "godwit-trace reads it"
                break
            command.append(word)
        for option in {each.partition("=")[0].strip(",.)]'\"") for each in words if re.match(r"\[?--[a-z]", each)}:
            self.assertRegex(options_of(command), rf"(?m)[ ,]{re.escape(option.lstrip('['))}\b", f"{page}: {' '.join(command)}")

    def test_every_option_that_they_show_is_one_of_the_program(self):
        seen = 0
        for page in PAGES:
            for program, words in shown_commands(page.read_text(encoding="utf-8")):
                if not (PROGRAMS / program).is_file():
                    continue  # a build without it
                with self.subTest(page=page.name, command=f"{program} {' '.join(words)}"):
                    self.check(page.relative_to(ROOT), program, words)
                seen += 1
        self.assertGreater(seen, 100)

    def test_every_word_for_a_running_godwitd_is_one(self):
        known = subcommands("godwitd", "ctl")
        for page in PAGES:
            text = page.read_text(encoding="utf-8")
            for word in re.findall(r"\bgodwitd ctl ([a-z][a-z-]+)", text):
                self.assertIn(word, known, page.name)


if __name__ == "__main__":
    unittest.main()
