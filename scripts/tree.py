"""What the check scripts share: the files of the tree, C++ without comments, a memory of passed checks, a report."""

import argparse
import hashlib
import json
import os
import re
import sys
import time
from pathlib import Path

SKIPPED_FOLDERS = {".git", "build", "node_modules", "__pycache__"}
CODE_FOLDERS = ("io", "runtime", "messages", "actors", "invariants", "programs", "tests")


class Check:
    """Collects failures of one check and reports them: one line when all is well, else a sentence for each failure."""

    def __init__(self, name):
        self.name = name
        self.failures = []
        self.started = time.monotonic()

    def fail(self, where, sentence):
        self.failures.append(f"{where}: {sentence}")

    def finish(self, summary):
        seconds = time.monotonic() - self.started
        for failure in sorted(set(self.failures)):
            print(f"  {failure}")
        if self.failures:
            print(f"{self.name}: FAILED, {len(set(self.failures))} places ({seconds:.1f} s)")
            return 1
        print(f"{self.name}: ok ({summary}, {seconds:.1f} s)")
        return 0


def arguments(description):
    parser = argparse.ArgumentParser(description=description)
    here = Path(__file__).resolve().parent.parent
    parser.add_argument("--root", type=Path, default=here, help="the tree to check (default: the one of this script)")
    return parser


def files(root, suffixes, folders=None):
    """All files below root with one of these suffixes, relative to root, sorted."""
    found = []
    for start in [root / folder for folder in folders] if folders else [root]:
        for place, inner, names in os.walk(start):
            inner[:] = [name for name in inner if name not in SKIPPED_FOLDERS]
            found += [Path(place, name).relative_to(root) for name in names if name.endswith(suffixes)]
    return sorted(found)


TOKEN = re.compile(
    r"""//[^\n]* | /\*.*?\*/ | R"(?P<mark>[^()\s\\]{0,16})\(.*?\)(?P=mark)" """
    r""" | (?P<include>^[ \t]*\#[ \t]*include[^\n]*) | "(?:\\.|[^"\\\n])*" | '(?:\\.|[^'\\\n])+' """,
    re.DOTALL | re.VERBOSE | re.MULTILINE,
)


def without_comments(code):
    """C++ with comments and literals blanked: words in them are not code. Lines keep their numbers."""

    def blank(match):
        if match.group("include"):
            return match.group(0)
        return re.sub(r"[^\n]", " ", match.group(0))

    return TOKEN.sub(blank, code)


class Memory:
    """Remembers which checks passed on which content, so that the next run does only what has changed.

    An entry holds the digest of each file that the check depended on. Only passed checks are remembered. Entries lie in
    the user's cache folder, so that another clone of the same content finds them.
    """

    def __init__(self, root, kind, tool):
        cache = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
        self.root = root.resolve()
        self.folder = Path(cache) / "godwit" / kind
        self.tool = tool
        self.digests = {}

    def entry(self, subject):
        return self.folder / hashlib.sha256(f"{subject}\n{self.tool}".encode()).hexdigest()

    def digest(self, path):
        if path not in self.digests:
            try:
                if path.startswith("/"):  # a header of a Debian package: time and size say enough
                    status = os.stat(path)
                    self.digests[path] = f"{status.st_size} {status.st_mtime_ns}"
                else:
                    self.digests[path] = hashlib.sha256((self.root / path).read_bytes()).hexdigest()
            except OSError:
                self.digests[path] = "missing"
        return self.digests[path]

    def relative(self, path):
        full = os.path.normpath(os.path.join(self.root, path))
        prefix = f"{self.root}/"
        return full[len(prefix):] if full.startswith(prefix) else full

    def passed(self, subject):
        try:
            known = json.loads(self.entry(subject).read_text())
            return bool(known) and all(self.digest(path) == digest for path, digest in known.items())
        except (OSError, ValueError, AttributeError):
            return False

    def remember(self, subject, depends_on):
        known = {path: self.digest(path) for path in map(self.relative, depends_on)}
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            scratch = self.folder / f"scratch.{os.getpid()}.{hashlib.sha256(str(subject).encode()).hexdigest()[:16]}"
            scratch.write_text(json.dumps(known))
            scratch.rename(self.entry(subject))
        except OSError as error:
            print(f"  (not remembered: {error})", file=sys.stderr)


def dependencies(makefile):
    """The files that a compiler's dependency output names."""
    _, _, names = makefile.replace("\\\n", " ").partition(": ")
    return names.split()
