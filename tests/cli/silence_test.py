"""Silence of agents that do what they are told, from outside: the crossing worked out by others, lanes by hand, a fleet, runs."""

import itertools
import json
import subprocess
import unittest

import h5py
import numpy
from program import CONFIGS, Case, spec_with, without_comments, without_places

MOST = 32767  # of int16: unbounded


def crossing(silence, **more):
    spec = json.loads(without_comments((CONFIGS / "crossing.json").read_text()))
    return {**spec, "silence": silence, **more}


def both(text):
    """The rule of both vehicles; # is the number of each."""
    return {"first": text.replace("#", "1"), "second": text.replace("#", "2")}


GIVE_WAY = {"first": "u1 == 1", "second": "u2 == -1"}
# How many cells have at least so much silence: 0, 1, 2, ... steps.
HAND = {
    "u# == -1": [20501, 19569, 18061, 16149, 13601, 11053, 8505, 6110, 3904, 2086, 1193, 861],
    "u# <= 0": [20501, 18684, 15600, 12309, 9848],
    "u# == 0": [20501, 19258, 17374, 14916, 13272],
    "true": [20501, 17995, 13264, 11494, 9681],
}
LAST = {"u# == -1": 861, "u# == 0": 2525, "true": 861}


def lanes(agents):
    """Cars that have to be in different ones of two lanes from now on."""
    names = ["one", "two", "three"][:agents]
    inputs = [f"u{i + 1}" for i in range(agents)]
    apart = " and ".join(f"{a} != {b}" for a, b in itertools.combinations(inputs, 2))
    return {
        "coordreq": 1,
        "name": "lanes",
        "states": [{"name": "e", "lower": 0, "upper": 1, "step": 1, "discrete": True}],
        "inputs": [{"name": name, "values": [0, 1]} for name in inputs],
        "agents": [{"name": name, "inputs": [own]} for name, own in zip(names, inputs)],
        "dynamics": {"time": "discrete", "period": 1, "equations": {"e": f"if({apart}, 0, 1)"}},
        "safe": "e == 0",
    }


def chain(**more):
    """A point that silent agents move up by one a step, and that falls back by one afterwards; above 6 it is lost."""
    return {
        "coordreq": 1,
        "name": "chain",
        "states": [{"name": "x", "lower": 0, "upper": 9, "step": 1, "discrete": True, "outside": "saturate"}],
        "inputs": [{"name": "u", "values": [-1, 0, 1]}, {"name": "v", "values": [0, 1]}],
        "agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
        "dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x + u"}},
        "safe": "x <= 6",
        "silence": {"actions": {"a": "u == 1", "b": "true"}, "then": {"a": "u == if(x <= 4, -1, 1)", "b": "v == 0"}},
        **more,
    }


class Cases(Case):
    def results(self, problem, *arguments):
        self.write("spec.json", problem)
        return self.analyze("spec.json", "-o", "r.h5", *arguments)

    def silence(self, problem):
        return self.results(problem)["partitions"][0]["silence"]

    def arrays(self, *names):
        with h5py.File(self.folder / "r.h5") as file:
            return [file[name][...] for name in names]

    # what is found

    def test_the_crossing(self):
        plain = None
        for rule, sizes in HAND.items():
            found = self.results(crossing({"actions": both(rule)}))
            own = found["partitions"][0]["silence"]
            self.assertEqual(own["layers"][: len(sizes)], sizes, rule)
            if rule in LAST:
                self.assertEqual(own["fixed_point"], LAST[rule], rule)
            self.assertEqual(own["F"], len(own["layers"]) - 1)
            self.assertNotIn("silence_set", found)
            plain = plain or found["partitions"][0]["layers"]
            self.assertEqual(found["partitions"][0]["layers"], plain)

    def test_the_crossing_with_what_comes_after(self):
        found = self.results(crossing({"then": GIVE_WAY}))
        self.assertEqual(found["silence_set"], 10506)
        self.assertEqual(found["partitions"][0]["silence"]["layers"][0], 10506)
        found = self.results(crossing({"actions": both("true"), "then": GIVE_WAY}))
        self.assertEqual(found["partitions"][0]["silence"]["layers"][:5], [10506, 8705, 6808, 5397, 4172])
        silence, members, sizes = self.arrays("silence", "silence_set", "silence_layer_size")
        self.assertTrue(((silence[0] >= 0) == (members == 1)).all())
        self.assertEqual(sizes[0, :5].tolist(), [10506, 8705, 6808, 5397, 4172])
        with h5py.File(self.folder / "r.h5") as file:
            self.assertEqual(int(file["silence_set"].attrs["cells"]), 10506)
            self.assertEqual(file["silence"].attrs["flag_meanings"], "not_safe not_in_silence_set unbounded")

    def test_lanes(self):
        for agents, invariant in ((2, 1), (3, 0)):
            problem = lanes(agents)
            names = [agent["name"] for agent in problem["agents"]]
            rules = {name: f"u{i + 1} == {min(i, 1)}" for i, name in enumerate(names)}
            found = self.results({**problem, "silence": {"actions": {name: "true" for name in names}, "then": rules}})
            self.assertEqual(found["invariant"], invariant)
            # Pairs are kept apart by rules that differ with the role; three agents have two lanes only.
            self.assertEqual(found["silence_set"], invariant)
            self.assertEqual(found["partitions"][0]["silence"]["layers"], [invariant, 0][: invariant + 1])
            (silence,) = self.arrays("silence")
            self.assertEqual(silence.tolist(), [[0 if invariant else -1, -2]])

    def test_a_chain_by_hand(self):
        found = self.results(chain())
        self.assertEqual(found["silence_set"], 5)
        self.assertEqual(found["partitions"][0]["silence"]["layers"], [5, 4, 3, 2, 1, 0])
        (silence,) = self.arrays("silence")
        self.assertEqual(silence.tolist(), [[4, 3, 2, 1, 0, -1, -1, -2, -2, -2]])
        found = self.results(chain(silence={"actions": {"a": "u == 1", "b": "true"}}))
        self.assertEqual(found["partitions"][0]["silence"]["layers"], [7, 6, 5, 4, 3, 2, 1, 0])
        found = self.results(chain(coordination={"max_delay": 2}))
        own = found["partitions"][0]["silence"]
        self.assertEqual((own["layers"], own["F"], own["truncated"]), ([5, 4, 3], None, True))

    def test_agents_without_a_rule_do_what_the_controller_leaves_to_them(self):
        self.results(chain(silence={"actions": {"b": "v == 1"}}))
        delay, silence = self.arrays("delay", "silence")
        self.assertTrue((delay == silence).all())

    def test_agents_that_are_told_nothing_they_could_do(self):
        problem = chain(silence={"actions": {"a": "x > 3 or u == 1", "b": "x != 2 and v == 0"}})
        self.write("spec.json", problem)
        result = self.run_program("analyze", "spec.json", "-o", "r.h5", "--quiet", "--json")
        self.assertEqual(result.returncode, 0)
        result = self.run_program("analyze", "spec.json", "-o", "r.h5")
        self.assertIn(
            b"coordreq: warning: in 1 cell the communication-loss rule permits no action for 'b'; "
            b"the tolerated silence there is 0 (/silence/actions)\n",
            result.stderr,
        )
        (silence,) = self.arrays("silence")
        self.assertEqual(silence[0, 2], 0)

    def test_rules_may_remember(self):
        seen = {"a": "seen and u == 0 or not seen and u == 1", "b": "true"}
        found = self.results(chain(memory={"seen": "once(x >= 3)"}, silence={"actions": seen}))
        self.assertEqual(found["partitions"][0]["silence"]["fixed_point"], 14)
        result = self.run_program("verify", "r.h5", "--strict")
        self.assertEqual(result.returncode, 0, result.stdout.decode())
        result = self.run_program("query", "r.h5", "--at", "x=2,seen_past=0", "--json")
        own = json.loads(result.stdout)["partitions"][0]["silence"]
        self.assertEqual([one["actions"] for one in own["classes"]], [[2], [0, 1]])
        result = self.run_program("query", "r.h5", "--at", "x=2,seen_past=1", "--json")
        self.assertEqual(json.loads(result.stdout)["partitions"][0]["silence"]["classes"][0]["actions"], [1])
        found = self.simulate("--from", "x=0", "--silent", "-o", "runs.h5")
        self.assertEqual((found["traces"][0]["outcome"], found["traces"][0]["end"]["x"]), ("completed", 3))

    def test_what_is_forbidden_is_blocked(self):
        rules = {"actions": {"a": "u == 1", "b": "true"}}
        found = self.results(chain(silence=rules, controller={"allow": "v == 0 or x >= 2"}))
        self.assertEqual(self.arrays("silence")[0][0, :3].tolist(), [0, 0, 4])
        self.assertGreater(found["invariant"], 0)

    def test_the_rule_of_the_road(self):
        found = self.analyze(str(CONFIGS / "brake_on_silence.json"), "-o", "r.h5")
        layers = found["partitions"][0]["silence"]["layers"]
        self.assertEqual(layers[0], found["silence_set"])
        self.assertGreater(len(layers), 2)
        settings = [f'silence.actions.{name}="true"' for name in ("first", "second")]
        trust = self.analyze(
            str(CONFIGS / "brake_on_silence.json"), "--set", settings[0], "--set", settings[1], "-o", "trust.h5"
        )
        self.assertEqual(trust["silence_set"], found["silence_set"])
        self.assertTrue(all(a <= b for a, b in zip(trust["partitions"][0]["silence"]["layers"], layers)))

    def test_an_analysis_that_was_broken_off_ends_in_the_same_file(self):
        problem = crossing({"actions": {"first": "u1 <= 0"}, "then": GIVE_WAY})
        self.results(problem)
        whole = (self.folder / "r.h5").read_bytes()
        for arguments in (("--checkpoint", "c"), ("--checkpoint", "c", "--resume")):
            result = self.run_program("analyze", "spec.json", "-o", "r.h5", "--quiet", *arguments)
            self.assertEqual((result.returncode, result.stderr), (0, b""))
            self.assertEqual((self.folder / "r.h5").read_bytes(), whole)

    # inputs that are held

    def hold(self, held, **more):
        """The chain with other rules. The state of an input stands behind all others."""
        return chain(**{"silence": {"hold": held}, **more})

    def by_hand(self, held, rules, **more):
        spec = chain(**{"silence": {"actions": rules}, **more})
        for name, state, update in held:
            spec["states"].append({"name": name, "discrete": True, **state})
            spec["dynamics"]["equations"][name] = update
        return spec

    def assert_equal_files(self, one, two):
        """All datasets are equal, but for the text of the spec and its hash."""
        files = []
        for spec in (one, two):
            self.results(spec)
            found = {}
            with h5py.File(self.folder / "r.h5") as file:
                file.visititems(
                    lambda path, item: found.update({path: item[...].tolist()})
                    if isinstance(item, h5py.Dataset) and path not in ("spec", "spec_json")
                    else None
                )
            files.append(found)
        self.assertEqual(files[0].keys(), files[1].keys())
        self.assertEqual([path for path in files[0] if files[0][path] != files[1][path]], [])
        self.assertIn("silence", files[0])

    def test_holding_an_input_is_what_it_is_by_hand(self):
        of_u = ("u_held", {"lower": -1, "upper": 1, "step": 1}, "u")
        of_v = ("v_held", {"lower": 0, "upper": 1, "step": 1}, "v")
        rule = {"a": "u == u_held"}
        self.assert_equal_files(self.hold(["u"]), self.by_hand([of_u], rule))
        both_rules = {**rule, "b": "v == v_held"}
        self.assert_equal_files(self.hold("all"), self.by_hand([of_u, of_v], both_rules))
        self.assert_equal_files(
            self.hold(["v"], silence={"hold": ["v"], "actions": {"a": "u == 1", "b": "v >= 0"}}),
            self.by_hand([of_v], {"a": "u == 1", "b": "v >= 0 and v == v_held"}),
        )
        self.assertEqual(self.run_program("verify", "r.h5", "--quiet").returncode, 0)

    def test_values_that_are_not_evenly_spaced_are_held_by_their_number(self):
        inputs = [{"name": "u", "values": [2, -1, 0]}, {"name": "v", "values": [0, 1]}]
        self.assert_equal_files(
            self.hold(["u"], inputs=inputs),
            self.by_hand(
                [("u_held", {"lower": 0, "upper": 2, "step": 1}, "if(u == 2, 0, if(u == -1, 1, 2))")],
                {"a": "u == if(u_held == 0, 2, if(u_held == 1, -1, 0))"},
                inputs=inputs,
            ),
        )

    def test_constants_units_and_sight_of_an_input_that_is_held(self):
        spec = self.hold(["u"], constants={"MOST": "1/2 + 1/2"})
        spec["inputs"][0] = {"name": "u", "lower": "-MOST", "upper": "MOST", "count": 3, "unit": "m"}
        spec["agents"][0]["sees"] = ["x"]
        spec["definitions"] = {"low": "x - MOST"}
        self.results(spec)
        info = self.run_program("info", "r.h5").stdout.decode()
        self.assertRegex(info, r"\nu_held +state +3 +-1 +1 +m ")
        found = json.loads(self.run_program("query", "r.h5", "--at", "x=2,u_held=1", "--json").stdout)
        self.assertEqual(found["partitions"][0]["silence"]["classes"][0]["actions"], [2])

    def test_an_input_that_is_held_in_continuous_time(self):
        spec = self.hold(["u"])
        spec["states"][0] = {"name": "x", "lower": 0, "upper": 9, "step": 1, "outside": "saturate"}
        spec["dynamics"] = {"time": "continuous", "period": 1, "equations": {"x": "u"}}
        self.results(spec)
        self.assertGreater(len(numpy.unique(self.arrays("silence")[0])), 2)
        self.assertEqual(self.run_program("verify", "r.h5", "--quiet").returncode, 0)

    def test_errors_of_inputs_that_are_held(self):
        for message, hold, more in (
            ("'w' is not an input (/silence/hold/0)", ["w"], {}),
            ("the input 'u' is listed twice (/silence/hold/1)", ["u", "u"], {}),
            ("expected \"all\" or a list of inputs, found 'u' (/silence/hold)", "u", {}),
            ("the name 'u_held' is taken, expected it free for the state that keeps 'u' (/silence/hold)", "all", {"constants": {"u_held": 1}}),
        ):  # fmt: skip
            with self.subTest(message=message):
                self.write("spec.json", self.hold(hold, **more))
                result = self.run_program("validate", "spec.json")
                self.assertEqual(result.returncode, 3)
                self.assertEqual(without_places(result.stderr).decode(), f"coordreq: error: {message}\n")

    # commands

    def test_query(self):
        self.results(chain())
        result = self.run_program("query", "r.h5", "--at", "x=1", "--json")
        own = json.loads(result.stdout)["partitions"][0]["silence"]
        self.assertEqual((own["delay"], own["delay_status"], own["delay_time"]), (3, "steps", 3))
        self.assertNotIn("countdown", own)
        self.assertEqual([one["actions"] for one in own["classes"]], [[2], [0, 1]])
        text = self.run_program("query", "r.h5", "--at", "x=1").stdout.decode()
        self.assertRegex(text, r"\n  silence +3 steps\n")
        self.assertRegex(text, r"\n  silent of a +1 of 3: u = 1\n")
        text = self.run_program("query", "r.h5", "--at", "x=5").stdout.decode()
        self.assertRegex(text, r"\n  silence +none: the fallback rule does not keep the system safe\n")
        result = self.run_program("query", "r.h5", stdin=b"x\n1\n5\n8\n")
        lines = [line.split(",") for line in result.stdout.decode().splitlines()]
        place = lines[0].index("silence_delay:a|b")
        self.assertEqual([line[place] for line in lines[1:]], ["3", "-1", "-2"])
        self.assertEqual([line[lines[0].index("silence_actions:a|b:a")] for line in lines[1:]], ["2", "2", ""])

    def test_other_formats_tell_of_it(self):
        self.results(chain())
        table = self.run_program("export", "r.h5", "--format", "csv").stdout.decode().splitlines()
        names = table[0].split(",")
        self.assertTrue({"silence", "silence_set"} <= {name.split(":")[0] for name in names})
        self.run_program("report", "r.h5", "-o", "r.html")
        self.assertIn("Silence under the communication-loss rule", (self.folder / "r.html").read_text())
        info = json.loads(self.run_program("info", "r.h5", "--json").stdout)
        self.assertEqual((info["silence_set"], info["partitions"][0]["silence"]["layers"]), (5, [5, 4, 3, 2, 1, 0]))
        text = self.analyze_text("spec.json")
        self.assertRegex(text, r"\n  silent +5 4 3 2 1 0\n")
        (self.folder / "r.h5").rename(self.folder / "one.h5")
        self.results(chain(safe="x <= 5"))
        self.assertIn("silence", self.run_program("compare", "one.h5", "r.h5", "--json").stdout.decode())

    def analyze_text(self, spec):
        return self.run_program("analyze", spec, "-o", "again.h5").stdout.decode()

    def test_c_header(self):
        self.results(chain())
        result = self.run_program("export", "r.h5", "--format", "c-header")
        self.write("exported.h", result.stdout)
        self.write(
            "main.c",
            """
#include "exported.h"
#include <stdio.h>
int main(void) {
  int32_t x;
  for (x = -2; x < 10; ++x)
    printf("%d %d%d%d\\n", coordreq_chain_silence_countdown(x), coordreq_chain_silence_allowed(x, 0, 0),
           coordreq_chain_silence_allowed(x, 0, 1), coordreq_chain_silence_allowed(x, 0, 2));
  return 0;
}
""",
        )
        flags = ["-std=c99", "-O2", "-Wall", "-Wextra", "-Werror", "-pedantic", "-Wno-unused-const-variable"]
        subprocess.run(["gcc", *flags, "main.c", "-o", "main"], cwd=self.folder, check=True)
        lines = subprocess.run([self.folder / "main"], capture_output=True, text=True, check=True).stdout.splitlines()
        self.assertEqual(lines[2:9], ["4 001", "3 001", "2 001", "1 001", "0 001", "-1 001", "-1 001"])
        self.assertEqual(lines[9], "-2 000")

    def test_files_verify(self):
        for problem in (
            chain(),
            chain(coordination={"max_delay": 2, "partitions": "all"}),
            chain(silence={"actions": {"b": "v == 1"}}),
            chain(controller={"allow": "v == 0 or x >= 2"}, silence={"actions": {"a": "u == 1", "b": "true"}}),
            chain(network={"loss": 0.1}, risk={"horizon": 5}),
            chain(controller={"synthesis": "given", "allow": "u == -1"}),
            crossing({"actions": {"first": "u1 <= 0"}, "then": GIVE_WAY}),
        ):
            self.results(problem)
            for arguments in ((), ("--sample", "1")):
                result = self.run_program("verify", "r.h5", "--strict", *arguments)
                self.assertEqual((result.returncode, result.stderr), (0, b""), result.stdout.decode())

    def test_changed_values_are_found(self):
        self.results(chain())
        changes = [("silence", (0, 1), 2), ("silence", (0, 1), 4), ("silence", (0, 5), 0), ("silence", (0, 8), -1)]
        changes += [("silence_set", (4,), 0), ("silence_set", (5,), 1), ("silence_set", (0,), 0)]
        changes += [("silence_layer_size", (0, 1), 3), ("silence_fixed_point_index", (0,), 4)]
        for name, at, value in changes:
            with h5py.File(self.folder / "r.h5", "r+") as file:
                before = file[name][at]
                file[name][at] = value
            result = self.run_program("verify", "r.h5")
            self.assertEqual(result.returncode, 1, (name, at, value))
            with h5py.File(self.folder / "r.h5", "r+") as file:
                file[name][at] = before
        self.assertEqual(self.run_program("verify", "r.h5").returncode, 0)

    def test_a_set_that_could_be_larger_is_found(self):
        self.results(chain())
        with h5py.File(self.folder / "r.h5", "r+") as file:
            file["silence"][0] = numpy.where(file["silence"][0] >= 0, -1, file["silence"][0])
            file["silence_set"][...] = 0
            file["silence_set"].attrs["cells"] = numpy.uint64(0)
            file["silence_layer_size"][...] = 0
            file["silence_fixed_point_index"][...] = 0
        result = self.run_program("verify", "r.h5")
        self.assertEqual(result.returncode, 1)
        self.assertIn(b"x = 0: expected in the set, the fallback rule keeps it", result.stdout)

    def test_requirements(self):
        def asked(problem, where, **requirement):
            self.write("spec.json", {**problem, "requirements": [{"name": "r", "where": where, **requirement}]})
            result = self.run_program("analyze", "spec.json", "-o", "r.h5", "--json")
            (found,) = json.loads(result.stdout)["requirements"]
            self.assertEqual(result.returncode, 0 if found["holds"] else 1)
            verified = self.run_program("verify", "r.h5", "--strict")
            self.assertEqual(verified.returncode, 0, verified.stdout.decode())
            return found

        self.assertTrue(asked(chain(), "x <= 2", min_silence=2)["holds"])
        self.assertTrue(asked(chain(), "x <= 2", min_silence_time=1.5)["holds"])
        found = asked(chain(), "x <= 2", min_silence=3)
        self.assertEqual((found["failing"], found["least_silence"]), (1, 2))
        story = found["counterexample"]
        self.assertEqual([step["state"]["x"] for step in story["steps"]], [2, 3, 4, 5, 6])
        self.assertEqual([step["action"] for step in story["steps"]], ["silent"] * 3 + ["afterwards"] * 2)
        self.assertEqual((story["end"], story["end_sample"]["state"]), ("outside_safe_set", {"x": 7}))
        self.assertEqual((story["proven"], story["seen"]), (2, 3))
        text = self.run_program("analyze", "spec.json", "-o", "r.h5").stdout.decode()
        self.assertIn("requirement r: silence of a|b at least 3 steps\n", text)
        self.assertIn("FAILS: 1 of 3 cells fails, the worst at x = 2: it has a silence of 2 steps.", text)
        self.assertIn("The agents follow the communication-loss rule, and after 3 steps it is too late.", text)
        self.assertIn("With the fallback rule, after 2 steps the state is no longer safe.", text)
        seen = "Proven: 2 steps. A nominal simulation from the first state left the silence set after 3 steps."
        self.assertIn(seen, text)
        # Without what comes after: all together cannot help from beyond K.
        alone = chain(silence={"actions": {"a": "u == 1", "b": "true"}})
        story = asked(alone, "x <= 5", min_silence=3)["counterexample"]
        self.assertEqual([step["action"] for step in story["steps"]], ["silent"] * 2)
        told = chain(silence={"actions": {"a": "u == 1", "b": "x != 2 and v == 0"}})
        story = asked(told, "x <= 1", min_silence=2)["counterexample"]
        self.assertEqual((story["end"], story["end_sample"]["state"]), ("no_silent_action", {"x": 2}))
        found = asked(chain(), "x <= 5", min_silence=0)
        self.assertEqual((found["least_silence"], found["least_silence_status"]), (None, "not_in_silence_set"))
        self.assertEqual([step["action"] for step in found["counterexample"]["steps"]], ["afterwards"] * 2)
        self.assertEqual((found["counterexample"]["proven"], found["counterexample"]["seen"]), (2, 2))
        # Of equal cells the one that is lost first, not one that coordination keeps.
        walk = chain(safe="true", silence={"actions": {"a": "u == 0", "b": "true"}, "then": {"a": "u == 1", "b": "true"}})
        walk["states"][0]["outside"] = {"below": "saturate", "above": "unsafe"}
        walk["dynamics"]["equations"] = {"x": "if(x == 0, max(u, 0), x + 1)"}
        found = asked(walk, "true", min_silence=1)
        self.assertEqual((found["failing"], found["counterexample"]["state"]), (10, {"x": 9}))
        walk["silence"].pop("then")
        found = asked(walk, "x >= 1", min_silence=1)
        self.assertEqual(found["least_silence_status"], "not_invariant")
        text = self.run_program("analyze", "spec.json", "-o", "r.h5").stdout.decode()
        self.assertIn("the worst at x = 9: it cannot be kept safe, even if all agents coordinate.", text)

    def test_explained(self):
        def explained(at):
            return json.loads(self.run_program("explain", "r.h5", "--at", at, "--json").stdout)

        self.results(chain())
        found = explained("x=2")
        own = found["silence"]
        self.assertEqual((own["silence"], own["silence_status"], found["delay_status"]), (2, "steps", "unbounded"))
        classes = [(one["name"], one["permitted"], one["total"], one["actions"]) for one in own["classes"]]
        self.assertEqual(classes, [("a", 1, 3, "u = 1"), ("b", 2, 2, "v = 0, 1")])
        way = own["way_out"]
        self.assertEqual([step["state"]["x"] for step in way["steps"]], [2, 3, 4])
        self.assertEqual([step["silence"] for step in way["steps"]], [2, 1, 0])
        self.assertEqual((way["end"], way["end_sample"]["state"]), ("outside_silence_set", {"x": 5}))
        self.assertEqual((way["proven"], way["seen"]), (2, 3))
        said = [
            "During silence the rule permits here: a u = 1 and b any action.",
            "The agents follow the communication-loss rule, and after 3 steps the fallback rule is no longer safe.",
            "Proven: 2 steps. A nominal simulation from the first state left the silence set after 3 steps.",
        ]
        for sentence in said:
            self.assertIn(sentence, found["sentences"])
        text = self.run_program("explain", "r.h5", "--at", "x=2").stdout.decode()
        self.assertRegex(text, r"\nsilence +2 steps\n")
        self.assertIn("\nshortest path under the communication-loss rule\n", text)
        own = explained("x=5")["silence"]
        self.assertEqual((own["silence"], own["silence_status"], own["way_out"]), (None, "not_in_silence_set", None))
        text = self.run_program("explain", "r.h5", "--at", "x=5").stdout.decode()
        self.assertRegex(text, r"\nsilence +none: the fallback rule does not keep the system safe\n")
        self.assertEqual(explained("x=8")["sentences"], ["The cell is not safe."])
        self.results(chain(silence={"actions": {"a": "u == 1", "b": "x != 5"}}))
        way = explained("x=4")["silence"]["way_out"]
        self.assertEqual((len(way["steps"]), way["end"], way["proven"], way["seen"]), (1, "no_silent_action", 1, None))
        self.assertIn("a u = 1 and b no action.", " ".join(explained("x=5")["sentences"]))
        self.results(chain(silence={"actions": {"a": "u == 0", "b": "true"}}))
        own = explained("x=4")["silence"]
        self.assertEqual((own["silence"], own["silence_status"], own["way_out"]), (None, "unbounded", None))

    def test_the_way_that_is_explained_is_that_of_a_requirement(self):
        asked = [{"name": "r", "where": "-4.1 < p1 < -3.9 and -4.1 < p2 < -3.9 and v1 == 1 and v2 == 1", "min_silence": 30}]
        self.write("spec.json", crossing({"actions": both("u# <= 0")}, requirements=asked))
        result = self.run_program("analyze", "spec.json", "-o", "r.h5", "--json", "--quiet")
        (judged,) = json.loads(result.stdout)["requirements"]
        state = ",".join(f"{name}={value}" for name, value in judged["counterexample"]["state"].items())
        found = json.loads(self.run_program("explain", "r.h5", "--at", state, "--json").stdout)["silence"]
        self.assertEqual(found["silence"], judged["least_silence"])
        self.assertEqual(found["way_out"], judged["counterexample"])

    def test_risk_is_that_of_what_agents_are_told(self):
        self.results(chain(network={"loss": 0.5}, risk={"horizon": 1}, silence={"actions": {"a": "u == 1", "b": "true"}}))
        with h5py.File(self.folder / "r.h5") as file:
            modes = file["mode"][...].astype(str).tolist()
            risk = dict(zip(modes, file["risk"][...]))
        self.assertEqual(risk["down"].tolist(), [0] * 6 + [1] * 4)
        self.assertEqual(risk["up"].tolist(), [0] * 7 + [1] * 3)

    # runs

    def simulate(self, *arguments, code=0):
        result = self.run_program("simulate", "r.h5", "--steps", "20", "--json", *arguments)
        self.assertEqual(result.returncode, code, result.stderr)
        return json.loads(result.stdout)

    def test_runs_within_the_promise(self):
        self.results(chain())
        found = self.simulate("--from", "x=1", "--silent", "3", "-o", "runs.h5")
        self.assertEqual((found["silent"], found["outcomes"]["completed"]), (3, 1))
        with h5py.File(self.folder / "runs.h5") as file:
            self.assertEqual(file["state"][0, :8, 0].tolist(), [1, 2, 3, 4, 3, 2, 1, 0])
            self.assertEqual(file["countdown"][0, :5].tolist(), [3, 2, 1, 0, 0])
            self.assertEqual(file.attrs["silent"], 3)
        found = self.simulate("--from", "x=1", "--silent", "4")
        self.assertEqual(found["traces"][0]["outcome"], "left_safe_set")
        self.assertEqual(found["traces"][0]["steps"], 6)
        found = self.simulate("--from", "x=1", "--silent")
        self.assertIsNone(found["silent"])
        self.assertEqual((found["traces"][0]["outcome"], found["traces"][0]["steps"]), ("left_safe_set", 6))

    def test_runs_that_coordinate_afterwards(self):
        self.results(chain(silence={"actions": {"a": "u == 1", "b": "true"}}))
        found = self.simulate("--from", "x=1", "--silent", "5")
        self.assertEqual((found["outcomes"]["completed"], found["coordinated"]), (1, 15))
        self.results(chain(silence={"actions": {"a": "u == 1", "b": "x != 3"}}))
        found = self.simulate("--from", "x=1", "--silent", "5")
        self.assertEqual((found["traces"][0]["outcome"], found["traces"][0]["steps"]), ("stuck", 2))

    def test_a_broken_promise_is_a_violation(self):
        self.results(chain())
        with h5py.File(self.folder / "r.h5", "r+") as file:
            file["silence"][0, 5] = 3
            file["silence_set"][5] = 1
        found = self.simulate("--from", "x=5", "--silent", "3", code=1)
        self.assertEqual(found["traces"][0]["outcome"], "broke_promise")
        text = self.run_program("simulate", "r.h5", "--from", "x=5", "--steps", "20", "--silent", "3").stdout.decode()
        self.assertIn("chain, partition a|b: 1 run of 20 steps, policy random, silent for 3 steps, seed 1\n", text)
        self.assertIn("Run 0 left the safe set within the promised silence at step 2, at x = 7.\n", text)

    def test_runs_from_anywhere(self):
        for silence in ({"actions": both("u# <= 0"), "then": GIVE_WAY}, {"actions": {"first": "u1 == -1"}}):
            self.results(crossing(silence))
            for policy, steps in itertools.product(("random", "adversarial"), ((), ("2",))):
                arguments = ("--runs", "300", "--policy", policy, "--start", "random", "--silent", *steps)
                found = self.simulate(*arguments)
                self.assertEqual(found["outcomes"]["broke_promise"], 0)
                self.assertEqual(sum(found["outcomes"].values()), 300)

    # what is refused

    def test_refusals(self):
        silence = {"actions": {"first": "u1 <= u2"}}
        self.write("bad.json", crossing(silence))
        self.assert_fails(
            3,
            "expected inputs of the agent 'first' and states that it sees, found the input 'u2' (/silence/actions/first)",
            *("analyze", "bad.json", "-o", "none.h5"),
        )
        problem = crossing({"actions": {"first": "p2 >= 0 or u1 <= 0"}})
        problem["agents"][0]["sees"] = ["p1", "v1"]
        self.write("bad.json", problem)
        self.assert_fails(
            3,
            "expected inputs of the agent 'first' and states that it sees, found the state 'p2' (/silence/actions/first)",
            *("analyze", "bad.json", "-o", "none.h5"),
        )
        self.write("bad.json", crossing({"then": {"first": "u1 == -1"}}))
        self.assert_fails(
            3,
            "expected a condition for each agent, found none for 'second' (/silence/then)",
            *("analyze", "bad.json", "-o", "none.h5"),
        )
        self.write("bad.json", chain(silence={"actions": {"a": "sqrt(x - 4) >= u"}}))
        self.assert_fails(
            3, "the condition cannot be decided at x = 0, u = -1 (/silence/actions/a)", "analyze", "bad.json", "-o", "none.h5"
        )
        self.write("bad.json", spec_with(requirements=[{"name": "r", "where": "true", "min_silence": 1}]))
        self.assert_fails(
            3,
            "'min_silence' is for a spec with the key 'silence' (/requirements/0/min_silence)",
            *("analyze", "bad.json", "-o", "none.h5"),
        )

    def test_refusals_of_runs(self):
        self.results(spec_with())
        start = ("simulate", "r.h5", "--steps", "2")
        self.assert_fails(
            2,
            "the spec has no communication-loss rule, expected the key 'silence' (--silent)",
            *start, "--start", "random", "--silent",
        )  # fmt: skip
        self.results(chain())
        self.assert_fails(
            2,
            "the start is not in the silence set: the fallback rule is not safe from there (--from)",
            *start, "--from", "x=5", "--silent",
        )  # fmt: skip
        self.assert_fails(2, "the start is not in the safe set (--from)", *start, "--from", "x=8", "--silent")
        self.results(chain(silence={"then": {"a": "u == 1", "b": "true"}}))
        self.assert_fails(
            2, "the silence set is empty: there is no state to start from (--start)", *start, "--start", "random", "--silent"
        )
        self.results(chain(goal="x == 0"))
        self.assert_fails(
            2,
            "agents under the communication-loss rule do not pursue the goal, expected --silent or --until (--until)",
            *start, "--from", "x=1", "--silent", "--until", "goal",
        )  # fmt: skip


if __name__ == "__main__":
    unittest.main()
