"""Goals to stay at and to return to, from outside: cases worked by hand, what commands tell of them, faults that are found."""

import json
import subprocess
import unittest

import h5py
import numpy
from program import Case

MOST = 32767  # of int16: unbounded, or cannot be forced


def game(last, following, goal, then, u=(0, 1), **more):
    """A state p of 0, ..., last, and two agents with an input each."""
    return {
        "coordreq": 1,
        "name": "game",
        "states": [{"name": "p", "lower": 0, "upper": last, "step": 1, "discrete": True, "outside": "saturate"}],
        "inputs": [{"name": "u", "values": list(u)}, {"name": "v", "values": [0, 1]}],
        "agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
        "dynamics": {"time": "discrete", "period": 1, "unit": "s", "equations": {"p": following}},
        "safe": "true",
        "goal": {"where": goal, "then": then},
        "output": {"controller": True, "actions": True},
        **more,
    }


def line(then):
    return game(4, "p + u", "p == 3", then, u=(-1, 0, 1))


# From 0 to 1, from 1 to 2, from 3 to 2, and from 2 to 3 if u == v, else to 1.
def meeting(then, **more):
    return game(3, "if(p == 3, 2, if(p == 2, if(u == v, 3, 1), p + 1))", "p >= 2", then, **more)


# From 0, in the goal, the world may go to 1, outside of it, and so to 2; or wait.
WAITING = {
    **game(2, "if(p < 0.5, d, 2)", "p == 0 or p == 2", "stay"),
    "states": [{"name": "p", "lower": 0, "upper": 2, "step": 1, "outside": "saturate"}],
    "disturbances": [{"name": "d", "lower": 0, "upper": 1}],
    "abstraction": {"cells": "half_open", "safe": "center"},
}


class Cases(Case):
    def results(self, problem):
        self.write("spec.json", problem)
        result = self.run_program("analyze", "spec.json", "-o", "r.h5", "--json", "--quiet", "--force")
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        self.summary = json.loads(result.stdout)
        with h5py.File(self.folder / "r.h5") as file:
            return {name: numpy.array(file[name]) for name in file if isinstance(file[name], h5py.Dataset)}

    def text_of(self, *arguments):
        result = self.run_program(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr.decode())
        return result.stdout.decode()

    def test_cells_by_hand(self):
        found = self.results(line("stay"))
        self.assertEqual(found["arrival"].tolist(), [3, 2, 1, 0, 1])
        self.assertEqual(self.summary["goal"], {"cells": 1, "winning": 5, "longest_arrival": 3, "then": "stay"})
        # Only u = 0 keeps the state in 3; joint inputs are numbered (-1, 0), (-1, 1), (0, 0), ...
        self.assertEqual(found["controller:goal"].ravel().tolist(), [0b110000] * 3 + [0b001100, 0b000011])
        found = self.results(line("return"))
        self.assertEqual(found["arrival"].tolist(), [3, 2, 1, 0, 1])
        self.assertEqual(
            self.summary["goal"],
            {"cells": 1, "winning": 5, "longest_arrival": 3, "then": "return", "longest_return": 1, "longest_gap": 2},
        )
        self.assertEqual(found["controller:goal"].ravel().tolist(), [0b110000] * 3 + [0b111111, 0b000011])
        self.assertEqual(found["approach_delay"].tolist(), [[MOST] * 5])

    def test_layers_in_the_goal(self):
        found = self.results(meeting("stay", coordination={"connection_delay": 1}))
        self.assertEqual(found["delay"].tolist(), [[MOST] * 4])
        self.assertEqual(found["arrival"].tolist(), [2, 1, 0, 0])
        self.assertEqual(found["approach_delay"].tolist(), [[2, 1, 0, 1]])
        self.assertEqual(found["approach_trigger"].tolist(), [[1, 0, -3, 0]])
        (partition,) = self.summary["partitions"]
        self.assertEqual(partition["approach"]["layers"], [4, 3, 1, 0])
        self.assertEqual(partition["approach"]["F"], 3)
        self.results(meeting("stay", coordination={"max_delay": 1}))
        (partition,) = self.summary["partitions"]
        self.assertEqual((partition["approach"]["layers"], partition["approach"]["F"]), ([4, 3], None))

    def test_commands_tell_of_it(self):
        self.results(line("return"))
        text = self.text_of("analyze", "spec.json", "-o", "r.h5", "--force")
        self.assertIn("goal                 1 cell to return to; forced from 5 cells, the next visit within 3 steps (3 s)", text)
        self.assertIn("time between visits  1 step (1 s) can be forced, 2 steps (2 s) at most whatever is chosen", text)
        goal = json.loads(self.text_of("info", "r.h5", "--json"))["goal"]
        self.assertEqual((goal["then"], goal["longest_return"], goal["longest_gap"]), ("return", 1, 2))
        self.assertIn("time to the next visit", self.text_of("query", "r.h5", "--at", "p=1"))
        self.results(line("stay"))
        text = self.text_of("analyze", "spec.json", "-o", "r.h5", "--force")
        self.assertIn("1 cell to stay at; forced from 5 cells, at most 3 samples outside it", text)
        self.assertRegex(self.text_of("info", "r.h5"), "goal +1 to stay at\n(.*\n)*most samples outside it +3\n")

    def test_what_agents_choose_keeps_in_the_goal(self):
        self.results(line("stay"))
        allowed = json.loads(self.text_of("query", "r.h5", "--at", "p=3", "--json"))
        self.assertEqual(allowed["arrival"], 0)
        for policy in ("random", "adversarial"):
            run = ("simulate", "r.h5", "--steps", "12", "--start", "random", "--runs", "20", "--policy", policy, "--json")
            for trace in json.loads(self.text_of(*run))["traces"]:
                self.assertEqual(trace["outcome"], "completed")
                start = trace["start"]["p"]
                self.assertEqual(trace["outside_goal"], abs(start - 3))
                self.assertEqual(trace["last_outside_goal"], abs(start - 3) - 1 if start != 3 else None)
        self.assertIn("at most 3 samples outside, the last after 2 steps", self.text_of("simulate", "r.h5", "--steps", "9", "--from", "p=0"))
        self.results(line("return"))
        for trace in json.loads(self.text_of("simulate", "r.h5", "--steps", "40", "--start", "random", "--runs", "20", "--json"))["traces"]:
            self.assertEqual(trace["outcome"], "completed")
            self.assertLessEqual(trace["longest_gap"], 2)
        self.assert_fails(2, "runs do not end in a goal to stay at or to return to (--until)", "simulate", "r.h5", "--start", "random", "--steps", "3", "--until", "goal")

    def story(self, problem, where, **limit):
        """The counterexample of a requirement: its cells, how it ends, and the text of the analysis."""
        self.write("spec.json", {**problem, "requirements": [{"name": "r", "where": where, **limit}]})
        result = self.run_program("analyze", "spec.json", "-o", "r.h5", "--json", "--quiet", "--force")
        self.assertEqual(result.returncode, 1, result.stderr.decode())
        (requirement,) = json.loads(result.stdout)["requirements"]
        text = self.run_program("analyze", "spec.json", "-o", "r.h5", "--force").stdout.decode()
        self.assertIn("holds", self.text_of("verify", "r.h5", "--full"))
        story = requirement["counterexample"]
        samples = story["steps"] + ([story["end_sample"]] if story["end_sample"] else [])
        return [sample["cell"] for sample in samples], story["end"], text

    def test_limits_of_arrival(self):
        for then in ("stay", "return"):
            self.write("spec.json", {**line(then), "requirements": [{"name": "r", "where": "0 <= p <= 4", "max_arrival": 3}]})
            result = self.run_program("analyze", "spec.json", "-o", "r.h5")
            self.assertEqual(result.returncode, 0, result.stderr.decode())
        cells, end, text = self.story(line("stay"), "0 <= p <= 4", max_arrival=2)
        self.assertEqual((cells, end), ([0, 1, 2, 3], "arrived"))
        self.assertIn("requirement r: outside the goal for at most 2 samples\n", text)
        self.assertIn("it may be outside the goal for 3 samples", text)
        cells, end, text = self.story(line("return"), "0 <= p <= 4", max_arrival=2)
        self.assertEqual((cells, end), ([0, 1, 2, 3], "arrived"))
        self.assertIn("at the next visit of the goal after at most 2 steps (2 s)", text)

    def test_the_world_shows_what_it_can_force(self):
        # It could wait in 0 for ever, and would show nothing.
        cells, end, _ = self.story(WAITING, "0 <= p <= 2", max_arrival=0)
        self.assertEqual((cells, end), ([0, 1, 2], "arrived"))
        # Left alone it waits in 0, which shows nothing; 1 is in the goal, too, but nearer to 2.
        drift = {**WAITING, "dynamics": {**WAITING["dynamics"], "equations": {"p": "p + d"}}}
        drift["states"] = [{**WAITING["states"][0], "upper": 3}]
        drift["disturbances"] = [{"name": "d", "lower": 0, "upper": 0.7}]
        drift["goal"] = {"where": "p <= 1 or p == 3", "then": "stay"}
        cells, end, _ = self.story(drift, "p == 0", max_arrival=0)
        self.assertEqual((cells, end), ([0, 1, 2, 2], "never_arrives"))
        trap = {**WAITING, "dynamics": {**WAITING["dynamics"], "equations": {"p": "if(p < 0.5, d, 1)"}}}
        trap["states"] = [{**WAITING["states"][0], "upper": 1}]
        for then, words in (("stay", "the state may never stay in the goal"), ("return", "the goal may never be visited again")):
            trap["goal"] = {"where": "p == 0", "then": then}
            cells, end, text = self.story(trap, "p == 0", max_arrival=5)
            self.assertEqual((cells, end), ([0, 1, 1], "never_arrives"))
            self.assertIn(f"the state repeats: {words}", text)
        # A run that waits in the goal shows nothing, for either of them.
        for then in ("stay", "return"):
            trap["goal"] = {"where": "p == 0", "then": then}
            self.story(trap, "p == 0", max_arrival=5)
            with h5py.File(self.folder / "r.h5", "r+") as file:
                file["counterexample/0/cell"][...] = 0
                file["counterexample/0/state"][...] = 0
                file["counterexample/0/input"][...] = file["counterexample/0/input"][0]
            result = self.run_program("verify", "r.h5")
            self.assertEqual(result.returncode, 1, result.stdout.decode())
            self.assertIn(b"are in the goal" if then == "stay" else b"visited again", result.stdout)

    def test_the_world_chooses_of_what_the_controller_lists(self):
        # Below 3 the controller lists waiting, so that nobody need ever come to the goal; in 4 it goes back.
        for then in ("stay", "return"):
            given = game(4, "if(p < 3, p + u, if(p == 3, p, p - 1))", "p == 3", then, controller={"synthesis": "given", "allow": "u >= 0"})
            self.assertEqual(self.results(given)["arrival"].tolist(), [MOST, MOST, MOST, 0, 1])
            cells, end, _ = self.story(given, "p == 1", max_arrival=9)
            self.assertEqual((cells, end), ([1, 1], "never_arrives"))
            cells, end, _ = self.story(given, "p == 4", max_arrival=0)
            self.assertEqual((cells, end), ([4, 3], "arrived"))

    def test_silence_that_fails_the_task(self):
        # Alone in 2 agents may miss each other, which leads out of the goal; from 3 that takes one step more.
        cells, end, text = self.story(meeting("stay"), "p == 3", min_approach_delay=2)
        self.assertEqual((cells, end), ([3, 2, 1], "time_lost"))
        self.assertIn("after 2 steps (2 s) the state has made no progress", text)

    def test_which_states_satisfy_a_limit(self):
        self.results(line("stay"))
        found = json.loads(self.text_of("require", "r.h5", "--arrival", "1", "--over", "p", "--json"))
        self.assertEqual(found["intervals"], [[2, 4]])
        self.results(line("return"))
        found = json.loads(self.text_of("require", "r.h5", "--arrival", "2", "--over", "p", "--json"))
        self.assertEqual(found["intervals"], [[1, 4]])
        self.results(meeting("stay"))
        found = json.loads(self.text_of("require", "r.h5", "--approach", "1", "--over", "p", "--json"))
        self.assertEqual(len(found["intervals"]), 2)  # 0 and 1, and 3

    def test_explain_tells_of_safety_beside_such_a_goal(self):
        self.results(meeting("return"))
        self.assertIn("unbounded", self.text_of("explain", "r.h5", "--at", "p=1"))

    def test_what_is_not_known_is_refused(self):
        self.write("spec.json", {**line("stay"), "goal": {"where": "p == 3", "then": "visit"}})
        self.assert_fails(3, "expected 'safe', 'over', 'stay' or 'return', found 'visit' (/goal/then)", "analyze", "spec.json")

    def test_goals_that_nobody_can_keep_are_warned_of(self):
        self.write("spec.json", game(4, "p + u", "p == 3", "stay", u=(-1, 1)))
        result = self.run_program("analyze", "spec.json", "-o", "r.h5")
        self.assertIn(b"from no cell can the goal be kept in the end", result.stderr)

    def test_verify_finds_faults(self):
        for problem in (line("stay"), line("return"), meeting("stay"), meeting("return"), WAITING):
            self.results(problem)
            self.assertIn("arrival", self.text_of("verify", "r.h5", "--full"))
        self.assertEqual(self.results(WAITING)["arrival"].tolist(), [1, 1, 0])
        # Also a solution of the equation of 0, but not the least one.
        with h5py.File(self.folder / "r.h5", "r+") as file:
            file["arrival"][0] = 5
            file["arrival"].attrs.modify("longest_arrival", 5)
        self.assertIn("arrival (fixed point)", self.text_of("verify", "r.h5"))
        result = self.run_program("verify", "r.h5", "--full")
        self.assertEqual(result.returncode, 1)
        self.assertIn(b"p = 0: could be less", result.stdout)
        # Less than can be kept.
        with h5py.File(self.folder / "r.h5", "r+") as file:
            file["arrival"][0] = 0
            file["arrival"].attrs.modify("longest_arrival", 1)
        self.assertEqual(self.run_program("verify", "r.h5").returncode, 1)

    def test_verify_finds_that_a_goal_can_be_visited(self):
        self.results({**line("return"), "output": {}})
        with h5py.File(self.folder / "r.h5", "r+") as file:
            file["arrival"][:] = MOST
            attributes = file["arrival"].attrs
            for name in ("longest_arrival", "longest_return", "longest_gap"):
                attributes.modify(name, -1)
            attributes.modify("winning_cells", 0)
            file["approach_delay"][:] = -4
            file["approach_trigger"][:] = -4
            file["approach_layer_size"][:] = 0
        self.assertIn("arrival (fixed point)", self.text_of("verify", "r.h5"))
        result = self.run_program("verify", "r.h5", "--full")
        self.assertEqual(result.returncode, 1)
        self.assertIn(b"p = 0: could be less", result.stdout)

    def test_the_c_header_says_the_same(self):
        self.results(meeting("stay"))
        header = self.text_of("export", "r.h5", "--format", "c-header")
        self.write("agents.h", header)
        self.write(
            "main.c",
            '#include <stdio.h>\n#include "agents.h"\nint main(void) { return 0; }\n',
        )
        subprocess.run(["cc", "-std=c99", "-Wall", "-Werror", "-Wno-unused-function", "-c", "main.c"], cwd=self.folder, check=True)


if __name__ == "__main__":
    unittest.main()
