"""coordreq explain: why a state tolerates so much silence, checked against the other commands."""

import json
import unittest

from program import CONFIGS, SPEC, Case, spec_with, without_comments

CORRIDOR = json.loads(without_comments((CONFIGS / "tutorial/corridor_1.json").read_text()))
SMALL = spec_with(states=[dict(state, outside="saturate") for state in SPEC["states"]])


class Cases(Case):
    def explain(self, at, *arguments, file="results.h5"):
        result = self.run_program("explain", file, "--at", at, "--json", *arguments)
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        return json.loads(result.stdout)

    def analyzed(self, spec, *arguments):
        self.write("spec.json", spec)
        return self.analyze("spec.json", "-o", "results.h5", *arguments)

    def text(self, at, *arguments):
        result = self.run_program("explain", "results.h5", "--at", at, *arguments)
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        return result.stdout.decode()

    def delay(self, at, file="results.h5"):
        (own,) = json.loads(self.run_program("query", file, "--at", at, "--json").stdout)["partitions"]
        return own["delay"], own["classes"]

    def test_every_cell_of_a_small_grid(self):
        """Delays are those of query; ways out lose one step a step; freedom is what query says is allowed."""
        self.analyzed(SMALL)
        for x in range(5):
            for y in range(5):
                at = f"x={x},y={y}"
                found = self.explain(at)
                delay, classes = self.delay(at)
                self.assertEqual((found["cell"], found["delay"]), (5 * x + y, delay), at)
                if x + y > 6:
                    self.assertEqual((found["delay_status"], found["sentences"]), ("not_safe", ["The cell is not safe."]))
                    continue
                steps = found["way_out"]["steps"]
                alone = [step["delay"] for step in steps if step["action"] == "independent"]
                self.assertEqual(alone, list(range(delay, -1, -1)), at)
                self.assertEqual(
                    [own["admissible"] for own in found["freedom"]["classes"]], [len(own["actions"]) for own in classes]
                )
                product = len(classes[0]["actions"]) * len(classes[1]["actions"])
                self.assertEqual(found["freedom"]["alone"], product)
                # Alone more may go wrong than together exactly where the delay is 0.
                self.assertEqual(found["freedom"]["together"] < product, delay == 0, at)

    def test_the_way_out_is_the_counterexample_of_a_requirement(self):
        requirement = {"name": "r", "where": "1.9 < p1 < 2 and 11.9 < p2 < 12", "min_delay": 20}
        summary = self.run_program("analyze", self.write("spec.json", dict(CORRIDOR, requirements=[requirement])),
                                   "-o", "results.h5", "--json", "--quiet")
        (judged,) = json.loads(summary.stdout)["requirements"]
        found = self.explain("p1=2,p2=12")
        self.assertEqual(judged["cells"], 1)
        self.assertEqual(found["way_out"], judged["counterexample"])
        self.assertEqual((found["delay"], found["delay_status"]), (judged["least_delay"], "steps"))

    def test_remedies_hold(self):
        """An `allow` for this cell alone, analysed, gives at least the delay that was promised."""
        self.analyzed(SMALL)
        promised = 0
        for at in ("x=2,y=2", "x=3,y=1", "x=0,y=4", "x=1,y=1"):
            found = self.explain(at)
            for own in found["remedies"]:
                promised += 1
                self.assertGreater(own["delay"], found["delay"])
                (name, value), = own["inputs"].items()
                x, y = (part[2:] for part in at.split(","))
                changed = dict(SMALL, name="changed",
                               controller={"allow": f"x != {x} or y != {y} or {name} == {value:g}"})
                self.write("changed.json", changed)
                self.analyze("changed.json", "-o", "changed.h5")
                self.assertGreaterEqual(self.delay(at, "changed.h5")[0], own["delay"])
        self.assertGreater(promised, 0)

    def test_more_freedom_and_less_silence(self):
        """Nearer to each other drones have to fly apart, so that less can go wrong."""
        self.analyzed(json.loads(without_comments((CONFIGS / "tutorial/corridor_4.json").read_text())))
        found = self.explain("p1=5,p2=7")
        other = found["freer_is_shorter"]
        self.assertGreater(other["delay"], found["delay"])
        self.assertLess(other["alone"], found["freedom"]["alone"])
        state = ",".join(f"{name}={value}" for name, value in other["state"].items())
        delay, classes = self.delay(state)
        self.assertEqual(delay, other["delay"])
        self.assertEqual(len(classes[0]["actions"]) * len(classes[1]["actions"]), other["alone"])
        self.assertTrue(any("a larger action set can shorten the delay" in text for text in found["sentences"]))

    def test_convention_is_that_of_the_analysis(self):
        self.analyzed(dict(CORRIDOR, coordination={"convention": True}))
        found = self.explain("p1=9,p2=11")
        query = json.loads(self.run_program("query", "results.h5", "--at", "p1=9,p2=11", "--json").stdout)
        kept = [(own["name"], len(own["actions"]), own["total"]) for own in query["convention"]]
        self.assertEqual([(own["agent"], own["kept"], own["total"]) for own in found["convention"]], kept)

    def test_silence_for_ever(self):
        dynamics = dict(SPEC["dynamics"], equations={"x": "x", "y": "y"})
        self.analyzed(dict(SMALL, dynamics=dynamics))
        found = self.explain("x=1,y=1")
        self.assertEqual((found["delay"], found["delay_status"], found["way_out"]), (None, "unbounded", None))
        self.assertEqual(found["remedies"], [])
        self.assertIn("unbounded: safe without coordination indefinitely", self.text("x=1,y=1"))

    def test_delays_that_were_cut_off(self):
        self.analyzed(dict(SMALL, coordination={"max_delay": 1}))
        found = self.explain("x=0,y=0")
        self.assertEqual((found["delay"], found["delay_status"], found["way_out"]), (1, "at_least", None))
        found = self.explain("x=3,y=3")
        self.assertEqual((found["delay"], found["delay_status"]), (0, "steps"))

    def test_outside_the_invariance_set(self):
        self.analyzed(spec_with(dynamics=dict(SPEC["dynamics"], equations={"x": "x + u + 2", "y": "y + v"})))
        found = self.explain("x=0,y=0")
        self.assertEqual((found["delay"], found["delay_status"], found["freedom"]), (None, "not_invariant", None))
        self.assertEqual({step["action"] for step in found["way_out"]["steps"]}, {"evasive"})
        self.assertIn("Even if all agents then coordinate, after", found["sentences"][0])

    def test_files_with_a_controller_and_tubes(self):
        self.analyzed(dict(CORRIDOR, abstraction={"between_samples": True}, states=[dict(state, outside="saturate") for state in CORRIDOR["states"]]))
        found = self.explain("p1=2,p2=12")
        self.assertEqual(found["delay"], self.delay("p1=2,p2=12")[0])
        self.assertEqual(len([step for step in found["way_out"]["steps"] if step["action"] == "independent"]), found["delay"] + 1)
        self.write("first.json", dict(SMALL, name="first", output={"controller": True}))
        self.analyze("first.json")
        self.analyzed(dict(SMALL, controller={"file": "first.h5", "synthesis": "given"}))
        self.assertEqual(self.explain("x=2,y=2")["delay"], self.delay("x=2,y=2")[0])

    def test_text(self):
        self.analyzed(SMALL)
        self.assertEqual(
            self.text("x=3,y=2"),
            """\
state      x = 3, y = 2
cell       number 17, around x = 3, y = 2
partition  a|b
delay      0 steps (0 s)

shortest path out of the invariance set
step  x [m]  y [m]  delay  collision time  action       a      b
   0      3      2      0           never  independent  u = 1  v = 1
   1      4      3      -               0

Each agent independently takes permitted actions, and after 1 step (0.5 s) the state is no longer safe.
Proven: 0 steps (0 s). A nominal simulation from the first state left the invariance set after 1 step (0.5 s).
Actions that the controller permits here: a all 3 and b all 3.
If each class chooses independently, 9 joint actions are possible; 8 of them keep the next state in the invariance set.
If "allow" permitted a only u = -1 here, the delay would be at least 1 step (0.5 s).
If "allow" permitted b only v = -1 here, the delay would be at least 2 steps (1 s).
With a convention ("convention": true) the agents would keep these actions here: a 3 of 3 and b 2 of 3; agents that keep to it \
never need to coordinate.
""",
        )

    def test_wrong_usage(self):
        self.analyzed(dict(SMALL, coordination={"partitions": "all"}))
        self.assert_fails(2, "no state, expected --at NAME=VALUE,...", "explain", "results.h5")
        self.assert_fails(
            2,
            "several partitions, expected the name of one of a+b, a|b (--partition)",
            *("explain", "results.h5", "--at", "x=1,y=1"),
        )
        self.assert_fails(
            2,
            "expected a state in a cell of the grid, found one outside; see query (--at)",
            *("explain", "results.h5", "--at", "x=9,y=1", "--partition", "a|b"),
        )
        self.assertEqual(self.explain("x=1,y=1", "--partition", "a+b")["delay_status"], "unbounded")


if __name__ == "__main__":
    unittest.main()
