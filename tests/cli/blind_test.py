"""Silence with own observations only, from outside: cases worked by hand, examples, tables, runs, the C header."""

import json
import subprocess
import unittest

import h5py
import numpy
from program import CONFIGS, SPEC, Case, spec_with, without_comments

MOST = 32767  # of int16: unbounded


def hand(values, s, e, values_of_second=(0,), **more):
    """A state s that tells which action is right; e becomes 1 at a mistake. Nobody sees anything."""
    discrete = {"lower": 0, "step": 1, "discrete": True}
    return {
        "coordreq": 1,
        "name": "hand",
        "states": [{"name": "s", "upper": values - 1, **discrete}, {"name": "e", "upper": 1, **discrete}],
        "inputs": [{"name": "u1", "values": [0, 1]}, {"name": "u2", "values": list(values_of_second)}],
        "agents": [{"name": "one", "inputs": ["u1"], "sees": []}, {"name": "two", "inputs": ["u2"], "sees": []}],
        "dynamics": {"time": "discrete", "period": 1, "equations": {"s": s, "e": e}},
        "safe": "e == 0",
        **more,
    }


MATCH = hand(2, "s", "if(u1 == s, 0, 1)")
TOGGLE = hand(2, "1 - s", "if(u1 == s, 0, 1)")
OWN = {"first": ["p1", "v1"], "second": ["p2", "v2"]}


def example(name, sees, **more):
    """An example whose agents see these states, all of them the same if it is a list."""
    spec = json.loads(without_comments((CONFIGS / name).read_text()))
    for agent in spec["agents"]:
        agent["sees"] = sees if isinstance(sees, list) else sees[agent["name"]]
    return {**spec, **more}


def intersections(file, name, seen):
    """Q^k of all fibres from the admissible actions that are stored: bytes [k - 1, seen states, byte]."""
    agents = [part for part in file["partition"][...].astype(str)][0]
    countdown = file["blind_countdown"][0]
    actions = file[f"actions/{agents}/{name}"][...]
    states = [scales[0].name[1:] for scales in file["safe"].dims]
    unseen = tuple(i for i, state in enumerate(states) if state not in seen)
    rows = []
    for k in range(1, len(file["silent_layer"]) + 1):
        k = min(k, max(1, file["blind_fixed_point_index"][0]))
        inside = (countdown >= k)[..., None]
        row = numpy.bitwise_and.reduce(numpy.where(inside, actions, 255).astype(numpy.uint8), axis=unseen)
        rows.append(numpy.where(inside.any(axis=unseen), row, 0))
    return numpy.array(rows)


class Cases(Case):
    def results(self, problem, *arguments):
        self.write("spec.json", problem)
        return self.analyze("spec.json", "-o", "r.h5", *arguments)

    def blind(self, problem):
        return self.results(problem)["partitions"][0]["blind"]

    def arrays(self, *names):
        with h5py.File(self.folder / "r.h5") as file:
            return [file[name][...] for name in names]

    # what is found

    def test_hand_cases(self):
        self.assertEqual(
            self.blind(MATCH),
            {"F": 1, "layers": [2, 1], "fixed_point": 1, "truncated": False, "best_state": {"s": 0, "e": 0}, "as_much": 1},
        )
        delay, countdown, sizes, fixed = self.arrays(
            "blind_delay", "blind_countdown", "blind_layer_size", "blind_fixed_point_index"
        )
        self.assertEqual(delay.tolist(), [[[MOST, -2], [1, -2]]])
        self.assertEqual(countdown.tolist(), [[[MOST, -2], [0, -2]]])
        self.assertEqual((sizes.tolist(), fixed.tolist()), ([[2, 1]], [1]))
        self.assertEqual(self.blind(TOGGLE)["layers"], [2, 1, 0])
        self.assertEqual(self.arrays("blind_delay")[0][0, :, 0].tolist(), [1, 2])
        with h5py.File(self.folder / "r.h5") as file:
            self.assertEqual(file["silent_layer"][...].tolist(), [1, 2])
            table = file["silent/one|two/one"]
            self.assertEqual(table[...].tolist(), [[1], [0]])  # of equals the lower action; then nothing is left
            self.assertEqual(
                (table.attrs["inputs"], table.attrs["actions"], table.attrs["bitorder"]), ("u1", 2, "little")
            )

    def test_own_position_and_speed_are_enough_at_the_crossing(self):
        summary = self.results(example("crossing.json", OWN, output={"actions": True}))
        (partition,) = summary["partitions"]
        self.assertEqual(partition["blind"]["layers"], partition["layers"])
        self.assertEqual(partition["blind"]["as_much"], summary["invariant"])
        delay, blind = self.arrays("delay", "blind_delay")
        self.assertTrue((delay == blind).all())
        with h5py.File(self.folder / "r.h5") as file:
            for name, seen in OWN.items():
                table = file[f"silent/first|second/{name}"]
                self.assertEqual({scales[0].name[1:] for scales in list(table.dims)[1:-1]}, set(seen))
                self.assertTrue((table[...] == intersections(file, name, seen)).all(), name)

    def test_seeing_nothing_at_the_crossing(self):
        blind = self.blind(example("crossing.json", [], output={"actions": True}))
        self.assertEqual(blind["layers"][:5], [20501, 18875, 15092, 12628, 11205])
        with h5py.File(self.folder / "r.h5") as file:
            for name in OWN:
                self.assertTrue((file[f"silent/first|second/{name}"][...] == intersections(file, name, [])).all())

    def test_the_coarse_intersection(self):
        summary = self.results(example("intersection_coarse.json", OWN))
        self.assertEqual(summary["partitions"][0]["blind"]["layers"][:3], [265121, 260802, 239011])
        self.assertEqual(summary["partitions"][0]["blind"]["as_much"], summary["invariant"])

    def test_aircraft_that_see_nothing(self):
        summary = self.results(example("aircraft_coarse.json", []))
        blind = summary["partitions"][0]["blind"]
        self.assertEqual(blind["layers"][:5], [8648, 7335, 5673, 4189, 2754])
        self.assertEqual(blind["as_much"], summary["invariant"] - 3)

    def test_together_agents_need_no_sight(self):
        partitions = [{"classes": []}, {"name": "both", "classes": [["one", "two"]]}]
        self.results({**MATCH, "coordination": {"partitions": partitions}})
        delay, blind, countdown = self.arrays("delay", "blind_delay", "blind_countdown")
        self.assertTrue((delay[1] == blind[1]).all() and (delay[1] == countdown[1]).all())
        with h5py.File(self.folder / "r.h5") as file:
            self.assertEqual(sorted(file["silent"]), ["one|two"])

    def test_who_sees_everything_asks_for_nothing_more(self):
        seeing = [{**agent, "sees": ["s", "e"]} for agent in MATCH["agents"]]
        summary = self.results({**MATCH, "agents": seeing})
        self.assertNotIn("blind", summary["partitions"][0])
        with h5py.File(self.folder / "r.h5") as file:
            self.assertFalse([name for name in file if "blind" in name or "silent" in name])

    def test_steps_that_end_the_search(self):
        for steps, layers, rows in ((0, [2], [[0]]), (1, [2, 1], [[1]]), (2, [2, 1, 0], [[1], [0]])):
            blind = self.blind({**TOGGLE, "coordination": {"max_delay": steps}})
            self.assertEqual((blind["layers"], blind["truncated"]), (layers, steps < 2), steps)
            delay, table = self.arrays("blind_delay", "silent/one|two/one")
            self.assertEqual(delay[0, :, 0].tolist(), [min(steps, 1), min(steps, 2)])
            self.assertEqual(table.tolist(), rows)

    def test_no_delay_is_longer_than_the_search(self):
        # B_0 = {0, 1, 2}, B_1 = {0, 1}, B_2 is empty, so that F is known; from 2 agents only leave for good.
        spec = {**TOGGLE, "states": [{"name": "x", "lower": 0, "upper": 2, "step": 1, "discrete": True,
                                      "outside": {"below": "unsafe", "above": "safe"}}],
                "inputs": [{"name": "u", "values": [0, 1]}, {"name": "v", "values": [0]}],
                "agents": [{"name": "a", "inputs": ["u"], "sees": []}, {"name": "b", "inputs": ["v"], "sees": []}],
                "dynamics": {"time": "discrete", "period": 1,
                             "equations": {"x": "if(x < 2, if(u == 0, 2, -1), if(u == 1, 3, -1))"}},
                "safe": "true"}  # fmt: skip
        for steps, longest in ((1, 1), (2, 2), (3, 2**15 - 1), (None, 2**15 - 1)):
            summary = self.results({**spec, "coordination": {"max_delay": steps}})
            (delay,) = self.arrays("blind_delay")
            self.assertEqual(delay[0].tolist(), [1, 1, longest], steps)
            self.assertEqual(summary["partitions"][0]["blind"]["F"], 2 if steps != 1 else None)
            verification = self.run_program("verify", "r.h5", "--quiet")
            self.assertEqual((verification.returncode, verification.stderr), (0, b""), steps)

    def test_an_analysis_that_was_broken_off_ends_in_the_same_file(self):
        self.results(example("crossing.json", []))
        whole = (self.folder / "r.h5").read_bytes()
        for arguments in (("--checkpoint", "c"), ("--checkpoint", "c", "--resume")):
            result = self.run_program("analyze", "spec.json", "-o", "r.h5", "--quiet", *arguments)
            self.assertEqual((result.returncode, result.stderr), (0, b""))
            self.assertEqual((self.folder / "r.h5").read_bytes(), whole)

    def test_any_number_of_threads_writes_the_same_bytes(self):
        self.results(example("crossing.json", []), "--threads", "1")
        one = (self.folder / "r.h5").read_bytes()
        self.results(example("crossing.json", []), "--threads", "3")
        self.assertEqual((self.folder / "r.h5").read_bytes(), one)

    def test_what_else_speaks_of_agents_who_see_everything(self):
        problem = {**MATCH, "goal": "s == 0", "network": {"delay": 1}, "coordination": {"horizon": 2, "convention": True}}
        self.write("spec.json", problem)
        result = self.run_program("analyze", "spec.json", "-o", "r.h5", "--quiet")
        self.assertIn(
            b"results for 'goal', 'coordination/horizon', 'coordination/convention' and 'network' assume that agents observe",
            self.run_program("analyze", "spec.json", "-o", "r.h5").stderr,
        )
        self.assertEqual(result.returncode, 0)

    # commands

    def test_runs_stay_in_the_invariance_set(self):
        for sees in (OWN, []):
            self.results(example("crossing.json", sees))
            for policy in ("random", "adversarial"):
                arguments = ("--steps", "30", "--runs", "300", "--policy", policy)
                result = self.run_program("simulate", "r.h5", "--blind", "--start", "random", *arguments, "--json")
                self.assertEqual((result.returncode, result.stderr), (0, b""))
                found = json.loads(result.stdout)
                self.assertTrue(found["blind"])
                self.assertLess(found["coordinated"], found["steps_done"])

    def test_the_countdown_is_that_of_all_that_may_be_next(self):
        def coordinated(problem, start, *arguments):
            self.results(problem)
            self.run_program("simulate", "r.h5", "--blind", "--from", start, "--steps", "6", "-o", "runs.h5", *arguments)
            with h5py.File(self.folder / "runs.h5") as file:
                self.assertEqual(file.attrs["blind"], 1)
                return file["countdown"][0].tolist(), file["coordinated"][0, :6].tolist()

        self.assertEqual(coordinated(TOGGLE, "s=0,e=0"), ([0, 0, 1, 0, 1, 0, 1], [1, 1, 0, 1, 0, 1]))
        later = {**TOGGLE, "coordination": {"connection_delay": 2}}
        self.assertEqual(coordinated(later, "s=0,e=0"), ([0] * 7, [1] * 6))
        # From s = 1 the cell is known for one step only; s = 0 lasts for ever.
        never = 2**31 - 1
        self.assertEqual(coordinated(MATCH, "s=1,e=0"), ([0] * 7, [1] * 6))
        self.assertEqual(coordinated(MATCH, "s=0,e=0"), ([0] + [never] * 6, [1, 0, 0, 0, 0, 0]))

    def test_query_shows_the_row_of_the_table(self):
        self.results(TOGGLE)
        result = self.run_program("query", "r.h5", "--at", "s=0,e=0", "--json")
        own = json.loads(result.stdout)["partitions"][0]["blind"]
        self.assertEqual((own["delay"], own["delay_status"], own["countdown"]), (1, "steps", 1))
        self.assertEqual([one["actions"] for one in own["classes"]], [[0], [0]])
        result = self.run_program("query", "r.h5", "--at", "s=1,e=0", "--json")
        own = json.loads(result.stdout)["partitions"][0]["blind"]
        self.assertEqual((own["delay"], own["countdown"]), (2, 0))
        self.assertEqual([one["actions"] for one in own["classes"]], [[], []])
        text = self.run_program("query", "r.h5", "--at", "s=0,e=0").stdout.decode()
        self.assertRegex(text, r"blind delay +1 step")
        self.assertRegex(text, r"blind of one +1 of 2: u1 = 0")

    def test_explain_tells_what_sight_is_worth(self):
        self.results(TOGGLE)
        result = self.run_program("explain", "r.h5", "--at", "s=0,e=0", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        found = json.loads(result.stdout)
        self.assertEqual((found["delay_status"], found["sight"]["blind_delay"]), ("unbounded", 1))
        self.assertEqual(found["sight"]["class"], "one")
        self.assertEqual(
            found["sight"]["cells"],
            [{"state": {"s": 1, "e": 0}, "actions": [1]}, {"state": {"s": 0, "e": 0}, "actions": [0]}],
        )
        self.assertIn("With own observations only, silence ends after 1 step.", found["sentences"])
        self.assertIn(
            "It may end at s = 1, e = 0, where one may take u1 = 1; but the class cannot distinguish this from s = 0, e = 0, where it may take "
            "u1 = 0.",
            found["sentences"],
        )
        self.results(spec_with())
        self.assertNotIn("sight", json.loads(self.run_program("explain", "r.h5", "--at", "x=1,y=1", "--json").stdout))

    def test_other_formats_tell_of_it(self):
        self.results(TOGGLE)
        table = self.run_program("export", "r.h5", "--format", "csv").stdout.decode().splitlines()
        self.assertTrue({"blind_delay", "blind_countdown"} <= {name.split(":")[0] for name in table[0].split(",")})
        self.run_program("report", "r.h5", "-o", "r.html")
        self.assertIn("Silence with own observations only", (self.folder / "r.html").read_text())
        result = self.run_program("info", "r.h5", "--json")
        self.assertEqual(json.loads(result.stdout)["partitions"][0]["blind"]["layers"], [2, 1, 0])

    def test_two_files_are_compared(self):
        self.results(MATCH)
        (self.folder / "r.h5").rename(self.folder / "one.h5")
        self.results({**MATCH, "agents": [{**MATCH["agents"][0], "sees": ["s"]}, MATCH["agents"][1]]})
        result = self.run_program("compare", "one.h5", "r.h5", "--json")
        self.assertIn("blind", result.stdout.decode())

    def test_c_header_of_the_tables_alone(self):
        self.results(example("crossing.json", OWN))
        result = self.run_program("export", "r.h5", "--format", "c-header")
        self.write("exported.h", result.stdout)
        self.write(
            "main.c",
            """
#define COORDREQ_CROSSING_SILENT_ONLY
#include "exported.h"
#include <stdio.h>
int main(void) {
  uint32_t c, a;
  int32_t k;
  double own[2], state[COORDREQ_CROSSING_STATES];
  while (scanf("%u %d %lf %lf", &c, &k, &own[0], &own[1]) == 4) {
    state[0] = state[1] = state[2] = state[3] = 1e300; /* what the class does not see */
    state[c == 0 ? 0 : 3] = own[0];
    state[c == 0 ? 1 : 2] = own[1];
    for (a = 0; a < coordreq_crossing_action_count(c); ++a)
      putchar(coordreq_crossing_silent(c, state, k, a) ? '1' : '0');
    putchar(10);
  }
  return 0;
}
""",
        )
        flags = ["-std=c99", "-O2", "-Wall", "-Wextra", "-Werror", "-pedantic", "-Wno-unused-const-variable"]
        subprocess.run(["gcc", *flags, "main.c", "-o", "main"], cwd=self.folder, check=True)
        lines, expected = [], []
        with h5py.File(self.folder / "r.h5") as file:
            for c, (name, seen) in enumerate(OWN.items()):
                table = numpy.unpackbits(file[f"silent/first|second/{name}"][...], axis=-1, bitorder="little")
                p, v = (file[state][...] for state in (sorted(seen)))
                if c == 1:  # in the order of the spec: v2, p2
                    table = table.transpose(0, 2, 1, 3)
                for k in (1, 2, 3, len(table), len(table) + 1, 2**31 - 1):
                    for i, position in enumerate(p):
                        for j, speed in enumerate(v):
                            lines.append(f"{c} {k} {position} {speed}")
                            bits = table[min(k, len(table)) - 1, i, j][:5]
                            expected.append("".join(str(bit) for bit in bits))
                lines += [f"{c} 0 0 1", f"{c} 1 50 1", f"{c} 1 -50 1", f"{c} 1 0 99"]
                expected += ["00000", "11111", "00000", "00000"]
        result = subprocess.run(
            [self.folder / "main"], input="\n".join(lines), capture_output=True, text=True, check=True
        )
        self.assertEqual(result.stdout.splitlines(), expected)
        size = subprocess.run(["size", "main"], cwd=self.folder, capture_output=True, text=True, check=True).stdout
        self.assertLess(int(size.splitlines()[1].split()[0]), 40_000, size)

    def test_files_verify(self):
        both = {"partitions": [{"classes": []}, {"name": "both", "classes": [["one", "two"]]}]}
        for problem in (MATCH, TOGGLE, {**TOGGLE, "coordination": {"max_delay": 1}}, {**MATCH, "coordination": both},
                        {**TOGGLE, "coordination": {"max_delay": 0}}, example("crossing.json", OWN),
                        example("crossing.json", [])):  # fmt: skip
            self.results(problem)
            for arguments in ((), ("--sample", "1")):
                result = self.run_program("verify", "r.h5", "--strict", *arguments)
                self.assertEqual((result.returncode, result.stderr), (0, b""), result.stdout.decode())

    def test_changed_values_are_found(self):
        self.results(example("crossing.json", []))
        with h5py.File(self.folder / "r.h5") as file:
            place = tuple(numpy.argwhere(file["blind_countdown"][...] == 2)[0])
        changes = [("blind_delay", place, 1), ("blind_delay", place, 3), ("blind_countdown", place, 3)]
        changes += [("blind_countdown", place, 0), ("blind_layer_size", (0, 1), 3), ("blind_fixed_point_index", (0,), 1)]
        changes += [("silent/first|second/first", (0, 0), 255), ("silent/first|second/second", (1, 0), 0)]
        for name, at, value in changes:
            with h5py.File(self.folder / "r.h5", "r+") as file:
                before = file[name][at]
                file[name][at] = value
            result = self.run_program("verify", "r.h5")
            self.assertEqual(result.returncode, 1, (name, value))
            with h5py.File(self.folder / "r.h5", "r+") as file:
                file[name][at] = before
        self.assertEqual(self.run_program("verify", "r.h5").returncode, 0)

    def test_requirements(self):
        def asked(problem, **requirement):
            self.write("spec.json", {**problem, "requirements": [{"name": "r", "where": "e == 0 and 0 <= s <= 1", **requirement}]})
            result = self.run_program("analyze", "spec.json", "-o", "r.h5", "--json")
            (found,) = json.loads(result.stdout)["requirements"]
            self.assertEqual(result.returncode, 0 if found["holds"] else 1)
            verified = self.run_program("verify", "r.h5", "--strict")
            self.assertEqual(verified.returncode, 0, verified.stdout.decode())
            return found

        self.assertTrue(asked(TOGGLE, min_blind_delay=1)["holds"])
        self.assertTrue(asked(TOGGLE, min_blind_delay_time=0.5)["holds"])
        found = asked(TOGGLE, min_blind_delay=2)
        self.assertEqual((found["failing"], found["least_blind_delay"]), (1, 1))
        story = found["counterexample"]
        self.assertEqual(story["end"], "no_common_action")
        self.assertEqual(story["steps"][0]["state"], {"s": 0, "e": 0})
        self.assertEqual(story["end_sample"]["state"], {"s": 1, "e": 0})
        text = self.run_program("analyze", "spec.json", "-o", "r.h5").stdout.decode()
        self.assertIn("blind delay of one|two at least 2 steps", text)
        self.assertIn("some class has no action that suits all cells that look the same to it", text)

    # what is refused

    def test_refusals(self):
        self.results(spec_with())
        self.assert_fails(
            2,
            "all agents see all states, expected some that do not: 'sees' in the spec (--blind)",
            *("simulate", "r.h5", "--start", "random", "--steps", "2", "--blind"),
        )
        self.results({**TOGGLE, "agents": [{**agent, "prefer": "s"} for agent in TOGGLE["agents"]]})
        self.assert_fails(
            2,
            "'prefer' reads what agents do not see, expected random or adversarial with --blind (--policy)",
            *("simulate", "r.h5", "--start", "random", "--steps", "2", "--blind", "--policy", "prefer"),
        )
        self.assert_fails(
            2,
            "expected --blind or --silent, found both (--silent)",
            *("simulate", "r.h5", "--start", "random", "--steps", "2", "--silent", "--blind"),
        )
        self.results({**TOGGLE, "goal": "s == 0"})
        self.assert_fails(
            2,
            "agents with own observations only do not pursue the goal, expected --blind or --until (--until)",
            *("simulate", "r.h5", "--start", "random", "--steps", "2", "--blind", "--until", "goal"),
        )
        self.write("bad.json", spec_with(requirements=[{"name": "r", "where": "true", "min_blind_delay": 1}]))
        self.assert_fails(
            3,
            "'min_blind_delay' is for a spec in which some agent does not see all states, by 'sees' "
            "(/requirements/0/min_blind_delay)",
            *("analyze", "bad.json", "-o", "none.h5"),
        )
        agents = [{**SPEC["agents"][0], "sees": ["z"]}, SPEC["agents"][1]]
        self.write("bad.json", spec_with(agents=agents))
        self.assert_fails(
            3, "'z' is not a state (/agents/0/sees/0)", "analyze", "bad.json", "-o", "none.h5"
        )
        agents = [{**SPEC["agents"][0], "sees": ["x"]}, SPEC["agents"][1]]
        states = [{**SPEC["states"][0], "measurement_error": 0.25}, SPEC["states"][1]]
        self.write("bad.json", spec_with(agents=agents, states=states))
        self.assert_fails(
            3,
            "a state with a measurement error, expected one class of the partition 'a|b' that sees it, found 'a' and "
            "'b' (/states/0/measurement_error)",
            *("analyze", "bad.json", "-o", "none.h5"),
        )


if __name__ == "__main__":
    unittest.main()
