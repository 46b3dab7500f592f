"""The figures of the examples, the paper's among them. The full-size intersection is in scripts/check_paper."""

import json
import unittest

from program import CONFIGS, Case, without_warnings


class Cases(Case):
    def summary(self, example):
        result = self.run_program("analyze", str(CONFIGS / f"{example}.json"), "--json", "-o", "out.h5")
        self.assertEqual((result.returncode, without_warnings(result.stderr)), (0, b""))
        return json.loads(result.stdout)

    def check(self, example, safe, invariant, iterations, layers, partition=0):
        summary = self.summary(example)
        self.assertEqual(
            (summary["safe"], summary["invariant"], summary["iterations"]), (safe, invariant, iterations)
        )
        found = summary["partitions"][partition]
        self.assertEqual(found["layers"][: len(layers)], layers)
        return found

    def test_gridworld_at_full_resolution(self):
        layers = [2345512, 2056068, 1551120, 1133160, 749280, 426360, 185136, 40200, 0]
        found = self.check("gridworld", 2351040, 2345512, 2, layers)
        self.assertEqual((found["F"], found["layers"]), (8, layers))
        self.assertEqual(found["max_delay_time"], 0.07)

    def test_gridworld_coarse(self):
        found = self.check("gridworld_coarse", 165920, 164552, 2, [164552, 124328, 58320, 17240, 0])
        self.assertEqual(found["F"], 4)

    def test_intersection_coarse(self):
        # Vehicles that leave fast enough never need to talk again.
        found = self.check("intersection_coarse", 275808, 265121, 6, [265121, 260808, 239011, 211112])
        self.assertEqual((found["F"], found["fixed_point"], found["max_delay_time"]), (20, 12648, None))

    def test_load(self):
        found = self.check("load", 2379, 2017, 8, [2017, 1659, 1277, 915])
        self.assertEqual((found["F"], found["fixed_point"]), (6, 0))

    def test_platoon(self):
        found = self.check("platoon", 162000, 28512, 74, [28512, 19440, 0])
        self.assertEqual(found["F"], 2)

    def test_aircraft_coarse(self):
        summary = self.summary("aircraft_coarse")
        self.assertEqual(summary["safe"], 10080)
        # Enclosures depend on the C library's last digits; more than the exact hull can never come out.
        self.assertLessEqual(summary["invariant"], 8700)
        self.assertGreaterEqual(summary["invariant"], 8600)


if __name__ == "__main__":
    unittest.main()
