"""Closed loops from outside: what is printed, what is stored, and a second opinion on every step of it."""

import itertools
import json
import subprocess
import unittest

import h5py
import numpy as np
from program import CONFIGS, SPEC, Case, spec_with

NEVER = 2**31 - 1
EVERYTHING = {"controller": True, "actions": True}
START = ("--from", "x=1,y=2")

# A point that drifts, measured with an error, on a ring and a line.
DRIFT = {
    "coordreq": 1,
    "name": "drift",
    "states": [
        {"name": "h", "lower": 0, "upper": 8, "count": 8, "outside": "periodic", "measurement_error": 0.25},
        {"name": "p", "lower": 0, "upper": 20, "step": 1, "unit": "m", "outside": "saturate"},
    ],
    "inputs": [{"name": "u", "values": [-1, 0, 1]}, {"name": "v", "values": [-2, 0, 1]}],
    "disturbances": [{"name": "w", "lower": -0.5, "upper": 0.25, "unit": "m/s"}],
    "agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
    "dynamics": {"time": "continuous", "period": 1, "unit": "s", "equations": {"h": "u", "p": "v + w"}},
    "safe": "p <= 16.5 or h <= 4",
    "abstraction": {"cells": "half_open"},
    "coordination": {"connection_delay": 1},
    "output": {"abstraction": True},
}


def rough(h, p, edges, **more):
    """A system whose derivatives jump or bend within a period."""
    ring = {"lower": 0, "upper": 1, "count": 8, "outside": "periodic"}
    line = {"lower": -1, "upper": 1, "step": 0.125, "outside": edges}
    return {
        "coordreq": 1,
        "name": "rough",
        "states": [{"name": "h", **(ring if edges == "periodic" else line)},
                   {"name": "p", "lower": -2, "upper": 3, "step": 0.25, "outside": "saturate"}],
        "inputs": [{"name": "u", "values": [-0.5, 0, 1]}],
        "disturbances": [{"name": "w", "lower": -0.1, "upper": 0.2}],
        "agents": [{"name": "a", "inputs": ["u"]}],
        "dynamics": {"time": "continuous", "period": 0.5, "equations": {"h": h, "p": p}},
        "safe": "true",
        **more,
    }


class Cases(Case):
    def simulate(self, *arguments, code=0):
        result = self.run_program("simulate", *arguments)
        self.assertEqual((result.stderr.decode(), result.returncode), ("", code))
        return result.stdout.decode()

    def results(self, spec, *arguments):
        self.write("spec.json", spec)
        self.analyze("spec.json", "-o", "r.h5", *arguments)

    def test_text(self):
        self.results(spec_with(output=EVERYTHING))
        self.assert_prints(
            """small, partition a|b: 1 run of 4 steps (2 s), policy adversarial, seed 1
outcome          stayed in the invariance set
coordinated      3 of 4 steps (75 %); a centralised loop coordinates all of them
longest silence  1 step (0.5 s)
smallest margin  0, in the units of "safe"
start            x = 1, y = 3
end              x = 2, y = 4
""",
            *("simulate", "r.h5", "--from", "x=1,y=3", "--steps", "4", "--policy", "adversarial"),
        )

    def test_text_of_several_runs(self):
        self.results(DRIFT)
        text = self.simulate("r.h5", "--start", "random", "--steps", "9", "--runs", "7", "-o", "runs.h5")
        self.assertRegex(
            text,
            r"""^drift, partition a\|b: 7 runs of 9 steps \(9 s\), policy random, disturbance random, seed 1
outcome          7 stayed in the invariance set
coordinated      \d+ of 63 steps \([0-9.]+ %\); a centralised loop coordinates all of them
longest silence  \d steps? \(\d s\)
smallest margin  [0-9.]+, in the units of "safe"

runs in runs\.h5
$""",
        )

    def test_json(self):
        self.results(SPEC)
        document = json.loads(self.simulate("r.h5", *START, "--steps", "3", "--seed", "9", "--json"))
        self.assertEqual(
            list(document),
            ["name", "results", "guarantee", "partition", "connection_delay", "policy", "disturbance", "seed"]
            + ["runs", "steps", "period", "period_unit", "outcomes", "steps_done", "coordinated"]
            + ["longest_silence", "longest_silence_time", "smallest_margin", "output", "traces"],
        )
        self.assertEqual(
            document["outcomes"],
            {"completed": 1, "left_safely": 0, "left_invariant": 0, "no_action": 0, "not_followed": 0},
        )
        self.assertEqual((document["seed"], document["steps_done"], document["output"]), (9, 3, None))
        (trace,) = document["traces"]
        self.assertEqual(trace["start"], {"x": 1.0, "y": 2.0})
        self.assertEqual((trace["run"], trace["outcome"], trace["steps"]), (0, "completed", 3))

    def test_an_infinite_margin_is_null(self):
        self.results(spec_with(safe="true"))
        document = json.loads(self.simulate("r.h5", *START, "--steps", "3", "--json"))
        self.assertIsNone(document["smallest_margin"])

    def test_quiet(self):
        self.results(SPEC)
        self.assert_prints("", "simulate", "r.h5", *START, "--steps", "3", "--quiet")

    def test_a_run_that_leaves_k_fails_and_is_kept(self):
        self.results(SPEC)
        with h5py.File(self.folder / "r.h5", "r+") as file:
            delay = file["delay"][...]
            file["delay"][...] = np.where(delay >= 0, 9, delay)
        text = self.simulate(
            *("r.h5", "--from", "x=3,y=3", "--steps", "5", "--policy", "adversarial", "-o", "runs.h5"), code=1
        )
        self.assertIn("outcome          left the invariance set\n", text)
        self.assertIn(
            "\nRun 0 left the invariance set at step 1, at x = 4, y = 4.\n"
            "That contradicts the analysis: please report it with `coordreq --version`.\n\nruns in runs.h5\n",
            text,
        )
        with h5py.File(self.folder / "runs.h5") as file:
            self.assertEqual((file["outcome"][0], file["samples"][0]), (2, 2))
            self.assertEqual(file["state"][0, :2].tolist(), [[3, 3], [4, 4]])
            self.assertEqual(file["delay"][0].tolist(), [9, -2, -4, -4, -4, -4])
            self.assertEqual(file["coordinated"][0].tolist(), [0, 255, 255, 255, 255, 255])
            self.assertTrue(np.isnan(file["state"][0, 2:]).all())

    def test_same_bytes_for_any_number_of_threads(self):
        self.results(DRIFT)
        files = []
        for threads in ("1", "2", "5"):
            self.simulate(
                *("r.h5", "--start", "random", "--steps", "20", "--runs", "30", "--threads", threads),
                *("-o", "runs.h5"),
            )
            files.append((self.folder / "runs.h5").read_bytes())
        self.assertEqual(files[0], files[1])
        self.assertEqual(files[0], files[2])

    def test_a_seam_is_passed_within_a_period(self):
        # h is 1 after 5/19; then p goes on from 0.197 with h from 0.
        self.results(rough("1.9", "h", "periodic"))
        self.simulate("r.h5", "--from", "h=0.5,p=0", "--steps", "1", "-o", "runs.h5")
        with h5py.File(self.folder / "runs.h5") as file:
            before, after = 5 / 19, 0.5 - 5 / 19
            self.assertAlmostEqual(file["state"][0, 1, 0], 0.45, 12)
            self.assertAlmostEqual(
                file["state"][0, 1, 1], 0.5 * before + 0.95 * before**2 + 0.95 * after**2, 12
            )

    def test_rough_runs_do_not_contradict_the_analysis(self):
        for h, p, edges in (
            ("1.9 + w", "h - 0.4", "periodic"),
            ("-3.7 + u", "sin(6*h) - h*h", "periodic"),
            ("2*h - 0.5 + u", "if(h < 0.3, 1, -1) + w", "periodic"),
            ("u - 0.5*sign(h) + w", "h", "saturate"),
            ("u + w - h*abs(h)", "max(h, w) - 0.2", "stop"),
            ("if(p > 0, u, -h)", "min(p, h) - 0.1*sign(p - 0.4)", "stop"),
        ):
            with self.subTest(h=h, p=p):
                self.results(rough(h, p, edges))
                for policy in ("random", "adversarial"):
                    options = ("--start", "random", "--steps", "20", "--runs", "4", "--policy", policy)
                    self.simulate("r.h5", *options, "--disturbance", "extremes")

    def check_runs(self, spec, policy, steps=12, runs=9, output=EVERYTHING):
        """Every step of runs of SPEC's dynamics, against the results file and Definition 3."""
        self.results(dict(spec, output=output))
        self.simulate(
            *("r.h5", "--start", "random", "--steps", str(steps), "--runs", str(runs), "--policy", policy),
            *("-o", "runs.h5"),
        )
        connection = spec.get("coordination", {}).get("connection_delay", 0)
        with h5py.File(self.folder / "r.h5") as results, h5py.File(self.folder / "runs.h5") as file:
            largest = np.iinfo(results["delay"].dtype).max
            delays = results["delay"][0].astype(np.int64)
            delays[delays == largest] = NEVER
            controller = np.unpackbits(results["controller"][...], axis=-1, bitorder="little")
            actions = [
                np.unpackbits(results[f"actions/a|b/{agent}"][...], axis=-1, bitorder="little")
                for agent in "ab"
            ]
            self.assertEqual(file["samples"][...].tolist(), [steps + 1] * runs)
            for r in range(runs):
                countdown = None
                for k in range(steps + 1):
                    state = file["state"][r, k]
                    cell = tuple(np.floor(state + 0.5).astype(int))
                    delay = delays[cell]
                    if countdown is None or countdown == 0:
                        countdown = delay if delay >= connection else 0
                    elif countdown < NEVER:
                        countdown -= 1
                    self.assertGreaterEqual(delay, 0)
                    self.assertEqual((file["delay"][r, k], file["countdown"][r, k]), (delay, countdown))
                    self.assertEqual(file["margin"][r, k], 6 - (state[0] + state[1]))
                    if k == steps:
                        break
                    self.assertEqual(file["coordinated"][r, k], countdown == 0)
                    u = file["input"][r, k]
                    numbers = (u + 1).astype(int)
                    if countdown == 0:
                        self.assertTrue(controller[cell][numbers[0] * 3 + numbers[1]])
                    for agent in range(2):
                        self.assertTrue(actions[agent][cell][numbers[agent]])
                    self.assertEqual(file["state"][r, k + 1].tolist(), (state + u).tolist())

    # Steps of 1/2^32 of a cell are exact in doubles, so that Python's arithmetic is exact here too.
    def test_every_step_of_random_runs(self):
        self.check_runs(SPEC, "random")

    def test_every_step_of_adversarial_runs_with_a_connection_delay(self):
        self.check_runs(spec_with(coordination={"connection_delay": 1}), "adversarial")

    def test_every_step_of_preferring_runs(self):
        agents = [
            {"name": "a", "inputs": ["u"], "prefer": "(x - 3)^2"},
            {"name": "b", "inputs": ["v"], "prefer": "-y"},
        ]
        self.check_runs(spec_with(agents=agents), "prefer")

    def test_every_step_where_the_way_must_be_safe_too(self):
        spec = spec_with(
            dynamics={"time": "continuous", "period": 0.5, "equations": {"x": "2*u", "y": "2*v"}},
            abstraction={"between_samples": True},
        )
        self.check_runs(spec, "adversarial", output={**EVERYTHING, "abstraction": True})

    def test_disturbances_and_measured_states(self):
        self.results(DRIFT)
        self.simulate(
            *("r.h5", "--start", "random", "--steps", "50", "--runs", "3", "--disturbance", "extremes"),
            *("-o", "runs.h5"),
        )
        with h5py.File(self.folder / "runs.h5") as file:
            state, measured = file["state"][...], file["measured"][...]
            u, w = file["input"][...], file["disturbance"][...]
            self.assertEqual(set(w[:, :-1].ravel()), {-0.5, 0.25})
            heading = np.mod(state[:, :-1, 0] + u[:, :-1, 0], 8)
            np.testing.assert_array_equal(state[:, 1:, 0], heading)
            position = np.clip(state[:, :-1, 1] + u[:, :-1, 1] + w[:, :-1, 0], 0, 20)
            np.testing.assert_array_equal(state[:, 1:, 1], position)
            error = np.mod(measured[..., 0] - state[..., 0] + 4, 8) - 4
            self.assertEqual(set(error.ravel()), {-0.25, 0.25})
            np.testing.assert_array_equal(measured[..., 1], state[..., 1])

    def test_constant_disturbances(self):
        self.results(DRIFT)
        for how, w in (("constant", -0.125), ("w=0.25", 0.25)):
            self.simulate(
                *("r.h5", "--from", "h=1,p=3", "--steps", "5", "--disturbance", how, "-o", "runs.h5")
            )
            with h5py.File(self.folder / "runs.h5") as file:
                self.assertEqual(file["disturbance"][0, :-1, 0].tolist(), [w] * 5)
                self.assertEqual(file["measured"][...].tolist(), file["state"][...].tolist())

    def test_xarray_and_netcdf_open_the_runs(self):
        import xarray

        self.results(DRIFT)
        self.simulate("r.h5", "--start", "random", "--steps", "4", "--runs", "3", "-o", "runs.h5")
        with xarray.open_dataset(self.folder / "runs.h5", engine="h5netcdf") as data:
            self.assertEqual(data.state.dims, ("run", "time", "state_name"))
            self.assertEqual(data.input.dims, ("run", "time", "input_name"))
            self.assertEqual(data.disturbance.dims, ("run", "time", "disturbance_name"))
            self.assertEqual(data.countdown.dims, ("run", "time"))
            self.assertEqual(data.time.values.tolist(), [0, 1, 2, 3, 4])
            self.assertEqual(data.time.attrs["units"], "s")
            self.assertEqual(data.state.sel(state_name="p").shape, (3, 5))
            self.assertEqual(data.state.attrs["long_name"], "true state: h [1], p [m]")
            self.assertEqual(data.attrs["filetype"], "coordreq-runs")
            self.assertEqual((data.attrs["policy"], data.attrs["connection_delay"]), ("random", 1))
        header = subprocess.run(
            ["ncdump", "-h", "runs.h5"], capture_output=True, cwd=self.folder, text=True, check=True
        ).stdout
        self.assertIn("double state(run, time, state_name) ;", header)
        self.assertNotIn("phony_dim", header)

    def test_runs_are_no_results(self):
        self.results(SPEC)
        self.simulate("r.h5", *START, "--steps", "3", "-o", "runs.h5")
        result = self.run_program("info", "runs.h5")
        self.assertEqual((result.returncode, result.stdout), (3, b""))

    def test_every_small_example_stays_safe(self):
        sharper = ("--set", "abstraction.cells=half_open", "--set", "abstraction.safe=inner")
        for name, *settings in (
            ("lane_change",),
            ("load",),
            ("intersection_coarse",),
            ("platoon",),
            ("circle", *sharper),
        ):
            summary = self.analyze(str(CONFIGS / f"{name}.json"), *settings, "-o", "r.h5")
            for partition, policy in itertools.product(summary["partitions"], ("random", "adversarial")):
                with self.subTest(example=name, partition=partition["name"], policy=policy):
                    document = json.loads(
                        self.simulate(
                            *("r.h5", "--start", "random", "--steps", "20", "--runs", "5", "--json"),
                            *("--policy", policy, "--partition", partition["name"]),
                            *("--disturbance", "extremes"),
                        )
                    )
                    self.assertEqual(document["outcomes"]["left_invariant"], 0)
                    self.assertGreater(document["steps_done"], 0)

    def stiff(self, equations, **inputs):
        """A spec whose second state decays at once."""
        state = {"lower": -2, "upper": 2, "step": 0.5, "outside": "saturate"}
        spec = spec_with(
            states=[dict(state, name="x"), dict(state, name="y")],
            inputs=[{"name": name, "values": values} for name, values in inputs.items()],
            agents=[{"name": name, "inputs": [name]} for name in inputs],
            dynamics={"time": "continuous", "period": 1, "equations": equations},
            safe="true",
        )
        self.results(spec)

    def test_stiff_plants_are_followed(self):
        for rate in (1e3, 1e6, 1e9):
            with self.subTest(rate=rate):
                self.stiff({"x": "u", "y": f"-{rate:.0f}*y + v"}, u=[-1, 0, 1], v=[0, 1])
                document = json.loads(self.simulate("r.h5", "--from", "x=0,y=1", "--steps", "3", "--json"))
                self.assertEqual(document["outcomes"]["completed"], 1)
                self.assertLess(abs(document["traces"][0]["end"]["y"]), 1.01 / rate)
        self.stiff({"x": "-7*x*u - x/3", "y": "0"}, u=[1, 1e6], v=[0, 1])
        document = json.loads(
            self.simulate("r.h5", "--start", "random", "--runs", "5", "--steps", "6", "--json")
        )
        self.assertEqual(document["outcomes"]["completed"], 5)

    def assert_refused(self, message, *arguments, code=2):
        self.assert_fails(code, message, "simulate", "r.h5", *arguments)

    def test_refusals_of_starts(self):
        self.results(spec_with(safe="x + y <= 5 and (x < 3 or y > 0)"))
        steps = ("--steps", "3")
        self.assert_refused("no start, expected --from NAME=VALUE,... or --start random", *steps)
        self.assert_refused(
            "expected --from or --start, found both", *START, "--start", "random", *steps
        )
        self.assert_refused("expected random, found 'x' (--start)", "--start", "x", *steps)
        self.assert_refused("no value for the state 'y' (--from)", "--from", "x=1", *steps)
        self.assert_refused("'z' is no state, expected 'x' or 'y' (--from)", "--from", "z=1,y=2", *steps)
        self.assert_refused("'x' is given twice (--from)", "--from", "x=1,x=2", *steps)
        self.assert_refused(
            "expected NAME=VALUE, found 'x' (--from)", "--from", "x", *steps
        )
        self.assert_refused("x = 4.5 is outside of the domain (--from)", "--from", "x=9/2,y=0", *steps)
        self.assert_refused("the start is not in the safe set (--from)", "--from", "x=4,y=4", *steps)

    def test_refusal_of_a_start_outside_k(self):
        dynamics = dict(SPEC["dynamics"], equations={"x": "x + 1", "y": "y"})
        self.results(spec_with(safe="x < 3", dynamics=dynamics))
        self.assert_refused(
            "the start is not in the invariance set: on this grid not even coordination keeps the system safe from there"
            " (--from)",
            *START,
            *("--steps", "3"),
        )
        self.assert_refused(
            "the invariance set is empty: there is no state to start from (--start)",
            *("--start", "random", "--steps", "3"),
        )

    def test_a_length_in_time(self):
        self.results(SPEC)
        for text, steps in (("3", 3), ("1.5s", 3), ("1500 ms", 3), ("1.2s", 3), ("0.05min", 6)):
            result = self.run_program("simulate", "r.h5", "--from", "x=1,y=1", "--steps", text, "--json")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(json.loads(result.stdout)["steps"], steps, text)

    def test_refusals_of_options(self):
        self.results(SPEC)
        self.assert_refused("no number of steps, expected --steps N", *START)
        for text in ("0", "x", "-1", "2147483647"):
            self.assert_refused(
                f"expected a number of steps from 1 on, or a time, e.g. 2s, found '{text}' (--steps)",
                *START,
                f"--steps={text}",
            )
        steps = (*START, "--steps", "3")
        self.assert_refused(
            "expected a whole number from 1 to 2147483646, found '0' (--runs)", *steps, "--runs", "0"
        )
        self.assert_refused(
            "expected a whole number from 0 to 18446744073709551615, found '1.5' (--seed)",
            *steps,
            *("--seed", "1.5"),
        )
        self.assert_refused(
            "expected random, adversarial or prefer, found 'x' (--policy)", *steps, "--policy", "x"
        )
        self.assert_refused("no agent of the spec has a 'prefer' (--policy)", *steps, "--policy", "prefer")
        self.assert_refused(
            "unknown partition 'x', expected one of a|b (--partition)", *steps, "--partition", "x"
        )
        self.assert_refused(
            "expected random, extremes, constant or NAME=VALUE,..., found 'x' (--disturbance)",
            *steps,
            *("--disturbance", "x"),
        )
        self.assert_refused(
            "the spec has no disturbances, expected no values (--disturbance)",
            *steps,
            *("--disturbance", "w=1"),
        )
        self.assert_refused("expected the name of a file, found '-' (--output)", *steps, "-o", "-")

    def test_refusals_of_disturbances(self):
        self.results(DRIFT)
        steps = ("--from", "h=1,p=3", "--steps", "3", "--disturbance")
        self.assert_refused("w = 1 is not in its range [-0.5, 0.25] (--disturbance)", *steps, "w=1")
        self.assert_refused("unknown disturbance 'x', expected one of w (--disturbance)", *steps, "x=1")
        self.assert_refused("'w' is given twice (--disturbance)", *steps, "w=0,w=0")
        self.assert_refused("expected NAME=VALUE, found '' (--disturbance)", *steps, "w=0,")

    def test_several_partitions_need_a_choice(self):
        partitions = [{"classes": []}, {"name": "both", "classes": [["a", "b"]]}]
        self.results(spec_with(coordination={"partitions": partitions}))
        self.assert_refused(
            "several partitions, expected the name of one of a|b, both (--partition)",
            *START,
            *("--steps", "3"),
        )
        text = self.simulate("r.h5", *START, "--steps", "3", "--partition", "a+b")
        self.assertTrue(text.startswith("small, partition both: 1 run of 3 steps"))
        self.assertIn("coordinated      0 of 3 steps (0 %)", text)

    def test_memory_is_refused_up_front(self):
        self.results(SPEC)
        result = self.run_program("simulate", "r.h5", *START, "--steps", "1000000", "--max-memory", "100M")
        self.assertEqual((result.returncode, result.stdout), (4, b""))
        self.assertRegex(
            result.stderr.decode(),
            r"^coordreq: error: 1 runs of 1000000 steps need about [0-9.]+ MiB of memory, the limit is 100.0 MiB"
            r" \(--max-memory\)\n$",
        )

    def test_a_folder_that_is_missing(self):
        self.results(SPEC)
        self.assert_refused(
            "the folder does not exist (no)", *START, "--steps", "3", "-o", "no/runs.h5", code=5
        )

    def test_no_results_file(self):
        self.assert_fails(
            5,
            "cannot read the results: No such file or directory (no.h5)",
            *("simulate", "no.h5", *START, "--steps", "3"),
        )


if __name__ == "__main__":
    unittest.main()
