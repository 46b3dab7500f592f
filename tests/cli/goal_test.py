"""Goals from outside: cases worked by hand, requirements with stories, the loop, and what is refused."""

import json
import unittest

import h5py
import numpy
from program import Case

MOST = 32767  # of int16: cannot be forced, or unbounded


def state(name, last, outside="saturate", **more):
    return {"name": name, "lower": 0, "upper": last, "step": 1, "outside": outside, **more}


def spec(states, inputs, equations, goal, time="discrete", **more):
    """Discrete states, every input an agent of its own, period 1, everything safe."""
    names = "abcd"
    return {
        "coordreq": 1,
        "name": "hand",
        "states": states,
        "inputs": [{"name": name, "values": values} for name, values in inputs.items()],
        "agents": [{"name": names[i], "inputs": [name]} for i, name in enumerate(inputs)],
        "dynamics": {"time": time, "period": 1, "unit": "s", "equations": equations},
        "safe": "true",
        "goal": goal,
        **more,
    }


TWO = ([state("p", 3, discrete=True), state("q", 3, discrete=True)], {"u": [0, 1], "v": [0, 1]})
WALK = {"p": "p - u", "q": "q - v"}
# One state that leaves the goal by an unsafe side unless the two disagree.
HOLD = spec(
    [state("s", 1, "unsafe", discrete=True)],
    {"u": [0, 1], "v": [0, 1]},
    {"s": "if(s == 0, 1, if(u == v, -1, 1))"},
    "s == 1",
)


def leaving(above):
    return spec(
        [state("p", 2, {"below": "unsafe", "above": above}, discrete=True)],
        {"u": [0, 1]},
        {"p": "p + u"},
        "p == 0",
    )


class Cases(Case):
    def results(self, problem, code=0, warning=""):
        self.write("spec.json", problem)
        result = self.run_program("analyze", "spec.json", "-o", "r.h5", "--quiet")
        self.assertEqual(result.returncode, code, result.stderr)
        if not warning:
            self.assertEqual(result.stderr, b"")
        with h5py.File(self.folder / "r.h5") as file:
            return {name: numpy.array(file[name]) for name in file if isinstance(file[name], h5py.Dataset)}

    def test_one_of_two_is_enough(self):
        found = self.results(spec(*TWO, WALK, "p == 0 or q == 0"))
        self.assertEqual((found["arrival"][2, 3], found["approach_delay"][0, 2, 3]), (2, MOST))
        self.assertEqual((found["arrival"][2, 2], found["approach_delay"][0, 2, 2]), (2, 0))

    def test_both_have_to_arrive(self):
        found = self.results(spec(*TWO, WALK, "p == 0 and q == 0"))
        self.assertEqual(found["arrival"][2, 3], 3)
        self.assertTrue((found["approach_delay"] == MOST).all())

    def test_staying_takes_coordination(self):
        found = self.results(HOLD)
        for name in ("arrival", "delay", "approach_delay"):
            self.assertEqual(found[name].ravel().tolist(), [1, 0], name)
        found = self.results({**HOLD, "coordination": {"connection_delay": 1}})
        self.assertEqual(found["approach_trigger"].ravel().tolist(), [0, -3])

    def test_sides(self):
        self.assertEqual(self.results(leaving("safe"))["arrival"].tolist(), [0, MOST, MOST])
        self.assertEqual(self.results(leaving("goal"))["arrival"].tolist(), [0, 2, 1])

    def test_cells_and_motion(self):
        def points(cells, values):
            return spec(
                [state("p", 4)],
                {"u": values},
                {"p": "u"},
                "p <= 0.5",
                time="continuous",
                abstraction={"cells": cells, "safe": "center"},
            )

        near, far = [-1, 0, 1], [-2, -1, 0, 1, 2]
        stuck = self.results(points("closed", near), warning="W = G")
        self.assertEqual(stuck["arrival"].tolist(), [0, MOST, MOST, MOST, MOST])
        for cells, values in (("half_open", near), ("closed", far)):
            self.assertEqual(self.results(points(cells, values))["arrival"].tolist(), [0, 1, 2, 3, 4])

    def test_long_ways_take_wider_numbers(self):
        for last in (252, 253, 254, 255, 300):
            found = self.results(
                spec([state("p", last, discrete=True)], {"u": [0, 1]}, {"p": "p - u"}, "p == 0")
            )
            self.assertEqual(found["arrival"].tolist(), list(range(last + 1)), last)

    def test_requirements(self):
        def asked(**requirement):
            return {**leaving("goal"), "requirements": [{"name": "r", "where": "p == 1", **requirement}]}

        self.results(asked(max_arrival=2))
        self.results(asked(max_arrival_time=2.9))
        self.write("spec.json", asked(max_arrival_time=1.5))
        result = self.run_program("analyze", "spec.json", "--json")
        self.assertEqual(result.returncode, 1)
        (found,) = json.loads(result.stdout)["requirements"]
        self.assertEqual((found["holds"], found["max_arrival"], found["longest_arrival"]), (False, 1, 2))
        story = found["counterexample"]
        self.assertEqual(story["end"], "arrived")
        self.assertEqual([step["state"]["p"] for step in story["steps"]], [1, 2])
        self.assertEqual([step["action"] for step in story["steps"]], ["together"] * 2)

    def test_stories_of_time_lost_and_of_never(self):
        problem = spec(*TWO, WALK, "p == 0 or q == 0")
        problem["requirements"] = [{"name": "r", "where": "p == 2 and q == 2", "min_approach_delay": 1}]
        self.write("spec.json", problem)
        result = self.run_program("analyze", "spec.json", "--json")
        self.assertEqual(result.returncode, 1)
        story = json.loads(result.stdout)["requirements"][0]["counterexample"]
        self.assertEqual((story["end"], story["end_sample"]["state"]), ("time_lost", {"p": 2, "q": 2}))
        self.write("spec.json", {**leaving("safe"), "requirements": [{"name": "r", "where": "p == 1", "max_arrival": 9}]})
        result = self.run_program("analyze", "spec.json", "--json")
        story = json.loads(result.stdout)["requirements"][0]["counterexample"]
        self.assertEqual((story["end"], len(story["steps"])), ("never_arrives", 1))

    def test_approaches_that_have_more_layers_than_cells(self):
        """They stand still while the layers of safety shrink by a cell each, and shrink after that."""
        self.write("spec.json", spec([state("x", 9, discrete=True)], {"u": [0, 1], "v": [0, 1]}, {"x": "x + u - v"}, "x == 0", safe="x <= 7"))
        summary = self.analyze("spec.json")
        apart = summary["partitions"][-1]["approach"]
        self.assertEqual(apart["F"], 15)
        with h5py.File(self.folder / "hand.h5") as file:
            self.assertEqual(file["approach_layer_size"][-1].tolist(), [8] * 8 + [7, 6, 5, 4, 3, 2, 1, 0])
        self.assertEqual(self.run_program("verify", "hand.h5", "--quiet").returncode, 0)

    def test_the_file_verifies(self):
        for problem in (spec(*TWO, WALK, "p == 0 or q == 0"), HOLD, leaving("goal"), leaving("safe")):
            problem["requirements"] = [{"name": "r", "where": "true", "max_arrival": 1}]
            self.write("spec.json", problem)
            self.run_program("analyze", "spec.json", "-o", "r.h5")
            result = self.run_program("verify", "r.h5")
            self.assertEqual(result.returncode, 0, result.stdout.decode())

    def test_no_run_is_seen_on_the_way_to_a_goal(self):
        self.write("spec.json", spec(*TWO, WALK, "p == 0 or q == 0", requirements=[{"name": "r", "where": "true", "max_arrival": 1}]))
        self.run_program("analyze", "spec.json", "-o", "r.h5")
        with h5py.File(self.folder / "r.h5", "r+") as file:
            self.assertEqual(file["counterexample/seen"][:].tolist(), [0])
            file["counterexample/seen"][0] = 3
        result = self.run_program("verify", "r.h5")
        self.assertEqual(result.returncode, 1)
        self.assertIn(b"a nominal simulation where none is made", result.stdout)

    def test_conventions_and_stored_actions_lead_to_the_goal(self):
        problem = spec(*TWO, WALK, "p == 0 or q == 0")
        problem["coordination"] = {"convention": True}
        problem["output"] = {"controller": True, "actions": True}
        self.results(problem)
        result = self.run_program("verify", "r.h5")
        self.assertEqual(result.returncode, 0, result.stdout.decode())
        with h5py.File(self.folder / "r.h5") as file:
            # At (2, 2) both must move, or only one of them: 1 is v, 2 is u, 3 both.
            self.assertEqual(file["controller:goal"][2, 2].tolist(), [0b1110])
            self.assertEqual(file["actions:goal/a|b/a"][2, 3].tolist(), [0b10])
            self.assertEqual(file["actions:goal/a|b/b"][2, 3].tolist(), [0b11])
            self.assertEqual(file["controller:goal"][0, 2].tolist(), [0b1111])

    def test_an_analysis_that_was_broken_off_ends_in_the_same_file(self):
        problem = spec(*TWO, WALK, "p == 0 or q == 0")
        self.results(problem)
        whole = (self.folder / "r.h5").read_bytes()
        for arguments in (("--checkpoint", "c"), ("--checkpoint", "c", "--resume")):
            result = self.run_program("analyze", "spec.json", "-o", "r.h5", "--quiet", *arguments)
            self.assertEqual((result.returncode, result.stderr), (0, b""))
            self.assertEqual((self.folder / "r.h5").read_bytes(), whole)

    def test_other_formats_tell_the_way(self):
        self.results(spec(*TWO, WALK, "p == 0 or q == 0"))
        table = self.run_program("export", "r.h5", "--format", "csv").stdout.decode().splitlines()
        self.assertIn("arrival", table[0].split(","))
        self.assertIn("approach_delay:a|b", table[0].split(","))
        header = self.run_program("export", "r.h5", "--format", "c-header").stdout.decode()
        self.assertIn("coordreq_hand_approach_countdown", header)
        self.run_program("report", "r.h5", "-o", "r.html")
        page = (self.folder / "r.html").read_text()
        self.assertIn("Time to the goal", page)
        self.assertIn("How soon is the goal reached?", page)

    def test_changed_values_are_found(self):
        self.results(spec(*TWO, WALK, "p == 0 or q == 0"))
        for name, value in (("arrival", 3), ("arrival", 1), ("approach_delay", 1), ("approach_trigger", 1)):
            with h5py.File(self.folder / "r.h5", "r+") as file:
                before = file[name][..., 2, 3].copy()
                file[name][..., 2, 3] = value
            result = self.run_program("verify", "r.h5")
            self.assertEqual(result.returncode, 1, name)
            with h5py.File(self.folder / "r.h5", "r+") as file:
                file[name][..., 2, 3] = before

    def test_runs_reach_the_goal_in_time(self):
        self.results(spec(*TWO, WALK, "p == 0 or q == 0"))
        for policy in ("random", "adversarial"):
            result = self.run_program(
                "simulate", "r.h5", "--from", "p=2,q=2", "--steps", "5", "--runs", "50", "--until", "goal",
                "--policy", policy, "--json",
            )
            self.assertEqual(result.returncode, 0, result.stderr)
            traces = json.loads(result.stdout)["traces"]
            self.assertEqual({trace["arrived"] for trace in traces}, {2})

    def test_query_tells_the_way(self):
        self.results(spec(*TWO, WALK, "p == 0 or q == 0"))
        result = self.run_program("query", "r.h5", "--at", "p=2,q=3", "--json")
        answer = json.loads(result.stdout)
        self.assertEqual(answer["arrival"], 2)
        approach = answer["partitions"][0]["approach"]
        self.assertEqual(approach["delay_status"], "unbounded")
        self.assertEqual([one["actions"] for one in approach["classes"]], [[1], [0, 1]])
        arrived = json.loads(self.run_program("query", "r.h5", "--at", "p=0,q=3", "--json").stdout)["partitions"][0]
        everything = [one["actions"] for one in arrived["classes"]]
        self.assertEqual([one["actions"] for one in arrived["approach"]["classes"]], everything)
        self.assertTrue(all(everything))

    def test_arriving_later_is_worse(self):
        self.results(spec(*TWO, WALK, "p == 0 or q == 0"))
        (self.folder / "r.h5").rename(self.folder / "before.h5")
        self.results(spec(*TWO, WALK, "p == 0 and q == 0"))
        result = self.run_program("compare", "before.h5", "r.h5", "--json")
        self.assertEqual(result.returncode, 1)
        self.assertGreater(json.loads(result.stdout)["arrival"]["lost"], 0)

    def test_a_goal_behind_a_side_without_a_step(self):
        """No cell of the grid is in the goal, and `max_delay` 0 asks nothing of the first step: a file that can be read."""
        problem = spec([state("s", 2, discrete=True, outside={"below": "safe", "above": "goal"})], {"u": [0, 1], "v": [0, 1]},
                       {"s": "if(u == v, s + 1, s - 1)"}, "s > 2")  # fmt: skip
        self.results({**problem, "coordination": {"max_delay": 0}})
        self.assertEqual(self.run_program("verify", "r.h5", "--strict").returncode, 0)
        with h5py.File(self.folder / "r.h5") as file:
            self.assertEqual((file["approach_fixed_point_index"][0], list(file["approach_layer_size"][0])), (-1, [3]))

    def test_delays_that_were_cut_off_are_lower_bounds(self):
        """In the goal every delay is unbounded, but `max_delay` ends the approach before that is known."""
        problem = spec(
            [state("s", 2, discrete=True)], {"u": [0, 1], "v": [0, 1]}, {"s": "if(s == 1 and u == 0 and v == 0, 1, s - 1)"},
            "s == 0",
        )  # fmt: skip
        for most in (2, 1):
            self.results({**problem, "coordination": {"max_delay": most}})
            (self.folder / "r.h5").rename(self.folder / f"r{most}.h5")
            self.assertEqual(self.run_program("verify", f"r{most}.h5", "--strict").returncode, 0)
        with h5py.File(self.folder / "r1.h5") as file:
            self.assertEqual((file["fixed_point_index"][0], file["approach_fixed_point_index"][0]), (0, -1))
        self.write("spec.json", {**problem, "coordination": {"max_delay": 1}})
        text = self.run_program("analyze", "spec.json").stdout.decode()
        self.assertRegex(text, "loses no time +for one step from 2 cells, indefinitely from an unknown number")
        result = self.run_program("query", "r1.h5", "--at", "s=0", "--json")
        approach = json.loads(result.stdout)["partitions"][0]["approach"]
        self.assertEqual((approach["delay"], approach["delay_status"]), (1, "at_least"))
        text = self.run_program("query", "r1.h5", "--at", "s=0").stdout.decode()
        self.assertRegex(text, "approach delay +at least 1 step")
        text = self.run_program("compare", "r2.h5", "r1.h5").stdout.decode()
        self.assertIn("at least 2 steps", text)
        self.assertIn("at which max_delay stopped the later analysis: perhaps nothing is lost there", text)

    def test_goals_that_nothing_comes_nearer_to(self):
        for goal, text in (
            ("p == 7", "no cell of the invariance set is in the goal on this grid: it cannot be forced"),
            ("p == 2", "the goal can be forced from goal cells only"),
        ):
            problem = spec([state("p", 2, discrete=True)], {"u": [0, 1]}, {"p": "p - u"}, goal)
            self.write("spec.json", {**problem, "abstraction": {"cells": "half_open"}})
            result = self.run_program("analyze", "spec.json", "--json")
            self.assertEqual(result.returncode, 0)
            self.assertIn(f"coordreq: warning: {text} (/goal)\n", result.stderr.decode())
            self.assertIn(text, [one["message"] for one in json.loads(result.stdout)["warnings"]])

    def test_what_is_refused(self):
        self.write("spec.json", {**leaving("goal"), "goal": "u == 0"})
        self.assert_fails(3, "expected an expression over states, found the input 'u' (/goal)", "validate", "spec.json")
        without = leaving("goal")
        del without["goal"]
        self.write("spec.json", without)
        self.assert_fails(
            3,
            "'goal' is for a spec with the key 'goal', expected 'safe' or another (/states/0/outside/above)",
            "validate",
            "spec.json",
        )
        without = leaving("safe")
        del without["goal"]
        without["requirements"] = [{"name": "r", "where": "true", "max_arrival": 1}]
        self.write("spec.json", without)
        self.assert_fails(
            3, "'max_arrival' is for a spec with the key 'goal' (/requirements/0/max_arrival)", "validate", "spec.json"
        )


if __name__ == "__main__":
    unittest.main()
