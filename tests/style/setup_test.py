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
    def set_up(self, *purposes, known="exit 0", apt=""):
        """With tools of Debian that find nothing installed, and a root who only writes down what is installed."""
        tools = {"dpkg-query": "exit 1", "apt-get": 'echo "$@" >>"$0.log"; ' + apt, "apt-cache": known, "sudo": "exit 0", "id": "echo 0"}
        with tempfile.TemporaryDirectory() as folder:
            for name, body in tools.items():
                path = pathlib.Path(folder, name)
                path.write_text(f"#!/bin/sh\n{body}\n")
                path.chmod(0o755)
            environment = dict(os.environ, PATH=folder + ":" + os.environ["PATH"])
            run = subprocess.run([SCRIPTS / "setup", *purposes], capture_output=True, text=True, env=environment)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.output = run.stdout
            installed = pathlib.Path(folder, "apt-get.log").read_text().splitlines()[-1]
        return installed.partition("--no-install-recommends ")[2].split(), run.stderr

    def asked_for(self, *purposes):
        installed, errors = self.set_up(*purposes)
        self.assertEqual(errors, "")
        return installed

    def test_all_packages(self):
        self.assertEqual(self.asked_for() + self.asked_for("fresh"), listed())

    def test_packages_of_a_purpose(self):
        parts = [self.asked_for(purpose) for purpose in ("build", "draw", "test", "fresh")]
        self.assertEqual(sum(parts, []), listed())
        self.assertIn("python3-matplotlib", parts[1])

    def test_a_package_that_another_system_does_not_have(self):
        installed, errors = self.set_up("build", known='[ "$2" != libflint-arb-dev ]')
        self.assertEqual(installed, [name for name in self.asked_for("build") if name != "libflint-arb-dev"])
        self.assertEqual(errors, "setup: this system has no package libflint-arb-dev; going on without it\n")

    def test_it_says_first_what_it_downloads(self):
        plan = "0 upgraded, 93 newly installed, 0 to remove and 0 not upgraded.", "Need to get 104 MB of archives."
        shown = " ".join(f"echo '{line}';" for line in ("Reading lists", *plan))
        self.set_up("build", apt=f'case "$*" in *--assume-no*) {shown} exit 1 ;; esac')
        self.assertEqual(self.output.splitlines()[-3:-1], [f"setup: {line}" for line in plan])


if __name__ == "__main__":
    unittest.main()
