"""Runs the program as a user does, in an empty folder of its own."""

import copy
import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["COORDREQ_PROGRAM"]
ROOT = pathlib.Path(os.environ["COORDREQ_ROOT"])
CONFIGS = ROOT / "configs"
SANITIZED = "COORDREQ_SANITIZED" in os.environ  # by scripts/sanitize; measures of memory mean nothing then

# Small and complete; tests change one thing in it.
SPEC = {
    "coordreq": 1,
    "name": "small",
    "states": [
        {"name": "x", "lower": 0, "upper": 4, "step": 1, "unit": "m", "outside": "unsafe"},
        {"name": "y", "lower": 0, "upper": 4, "step": 1, "unit": "m", "outside": "unsafe"},
    ],
    "inputs": [{"name": "u", "values": [-1, 0, 1]}, {"name": "v", "values": [-1, 0, 1]}],
    "agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
    "dynamics": {"time": "discrete", "period": 0.5, "unit": "s", "equations": {"x": "x + u", "y": "y + v"}},
    "safe": "x + y <= 6",
    "abstraction": {"cells": "half_open", "safe": "center"},
}


def spec_with(**changes):
    """SPEC with some top-level keys replaced; a key set to None is left out."""
    spec = copy.deepcopy(SPEC)
    spec.update(changes)
    return {key: value for key, value in spec.items() if value is not None}


def without_comments(text):
    """JSON text with // comments taken out; enough for our own example specs."""
    return re.sub(r"(?m)^\s*//.*$", "", text)


def without_warnings(stderr):
    """Standard error without the lines that advise on a spec, which tests of something else need not know."""
    return b"".join(line for line in stderr.splitlines(True) if not line.startswith(b"coordreq: warning: "))


def without_places(text):
    """Error lines without the place in the text of the spec, which tests of what is wrong need not know."""
    return re.sub(rb"; (?:line [0-9]+, column [0-9]+|set by [^\n]*)\)(?=\n|$)", b")", text)


class Case(unittest.TestCase):
    maxDiff = None
    shows_places = False
    replaces_unasked = True  # tests change a spec and analyse it again under its old name

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, content):
        """A file with text, bytes, or a spec given as a dictionary."""
        if isinstance(content, dict):
            content = json.dumps(content, indent=2)
        if isinstance(content, str):
            content = content.encode()
        (self.folder / name).write_bytes(content)
        return name

    def run_program(self, *arguments, stdin=b"", **options):
        if self.replaces_unasked and arguments[:1] == ("analyze",) and any(self.folder.glob("*.h5")):
            arguments = (*arguments, "--force")
        result = subprocess.run(
            [PROGRAM, *arguments], input=stdin, capture_output=True, cwd=self.folder, timeout=280, **options
        )
        # What is said after a minute depends on the machine.
        if isinstance(result.stderr, bytes) and not any(str(word).startswith("--progress") for word in arguments):
            result.stderr = b"".join(line for line in result.stderr.splitlines(True) if not line.endswith(b" so far\n"))
        if isinstance(result.stderr, bytes) and not self.shows_places:
            result.stderr = without_places(result.stderr)
        return result

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())

    def assert_fails(self, code, message, *arguments, stdin=b"", **options):
        """Exit code, one exact error line, the same with --json on standard output, and no file more than before."""
        before = self.files()
        result = self.run_program(*arguments, stdin=stdin, **options)
        self.assertEqual(result.stderr.decode(), f"coordreq: error: {message}\n")
        if "--json" in arguments:
            self.assert_is_error(result, code)
        else:
            self.assertEqual(result.stdout, b"")
        self.assertEqual(result.returncode, code)
        self.assertEqual(self.files(), before)

    def assert_is_error(self, result, code):
        """Standard output is the document of what standard error says."""
        document = json.loads(result.stdout)
        self.assertEqual(document.pop("exit_code"), code)
        lines = [document.pop("error"), *document.pop("more_errors", [])]
        self.assertEqual(document, {})
        told = without_places("".join(f"coordreq: error: {line}\n" for line in lines).encode())
        self.assertEqual(told, without_places(without_warnings(result.stderr)))

    def assert_prints(self, text, *arguments, **options):
        """Success, this exact text on standard output and nothing on standard error."""
        result = self.run_program(*arguments, **options)
        self.assertEqual(result.stderr.decode(), "")
        self.assertEqual(result.stdout.decode(), text)
        self.assertEqual(result.returncode, 0)

    def analyze(self, *arguments, stdin=b""):
        """The JSON summary of a successful run."""
        result = self.run_program("analyze", *arguments, "--json", stdin=stdin)
        self.assertEqual(without_warnings(result.stderr).decode(), "")
        self.assertEqual(result.returncode, 0)
        return json.loads(result.stdout)
