"""--max-memory is a promise in every command: it is kept, or the work is refused with what it needs.

COORDREQ_MEMORY_SPECS=N tries N random specs instead of a few; random_memory.py as many as asked in all commands."""

import json
import os
import random
import unittest

from program import CONFIGS, PROGRAM, SANITIZED, SPEC, Case, spec_with
from random_memory import MEBI, PERMITTED, Promise, measured
from random_systems import random_analysis

STORED_ACTIONS = (
    *("--set", "dynamics.period=0.02"),
    *("--set", "output.controller=true"),
    *("--set", "output.actions=true"),
)


def six_agents(**changes):
    """All 203 partitions of six agents, each of which moves along a line."""
    numbers = range(changes.pop("agents", 6))
    return spec_with(
        states=[{"name": f"x{i}", "lower": -1, "upper": 1, "step": 0.5} for i in numbers],
        inputs=[{"name": f"u{i}", "values": [-1, 0, 1]} for i in numbers],
        agents=[{"name": f"a{i}", "inputs": [f"u{i}"]} for i in numbers],
        dynamics={"time": "discrete", "period": 1, "equations": {f"x{i}": f"x{i} + 0.5*u{i}" for i in numbers}},
        safe=" and ".join(f"abs(x{i}) <= 0.6" for i in numbers),
        coordination={"partitions": "all", "horizon": 2},
        output={"actions": True},
        **changes,
    )


@unittest.skipIf(SANITIZED, "sanitisers take memory of their own")
class Cases(Case):
    def estimate(self, spec, *options):
        result = self.run_program("validate", spec, "--json", *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)["memory_bytes"]

    def peak(self, *arguments):
        """Exit code, and the most that the program held in memory."""
        return measured(PROGRAM, *arguments)

    def assert_kept(self, spec, threads, codes=(0, 1), settings=()):
        """That analyze accepts what validate tells, and keeps to it. @returns estimate and peak"""
        options = (*settings, "--threads", str(threads))
        estimate = self.estimate(spec, *options)
        options += ("--max-memory", str(round(1.02 * estimate)))  # the need is not told to the byte
        code, peak = self.peak("analyze", str(self.folder / spec), "-o", str(self.folder / "o.h5"), "--quiet", *options)
        self.assertIn(code, codes)
        self.assertLessEqual(peak, PERMITTED * estimate, f"{spec}, {threads} threads")
        return estimate, peak

    def test_random_specs(self):
        for seed in range(int(os.environ.get("COORDREQ_MEMORY_SPECS", "12"))):
            threads = random.Random(seed).choice([1, 2, 2, 4, 9, 32])
            with self.subTest(seed=seed, threads=threads):
                self.write("s.json", random_analysis(seed))
                # Some are refused when their posts are looked for, by warnings or by the analysis.
                if self.run_program("validate", "s.json").returncode == 3:
                    continue
                self.assert_kept("s.json", threads, codes=(0, 1, 3))

    def test_examples_take_about_what_is_told(self):
        for name, *settings in (
            ("circle", *STORED_ACTIONS),
            ("crossing", "--set", "coordination.convention=true"),
            ("gridworld_coarse",),
            ("intersection_network",),
            ("platoon",),
        ):
            with self.subTest(name=name):
                estimate, peak = self.assert_kept(str(CONFIGS / f"{name}.json"), 2, settings=settings)
                self.assertLessEqual(estimate, max(1.25 * peak, peak + 10 * MEBI))

    def test_many_partitions(self):
        self.write("s.json", six_agents(agents=5))
        self.assert_kept("s.json", 2)

    def test_many_requirements(self):
        region = {"where": "x <= 1", "invariant": True}
        self.write("s.json", spec_with(requirements=[dict(region, name=str(r)) for r in range(3000)]))
        self.assert_kept("s.json", 2)

    def test_many_threads(self):
        self.write("s.json", SPEC)
        self.assert_kept("s.json", 300)

    def assert_threads_take_little(self, most, spec):
        few, many = (self.peak("analyze", spec, "-o", str(self.folder / "o.h5"), "--force", "--quiet", "--threads", threads)
                     for threads in ("2", "16"))  # fmt: skip
        self.assertEqual((few[0], many[0]), (0, 0))
        self.assertLessEqual(many[1], most * few[1])

    def test_threads_share_what_they_read_of_coupled_motions(self):
        self.assert_threads_take_little(1.25, str(CONFIGS / "aircraft.json"))

    def test_threads_hold_little_of_what_they_write(self):
        spec = json.loads((CONFIGS / "gridworld.json").read_text().split("\n{", 1)[1].join(["{", ""]))
        for state in spec["states"]:
            state["step"] /= 2
        self.write("s.json", spec)
        self.assert_threads_take_little(1.3, str(self.folder / "s.json"))

    def test_fewer_threads_where_memory_is_short(self):
        self.write("s.json", SPEC)
        limit = round(1.02 * self.estimate("s.json", "--threads", "3"))
        told = json.loads(self.run_program("analyze", "s.json", "--threads", "300", "--max-memory", str(limit), "--json").stdout)
        self.assertGreaterEqual(told["threads"], 3)
        self.assertLess(told["threads"], 30)
        self.assertEqual(self.run_program("verify", "small.h5", "--threads", "300", "--max-memory", "40M").returncode, 0)

    def check_promise(self, seeds):
        promise = Promise(PROGRAM, self.folder)
        analysed = sum(promise.check_spec(seed) for seed in seeds)
        self.assertEqual(promise.broken, [])
        self.assertGreater(analysed, 0)
        self.assertGreater(min(promise.counts["kept"], promise.counts["refused at once"]), 0)

    def test_random_specs_in_all_commands(self):
        self.check_promise(range(4))

    def test_a_checkpoint(self):
        """It takes some more than validate can tell."""
        spec = str(CONFIGS / "circle.json")
        options = (*STORED_ACTIONS, "--threads", "1", "--quiet", "-o", str(self.folder / "o.h5"))
        saved = ("--checkpoint", str(self.folder / "saved"), "--checkpoint-every", "0")
        estimate = round(1.02 * self.estimate(spec, *STORED_ACTIONS, "--threads", "1"))
        self.assertEqual(self.peak("analyze", spec, *options, *saved, "--max-memory", str(estimate))[0], 4)
        limit = estimate + 5 * MEBI
        code, peak = self.peak("analyze", spec, *options, *saved, "--max-memory", str(limit))
        self.assertEqual(code, 0)
        self.assertLessEqual(peak, PERMITTED * limit)

    def test_a_long_description(self):
        self.write("s.json", spec_with(description="x" * 20_000_000))
        estimate, _ = self.assert_kept("s.json", 2)
        code, peak = self.peak("analyze", str(self.folder / "s.json"), "--max-memory", "60M", "--quiet")
        self.assertEqual(code, 4)
        self.assertLess(peak, 60 * MEBI)  # it was not even read
        self.assertGreater(estimate, 60 * MEBI)

    def test_all_outputs_with_many_threads(self):
        spec = json.loads((CONFIGS / "platoon.json").read_text().split("\n{", 1)[1].join(["{", ""]))
        spec["output"] = dict.fromkeys(("controller", "actions", "layers", "abstraction"), True)
        self.write("s.json", spec)
        self.assert_kept("s.json", 32)

    def test_what_was_not_estimated_is_refused_by_the_system(self):
        """Short values take far more memory than their text says."""
        text = json.dumps(spec_with(inputs=[{"name": "u", "values": "VALUES"}]))
        (self.folder / "s.json").write_text(text.replace('"VALUES"', "[" + ",".join(["0"] * 3_000_000) + "]"))
        for command in ("validate", "analyze"):
            self.assert_fails(4, "more memory is needed than the limit allows, and than was estimated (--max-memory)",
                              command, "s.json", "--max-memory", "50M", "--threads", "1")  # fmt: skip
            code, peak = self.peak(command, str(self.folder / "s.json"), "--max-memory", "50M", "--threads", "1")
            self.assertEqual(code, 4)
            self.assertLessEqual(peak, PERMITTED * 50 * MEBI)

    def test_what_needs_more_is_refused(self):
        self.write("s.json", six_agents(agents=4))
        estimate = self.estimate("s.json", "--threads", "2")
        output = ("-o", str(self.folder / "o.h5"), "--quiet", "--threads", "2")
        for command, options in (("analyze", output), ("validate", output[2:])):
            code, _ = self.peak(command, str(self.folder / "s.json"), *options, "--max-memory", str(estimate // 2))
            self.assertEqual(code, 4)
        self.assertEqual(self.files(), ["s.json"])
        limit = round(1.02 * estimate)  # the need is not told to the byte
        code, peak = self.peak("analyze", str(self.folder / "s.json"), *output, "--max-memory", str(limit))
        self.assertEqual(code, 0)
        self.assertLessEqual(peak, PERMITTED * limit)

    def test_what_reads_results_keeps_to_it_too(self):
        self.write("s.json", six_agents(agents=2))
        results = str(self.folder / "r.h5")
        self.assertEqual(self.peak("analyze", str(self.folder / "s.json"), "-o", results, "--quiet")[0], 0)
        state = ("--at", "x0=0,x1=0", "--threads", "2")
        for command, options in (
            ("info", ()), ("query", state), ("explain", (*state, "--partition", "a0|a1")), ("verify", ("--threads", "2")),
            ("compare", (results,)), ("export", ("--format", "csv", "-o", str(self.folder / "o.csv"))),
            ("report", ("-o", str(self.folder / "o.html"))), ("simulate", ("--from", "x0=0,x1=0", "--steps", "3", "--partition", "a0|a1")),
        ):  # fmt: skip
            with self.subTest(command=command):
                self.assertEqual(self.peak(command, results, *options, "--max-memory", "10M")[0], 4)
                code, peak = self.peak(command, results, *options, "--max-memory", "40M")
                self.assertEqual(code, 0)
                self.assertLessEqual(peak, PERMITTED * 40 * MEBI)


if __name__ == "__main__":
    unittest.main()
