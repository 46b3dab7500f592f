"""verify confirms right results of systems that are hard to enclose: all of their reachable sets, or it says why not."""

import json
import unittest

from magnitudes import complaint
from program import PROGRAM, Case
from random_systems import random_system


def state(name, lower, upper, step, **more):
    return dict({"name": name, "lower": lower, "upper": upper, "step": step}, **more)


def ring(name, count):
    return {"name": name, "lower": "-pi", "upper": "pi", "count": count, "outside": "periodic"}


def disturbance(name, size):
    return {"name": name, "lower": -size, "upper": size}


def system(states, equations, period, safe, disturbances=(), values=(-1, 0, 1), **more):
    """Continuous time, one agent with the input u."""
    return dict({
        "coordreq": 1,
        "name": "system",
        "states": states,
        "inputs": [{"name": "u", "values": list(values)}],
        "disturbances": list(disturbances),
        "agents": [{"name": "one", "inputs": ["u"]}],
        "dynamics": {"time": "continuous", "period": period, "equations": equations},
        "safe": safe,
    }, **more)  # fmt: skip


def boats(period):
    """A boat with its drag in a current that changes."""
    return system(
        [state("x", -4, 4, 1), state("y", -4, 4, 1), state("v", 0, 2, 0.25), ring("h", 12)],
        {"x": "v*cos(h) + c", "y": "v*sin(h) + d", "v": "1 + 0.5*u - 0.5*v*abs(v)", "h": "0.3*u"},
        period, "x^2 + y^2 >= 1", [disturbance("c", 0.1), disturbance("d", 0.1)],
    )  # fmt: skip


SYSTEMS = {
    "drag": system([state("v", -3, 3, 0.25)], {"v": "u - 0.25*v*abs(v) + w"}, 0.25, "abs(v) <= 2.6",
                   [disturbance("w", 0.2)], (-1, -0.5, 0, 0.5, 1)),
    "heading": system([state("x", -2, 2, 0.25), ring("h", 24)], {"x": "cos(h)", "h": "u + d"}, 0.25, "abs(x) <= 1.6",
                      [disturbance("d", 0.1)]),
    "pendulum": system([ring("a", 24), state("v", -2, 2, 0.25)], {"a": "v", "v": "-sin(a) + u + d"}, 0.2, "abs(v) <= 1.7",
                       [disturbance("d", 0.1)]),
    "stiff_pendulum": system([ring("a", 24), state("v", -2, 2, 0.25)], {"a": "v", "v": "-20*sin(a) - 10*v + u + d"}, 0.2,
                             "abs(v) <= 1.7", [disturbance("d", 0.1)]),
    "cubic": system([state("x", -2, 2, 0.1)], {"x": "-x^3 + d + 0.1*u"}, 0.25, "abs(x) <= 1.6", [disturbance("d", 0.3)]),
    "van_der_pol": system([state("x", -3, 3, 0.25), state("y", -3, 3, 0.25)], {"x": "y", "y": "(1 - x^2)*y - x + u"}, 0.5,
                          "abs(x) <= 2.5"),
    "unicycle": system([state("x", -2, 2, 0.5), state("y", -2, 2, 0.5), ring("h", 16)],
                       {"x": "cos(h) + d", "y": "sin(h) + e", "h": "u + f"}, 0.25, "x^2 + y^2 <= 3",
                       [disturbance("d", 0.1), disturbance("e", 0.1), disturbance("f", 0.1)]),
    "turning": system([ring("y", 24)], {"y": "2 + sin(y) + 0.1*u"}, 0.25, "true"),
    "escape": system([state("x", -3, 3, 0.25)], {"x": "x^3 + u + d"}, 0.5, "abs(x) <= 2.5", [disturbance("d", 0.1)]),
    "kink": system([state("v", -2, 2, 0.1), state("x", -1, 1, 0.25)], {"v": "abs(x - v^2) + 0.1*u", "x": "0"}, 0.2, "true"),
    "bearing": system([state("x", -2, 2, 0.5), state("y", -2, 2, 0.5)],
                      {"x": "u - 0.5*x - 0.3*atan2(y, x + 0.1*(x^2 + y^2) - 4)",
                       "y": "0.5*u - y + 0.2*mod(3*x, 2) + 0.1*floor(2*x)"}, 0.25, "x^2 + y^2 <= 3"),
    "corners": system([state("x", -2, 2, 0.25), state("y", -2, 2, 0.25)],
                      {"x": "abs(y) - abs(x) + u", "y": "max(x, y) - min(x^2, y)"}, 0.25, "abs(x) <= 1.6"),
}  # fmt: skip


class Cases(Case):
    def verified(self, spec, *arguments):
        """What verify says of a result as it is; None if there is none."""
        self.write("spec.json", spec)
        if self.run_program("analyze", "spec.json", "-o", "results.h5", "--quiet").returncode != 0:
            return None
        return self.run_program("verify", "results.h5", "--json", *arguments)

    def assert_confirmed(self, spec):
        """@returns how many reachable sets that are not exact"""
        result = self.verified(spec)
        summary = json.loads(result.stdout)
        doubts = [text for check in summary["checks"] for text in check["examples"] + check["doubts"]]
        self.assertEqual((summary["verdict"], doubts, result.returncode), ("holds", [], 0))
        confirmed = summary["confirmed"]
        self.assertEqual(confirmed["reachable_sets"], confirmed["of"])
        self.assertEqual(summary["not_independent"], [])
        return confirmed["of"]

    def test_disturbed_motion_is_confirmed(self):
        for name in ("drag", "heading", "pendulum", "cubic", "unicycle"):
            with self.subTest(system=name):
                self.assertGreater(self.assert_confirmed(SYSTEMS[name]), 0)

    def test_stiff_and_turning_motion_is_confirmed(self):
        for name in ("stiff_pendulum", "turning"):
            with self.subTest(system=name):
                self.assertGreater(self.assert_confirmed(SYSTEMS[name]), 0)

    def test_what_may_escape_beyond_an_unsafe_side_claims_nothing(self):
        self.assertEqual(self.assert_confirmed(SYSTEMS["escape"]), 25 * 3)

    def test_kinks_are_confirmed(self):
        for name in ("kink", "corners"):
            with self.subTest(system=name):
                self.assertGreater(self.assert_confirmed(SYSTEMS[name]), 0)

    def test_jumps_of_floor_mod_and_angles_are_confirmed(self):
        self.assertGreater(self.assert_confirmed(SYSTEMS["bearing"]), 0)
        runs = self.run_program("simulate", "results.h5", "--start", "random", "--runs", "100", "--steps", "20", "--json")
        self.assertEqual((json.loads(runs.stdout)["outcomes"]["completed"], runs.returncode), (100, 0))

    def test_motion_that_bends_much_within_a_period_is_confirmed(self):
        self.assert_confirmed(SYSTEMS["van_der_pol"])

    def test_boats_are_confirmed(self):
        for period in (1, 2):
            with self.subTest(period=period):
                self.assert_confirmed(boats(period))

    def test_a_shift_near_the_ends_of_indices_is_confirmed(self):
        """A ring that turns by all but as many cells as there are 32-bit numbers."""
        for shift in ("214748364.3", "-214748364.3", "429496729.7"):
            spec = system([ring("h", 24) | {"lower": 0, "upper": 1, "count": 10}], {"h": f"h + {shift} + 0.1*u"}, 1, "true")
            spec["dynamics"]["time"] = "discrete"
            with self.subTest(shift=shift):
                self.assert_confirmed(spec)
                self.assert_confirmed(dict(spec, output={"abstraction": True}))

    def test_wild_magnitudes_are_answered_or_refused(self):
        """A sample; `magnitudes.py PROGRAM` runs many."""
        happened = []
        for seed in (*range(8), 190):
            what, wrong = complaint(PROGRAM, seed, self.folder, 270)
            self.assertIsNone(wrong, f"{seed}: {wrong}")
            happened.append(what)
        self.assertIn("answered", happened)

    def check_random_systems(self, seeds):
        """A sample; `random_systems.py PROGRAM` runs all 500."""
        verdicts = {}
        for seed in seeds:
            result = self.verified(random_system(seed), "--budget", "5")
            verdicts[seed] = json.loads(result.stdout)["verdict"] if result else "refused"
        found = list(verdicts.values())
        self.assertNotIn("wrong", found, verdicts)
        self.assertGreaterEqual(found.count("holds"), 9, verdicts)

    def test_random_systems_are_confirmed(self):
        self.check_random_systems(range(124, 134))

    def test_more_random_systems_are_confirmed(self):
        self.check_random_systems(range(134, 144))


if __name__ == "__main__":
    unittest.main()
