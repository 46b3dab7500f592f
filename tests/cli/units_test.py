"""Warnings of units and scales that do not fit, and of what happens between the samples."""

import copy
import json
import unittest

from program import Case

# Two cars of 10 m/s that cross the same square of 2 m, looked at once a second.
TUNNEL = {
    "coordreq": 1,
    "name": "tunnel",
    "states": [
        {"name": name, "lower": -50, "upper": 50, "step": 1, "unit": "m", "outside": {"below": "unsafe", "above": "safe"}}
        for name in ("p1", "p2")
    ],
    "inputs": [{"name": name, "values": [10], "unit": "m/s"} for name in ("u1", "u2")],
    "agents": [{"name": "a", "inputs": ["u1"]}, {"name": "b", "inputs": ["u2"]}],
    "dynamics": {"time": "continuous", "period": 1, "unit": "s", "equations": {"p1": "u1", "p2": "u2"}},
    "safe": "not (abs(p1) < 1 and abs(p2) < 1)",
    "abstraction": {"cells": "half_open"},
}
# Robots on a rail.
RAIL = {
    "coordreq": 1,
    "name": "rail",
    "states": [{"name": name, "lower": 0, "upper": 20, "step": 0.25, "unit": "m", "outside": "saturate"} for name in ("p1", "p2")],
    "inputs": [{"name": name, "values": [-1, 0, 1], "unit": "m/s"} for name in ("v1", "v2")],
    "agents": [{"name": "left", "inputs": ["v1"]}, {"name": "right", "inputs": ["v2"]}],
    "dynamics": {"time": "continuous", "period": 0.5, "unit": "s", "equations": {"p1": "v1", "p2": "v2"}},
    "safe": "p2 - p1 >= 1",
    "abstraction": {"cells": "half_open"},
}
# A unicycle, whose heading is in degrees by mistake.
DEGREES = {
    "coordreq": 1,
    "name": "degrees",
    "states": [
        {"name": "x", "lower": -5, "upper": 5, "step": 0.5, "unit": "m", "outside": "saturate"},
        {"name": "th", "lower": -180, "upper": 180, "count": 36, "unit": "deg", "outside": "periodic"},
    ],
    "inputs": [{"name": "w", "values": [-30, 0, 30], "unit": "deg/s"}, {"name": "b", "values": [0, 1]}],
    "agents": [{"name": "one", "inputs": ["w"]}, {"name": "two", "inputs": ["b"]}],
    "dynamics": {"time": "continuous", "period": 0.5, "unit": "s", "equations": {"x": "cos(th) + 0.1*b", "th": "w"}},
    "safe": "abs(x) <= 4",
}


class Cases(Case):
    def answer(self, command, spec):
        self.write("spec.json", spec)
        result = self.run_program(command, "spec.json", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def told(self, command, spec, kind):
        return [(own["place"], own["message"]) for own in self.answer(command, spec)["warnings"] if own["kind"] == kind]

    def test_a_motion_that_passes_what_is_unsafe_between_the_samples(self):
        for command in ("analyze", "validate"):
            with self.subTest(command=command):
                ((place, message),) = self.told(command, TUNNEL, "between_samples")
                self.assertEqual(place, "/abstraction")
                self.assertRegex(
                    message,
                    r"^safety is asked only at samples, every 1 s: from p1 = -\d m, p2 = -\d m, with u1 = 10 m/s, u2 = 10 m/s, "
                    r"the motion to the next one is not safe, at p1 = [-0-9.]+ m, p2 = [-0-9.]+ m, and "
                    r'p1 moves by 10 m unseen; "between_samples": true asks for safety at all times$',
                )

    def test_the_motion_that_is_told_begins_in_the_invariance_set_and_really_passes(self):
        ((_, message),) = self.told("analyze", TUNNEL, "between_samples")
        start, passed = message.split("from ")[1].split(", with")[0], message.split("at p1")[1].split(", and")[0]
        p1, p2 = (float(text.split("=")[1].split()[0]) for text in start.split(","))
        answer = json.loads(self.run_program("query", "tunnel.h5", "--at", f"p1={p1:g},p2={p2:g}", "--json").stdout)
        self.assertTrue(answer["invariant"])
        x1, x2 = (float(text.split("=")[-1].split()[0]) for text in passed.split(","))
        self.assertTrue(p1 < x1 < p1 + 10 and abs(x1) < 1 and abs(x2) < 1)
        self.assertAlmostEqual(x1 - p1, x2 - p2)

    def test_asked_for_between_the_samples_nothing_is_passed(self):
        spec = dict(TUNNEL, abstraction={"cells": "half_open", "between_samples": True})
        self.assertEqual(self.told("analyze", spec, "between_samples"), [])
        slow = copy.deepcopy(TUNNEL)
        slow["dynamics"]["period"] = 0.1
        self.assertEqual(self.told("analyze", slow, "between_samples"), [])

    def test_the_guarantee_says_how_far_states_move_unseen(self):
        self.write("spec.json", TUNNEL)
        line = "samples: checked every 1 s only, for every point of a cell; between, p1 moves up to 10 m"
        for command in ("analyze", "validate"):
            self.assertRegex(self.run_program(command, "spec.json").stdout.decode(), rf"(?m)^guarantee +{line}$")
        self.write("spec.json", dict(TUNNEL, abstraction={"safe": "center"}))
        line = "samples-center: checked every 1 s only, where the centre of a cell is safe; between, p1 moves up to 10 m"
        self.assertRegex(self.run_program("validate", "spec.json").stdout.decode(), rf"(?m)^guarantee +{line}$")

    def test_how_far_each_state_moves(self):
        answer = self.answer("validate", RAIL)
        expected = [{"state": name, "amount": 0.5, "cells": 2, "share": 0.0246914} for name in ("p1", "p2")]
        self.assertEqual(answer["motion"], expected)
        self.assertEqual(self.answer("analyze", RAIL)["motion"], expected)
        table = self.run_program("validate", "spec.json").stdout.decode().split("\n\n")[1]
        self.assertEqual(
            table,
            "state  points  unit  outside   moves in a period at most  next value depends on\n"
            "p1         81  m     saturate  2 cells (2.47 %)           p1, v1\n"
            "p2         81  m     saturate  2 cells (2.47 %)           p2, v2",
        )

    def test_motion_is_the_greatest_of_inputs_states_and_disturbances(self):
        spec = copy.deepcopy(RAIL)
        spec["disturbances"] = [{"name": "w", "lower": -3, "upper": 3}]
        spec["dynamics"]["equations"] = {"p1": "v1 + w", "p2": "0.1*p2 + 0*v2"}
        motion = self.answer("validate", spec)["motion"]
        self.assertEqual(motion[0]["amount"], 2)
        self.assertAlmostEqual(motion[1]["amount"], 20.125 * 0.0512711, 5)  # e^0.05 - 1 from the outer face

    def test_how_tables_are_kept_is_told_on_request(self):
        self.write("spec.json", RAIL)
        short, long = (self.run_program("validate", "spec.json", *more).stdout.decode() for more in ([], ["--verbose"]))
        for word in ("table", "entries", "rows "):
            self.assertNotIn(word, short)
            self.assertIn(word, long)

    def test_a_period_in_another_unit(self):
        spec = copy.deepcopy(RAIL)
        spec["dynamics"].update(period=500, unit="ms")
        self.assertEqual(
            self.told("validate", spec, "scale"),
            [
                (
                    f"/states/{i}",
                    f"p{i + 1} moves by up to 500 m in a period of 500 ms, and its domain is 20.25 m long: is the period what was "
                    "meant, and in the unit of the equations?",
                )
                for i in (0, 1)
            ],
        )
        self.assertEqual(
            self.told("validate", spec, "units"),
            [
                (
                    f"/dynamics/equations/p{i}",
                    f"p{i} is in m and time in ms, so that its derivative is in m/ms, but v{i} is in m/s",
                )
                for i in (1, 2)
            ],
        )

    def test_units_that_do_not_fit(self):
        for units, fits in (
            (("m", "m/s", "s"), True),
            (("m", "km/h", "s"), False),
            (("km", "km/h", "h"), True),
            (("km", "km/h", "hours"), True),
            (("cm", "m/s", "s"), False),
            (("rad", "rad/s", "s"), True),
            (("rad", "deg/s", "s"), False),
            (("m/s", "m/s^2", "s"), True),
            (("m/s", "m s-2", "s"), True),
            (("m/s", "m/s", "s"), False),
            (("m", "furlong/s", "s"), True),
            (("parsec", "km/h", "s"), True),
            (("m", "km/h", ""), True),
        ):
            with self.subTest(units=units):
                spec = copy.deepcopy(RAIL)
                spec["states"][0]["unit"], spec["inputs"][0]["unit"], spec["dynamics"]["unit"] = units
                spec["states"][1]["unit"] = spec["inputs"][1]["unit"] = ""
                self.assertEqual(len(self.told("validate", spec, "units")), 0 if fits else 1)

    def test_what_a_constant_multiplies_may_be_converted(self):
        for equation, warned in (
            ("v1/3.6", 0),
            ("k*v1", 0),
            ("v1", 1),
            ("-v1", 1),
            ("v1 - p1*0", 1),
            ("v1*sin(p1)", 1),
            ("sin(p1)", 0),
            ("v1*v1", 1),
            ("min(v1, v1)", 1),
        ):
            with self.subTest(equation=equation):
                spec = copy.deepcopy(RAIL)
                spec["inputs"][0]["unit"] = "km/h"
                spec["constants"] = {"k": 0.28}
                spec["dynamics"]["equations"]["p1"] = equation
                self.assertEqual(len(self.told("validate", spec, "units")), warned)

    def test_sines_of_degrees(self):
        self.assertEqual(
            self.told("validate", DEGREES, "units"),
            [("/dynamics/equations/x", "cos takes radians, but th is in deg")],
        )

    def test_a_periodic_state_that_is_no_whole_number_of_turns(self):
        spec = copy.deepcopy(DEGREES)
        spec["states"][1]["unit"] = ""
        (warning,) = self.told("validate", spec, "units")
        self.assertEqual(
            warning,
            (
                "/dynamics/equations/x",
                "th is periodic, and over one period cos makes 57.2958 turns, no whole number: angles are in radians",
            ),
        )
        for equation in ("cos(th*pi/180)", "cos(3*th*pi/180)", "th"):
            spec["dynamics"]["equations"]["x"] = f"{equation} + 0.1*b"
            self.assertEqual(self.told("validate", spec, "units"), [], equation)
        spec["dynamics"]["equations"]["x"] = "cos(th*pi/360) + 0.1*b"
        self.assertEqual(len(self.told("validate", spec, "units")), 1)
        spec["dynamics"]["equations"]["x"] = "0.1*b"
        spec["safe"] = "abs(x) <= 4 and sin(th) <= 1"
        self.assertEqual([place for place, _ in self.told("validate", spec, "units")], ["/safe"])

    def test_a_discrete_state_may_jump(self):
        spec = copy.deepcopy(RAIL)
        spec["states"].append({"name": "n", "lower": 0, "upper": 1, "step": 1, "discrete": True, "outside": "saturate"})
        spec["dynamics"]["updates"] = {"n": "1 - n"}
        self.assertEqual(self.told("validate", spec, "scale"), [])


if __name__ == "__main__":
    unittest.main()
