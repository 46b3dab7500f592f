"""Updates of discrete states, and memories, through all commands."""

import json
import random
import subprocess
import unittest

import h5py
import numpy as np
from program import CONFIGS, ROOT, Case, spec_with, without_warnings

CHECK = """#include <stdio.h>
#include "exported.h"
int main(void) {
  double x[COORDREQ_PATROL_LOCK_STATES];
  for (;;) {
    uint32_t i;
    int32_t kept;
    for (i = 0; i < COORDREQ_PATROL_LOCK_STATES; ++i)
      if (scanf("%lf", &x[i]) != 1) return 0;
    kept = coordreq_patrol_lock_remember(coordreq_patrol_lock_cell(x));
    for (i = 0; i < COORDREQ_PATROL_LOCK_KEPT; ++i) printf("%g ", coordreq_patrol_lock_kept(kept, i));
    printf("\\n");
  }
}
"""


def point(memory, safe, **changes):
    """A discrete state p in {0, 1} that is what its agent wants."""
    return spec_with(
        name="point",
        states=[{"name": "p", "lower": 0, "upper": 1, "step": 1, "discrete": True}],
        inputs=[{"name": "u", "values": [0, 1]}],
        agents=[{"name": "a", "inputs": ["u"]}],
        dynamics={"time": "discrete", "period": 1, "equations": {"p": "u"}},
        memory=memory,
        safe=safe,
        abstraction=None,
        **changes,
    )


# A thermostat: the temperature switches the mode.
THERMOSTAT = spec_with(
    name="thermostat",
    states=[
        {"name": "T", "lower": 14, "upper": 26, "step": 0.5, "outside": "unsafe"},
        {"name": "m", "lower": 0, "upper": 1, "step": 1, "discrete": True},
    ],
    inputs=[{"name": "u", "values": [0, 1]}, {"name": "v", "values": [0, 1]}],
    dynamics={
        "time": "continuous",
        "period": 1,
        "equations": {"T": "2*m - 1 + (u - v)/2"},
        "updates": {"m": "if(T < 18, 1, if(T > 22, 0, m))"},
    },
    safe="15 <= T <= 25",
    abstraction=None,
    output={"abstraction": True},
)


FORMULAS = ("once({0})", "since({1}, {0})", "within(3, {0})", "for_last(2, {0}) or previous({1})", "always({1} or not {0})")


def random_spec(seed):
    """Two agents, a mode that one of them switches, and a memory that `safe` and `allow` name."""
    rng = random.Random(seed)
    points = rng.randint(5, 9)
    one, two = f"x >= {rng.randint(1, points - 2)}.3", f"y + m < {rng.randint(2, points)}"
    continuous = rng.random() < 0.5
    update = f"if(x >= {rng.randint(0, points)}.2, {rng.randint(0, 1)}, if({two}, m, 1))"
    equations = {"x": "u - m/2", "y": "v"} if continuous else {"x": "x + u - m/2", "y": "y + v", "m": update}
    dynamics = {"time": "continuous" if continuous else "discrete", "period": 1, "equations": equations}
    return spec_with(
        name="random",
        states=[
            *({"name": n, "lower": 0, "upper": points - 1, "step": 1, "outside": rng.choice(["unsafe", "saturate"])} for n in "xy"),
            {"name": "m", "lower": 0, "upper": 1, "step": 1, "discrete": True},
        ],
        dynamics=dict(dynamics, updates={"m": update}) if continuous else dynamics,
        memory={"was": rng.choice(FORMULAS).format(one, two)},
        safe=f"x + y <= {2 * points - 3} and (not was or x + 1 < {points} or y >= 1)",
        controller={"allow": rng.choice(["true", "not was or u <= 0", "was or v <= 0"])},
        abstraction={"cells": rng.choice(["closed", "half_open"]), "safe": rng.choice(["inner", "center"])},
        output={key: rng.random() < 0.5 for key in ("controller", "actions", "abstraction")},
    )


class Cases(Case):
    def run_well(self, *arguments):
        result = self.run_program(*arguments)
        self.assertEqual(without_warnings(result.stderr).decode(), "")
        self.assertEqual(result.returncode, 0, result.stdout.decode())
        return result.stdout.decode()

    def results(self, spec, *arguments):
        self.write("spec.json", spec)
        self.run_well("analyze", "spec.json", "-o", "out.h5", *arguments)
        return h5py.File(self.folder / "out.h5")

    # updates

    def test_a_mode_that_a_continuous_state_switches(self):
        with self.results(THERMOSTAT) as file:
            first, last = file["abstraction/m/first"][()], file["abstraction/m/last"][()]
            temperature = file["T"][()]
        for k, center in enumerate(temperature):
            for m in (0, 1):
                values = {1 if t < 18 else 0 if t > 22 else m for t in np.linspace(center - 0.25, center + 0.25, 11)}
                self.assertEqual((first[k, m], last[k, m]), (min(values), max(values)), (center, m))
        self.assertIn("holds", self.run_well("verify", "out.h5"))
        self.assertIn("stayed in the invariance set", self.run_well("simulate", "out.h5", "--from", "T=20,m=0", "--steps", "30"))

    def test_random_modes_and_memories_hold(self):
        for seed in range(12):
            with self.subTest(seed=seed):
                self.write("spec.json", random_spec(seed))
                result = self.run_program("analyze", "spec.json", "-o", "out.h5", "--quiet")
                self.assertEqual(result.returncode, 0, result.stderr)
                answer = json.loads(self.run_program("verify", "out.h5", "--json").stdout)
                self.assertEqual(answer["verdict"], "holds")
                runs = self.run_program("simulate", "out.h5", "--start", "random", "--runs", "5", "--steps", "20")
                self.assertTrue(runs.returncode == 0 or b"to start from" in runs.stderr, runs.stdout + runs.stderr)

    def test_verify_finds_a_wrong_update(self):
        with self.results(THERMOSTAT):
            pass
        with h5py.File(self.folder / "out.h5", "r+") as file:
            file["abstraction/m/last"][0, 0] = 0
            file["abstraction/m/first"][0, 0] = 0
        result = self.run_program("verify", "out.h5")
        self.assertEqual(result.returncode, 1)
        self.assertIn("abstraction m", result.stdout.decode())

    def test_validate_says_what_analyze_says(self):
        bad = json.loads(json.dumps(THERMOSTAT))
        bad["dynamics"]["updates"]["m"] = "if(T < 18, 1, m/2)"
        self.write("bad.json", bad)
        message = (
            "the next value of the discrete state 'm' can be 0.5 at T = 18, m = 1, expected 0 + k * 1 with an integer k "
            "(/dynamics/updates/m)"
        )
        for command in ("validate", "analyze"):
            self.assert_fails(3, message, command, "bad.json", "--threads", "1")

    # memories

    def test_what_once_was_bad_stays_bad(self):
        with self.results(point({"bad": "once(p==1)"}, "not bad")) as file:
            self.assertEqual(file["safe"].shape, (2, 2))
            self.assertEqual(list(file["bad_past"]), [0, 1])
            for name in ("safe", "invariant"):
                self.assertEqual(file[name][()].tolist(), [[1, 0], [0, 0]], name)
        self.assertIn("holds", self.run_well("verify", "out.h5"))
        self.assertIn("bad_past = 0", self.run_well("query", "out.h5", "--at", "p=0"))
        self.assertIn("outside", self.run_well("query", "out.h5", "--at", "p=0,bad_past=1"))

    def test_a_memory_is_a_state_made_by_hand(self):
        """The same product of system and automaton: K, delays and collision times are equal."""
        grid = [{"name": name, "lower": 0, "upper": 4, "step": 1, "discrete": True, "outside": "unsafe"} for name in "xy"]
        safe = "not (hot and tired and y >= 3) and x + y <= 6"
        own = spec_with(states=grid, memory={"hot": "within(3, x >= 3)", "tired": "since(y > 0, x >= 4)"}, safe=safe)
        equations = dict(own["dynamics"]["equations"], h="if(x >= 3, 2, max(h - 1, 0))", t="if(tired, 1, 0)")
        by_hand = spec_with(
            states=[
                *grid,
                {"name": "h", "lower": 0, "upper": 2, "step": 1, "discrete": True},
                {"name": "t", "lower": 0, "upper": 1, "step": 1, "discrete": True},
            ],
            definitions={"hot": "x >= 3 or h >= 1", "tired": "x >= 4 or y > 0 and t >= 1"},
            dynamics=dict(own["dynamics"], equations=equations),
            safe=safe,
        )
        found = []
        for spec in (own, by_hand):
            with self.results(spec) as file:
                found.append([file[name][()] for name in ("safe", "invariant", "collision_time", "delay")])
        for one, other in zip(*found):
            self.assertEqual(one.shape[-4:], (5, 5, 3, 2))
            self.assertTrue(np.array_equal(one, other))

    def test_what_is_not_given_is_as_at_first(self):
        self.results(point({"bad": "once(p==1)"}, "not bad")).close()
        for text in (b'{"p": 0}\n{"p": 0, "bad_past": 1}\n', b"p,bad_past\n0,0\n0,1\n"):
            lines = self.run_program("query", "out.h5", "--json", stdin=text).stdout.splitlines()
            self.assertEqual([json.loads(line)["safe"] for line in lines], [True, False])
        (line,) = self.run_program("query", "out.h5", "--json", stdin=b"p\n0\n").stdout.splitlines()
        self.assertEqual(json.loads(line)["state"], {"p": 0, "bad_past": 0})

    def test_a_region_begins_with_nothing_remembered(self):
        requirement = {"name": "start", "where": "p == 0", "invariant": True}
        self.results(point({"bad": "once(p==1)"}, "not bad", requirements=[requirement])).close()
        requirement["where"] = "p == 0 and bad"
        self.write("spec.json", point({"bad": "once(p==1)"}, "not bad", requirements=[requirement]))
        self.assertEqual(self.run_program("analyze", "spec.json").returncode, 1)

    def test_runs_follow_what_is_remembered(self):
        self.run_well("analyze", str(CONFIGS / "patrol_lock.json"), "-o", "out.h5")
        self.run_well("simulate", "out.h5", "--start", "random", "--runs", "20", "--steps", "60", "-o", "runs.h5")
        with h5py.File(self.folder / "runs.h5") as runs:
            x = runs["state"][:, :, :2]
        east = x > 3.5
        passed = (east[:, 1:] != east[:, :-1]).sum(axis=-1)
        self.assertTrue((passed <= 1).all())
        self.assertGreater(passed.sum(), 20)
        for run in passed:
            times = np.flatnonzero(run)
            self.assertTrue((np.diff(times) > 3).all(), times)

    def test_the_header_remembers_as_the_analysis_does(self):
        self.run_well("analyze", str(CONFIGS / "patrol_lock.json"), "-o", "out.h5", "--set", "output.abstraction=true")
        self.run_well("export", "out.h5", "--format", "c-header", "-o", "exported.h")
        self.write("main.c", CHECK)
        flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-Wno-unused-function"]
        subprocess.run(["gcc", *flags, "main.c", "-o", "main"], cwd=self.folder, check=True)
        with h5py.File(self.folder / "out.h5") as file:
            names = ["x1", "x2", "passed1_past1", "passed1_past2", "passed2_past1", "passed2_past2", "locked_past1", "locked_past2"]
            shape = file["safe"].shape
            self.assertEqual(shape, (8, 8, 2, 2, 2, 2, 2, 3))
            random = np.random.default_rng(1)
            states = np.stack([random.integers(0, n, 500) for n in shape], axis=-1)
            expected = []
            for state in states:
                row = []
                for name in names[2:]:
                    table = file[f"abstraction/{name}/first"]
                    scales = [dim[0].name.split("/")[-1] for dim in table.dims]
                    row.append(int(table[tuple(state[names.index(scale)] for scale in scales)]))
                expected.append(row)
        text = "".join(" ".join(map(str, state)) + "\n" for state in states)
        result = subprocess.run([self.folder / "main"], input=text, capture_output=True, text=True, check=True)
        self.assertEqual([[int(x) for x in line.split()] for line in result.stdout.splitlines()], expected)

    def test_allow_asks_a_memory_of_whole_cells(self):
        spec = spec_with(
            states=[{"name": "x", "lower": -2, "upper": 2, "step": 1, "outside": "saturate"}],
            inputs=[{"name": "u", "values": [-1, 0, 1]}],
            agents=[{"name": "a", "inputs": ["u"]}],
            dynamics={"time": "discrete", "period": 1, "equations": {"x": "x + u"}},
            memory={"seen": "once(x >= 0.2)"},
            definitions={"quiet": "not seen and x < 1.5"},
            safe="true",
            output={"controller": True},
            controller={"allow": "quiet or u == 0"},
        )
        for safe, allowed in (("inner", [7, 7, 2, 2, 2]), ("center", [7, 7, 7, 2, 2])):
            with self.results(dict(spec, abstraction={"cells": "half_open", "safe": safe})) as file:
                controller = file["controller"][..., 0]
            self.assertEqual(controller[:, 0].tolist(), allowed)
            self.assertTrue((controller[:, 1:] == 2).all())
            self.assertIn("holds", self.run_well("verify", "out.h5"))
            for k, x in enumerate((-2, -1, 0, 1, 2)):
                answer = json.loads(self.run_well("query", "out.h5", "--at", f"x={x}", "--json"))
                actions = answer["partitions"][0]["classes"][0]["actions"]
                self.assertEqual(sum(1 << u for u in actions), allowed[k])

    def test_first_come_costs_nothing(self):
        half = []
        for name, first in (("crossing", ()), ("first_come", (0, 0))):
            self.run_well("analyze", str(CONFIGS / f"{name}.json"), "-o", "out.h5")
            with h5py.File(self.folder / "out.h5") as file:
                delay = file["delay"][0][(..., *first)]
            delay = delay[delay >= 0]
            self.assertEqual(delay.size, 20501)
            half.append(int(np.sort(delay)[delay.size // 2]))
        self.assertEqual(half, [4, 5])

    def test_pictures_show_first_values(self):
        self.run_well("analyze", str(CONFIGS / "patrol_lock.json"), "-o", "out.h5")
        for more in ((), ("--slice", "x1=1", "--y", "locked_past1")):
            command = [ROOT / "scripts/plot", "layers", "out.h5", "-o", "picture.png", *more]
            result = subprocess.run(command, cwd=self.folder, capture_output=True, check=False)
            self.assertEqual((result.returncode, result.stderr), (0, b""))

    def test_the_examples_hold(self):
        for name in ("first_come", "patrol_lock"):
            with self.subTest(example=name):
                self.run_well("analyze", str(CONFIGS / f"{name}.json"), "-o", "out.h5")
                self.assertIn("holds", self.run_well("verify", "out.h5"))

    def test_a_controller_file_without_memories_holds_for_all_their_values(self):
        self.results(spec_with(output={"controller": True})).close()
        (self.folder / "out.h5").rename(self.folder / "plain.h5")
        memory = {"hot": "within(3, x >= 3)"}
        with self.results(spec_with(memory=memory, safe="x + y <= 6 or hot", controller={"file": "plain.h5"}, output={"controller": True})) as file:
            listed = file["controller:file"][()]
        with h5py.File(self.folder / "plain.h5") as file:
            plain = file["controller"][()]
        for k in range(3):
            self.assertTrue(np.array_equal(listed[:, :, k], plain))


if __name__ == "__main__":
    unittest.main()
