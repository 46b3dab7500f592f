"""What `allow` forbids, silent agents do not do together: two shuttles on a rail that must not pass through each other.

By hand: K has the 12 cells with p1 != p2. In (1, 2) they may go left, right or apart, so that each has both actions; one
takes its part of "right", the other its part of "left", and they pass through each other. Cells with an odd distance lead
there after one step. With an even one (0, 2) and (1, 3) take turns, and nobody has a choice."""

import json
import unittest

import h5py
import numpy as np
from program import Case

RAIL = {"lower": 0, "upper": 3, "step": 1, "discrete": True, "outside": "unsafe"}
SWAP = {
    "coordreq": 1,
    "name": "swap",
    "states": [{"name": "p1", **RAIL}, {"name": "p2", **RAIL}],
    "inputs": [{"name": "u1", "values": [-1, 1]}, {"name": "u2", "values": [-1, 1]}],
    "agents": [{"name": "a", "inputs": ["u1"]}, {"name": "b", "inputs": ["u2"]}],
    "dynamics": {"time": "discrete", "period": 1, "equations": {"p1": "p1 + u1", "p2": "p2 + u2"}},
    "safe": "p1 != p2",
    "controller": {"allow": "not (p1 + u1 == p2 and p2 + u2 == p1)"},
    "abstraction": {"cells": "half_open"},
    "output": {"controller": True, "actions": True},
}
FOREVER = np.iinfo(np.int16).max
DELAYS = [[-2, 1, FOREVER, 1], [1, -2, 0, FOREVER], [FOREVER, 0, -2, 1], [1, FOREVER, 1, -2]]
LONG = ("--steps", "40", "--runs", "20")
MEET = {"name": "meet", "where": "p1 == 1 and p2 == 2", "min_delay": 1}


class Cases(Case):
    def swap(self, name="swap.h5", code=0, **changes):
        """The summary."""
        self.write("swap.json", {**SWAP, **changes})
        result = self.run_program("analyze", "swap.json", "-o", name, "--json")
        self.assertEqual(result.returncode, code, result.stderr)
        return json.loads(result.stdout)

    def json(self, *arguments):
        result = self.run_program(*arguments, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def delays(self, name="swap.h5"):
        with h5py.File(self.folder / name) as file:
            return file["delay"][0].tolist()

    def test_delays_are_those_by_hand(self):
        (alone,) = self.swap()["partitions"]
        self.assertEqual((alone["layers"], alone["F"], alone["fixed_point"]), ([12, 10, 4], 2, 4))
        self.assertEqual(self.delays(), DELAYS)
        self.assertEqual(self.run_program("verify", "swap.h5", "--strict").returncode, 0)

    def test_both_kinds_of_synthesis(self):
        self.swap(controller={**SWAP["controller"], "synthesis": "given"}, safe="true")
        found = self.json("verify", "swap.h5")
        self.assertEqual(found["verdict"], "holds")

    def test_others_delays_are_wrong(self):
        self.swap()
        for cell, delay in (((1, 2), 1), ((0, 1), 2), ((1, 2), FOREVER)):
            with h5py.File(self.folder / "swap.h5", "r+") as file:
                before = file["delay"][0][cell]
                file["delay"][(0, *cell)] = delay
            self.assertEqual(self.run_program("verify", "swap.h5").returncode, 1)
            with h5py.File(self.folder / "swap.h5", "r+") as file:
                file["delay"][(0, *cell)] = before
        self.assertEqual(self.run_program("verify", "swap.h5").returncode, 0)

    def test_a_counterexample_ends_with_what_is_forbidden(self):
        (found,) = self.swap(code=1, requirements=[MEET])["requirements"]
        story = found["counterexample"]
        self.assertEqual((story["end"], story["end_sample"], len(story["steps"])), ("not_allowed", None, 1))
        self.assertEqual(story["steps"][0]["inputs"], {"a": {"u1": 1}, "b": {"u2": -1}})
        text = self.run_program("analyze", "swap.json").stdout.decode()
        sentence = "Each agent independently takes permitted actions, and after 1 step their joint input is one that 'allow' forbids."
        self.assertIn(sentence, text)
        self.assertEqual(self.run_program("verify", "swap.h5", "--strict").returncode, 0)
        with h5py.File(self.folder / "swap.h5", "r+") as file:
            file["counterexample/0/input"][0] = [1, 1]
        self.assertEqual(self.run_program("verify", "swap.h5").returncode, 1)

    def test_explain_tells_of_it(self):
        self.swap()
        found = self.json("explain", "swap.h5", "--at", "p1=1,p2=2")
        self.assertEqual((found["delay"], found["way_out"]["end"]), (0, "not_allowed"))
        # Left with u1 = -1, or with u2 = 1, the other one's choice does no harm.
        remedies = [(own["class"], own["inputs"], own["delay"]) for own in found["remedies"]]
        self.assertEqual(remedies, [("a", {"u1": -1}, 2), ("b", {"u2": 1}, 2)])

    def test_a_network_is_not_safe_with_it(self):
        modes = [{"name": "up", "partition": "a+b"}, {"name": "down", "partition": "a|b"}]
        transitions = [["up", "up"], ["up", "down"], ["down", "up"]]
        for resynthesise in (False, True):
            network = {"modes": modes, "transitions": transitions, "resynthesise": resynthesise}
            self.swap(network=network)
            with h5py.File(self.folder / "swap.h5") as file:
                safe = file["network_safe"][()]
            self.assertFalse(safe[1][1, 2] or safe[1][2, 1])
            self.assertEqual(self.run_program("verify", "swap.h5", "--strict").returncode, 0)
            if not resynthesise:
                even = np.array(DELAYS) == FOREVER
                np.testing.assert_array_equal(safe, [even, even])

    def test_those_who_meet_have_to_talk(self):
        self.swap(coordination={"partitions": "all", "horizon": 1})
        answer = self.json("query", "swap.h5", "--at", "p1=1,p2=2")
        self.assertEqual(answer["coalition"]["partition"], "a+b")
        answer = self.json("query", "swap.h5", "--at", "p1=0,p2=1")
        self.assertEqual(answer["coalition"]["partition"], "a|b")

    def test_no_run_does_it(self):
        self.swap()
        for policy in ("random", "adversarial"):
            found = self.json("simulate", "swap.h5", *LONG, "--start", "random", "--policy", policy)
            self.assertEqual((found["outcomes"]["completed"], found["outcomes"]["not_allowed"]), (20, 0))

    def test_a_run_of_wrong_delays_ends_with_it(self):
        self.swap()
        with h5py.File(self.folder / "swap.h5", "r+") as file:
            file["delay"][0, 1, 2] = file["delay"][0, 2, 1] = 5
        result = self.run_program("simulate", "swap.h5", *LONG, "--from", "p1=1,p2=2")
        self.assertEqual(result.returncode, 1)
        self.assertIn(b"did what 'allow' forbids", result.stdout)

    def test_a_file_forbids_nothing(self):
        self.swap("listed.h5")
        listed = {"file": "listed.h5"}
        (alone,) = self.swap(controller=listed)["partitions"]
        self.assertEqual((alone["F"], alone["layers"]), (0, [12]))
        self.assertEqual(self.run_program("verify", "swap.h5", "--strict").returncode, 0)
        self.swap(controller={**listed, **SWAP["controller"]})
        self.assertEqual(self.delays(), DELAYS)
        self.assertEqual(self.run_program("verify", "swap.h5", "--strict").returncode, 0)

    def test_what_is_forbidden_to_each_is_not_mixed(self):
        """`allow` that joins nobody leaves all as it was."""
        (alone,) = self.swap(controller={"allow": "u1 == 1 or p1 > 0"})["partitions"]
        (plain,) = self.swap(controller={})["partitions"]
        self.assertEqual(alone["layers"], plain["layers"])


if __name__ == "__main__":
    unittest.main()
