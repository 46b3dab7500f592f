"""`compare A B`: which cells have lost delay."""

import json
import unittest

import h5py
import numpy as np
from program import SPEC, Case, spec_with

REQUIREMENT = {"name": "middle", "where": "x >= 1.9 and x <= 2.1 and y >= 1.9 and y <= 2.1", "min_delay": 1}

LOST = """old.h5 -> new.h5: 25 cells

cells of the    before  after  left  joined
safe set            22     15     7       0
invariance set      22     15     7       0

partition  lost delay  left the set  now bounded  gained delay
a|b                22             7            0             0

partition a|b: the worst 3 of 22 cells that lost delay
  cell  x [m]  y [m]  before          after
     9      1      4  1 step (0.5 s)  not safe
    21      4      1  1 step (0.5 s)  not safe
    13      2      3  0 steps (0 s)   not safe

requirement middle: held, now FAILS

Worse: cells have lost delay.
"""

BETTER = """new.h5 -> old.h5: 25 cells

cells of the    before  after  left  joined
safe set            15     22     0       7
invariance set      15     22     0       7

partition  lost delay  left the set  now bounded  gained delay
a|b                 0             0            0            22

requirement middle: failed, now holds

Not worse: no cell has lost delay.
"""


class Cases(Case):
    def analyze_to(self, path, spec, *arguments):
        self.write("spec.json", spec)
        result = self.run_program("analyze", "spec.json", "-o", path, "--quiet", *arguments)
        self.assertIn(result.returncode, (0, 1), result.stderr)
        return path

    def compare(self, *arguments, code):
        result = self.run_program("compare", *arguments, "--json")
        self.assertEqual((result.stderr, result.returncode), (b"", code))
        return json.loads(result.stdout)

    def delays(self, path, partition=0):
        with h5py.File(self.folder / path) as file:
            stored = file["delay"]
            delays = stored[partition].astype(float)
            delays[stored[partition] == np.iinfo(stored.dtype).max] = np.inf
        return np.maximum(delays, -1)

    def test_text(self):
        self.analyze_to("old.h5", spec_with(requirements=[REQUIREMENT]))
        self.analyze_to("new.h5", spec_with(requirements=[REQUIREMENT], safe="x + y <= 4"))
        result = self.run_program("compare", "old.h5", "new.h5", "--limit", "3")
        self.assertEqual(result.stdout.decode(), LOST)
        self.assertEqual((result.stderr, result.returncode), (b"", 1))
        result = self.run_program("compare", "old.h5", "new.h5", "--quiet")
        self.assertEqual((result.stdout, result.stderr, result.returncode), (b"", b"", 1))
        self.assert_prints(BETTER, "compare", "new.h5", "old.h5")

    def test_counts_are_those_of_the_arrays(self):
        partitions = {"partitions": "all"}
        self.analyze_to("a.h5", spec_with(coordination=partitions))
        self.analyze_to("b.h5", spec_with(coordination=partitions, safe="x + y <= 6 and x != 2"))
        self.analyze_to("c.h5", spec_with(coordination=partitions, safe="x + y <= 9"))
        for before, after in ("ab", "ba", "ac", "ca", "bc", "cb"):
            for tolerance in (0, 1):
                with self.subTest(before=before, after=after, tolerance=tolerance):
                    self.check_counts(f"{before}.h5", f"{after}.h5", tolerance)

    def check_counts(self, before, after, tolerance):
        result = self.run_program("compare", before, after, "--json", "--tolerance", str(tolerance))
        found = json.loads(result.stdout)
        worse = False
        for index, partition in enumerate(found["partitions"]):
            old, new = self.delays(before, index), self.delays(after, index)
            tolerated = (old > new) & (new >= 0) & np.isfinite(old) & (old <= new + tolerance)
            lost = (old > new) & ~tolerated
            self.assertEqual(partition["lost"], lost.sum())
            self.assertEqual(partition["tolerated"], tolerated.sum())
            self.assertEqual(partition["gained"], (new > old).sum())
            self.assertEqual(partition["left"], ((old >= 0) & (new < 0)).sum())
            self.assertEqual(partition["now_bounded"], (np.isinf(old) & (new >= 0) & np.isfinite(new)).sum())
            self.assertEqual(len(partition["worst"]), min(5, lost.sum()))
            for cell in partition["worst"]:
                place = (int(cell["state"]["x"]), int(cell["state"]["y"]))
                self.assertTrue(lost[place])
                self.assertEqual(cell["cell"], place[0] * 5 + place[1])
                self.assertEqual(cell["before"], old[place] if np.isfinite(old[place]) else None)
                self.assertEqual(cell["before_status"], "steps" if np.isfinite(old[place]) else "unbounded")
            worse = worse or lost.any()
        self.assertEqual(found["worse"], worse)
        self.assertEqual(result.returncode, 1 if worse else 0)

    def test_json(self):
        self.analyze_to("old.h5", spec_with(requirements=[REQUIREMENT]))
        self.analyze_to("new.h5", spec_with(name="other", safe="x + y <= 6 and (x != 4 or y != 0)"))
        found = self.compare("old.h5", "new.h5", "--limit", "1", code=1)
        for file in ("before", "after"):
            self.assertRegex(found[file].pop("spec_sha256"), "^[0-9a-f]{64}$")
        self.assertEqual(
            found,
            {
                "before": {
                    "file": "old.h5",
                    "name": "small",
                    "only_partitions": [],
                    "only_requirements": ["middle"],
                },
                "after": {"file": "new.h5", "name": "other", "only_partitions": [], "only_requirements": []},
                "cells": 25,
                "tolerance": 0,
                "safe": {"before": 22, "after": 21, "left": 1, "joined": 0},
                "invariant": {"before": 22, "after": 21, "left": 1, "joined": 0},
                "partitions": [
                    {
                        "name": "a|b",
                        "name_before": "a|b",
                        "lost": 5,
                        "left": 1,
                        "now_bounded": 0,
                        "cut_off": 0,
                        "tolerated": 0,
                        "gained": 0,
                        "worst": [
                            {
                                "cell": 20,
                                "state": {"x": 4.0, "y": 0.0},
                                "before": 2,
                                "before_status": "steps",
                                "after": None,
                                "after_status": "not_safe",
                            }
                        ],
                    }
                ],
                "verdicts": [],
                "worse": True,
            },
        )

    def test_max_delay(self):
        self.analyze_to("whole.h5", SPEC)
        self.analyze_to("cut.h5", spec_with(coordination={"max_delay": 2}))
        result = self.run_program("compare", "whole.h5", "cut.h5")
        self.assertIn(
            """
partition a|b: 1 cell that lost delay
  cell  x [m]  y [m]  before           after
     0      0      0  3 steps (1.5 s)  at least 2 steps (1 s)
  1 cell of these has the delay at which max_delay stopped the later analysis: perhaps nothing is lost there.
""",
            result.stdout.decode(),
        )
        self.assertEqual(result.returncode, 1)
        self.assertEqual(self.compare("cut.h5", "whole.h5", code=0)["partitions"][0]["gained"], 1)

    def test_partitions_in_one_file_only(self):
        apart = {"name": "apart", "classes": []}
        self.analyze_to("a.h5", spec_with(coordination={"partitions": [{"name": "one", "classes": [["a", "b"]]}, apart]}))
        self.analyze_to("b.h5", SPEC)
        text = self.run_program("compare", "a.h5", "b.h5").stdout.decode()
        self.assertIn("\na|b (was: apart)  ", text)
        self.assertIn("\npartition one: only in a.h5\n", text)
        self.analyze_to("c.h5", spec_with(coordination={"partitions": [{"name": "all", "classes": [["a", "b"]]}]}))
        self.assert_fails(3, "no partition of b.h5 is in it (c.h5)", "compare", "b.h5", "c.h5")

    def test_more_cells_than_are_read_at_a_time(self):
        spec = spec_with(
            states=[{"name": "x", "lower": 0, "upper": 1199999, "step": 1}],
            inputs=[{"name": "u", "values": [0]}],
            agents=[{"name": "a", "inputs": ["u"]}],
            dynamics={"time": "discrete", "period": 1, "equations": {"x": "x + u"}},
            safe="x >= 0",
        )
        self.analyze_to("a.h5", spec)
        self.analyze_to("b.h5", dict(spec, safe="x < 1048570 or x > 1048580"))
        found = self.compare("a.h5", "b.h5", "--limit", "20", code=1)
        self.assertEqual([cell["cell"] for cell in found["partitions"][0]["worst"]], list(range(1048570, 1048581)))

    def test_grids_that_differ(self):
        self.analyze_to("a.h5", SPEC)
        self.analyze_to("b.h5", SPEC, "--set", "states.y.step=0.5")
        self.assert_fails(
            3, "expected the grid of y as in a.h5: 5 points, found 9 points (b.h5)", "compare", "a.h5", "b.h5"
        )
        self.analyze_to("b.h5", SPEC, "--set", "dynamics.period=1/4")
        self.assert_fails(
            3, "expected the period as in a.h5: 0.5 s, found 0.25 s (b.h5)", "compare", "a.h5", "b.h5"
        )

    def test_files_that_are_no_results(self):
        self.analyze_to("a.h5", SPEC)
        self.assert_fails(5, "cannot read the results: No such file or directory (b.h5)", "compare", "a.h5", "b.h5")
        self.assertEqual(self.run_program("compare", "spec.json", "a.h5").returncode, 3)

    def test_numbers_that_are_none(self):
        for option, most in (("--tolerance", 2147483646), ("--limit", 1000000)):
            for value in ("-1", "2.5", "few", ""):
                with self.subTest(option=option, value=value):
                    message = f"expected a whole number from 0 to {most}, found '{value}' ({option})"
                    self.assert_fails(2, message, "compare", "a.h5", "b.h5", option, value)


if __name__ == "__main__":
    unittest.main()
