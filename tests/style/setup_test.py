"""`scripts/setup` asks for every package of its list, where none is installed."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPTS = pathlib.Path(sys.argv.pop()) / "scripts"


def listed():
    lines = (SCRIPTS / "packages.txt").read_text().splitlines()
    return [line.split()[0] for line in lines if line.strip() and not line.startswith("#")]


class Setup(unittest.TestCase):
    def asked_for(self, *purposes):
        """With tools of Debian that find nothing installed, and a root who installs nothing."""
        with tempfile.TemporaryDirectory() as folder:
            for name, body in (("dpkg-query", "exit 1"), ("apt-get", "exit 0"), ("sudo", "exit 0"), ("id", "echo 0")):
                path = pathlib.Path(folder, name)
                path.write_text(f"#!/bin/sh\n{body}\n")
                path.chmod(0o755)
            environment = dict(os.environ, PATH=folder + ":" + os.environ["PATH"])
            run = subprocess.run([SCRIPTS / "setup", *purposes], capture_output=True, text=True, env=environment)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        return run.stdout.splitlines()[0].partition("packages: ")[2].split()

    def test_all_packages(self):
        self.assertEqual(self.asked_for() + self.asked_for("fresh"), listed())

    def test_packages_of_a_purpose(self):
        parts = [self.asked_for(purpose) for purpose in ("build", "draw", "test", "fresh")]
        self.assertEqual(sum(parts, []), listed())
        self.assertIn("python3-matplotlib", parts[1])


if __name__ == "__main__":
    unittest.main()
