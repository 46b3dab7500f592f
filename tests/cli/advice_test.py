"""Warnings: what is no error and can mislead, on standard error and in JSON."""

import json
import signal
import subprocess
import threading
import time
import unittest

import h5py

from program import CONFIGS, PROGRAM, ROOT, SPEC, Case, spec_with, without_comments, without_warnings

X, Y = SPEC["states"]


def without_outside(state):
    return {key: value for key, value in state.items() if key != "outside"}


class Cases(Case):
    def warnings(self, command, spec, *arguments):
        """Those in JSON, which are those on standard error; with --quiet there are none there."""
        self.write("spec.json", spec)
        result = self.run_program(command, "spec.json", "--json", *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        found = json.loads(result.stdout)["warnings"]
        lines = [
            f"coordreq: warning: {own['message']}" + (f" ({own['place']})" if own["place"] else "") for own in found
        ]
        self.assertEqual(result.stderr.decode().splitlines(), lines)
        quiet = self.run_program(command, "spec.json", "--quiet", *arguments)
        self.assertEqual((quiet.returncode, quiet.stdout, quiet.stderr), (0, b"", b""))
        return found

    def both(self, spec, *arguments):
        """What analyze and validate say alike: (kind, place) of each."""
        found = self.warnings("analyze", spec, *arguments)
        # validate knows K of small problems alone.
        found = [own for own in found if own["kind"] not in ("empty", "no_silence", "standing")]
        said = [own for own in self.warnings("validate", spec, *arguments) if own["kind"] != "standing"]
        self.assertEqual(said, found)
        return [(own["kind"], own["place"]) for own in found]

    def texts(self, command, spec, kind):
        return [own["message"] for own in self.warnings(command, spec) if own["kind"] == kind]

    def test_nothing_to_warn_of(self):
        self.assertEqual(self.both(SPEC), [])

    def test_a_step_that_does_not_divide_the_domain(self):
        spec = spec_with(states=[X, dict(Y, upper=4.5)])
        self.assertEqual(self.both(spec), [("grid", "/states/1")])
        self.assertEqual(
            self.texts("validate", spec, "grid"),
            [
                "the grid points of y go from 0 to 4 in steps of 1, not from 0 to 4.5, because the step does not "
                "divide that"
            ],
        )

    def test_an_origin_off_the_ends(self):
        self.assertEqual(self.both(spec_with(states=[X, dict(Y, origin=0.25)])), [("grid", "/states/1")])
        # The cells end where the domain does.
        self.assertEqual(self.both(spec_with(states=[X, dict(Y, origin=0.5)])), [])

    def test_inputs_that_miss_their_limits(self):
        u = {"name": "u", "lower": -1, "upper": 1, "step": 0.3}
        dynamics = dict(SPEC["dynamics"], equations={"x": "x + 4*u", "y": "y + v"})
        spec = spec_with(inputs=[u, SPEC["inputs"][1]], dynamics=dynamics)
        self.assertEqual(
            self.texts("validate", spec, "grid"),
            ["the values of u go from -0.9 to 0.9 in steps of 0.3, not from -1 to 1, because the step does not divide that"],
        )

    def test_names_that_nothing_uses(self):
        spec = spec_with(
            constants={"a": 1, "b": "a + 1", "c": 3, "d": 6},
            definitions={"e": "x + c", "f": "e + y"},
            disturbances=[{"name": "w", "lower": 0, "upper": 0}, {"name": "z", "lower": 0, "upper": 0}],
            dynamics=dict(SPEC["dynamics"], equations={"x": "x + u + w", "y": "y + v"}),
            safe="x + y <= d",
        )
        self.assertEqual(
            self.both(spec),
            [
                ("unused", "/constants/a"),
                ("unused", "/constants/b"),
                ("unused", "/constants/c"),
                ("unused", "/definitions/e"),
                ("unused", "/definitions/f"),
                ("unused", "/disturbances/1"),
            ],
        )
        self.assertEqual(self.texts("validate", spec, "unused")[-1], "nothing depends on the disturbance z")

    def test_an_input_that_moves_nothing(self):
        spec = spec_with(dynamics=dict(SPEC["dynamics"], equations={"x": "x + u", "y": "y"}))
        self.assertEqual(self.both(spec), [("unused", "/inputs/1")])

    def test_a_memory_that_nothing_uses(self):
        memory = {"seen": "once(x >= 3)", "both": "once(seen and y >= 3)", "used": "once(y >= 2)"}
        self.assertEqual(
            self.both(spec_with(memory=memory, safe="x + y <= 6 or used")),
            [("unused", "/memory/both"), ("unused", "/memory/seen")],
        )

    def corridor(self):
        return json.loads(without_comments((CONFIGS / "tutorial/corridor_2.json").read_text()))

    def test_motion_of_less_than_a_cell(self):
        """The period of 0.01 s on steps of 0.25 m that answers 0.37 s where 9.5 s are true."""
        spec = self.corridor()
        self.assertEqual(self.both(spec), [])
        for period, kinds in ((0.01, ["motion"] * 2), (0.249, ["motion"] * 2), (0.25, [])):
            spec["dynamics"]["period"] = period
            self.assertEqual([kind for kind, _ in self.both(spec)], kinds, period)
        spec["dynamics"]["period"] = 0.01
        self.assertIn(
            "p1 moves by less than one cell (0.25 m) in a period (0.01 s)", self.texts("validate", spec, "motion")[0]
        )
        self.assertIn("make the step smaller or the period longer, e.g. to 0.01 m or 0.25 s", self.texts("validate", spec, "motion")[0])
        # Half-open cells lose as much, unless nothing moves at all; discrete states have no cells to spread to.
        spec["abstraction"] = {"cells": "half_open"}
        self.assertEqual([place for _, place in self.both(spec)], ["/states/0", "/states/1"])
        still = {"x": "x + u + 2*v", "y": "y"}
        spec = spec_with(dynamics=dict(SPEC["dynamics"], equations=still))
        self.assertEqual(self.both(spec), [])
        spec["abstraction"] = {"cells": "closed"}
        self.assertEqual(self.both(spec), [("motion", "/states/1")])
        spec["states"] = [X, dict(Y, discrete=True)]
        self.assertEqual(self.both(spec), [])

    def test_a_motion_of_just_a_cell_is_no_warning(self):
        """Two carts whose speeds stop at 1 m/s, on cells that they cross in a period."""
        spec = self.merge(vmax=1)
        self.assertEqual([kind for kind, _ in self.both(spec) if kind == "motion"], [])
        spec = self.merge(vmax=0.75)
        self.assertEqual([kind for kind, _ in self.both(spec) if kind == "motion"], ["motion"] * 2)

    def merge(self, vmax=2, step=0.25, speed="stop", **grid):
        """Two carts that come to a merge at 0."""
        states = []
        for i in (1, 2):
            states.append({"name": f"p{i}", "lower": -20, "upper": 2, "step": 0.5, "unit": "m", "outside": {"below": "saturate", "above": "safe"}})
            states.append({"name": f"v{i}", "lower": 0, "upper": vmax, "step": step, "unit": "m/s", "outside": speed, **grid})
        return {
            "coordreq": 1, "name": "merge", "states": states,
            "inputs": [{"name": f"a{i}", "values": [-1, -0.5, 0, 0.5], "unit": "m/s^2"} for i in (1, 2)],
            "agents": [{"name": f"cart{i}", "inputs": [f"a{i}"]} for i in (1, 2)],
            "dynamics": {"time": "continuous", "period": 0.5, "unit": "s", "equations": {"p1": "v1", "v1": "a1", "p2": "v2", "v2": "a2"}},
            "safe": "not (abs(p1) <= 1.5 and abs(p2) <= 1.5)",
            "abstraction": {"cells": "half_open", "between_samples": True},
        }  # fmt: skip

    def kept(self, spec):
        self.write("spec.json", spec)
        return json.loads(self.run_program("analyze", "spec.json", "--json", "-o", "out.h5").stdout)["invariant"]

    def test_standing_vehicles_that_creep(self):
        spec = self.merge()
        (text,) = self.texts("analyze", spec, "standing")
        self.assertRegex(text, r"^at p1 = \S+, v1 = 0, p2 = \S+, v2 = 0 nothing moves with a1 = -1, a2 = -1, yet the cell is not in")
        self.assertIn('what can help: a face of half-open cells at the limit ("lower": -0.125, "origin": 0.125), v1 as a', text)
        # The state that it names is in S, and no cell of K.
        values = text[len("at ") : text.index(" nothing")].replace(" = ", "=").replace(", ", ",")
        creeping = self.kept(spec)
        answer = json.loads(self.run_program("query", "out.h5", "--at", values, "--json").stdout)
        self.assertEqual((answer["safe"], answer["invariant"]), (True, False))
        # What it says helps, does; the figures are those of the page on modelling.
        face = self.merge(vmax=1.875, lower=-0.125, origin=0.125)
        self.assertEqual(self.texts("analyze", face, "standing"), [])
        figures = [creeping, self.kept(self.merge(speed="saturate")), self.kept(face)]
        self.assertEqual(figures, [105089, 154892, 156495])
        page = (ROOT / "docs/how-to/modelling.md").read_text()
        for figure in figures:
            self.assertIn(f"{figure:,}", page)

    def test_a_wall_at_a_standstill(self):
        """K is empty on every grid; a face at the standstill, or a set point, helps, and no finer grid is advised."""
        states = [
            {"name": "d", "lower": 0, "upper": 10, "step": 1, "outside": {"below": "unsafe", "above": "saturate"}},
            {"name": "v", "lower": 0, "upper": 2, "step": 1, "outside": "stop"},
        ]
        spec = {
            "coordreq": 1, "name": "train", "states": states, "inputs": [{"name": "a", "values": [-1, 0]}],
            "agents": [{"name": "one", "inputs": ["a"]}],
            "dynamics": {"time": "continuous", "period": 1, "equations": {"d": "-v", "v": "a"}},
            "safe": "true", "abstraction": {"cells": "half_open"},
        }  # fmt: skip
        for half in (1, 2, 4):
            finer = dict(spec, states=[dict(state, step=1 / half) for state in states])
            self.assertEqual(self.kept(finer), 0)
            self.assertEqual(len(self.texts("analyze", finer, "standing")), 1)
        (empty,) = self.texts("analyze", spec, "empty")
        self.assertIn("half-open cells of v have a face at its lower limit", empty)
        self.assertNotIn("a finer grid may", empty)
        face = dict(spec, states=[states[0], dict(states[1], lower=-0.5, upper=1.5, origin=0.5)])
        point = dict(spec, states=[states[0], {"name": "v", "lower": 0, "upper": 2, "step": 1, "discrete": True}])
        point["dynamics"] = dict(spec["dynamics"], equations={"d": "-v"}, updates={"v": "max(0, v + a)"})
        for helped in (face, point):
            self.assertGreater(self.kept(helped), 0)
            self.assertEqual(self.texts("analyze", helped, "standing"), [])

    def test_a_motion_that_ends_on_a_face(self):
        """A train at 8 m/s, 7.75 m before the wall, brakes to 7 m/s: it ends on the face of the last safe cell."""
        states = [
            {"name": "d", "lower": 0, "upper": 60, "step": 0.5, "outside": "unsafe"},
            {"name": "v", "lower": 0, "upper": 8, "step": 0.25, "outside": "stop"},
        ]
        spec = {
            "coordreq": 1, "name": "etcs", "states": states,
            "inputs": [{"name": "a", "values": [-1, -0.5, 0, 0.5]}, {"name": "r", "values": [0, 1]}],
            "agents": [{"name": "train", "inputs": ["a"]}, {"name": "rbc", "inputs": ["r"]}],
            "dynamics": {"time": "continuous", "period": 1, "equations": {"d": "-v - r", "v": "a"}},
            "safe": "d >= 0.25", "abstraction": {"cells": "half_open", "between_samples": True},
        }  # fmt: skip
        self.assertEqual(self.kept(spec), 0)
        answer = json.loads(self.run_program("query", "out.h5", "--at", "d=8,v=8", "--json").stdout)
        self.assertEqual(answer["collision_time"], 2)
        self.assertIn(b"holds", self.run_program("verify", "out.h5", "--strict").stdout)
        # With a face at the standstill the train can wait, at all times.
        states[1].update(lower=-0.125, upper=8.125, origin=0.125)
        self.assertEqual(self.kept(spec), 3231)
        self.assertIn(b"holds", self.run_program("verify", "out.h5", "--strict").stdout)

    def heating(self, **state):
        return spec_with(
            states=[{"name": "T", "lower": 16, "upper": 26, "step": 0.25, **state}, Y],
            dynamics=dict(SPEC["dynamics"], equations={"T": "T + u", "y": "y + v"}),
            safe="18 <= T and T <= 24",
            abstraction={"cells": "half_open"},
        )

    def test_bounds_within_cells(self):
        self.assertEqual(
            self.texts("validate", self.heating(), "bound"),
            [
                "bounds of 'safe' lie within cells, which are not safe as a whole: T at 18 and 24; they are faces of cells "
                'with "origin": 0.125 for T'
            ],
        )
        self.assertEqual(self.texts("validate", self.heating(origin=0.125), "bound"), [])
        # A bound that is no whole number of steps from the other takes a finer step.
        spec = dict(self.heating(), safe="18 <= T and T <= 24.1")
        (text,) = self.texts("validate", spec, "bound")
        self.assertIn('with "step": 0.05 and "origin": 0.025 for T', text)
        self.assertEqual(self.texts("validate", dict(self.heating(step=0.05, origin=0.025), safe=spec["safe"]), "bound"), [])
        # Cells count by their centres, or points are cells.
        self.assertEqual(self.texts("validate", dict(self.heating(), abstraction={"safe": "center"}), "bound"), [])

    def test_a_function_outside_its_domain_in_a_large_problem(self):
        spec = self.merge(speed="saturate")
        spec["dynamics"]["equations"]["p1"] = "v1/p2"
        self.write("spec.json", spec)
        for arguments in ((), ("--posts", "100")):
            result = self.run_program("validate", "spec.json", *arguments)
            self.assertEqual(result.returncode, 3, result.stdout)
            self.assertRegex(
                result.stderr.decode().splitlines()[-1],
                r"^coordreq: error: the equation of 'p1', 'v1/p2', is not defined everywhere .*division by a number in .*\(/dynamics/equations/p1\)$",
            )
        spec["dynamics"]["equations"]["p1"] = "v1*sqrt(4 + p2)"
        self.write("spec.json", spec)
        result = self.run_program("validate", "spec.json")
        self.assertEqual(result.returncode, 3, result.stdout)
        self.assertIn(b"the equation of 'p1'", result.stderr)
        # What is defined everywhere is none.
        spec["dynamics"]["equations"]["p1"] = "v1/(p2 + 30)"
        self.write("spec.json", spec)
        self.assertEqual(self.run_program("validate", "spec.json").returncode, 0)

    def test_a_safe_set_without_a_state(self):
        spec = self.merge()
        spec["safe"] = "p1 >= 3 and p2 <= 1"
        self.assertEqual(self.texts("validate", spec, "empty"), ["the safe set is empty on this grid"])
        self.assertEqual(self.texts("validate", spec_with(safe="x >= 5"), "empty"), ["the safe set is empty on this grid"])
        spec["safe"] = "p1 >= 1 and p2 <= -15"
        self.assertEqual(self.texts("validate", spec, "empty"), [])

    def test_posts_is_a_number(self):
        self.write("spec.json", SPEC)
        self.assert_fails(2, "expected a whole number from 1 to 1000000000, found '0' (--posts)", "validate", "spec.json", "--posts", "0")

    def obstacle(self, clock):
        """One that crosses the place of a robot in the middle of a period, by a clock that jumps, or not."""
        t = {"name": "t", "lower": 0, "upper": 9, "step": 1, "outside": {"below": "unsafe", "above": "safe"}}
        jumps = clock == "jumps"
        return {
            "coordreq": 1, "name": "obstacle",
            "states": [dict(t, discrete=True) if jumps else t, {"name": "p", "lower": -5, "upper": 5, "step": 0.5, "outside": "unsafe"}],
            "inputs": [{"name": "u", "values": [0]}], "agents": [{"name": "robot", "inputs": ["u"]}],
            "dynamics": {"time": "continuous", "period": 1, "unit": "s", "equations": {"p": "u", **({} if jumps else {"t": "1"})},
                         **({"updates": {"t": "t + 1"}} if jumps else {})},
            "safe": "abs(p - (2*t - 9)) >= 0.75", "abstraction": {"cells": "half_open", "between_samples": True},
        }  # fmt: skip

    def test_states_that_jump(self):
        spec = self.obstacle("jumps")
        (text,) = self.texts("validate", spec, "jump")
        self.assertEqual(
            text,
            "'safe' depends on t, which jumps at the sampling instants: between two samples it counts as at the first of them, so "
            "that motion with it between the samples is not covered; a continuous state with an equation moves all the time",
        )
        self.write("spec.json", spec)
        named = "; t jumps at the sampling instants and keeps its value between\n"
        self.assertIn(named, self.run_program("analyze", "spec.json", "-o", "out.h5").stdout.decode())
        for command in (("validate", "spec.json"), ("info", "out.h5"), ("query", "out.h5", "--at", "t=1,p=0")):
            self.assertIn(named, self.run_program(*command).stdout.decode(), command)
        # Its motion is shown: a cell a period.
        report = json.loads(self.run_program("validate", "spec.json", "--json").stdout)
        self.assertEqual([own["amount"] for own in report["motion"]], [1, 0])
        # A clock that moves does not jump; a robot at 0 is then not safe at t = 4, which crosses it before 5.
        moving = self.obstacle("moves")
        self.assertEqual(self.texts("validate", moving, "jump"), [])
        safe = {}
        for name, own in (("jumps", spec), ("moves", moving)):
            self.write("spec.json", own)
            self.run_program("analyze", "spec.json", "-o", "out.h5", "--quiet")
            safe[name] = json.loads(self.run_program("query", "out.h5", "--at", "t=4,p=0", "--json").stdout)["invariant"]
        self.assertEqual(safe, {"jumps": True, "moves": False})
        # Asked at samples only it is where it is then.
        spec["abstraction"] = {"cells": "half_open"}
        self.assertEqual(self.texts("validate", spec, "jump"), [])

    def test_motion_in_tables_that_are_sums(self):
        """p moves with v and h: affine, and coupled with what is not."""
        states = [
            dict(X, name="h", lower="-pi", upper="pi", step=None, count=24, outside="periodic"),
            dict(X, name="p", lower=-5, upper=5, step=0.5),
            dict(X, name="q", lower=-5, upper=5, step=0.5),
        ]
        states = [{key: value for key, value in state.items() if value is not None} for state in states]
        for speed, expected in (("4", []), ("0.1", [("motion", "/states/1"), ("motion", "/states/2")])):
            equations = {"h": "4*u", "p": f"{speed}*cos(h) + 0.1*v*q", "q": f"{speed}*sin(h) - 0.1*v*p"}
            dynamics = {"time": "continuous", "period": 0.25, "unit": "s", "equations": equations}
            spec = spec_with(states=states, dynamics=dynamics, safe="p^2 + q^2 >= 1", abstraction=None)
            self.write("spec.json", spec)
            report = json.loads(self.run_program("validate", "spec.json", "--json").stdout)
            self.assertEqual([own["sum"] for own in report["states"]], [False, True, True])
            self.assertEqual(self.both(spec), expected)

    def test_validate_does_not_enclose_what_takes_the_analysis_long(self):
        h = {"name": "h", "lower": 0, "upper": 200, "step": 10, "outside": "saturate"}
        states = [without_outside(dict(X, name="p")), dict(Y, name="q"), h]
        # Enclosures take few steps, or hundreds each.
        for rate, expected in ((1, [("blocked", "/states")]), (60, [])):
            equations = {"p": "v*cos(h)", "q": "v*sin(h)", "h": f"{rate}*u"}
            dynamics = {"time": "continuous", "period": 0.5, "unit": "s", "equations": equations}
            spec = spec_with(states=states, dynamics=dynamics, safe="p <= 3", abstraction={"effort": 1})
            found = self.warnings("validate", spec)
            self.assertEqual([(own["kind"], own["place"]) for own in found if own["kind"] == "blocked"], expected)

    def test_sides_at_the_default_that_block(self):
        spec = spec_with(states=[without_outside(X), dict(Y, outside={"above": "unsafe"})], safe="x <= 3")
        # x below 0 with u = -1 from 5 cells, and y with v = -1 from 4; above, x would leave from 4, which is not safe.
        self.assertEqual(self.both(spec), [("blocked", "/states")])
        (text,) = self.texts("analyze", spec, "blocked")
        self.assertTrue(text.endswith(' since "outside" is not set there: 15 below x, 12 below y'), text)
        # What is not allowed anyway is not blocked, at x = 0 with u = -1 and v = -1 either.
        spec["controller"] = {"allow": "x > 0 or u >= 0"}
        (text,) = self.texts("analyze", spec, "blocked")
        self.assertTrue(text.endswith(" there: 11 below y"), text)
        spec["states"] = SPEC["states"]
        self.assertEqual(self.both(spec), [])

    def likely_causes(self, spec, kind):
        (own,) = [own for own in self.warnings("analyze", spec) if own["kind"] == kind]
        return own["message"]

    def test_numbers_of_rooms_that_matter(self):
        def rooms(equation, step=1, **changes):
            room = {"name": "room", "lower": 0, "upper": 4 * step, "step": step, "discrete": True, "outside": "unsafe"}
            return spec_with(states=[{**room, **changes}, Y], disturbances=[{"name": "w", "lower": -1, "upper": 1}],
                             dynamics=dict(SPEC["dynamics"], equations={"room": equation, "y": "y + u + v"}),
                             safe="y <= 4")  # fmt: skip

        start = "successor sets are ranges of numbers, so that it matters how the values of room are numbered: "
        end = "; give neighbouring numbers to values that can follow together"
        self.assertEqual(
            self.texts("analyze", rooms("if(room == 1 and w > 0, 3, room)"), "numbering"),
            [start + "from room = 1 it can become 1 or 3, and the successor set holds 2 as well" + end],
        )
        self.assertEqual(
            self.texts("validate", rooms("if(room == 2 and w > 0, 8, room)", 2), "numbering"),
            [start + "from room = 2 it can become 2 or 8, and the successor set holds 4 as well" + end],
        )
        # Neighbours, values that are certain, and what ends in the same cells.
        for equation, more in (
            ("if(room == 1 and w > 0, 2, room)", {}),
            ("if(room == 1 and w > 2, 3, room)", {}),
            ("if(w > 0, if(w > 0.5, 1, 3), 2)", {}),
            ("if(room == 1 and w > 0, 9, 0)", {}),
            ("if(room == 1 and w > 0, 9, 4)", {"outside": "saturate"}),
            ("if(room == 4 and w > 0, 5, room)", {"outside": "periodic", "lower": 0, "upper": 5, "count": 5}),
        ):
            spec = rooms(equation, **more)
            if "count" in more:
                del spec["states"][0]["step"]
            self.assertEqual(self.texts("analyze", spec, "numbering"), [], equation)

    def test_an_empty_invariance_set_and_what_helps(self):
        equations = {"x": "x + 2*u + 5", "y": "y + v"}
        spec = spec_with(dynamics=dict(SPEC["dynamics"], equations=equations))
        text = self.likely_causes(spec, "empty")
        self.assertRegex(
            text, r"^the invariance set is empty on this grid; of [0-9]+ changes tried one by one, it helps if x saturates above, or if all sides saturate$"
        )
        result = self.run_program("analyze", "spec.json")
        self.assertEqual(result.returncode, 0)
        self.assertIn(b"The invariance set is empty on this grid: no state can be kept safe", result.stdout)
        w = [{"name": "w", "lower": -3, "upper": 3}]
        spec = spec_with(disturbances=w, dynamics=dict(SPEC["dynamics"], equations={"x": "x + u + w", "y": "y + v"}))
        self.assertRegex(self.likely_causes(spec, "empty"), "it helps if all sides saturate, or if w is 0$")

    def test_disturbances_that_help_only_together(self):
        w = [{"name": name, "lower": -3, "upper": 3} for name in ("wx", "wy")]
        equations = {"x": "x + u + wx", "y": "y + v + wy"}
        spec = spec_with(disturbances=w, dynamics=dict(SPEC["dynamics"], equations=equations))
        self.assertRegex(self.likely_causes(spec, "empty"), "it helps if wx is 0 and wy is 0$")

    def test_a_safe_set_that_is_empty_for_its_steps(self):
        spec = spec_with(safe="x >= 0.9 and x <= 1.1", abstraction={"cells": "half_open"}, states=[X, dict(Y, outside="saturate")])
        spec["dynamics"] = dict(SPEC["dynamics"], equations={"x": "x", "y": "y + u + v"})
        text = self.likely_causes(spec, "empty")
        self.assertRegex(text, "^the safe set is empty on this grid; .* it helps if only centres of cells must be safe$")

    def test_an_empty_safe_set_that_nothing_fills(self):
        """No state is safe, so there is none to explain."""
        text = self.likely_causes(spec_with(safe="x < -5"), "empty")
        self.assertRegex(text, "^the safe set is empty on this grid; of [0-9]+ changes tried one by one, none helps$")

    def test_a_problem_that_this_machine_cannot_hold(self):
        """It is valid all the same, and what it would need is told."""
        self.write("spec.json", spec_with(states=[dict(X, step="1e-7"), dict(Y, step="1e-7")]))
        result = self.run_program("validate", "spec.json", "--json")
        self.assertEqual(result.returncode, 0)
        (warning,) = json.loads(result.stdout)["warnings"]
        self.assertEqual((warning["kind"], warning["place"]), ("memory", "/states"))
        self.assertRegex(warning["message"], "^analyze needs about [0-9.]+ .iB, and this machine has [0-9.]+ .iB: ")

    def test_no_silence_at_all(self):
        """Only opposite actions keep the sum, so alone nobody may act."""
        spec = spec_with(safe="x + y >= 4 and x + y <= 4", states=[dict(X, outside="saturate"), dict(Y, outside="saturate")])
        text = self.likely_causes(spec, "no_silence")
        self.assertRegex(
            text,
            r"^with the partition a\|b no state tolerates even one step without coordination on this grid; of [0-9]+ "
            "changes tried one by one, none helps; a finer grid may .--refine 4., and 'coordreq explain' shows what goes wrong at a state$",
        )

    def test_causes_are_sought_on_a_coarse_copy(self):
        """A million cells; the side above x is what empties K on any grid."""
        states = [dict(X, step="1/250"), dict(Y, step="1/250")]
        spec = spec_with(states=states, dynamics=dict(SPEC["dynamics"], equations={"x": "x + 2*u + 5", "y": "y + v"}))
        text = self.likely_causes(spec, "empty")
        self.assertRegex(text, r" tried one by one on a copy with [0-9]{2},[0-9]{3} cells \(steps up to 4 times as long\), it helps if x saturates above")

    def summary_of(self, process):
        """Without what is that of one run."""
        said = json.loads(process.communicate(timeout=600)[0])
        self.assertEqual(process.returncode, 0)
        return {key: value for key, value in said.items() if key not in ("seconds", "peak_memory_bytes")}

    def test_a_busy_machine_says_the_same(self):
        """All changes that are tried take longer there than any patience that has ever been tried."""
        states = [dict(X, step="1/50"), dict(Y, step="1/50")]
        equations = {"x": "x + 2*u + 5 + 0.1*sin(y)", "y": "y + v + 0.1*cos(x)"}
        self.write("spec.json", spec_with(states=states, dynamics=dict(SPEC["dynamics"], equations=equations)))
        command = [PROGRAM, "analyze", "spec.json", "-o", "o.h5", "--json", "--threads", "2"]
        options = {"cwd": self.folder, "stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL}
        with subprocess.Popen(command, **options) as process:
            expected = self.summary_of(process)
        with subprocess.Popen(command, **options) as process:
            busy = threading.Thread(target=self.let_wait, args=[process])
            busy.start()
            found = self.summary_of(process)
            busy.join()
        self.assertEqual(found, expected)
        self.assertIn(" changes tried one by one", expected["warnings"][0]["message"])

    def let_wait(self, process):
        """Nearly all of the time."""
        while process.poll() is None:
            process.send_signal(signal.SIGSTOP)
            time.sleep(0.06)
            process.send_signal(signal.SIGCONT)
            time.sleep(0.002)

    def test_a_requirement_that_fails_is_no_other_exit_code(self):
        requirement = [{"name": "r", "where": "x <= 1", "invariant": True}]
        spec = spec_with(constants={"k": 1}, requirements=requirement, safe="x >= 2")
        self.write("spec.json", spec)
        result = self.run_program("analyze", "spec.json")
        self.assertEqual((result.returncode, result.stderr.count(b"warning: ")), (1, 1))

    def test_of_several_analyses_each_line_is_printed_once(self):
        self.write("spec.json", spec_with(constants={"k": 1, "r": 6}, safe="x + y <= r"))
        result = self.run_program("analyze", "spec.json", "--sweep", "constants.r=5,6")
        self.assertEqual(
            result.stderr.decode(),
            "coordreq: warning: spec.json constants.r=5: nothing depends on the constant k (/constants/k)\n",
        )
        result = self.run_program("analyze", "spec.json", "--sweep", "constants.r=5,6", "--json")
        runs = json.loads(result.stdout)["runs"]
        self.assertEqual([len(run["summary"]["warnings"]) for run in runs], [1, 1])

    def test_the_results_file_is_the_same(self):
        """Warnings are nothing that a file holds."""
        self.write("plain.json", SPEC)
        self.write("warned.json", spec_with(states=[without_outside(X), Y]))
        for name in ("plain", "warned"):
            self.assertEqual(self.run_program("analyze", f"{name}.json", "-o", f"{name}.h5").returncode, 0)
        result = self.run_program("compare", "plain.h5", "warned.h5")
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        with h5py.File(self.folder / "warned.h5") as file:
            self.assertNotIn("warning", " ".join(file))

    def test_the_examples_are_valid_and_have_no_warnings_but_those_that_they_speak_of(self):
        for path in sorted([*CONFIGS.glob("*.json"), *CONFIGS.glob("tutorial/*.json")]):
            with self.subTest(path.name):
                result = self.run_program("validate", str(path), "--json")
                self.assertEqual((result.returncode, without_warnings(result.stderr)), (0, b""))
                self.assertEqual(json.loads(result.stdout)["name"], path.stem)
                found = [own["kind"] for own in json.loads(result.stdout)["warnings"]]
                # The first step of the tutorial says nothing of the walls, and the second one explains it.
                expected = ["blocked"] if path.name == "corridor_1.json" else []
                # Gaps of exactly 2 m are in the middle of cells, as the page on coalitions shows.
                expected = ["bound"] if path.name.startswith("platoon") else expected
                if "between_samples" in found:
                    self.assertIn("the program warns about this", path.read_text())
                    expected = ["between_samples"]
                self.assertEqual(found, expected)


if __name__ == "__main__":
    unittest.main()
