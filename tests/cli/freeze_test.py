"""Lists of digests by scripts/freeze: equal for one program, and what differs is named."""

import subprocess
import sys
import unittest

from program import PROGRAM, ROOT, Case


def freeze(*arguments):
    done = subprocess.run([sys.executable, "-B", ROOT / "scripts/freeze", *arguments], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout


class Cases(Case):
    def frozen(self, name):
        code, _ = freeze("--only", "crossing_risk", "--random", "1", "--jobs", "1", PROGRAM, self.folder / name)
        self.assertEqual(code, 0)
        return self.folder / name

    def test_two_lists_of_one_program_are_equal(self):
        lists = [self.frozen(name) for name in ("a", "b")]
        lines = lists[0].read_text(encoding="utf-8").splitlines()
        for what in ("crossing_risk threads 1: analyze", "crossing_risk threads 2: analyze, r.h5", "random0 threads 1: verify --json"):
            self.assertEqual(sum(line.endswith(" " + what) for line in lines), 1, what)
        self.assertEqual(freeze("--compare", *lists), (0, f"0 of {len(lines)} differ\n"))

    def test_what_differs_is_named(self):
        (self.folder / "a").write_text("12 x threads 1: info\n34 x threads 1: query\n", encoding="utf-8")
        (self.folder / "b").write_text("12 x threads 1: info\n35 x threads 1: query\n36 y threads 1: query\n", encoding="utf-8")
        self.assertEqual(freeze("--compare", self.folder / "a", self.folder / "b"),
                         (1, "x threads 1: query\ny threads 1: query\n2 of 2 differ\n"))  # fmt: skip


if __name__ == "__main__":
    unittest.main()
