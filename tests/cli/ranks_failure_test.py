"""Ranks that are killed, interrupted, or short of memory or disk: all end, one line says why, nothing is left."""

import os
import signal
import time
import unittest

from program import CONFIGS, SANITIZED, spec_with
from ranks_case import MPIRUN, RanksCase

MPICH = "mpich" in (MPIRUN or "")

FINE = spec_with(states=[{"name": name, "lower": 0, "upper": 1500, "step": 1, "outside": "unsafe"} for name in "xy"], safe="true")

# Takes more address space than a rank with 300 MB has left.
LARGE = spec_with(
    states=[{"name": name, "lower": 0, "upper": upper, "step": 1, "outside": "unsafe"} for name, upper in (("x", 20000), ("y", 8000))],
    safe="true",
)


class Cases(RanksCase):
    def start_long_run(self):
        """With several ranks that are at work for some seconds."""
        spec = str(CONFIGS / "intersection_network.json")
        process, ranks = self.start(3, "analyze", spec, "-o", "long.h5", "--refine", "3", "--progress", "none")
        self.assertEqual(len(ranks), 3)
        time.sleep(1)
        return process, ranks

    def assert_nothing_is_left(self, process, ranks):
        process.communicate(timeout=60)
        for rank in ranks:
            while os.path.exists(f"/proc/{rank}"):  # until the test's own limit
                time.sleep(0.01)
        self.assertEqual(self.files(), [])

    def test_a_rank_that_is_killed_ends_all(self):
        for which in (0, -1):
            with self.subTest(which=which):
                process, ranks = self.start_long_run()
                os.kill(ranks[which], signal.SIGKILL)
                self.assert_nothing_is_left(process, ranks)
                self.assertNotEqual(process.returncode, 0)

    def test_an_interrupt_ends_all(self):
        process, ranks = self.start_long_run()
        process.send_signal(signal.SIGTERM)
        self.assert_nothing_is_left(process, ranks)
        if not MPICH:  # its mpiexec at times returns 0, although the ranks returned 130
            self.assertNotEqual(process.returncode, 0)

    def temporary(self):
        return [name for name in self.files() if name.startswith(".coordreq-")]

    def killed_while_it_writes(self):
        """@returns whether the first rank was still there"""
        process, ranks = self.start(3, "analyze", "fine.json", "-o", "o.h5")
        # The file of the probe at the beginning is empty.
        while process.poll() is None and not any(self.is_filled(name) for name in self.temporary()):
            time.sleep(0.001)
        try:
            os.kill(ranks[0], signal.SIGKILL)
        except (IndexError, ProcessLookupError):
            pass
        process.communicate(timeout=60)
        return process.returncode != 0

    def test_the_first_rank_is_killed_while_it_writes(self):
        """What it leaves the next run removes."""
        self.write("fine.json", FINE)
        for _ in range(10):  # on a busy machine this process may be late
            if self.killed_while_it_writes():
                break
            (self.folder / "o.h5").unlink(missing_ok=True)
        self.assertNotIn("o.h5", self.files())
        self.assertEqual(self.run_ranks(2, "analyze", "fine.json", "-o", "o.h5").returncode, 0)
        self.assertEqual(self.files(), ["fine.json", "o.h5"])

    def is_filled(self, name):
        try:
            return (self.folder / name).stat().st_size > 0
        except FileNotFoundError:
            return False

    @unittest.skipIf(MPICH, "MPICH takes memory from files, which the limit is for too")
    def test_a_full_disk(self):
        self.write("fine.json", FINE)
        result = self.run_command(self.limited(3, 0, "ulimit -f 8", "analyze", "fine.json", "-o", "o.h5"))
        self.assert_one_error(result, 5, "cannot write the results: File too large (o.h5)")
        self.assertEqual(self.files(), ["fine.json"])

    @unittest.skipIf(SANITIZED, "sanitisers need address space of their own")
    def test_no_memory_on_one_rank(self):
        self.write("large.json", LARGE)
        result = self.run_command(self.limited(3, 1, "ulimit -v 300000", "analyze", "large.json", "-o", "o.h5"))
        advice = 'make the grids coarser, or find the need with "coordreq validate"'
        self.assert_one_error(result, 4, f"the system gave no more memory; {advice}")
        self.assertEqual(self.files(), ["large.json"])


if __name__ == "__main__":
    unittest.main()
