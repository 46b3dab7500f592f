"""Goals that end the task, from outside: cases worked by hand, what counts as the goal, and all that tells of it."""

import json
import subprocess
import unittest

import h5py
import numpy
from program import Case

MOST = 32767  # of int16: unbounded, or cannot be forced

# A lander that sinks by 1 a second, by 2 if both push. On the ground it goes on sinking, out of the domain: nobody can
# stay there, so that a goal of that kind can only be the end. From 1 both must not push, from 2 nothing is wrong.
LANDER = {
    "coordreq": 1,
    "name": "lander",
    "states": [{"name": "h", "lower": 0, "upper": 4, "step": 1, "discrete": True, "outside": "unsafe"}],
    "inputs": [{"name": "u", "values": [0, 1]}, {"name": "v", "values": [0, 1]}],
    "agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
    "dynamics": {"time": "discrete", "period": 1, "unit": "s", "equations": {"h": "h - 1 - min(u, v)"}},
    "safe": "true",
    "goal": {"where": "h == 0", "then": "over"},
}


def moving(where, steps, state=None, **more):
    """One agent that moves a point by one of these steps in a second; cells are [a, b)."""
    return {
        "coordreq": 1,
        "name": "point",
        "states": [{"name": "p", "lower": 0, "upper": 4, "step": 1, "outside": "unsafe", **(state or {})}],
        "inputs": [{"name": "u", "values": steps}],
        "agents": [{"name": "a", "inputs": ["u"]}],
        "dynamics": {"time": "continuous", "period": 1, "equations": {"p": "u"}},
        "safe": "true",
        "goal": {"where": where, "then": "over"},
        "abstraction": {"cells": "half_open"},
        **more,
    }


class Cases(Case):
    def results(self, problem):
        self.write("spec.json", problem)
        result = self.run_program("analyze", "spec.json", "-o", "r.h5", "--json", "--quiet")
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        self.summary = json.loads(result.stdout)
        with h5py.File(self.folder / "r.h5") as file:
            return {name: numpy.array(file[name]) for name in file if isinstance(file[name], h5py.Dataset)}

    def text_of(self, *arguments):
        result = self.run_program(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr.decode())
        return result.stdout.decode()

    def test_a_goal_in_which_nobody_can_stay(self):
        found = self.results({**LANDER, "output": {"controller": True, "actions": True}})
        self.assertEqual(found["safe"].tolist(), [1] * 5)
        self.assertEqual(found["invariant"].tolist(), [1] * 5)
        self.assertEqual(found["collision_time"].tolist(), [MOST] * 5)
        self.assertEqual(found["arrival"].tolist(), [0, 1, 1, 2, 2])
        self.assertEqual(found["delay"].tolist(), [[MOST, 0, 1, 1, 2]])
        self.assertEqual(found["approach_delay"].tolist(), [[MOST, 0, MOST, 1, MOST]])
        # No joint input in the goal; below 1 all but both.
        self.assertEqual(found["controller"].ravel().tolist(), [0, 0b0111, 0b1111, 0b1111, 0b1111])
        self.assertEqual(found["controller:goal"].ravel().tolist(), [0, 0b0111, 0b1000, 0b1111, 0b1000])
        self.assertEqual(self.summary["goal"], {"cells": 1, "winning": 5, "longest_arrival": 2, "then": "over"})
        (partition,) = self.summary["partitions"]
        self.assertEqual((partition["F"], partition["layers"], partition["fixed_point"]), (3, [5, 4, 2, 1], 1))
        self.assertEqual(partition["max_delay_time"], 2)  # of the cells in which the task goes on
        self.assertEqual(self.run_program("verify", "r.h5", "--strict").returncode, 0)

    def test_a_goal_to_stay_in_is_none_there_and_says_what_helps(self):
        for goal in ("h == 1", {"where": "h == 1", "then": "safe"}):
            rests = {**LANDER["dynamics"], "equations": {"h": "if(h == 0, 0, h - 1 - min(u, v))"}}
            problem = {**LANDER, "goal": goal, "dynamics": rests}
            self.write("spec.json", problem)
            result = self.run_program("analyze", "spec.json", "-o", "r.h5", "--quiet")
            self.assertEqual(result.returncode, 0)
            with h5py.File(self.folder / "r.h5") as file:
                self.assertEqual(file["arrival"][...].tolist(), [MOST, 0, 1, 1, 2])
        self.write("spec.json", {**LANDER, "goal": "h == 0"})
        result = self.run_program("analyze", "spec.json", "-o", "r.h5")
        self.assertIn(
            'no cell of the invariance set is in the goal on this grid: it cannot be forced; of the safe set one is: if the task '
            'ends there, say "then": "over" (/goal)',
            result.stderr.decode(),
        )
        self.write("spec.json", {**LANDER, "goal": {"where": "h == 7", "then": "over"}})
        result = self.run_program("analyze", "spec.json", "-o", "r.h5")
        self.assertIn(
            "no cell of the safe set is in the goal on this grid: it cannot be forced (/goal)", result.stderr.decode()
        )

    def test_unsafe_cells_are_no_goal(self):
        found = self.results({**LANDER, "safe": "h != 0", "goal": {"where": "h <= 1", "then": "over"}})
        self.assertEqual(found["arrival"].tolist(), [-2, 0, 1, 1, 2])
        self.assertEqual(found["delay"].tolist(), [[-2, MOST, 0, 1, 1]])

    def test_where_silence_is_cut_off(self):
        found = self.results({**LANDER, "coordination": {"max_delay": 1, "connection_delay": 1}})
        self.assertEqual(found["delay"].tolist(), [[1, 0, 1, 1, 1]])
        self.assertEqual(found["approach_delay"].tolist(), [[1, 0, 1, 1, 1]])
        self.assertEqual(found["trigger"].tolist(), [[0, -3, 0, 0, 0]])
        (partition,) = self.summary["partitions"]
        self.assertEqual((partition["F"], partition["layers"]), (None, [5, 4]))
        self.assertEqual(partition["never_without_connection"], 1)
        self.assertEqual(self.run_program("verify", "r.h5", "--strict").returncode, 0)

    def test_everything_allowed_must_come_there(self):
        """Of a given controller both must not push at 1: all of K but the goal is lost that can come there."""
        found = self.results({**LANDER, "controller": {"synthesis": "given"}})
        self.assertEqual(found["invariant"].tolist(), [1, 0, 0, 0, 0])
        self.assertEqual(found["collision_time"].tolist(), [MOST, 1, 2, 2, 3])
        found = self.results({**LANDER, "controller": {"synthesis": "given", "allow": "h != 1 or u == 0"}})
        self.assertEqual(found["arrival"].tolist(), [0, 1, 2, 3, 4])
        found = self.results({**LANDER, "controller": {"synthesis": "given", "allow": "h > 1 or (h == 1 and u == 0)"}})
        self.assertEqual(found["arrival"].tolist(), [0, 1, 2, 3, 4])

    def test_networks_and_their_risk(self):
        problem = {**LANDER, "network": {"loss": 0.5}, "risk": {"horizon": 2}}
        found = self.results(problem)
        self.assertEqual(found["network_safe"].tolist(), [[1, 1, 0, 0, 0], [1, 0, 0, 0, 0]])
        # Without a word both may push at 1; from 2 and 3 they may be there next, with a step that is lost with 0.5.
        self.assertEqual(found["risk"].tolist(), [[0, 0, 0.5, 0.5, 0], [0, 1, 0.5, 0.5, 0]])
        self.assertEqual(self.run_program("verify", "r.h5", "--strict", "--full").returncode, 0)
        # With care both push at 2 and at 4, so that they are at 1 only with a step that is not lost.
        found = self.results({**problem, "network": {"loss": 0.5, "resynthesise": True}})
        self.assertEqual(found["network_safe"].tolist(), [[1, 1, 1, 1, 1], [1, 0, 1, 0, 1]])
        self.assertEqual(self.run_program("verify", "r.h5", "--strict").returncode, 0)

    def test_conventions_and_coalitions(self):
        coordination = {"convention": True, "horizon": 2, "partitions": "all"}
        problem = {**LANDER, "coordination": coordination, "output": {"actions": True}}
        found = self.results(problem)
        freedom = found["convention_freedom"]
        self.assertTrue(numpy.isnan(freedom[:, 0]).all())
        self.assertFalse(numpy.isnan(freedom[:, 1:]).any())
        with h5py.File(self.folder / "r.h5") as file:
            self.assertEqual(file["actions:convention/a"][0].tolist(), [0])
            names = [name.decode() for name in file["partition"][...]]
            self.assertEqual(names[file["coalition"][0]], "a|b")
        answer = json.loads(self.text_of("query", "r.h5", "--at", "h=0", "--json"))
        self.assertEqual([one["actions"] for one in answer["convention"]], [[], []])
        self.assertEqual(self.run_program("verify", "r.h5", "--strict").returncode, 0)

    def test_cells_of_the_goal_that_are_not_safe_end_nothing(self):
        found = self.results({**LANDER, "safe": "h < 4", "goal": {"where": "h == 0 or h == 4", "then": "over"}})
        self.assertEqual(found["arrival"].tolist()[:4], [0, 1, 1, 2])
        self.assertEqual(self.summary["partitions"][0]["max_delay_time"], 1)  # every cell but h = 0 is bounded

    def test_a_cell_counts_only_where_all_of_it_is_provably_there(self):
        cases = {
            "p <= 1.5": (moving("p <= 1.5", [-1, 1]), [0, 0, 1, 2, 3]),
            "a part of a cell": (moving("p <= 1.25", [-1, 1]), [0, 1, 2, 3, 4]),
            "what is measured may be off": (
                moving("p <= 1.5", [-1, 1], state={"measurement_error": "1/4"}),
                [0, MOST, MOST, MOST, MOST],
            ),
            "beyond its centre": (
                moving("p <= 1.25", [-1, 1], abstraction={"cells": "half_open", "safe": "center"}),
                [0, 0, 1, 2, 3],
            ),
            "no cell beyond a limit": (moving("p >= 4", [1], state={"outside": "stop"}), [MOST] * 5),
            "half a cell at a limit": (moving("p >= 3.5", [1], state={"outside": "stop"}), None),
        }
        for name, (problem, arrival) in cases.items():
            with self.subTest(name):
                self.write("spec.json", problem)
                self.run_program("analyze", "spec.json", "-o", "r.h5", "--quiet")
                with h5py.File(self.folder / "r.h5") as file:
                    found = file["arrival"][...].tolist()
                self.assertEqual(found if arrival else found[-2:], arrival or [1, 0])
                self.assertEqual(self.run_program("verify", "r.h5", "--strict").returncode, 0)

    def test_passing_by_is_not_arriving(self):
        """From 3 two steps a second pass through 2 between the samples, and then out of the domain."""
        problem = moving("1.5 <= p <= 2.5", [-2])
        for between in (False, True):
            found = self.results({**problem, "abstraction": {"cells": "half_open", "between_samples": between}})
            self.assertEqual(found["arrival"].tolist(), [-1, -1, 0, -1, 1])
            self.assertEqual(self.run_program("verify", "r.h5", "--strict").returncode, 0)
        problem["safe"] = "p <= 2.5 or p >= 3.5"
        for between, at_4 in ((False, 1), (True, -1)):
            found = self.results({**problem, "abstraction": {"cells": "half_open", "between_samples": between}})
            self.assertEqual(found["arrival"].tolist(), [-1, -1, 0, -2, at_4])

    def test_runs_end_there(self):
        self.results(LANDER)
        run = ("simulate", "r.h5", "--steps", "9", "--runs", "40", "--json")
        for policy in ("random", "adversarial"):
            found = json.loads(self.text_of(*run, "--start", "random", "--policy", policy))
            for trace in found["traces"]:
                self.assertEqual((trace["outcome"], trace["steps"]), ("reached_goal", trace["arrived"]))
                self.assertEqual(trace["end"], {"h": 0})
                self.assertLessEqual(trace["arrived"], 2)
        found = json.loads(self.text_of(*run, "--from", "h=0"))
        self.assertEqual({trace["steps"] for trace in found["traces"]}, {0})
        sees = [{"name": "a", "inputs": ["u"], "sees": []}, {"name": "b", "inputs": ["v"]}]
        self.results({**LANDER, "agents": sees, "network": {"loss": 0.5}})
        self.assertEqual(self.run_program("verify", "r.h5", "--strict").returncode, 0)
        found = json.loads(self.text_of(*run, "--from", "h=4", "--blind"))
        self.assertEqual({trace["outcome"] for trace in found["traces"]}, {"reached_goal"})
        found = json.loads(self.text_of(*run, "--from", "h=4", "--lossy"))
        self.assertLessEqual({trace["outcome"] for trace in found["traces"]}, {"reached_goal", "left_invariant", "not_allowed"})
        self.assertIn("reached_goal", {trace["outcome"] for trace in found["traces"]})

    def test_commands_tell_of_it(self):
        self.results(LANDER)
        text = self.text_of("analyze", "spec.json", "-o", "r.h5")
        self.assertIn("goal            1 cell, which ends the task; forced from 5 cells, within 2 steps (2 s)", text)
        self.assertRegex(self.text_of("info", "r.h5"), "goal +1, which ends the task\n")
        self.assertEqual(json.loads(self.text_of("info", "r.h5", "--json"))["goal"]["then"], "over")
        text = self.text_of("explain", "r.h5", "--at", "h=0")
        self.assertRegex(text, "delay +unbounded: the task is over here\n")
        self.assertTrue(text.endswith("The goal is reached here and the task ends: later states do not matter.\n"))
        self.assertTrue(json.loads(self.text_of("explain", "r.h5", "--at", "h=0", "--json"))["over"])
        found = json.loads(self.text_of("explain", "r.h5", "--at", "h=2", "--json"))
        self.assertEqual((found["over"], found["delay"], found["freer_is_shorter"]), (False, 1, None))
        answer = json.loads(self.text_of("query", "r.h5", "--at", "h=0", "--json"))
        self.assertEqual((answer["arrival"], answer["partitions"][0]["delay_status"]), (0, "unbounded"))
        self.text_of("report", "r.h5", "-o", "r.html")
        self.assertIn("1 state in which the task is over.", (self.folder / "r.html").read_text())

    def test_requirements_with_their_stories(self):
        asked = [
            {"name": "stays", "where": "0 <= h <= 4", "invariant": True},
            {"name": "soon", "where": "0 <= h <= 4", "max_arrival": 2},
            {"name": "sooner", "where": "1 <= h <= 4", "max_arrival": 1},
            {"name": "silence", "where": "0 <= h <= 1", "min_delay": 1},
        ]
        self.write("spec.json", {**LANDER, "requirements": asked})
        result = self.run_program("analyze", "spec.json", "-o", "r.h5", "--json")
        self.assertEqual(result.returncode, 1)
        stays, soon, sooner, silence = json.loads(result.stdout)["requirements"]
        self.assertTrue(stays["holds"] and soon["holds"])
        story = sooner["counterexample"]
        self.assertEqual((story["end"], story["end_sample"]["state"]), ("arrived", {"h": 0}))
        self.assertEqual([step["state"]["h"] for step in story["steps"]], [3, 2])
        self.assertEqual((silence["failing"], silence["counterexample"]["end"]), (1, "left_domain"))
        self.assertEqual(self.run_program("verify", "r.h5", "--strict").returncode, 0)

    def test_silent_agents_and_what_comes_after(self):
        both = {"a": "u == 1", "b": "v == 1"}
        self.results({**LANDER, "silence": {"actions": both}})
        (partition,) = self.summary["partitions"]
        # Two down a second: from 4 by 2 into the goal, from 3 by 1 past it.
        expected = {"F": 2, "layers": [5, 4, 3], "fixed_point": 3, "truncated": False, "best_state": {"h": 3.0}}
        self.assertEqual(partition["silence"], expected)
        with h5py.File(self.folder / "r.h5") as file:
            self.assertEqual(file["silence"][...].tolist(), [[MOST, 0, MOST, 1, MOST]])
        self.assertEqual(self.run_program("verify", "r.h5", "--strict").returncode, 0)
        # After any silence two down a second for ever: from 1 and 3 that is too much.
        found = self.results({**LANDER, "silence": {"actions": {"a": "true", "b": "true"}, "then": both}})
        self.assertEqual(found["silence"].tolist(), [[MOST, -1, 0, -1, 0]])
        self.assertEqual(found["silence_set"].tolist(), [1, 0, 1, 0, 1])
        self.assertEqual(self.summary["silence_set"], 3)
        self.assertEqual(self.run_program("verify", "r.h5", "--strict").returncode, 0)
        run = ("simulate", "r.h5", "--steps", "9", "--runs", "20", "--json", "--silent")
        found = json.loads(self.text_of(*run, "0", "--from", "h=4"))
        self.assertEqual({(trace["outcome"], trace["steps"]) for trace in found["traces"]}, {("reached_goal", 2)})
        found = json.loads(self.text_of(*run, "--start", "random"))
        self.assertIn("reached_goal", {trace["outcome"] for trace in found["traces"]})
        for at, value in (((0, 0), 0), ((0, 2), MOST)):
            with h5py.File(self.folder / "r.h5", "r+") as file:
                before = file["silence"][at]
                file["silence"][at] = value
            self.assertEqual(self.run_program("verify", "r.h5").returncode, 1)
            with h5py.File(self.folder / "r.h5", "r+") as file:
                file["silence"][at] = before
        with h5py.File(self.folder / "r.h5", "r+") as file:
            file["silence_set"][0] = 0
        self.assertEqual(self.run_program("verify", "r.h5").returncode, 1)
        # Nobody is asked there, so that a rule may say nothing.
        self.results({**LANDER, "silence": {"actions": {"a": "h > 0 and u == 1", "b": "v == 1"}}})
        self.assertEqual(self.summary["partitions"][0]["silence"], expected)
        self.assertEqual(self.run_program("verify", "r.h5", "--strict").returncode, 0)
        self.assertNotIn("silence", [warning["kind"] for warning in self.summary["warnings"]])

    def test_c_headers_know_when_it_is_over(self):
        self.results({**LANDER, "states": [{**LANDER["states"][0], "outside": {"above": "goal", "below": "unsafe"}}]})
        self.text_of("export", "r.h5", "--format", "c-header", "-o", "exported.h")
        (self.folder / "main.c").write_text("""
#include "exported.h"
#include <stdio.h>
int main(void) {
  int32_t cell;
  for (cell = -3; cell <= COORDREQ_LANDER_CELLS; ++cell) putchar(coordreq_lander_is_over(cell) ? '1' : '0');
  printf(" %d", coordreq_lander_countdown(0) == COORDREQ_LANDER_NEVER);
  printf(" %d", coordreq_lander_approach_countdown(0) == COORDREQ_LANDER_NEVER);
  return 0;
}
""")  # fmt: skip
        flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-Wno-unused-function"]
        subprocess.run(["gcc", *flags, "main.c", "-o", "main"], cwd=self.folder, check=True)
        result = subprocess.run([self.folder / "main"], capture_output=True, text=True, check=True)
        # No cell, beyond a side that is left for good, outside; the goal, and not.
        self.assertEqual(result.stdout, "010" + "10000" + "0 1 1")

    def test_changed_values_are_found(self):
        self.results({**LANDER, "network": {"loss": 0.5}, "risk": {"horizon": 2}})
        original = (self.folder / "r.h5").read_bytes()
        for name, cell, value in (
            ("arrival", 0, 1), ("arrival", 1, 0), ("invariant", 0, 0), ("collision_time", 0, 3), ("delay", 0, 3),
            ("approach_delay", 0, 3), ("network_safe", 0, 0), ("risk", 0, 0.5), ("trigger", 0, 3),
        ):  # fmt: skip
            (self.folder / "r.h5").write_bytes(original)
            with h5py.File(self.folder / "r.h5", "r+") as file:
                file[name][..., cell] = value
            self.assertEqual(self.run_program("verify", "r.h5").returncode, 1, name)

    def test_a_goal_that_is_left_out_is_found(self):
        """A file that knows nothing of a goal cell, nor of what leads to it, and is right but for that."""
        self.results({**LANDER, "goal": {"where": "h == 0 or h == 4", "then": "over"}})
        with h5py.File(self.folder / "r.h5", "r+") as file:
            for name, value in (("invariant", 0), ("collision_time", 1), ("arrival", -1), ("delay", -1), ("trigger", -1)):
                file[name][..., 0] = value
            for name in ("approach_delay", "approach_trigger"):
                file[name][..., 0] = -1
        result = self.run_program("verify", "r.h5")
        self.assertEqual(result.returncode, 1)
        self.assertIn("h = 0: does not count as the goal, but it is", result.stdout.decode())

    def test_memories_can_end_the_task(self):
        """Over once the lander has been on the ground, whatever it does after that."""
        problem = {**LANDER, "states": [{**LANDER["states"][0], "outside": "saturate"}], "memory": {"landed": "once(h == 0)"}}
        found = self.results({**problem, "safe": "h >= 1 or landed", "goal": {"where": "landed", "then": "over"}})
        self.assertEqual(found["arrival"][:, 0].tolist(), [0, 1, 1, 2, 2])
        self.assertTrue((found["arrival"][:, 1] == 0).all())
        self.assertEqual(self.run_program("verify", "r.h5", "--strict").returncode, 0)


if __name__ == "__main__":
    unittest.main()
