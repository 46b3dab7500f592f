"""scripts/scaling --against: two programs beside each other."""

import re
import subprocess
import sys
import unittest

from program import PROGRAM, ROOT, Case


def against(*arguments):
    command = [sys.executable, "-B", ROOT / "scripts/scaling", "--against", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False)


class Cases(Case):
    def test_a_program_takes_what_it_takes(self):
        done = against(PROGRAM, "--only", "lane_change,swap", PROGRAM)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        rows = re.findall(r"(?m)^\| (\w+) \| ([0-9,.]+) \| ([0-9,.]+) \| ([0-9.]+) \|$", done.stdout)
        self.assertEqual([row[0] for row in rows], ["lane_change", "swap"])
        for _, then, now, ratio in rows:
            self.assertGreater(float(then.replace(",", "")), 1)
            self.assertAlmostEqual(float(now.replace(",", "")) / float(then.replace(",", "")), float(ratio), places=2)
            self.assertAlmostEqual(float(ratio), 1, delta=0.01)

    def test_a_commit_that_is_none_is_said(self):
        self.assertNotEqual(against("no-such-commit", PROGRAM).returncode, 0)


if __name__ == "__main__":
    unittest.main()
