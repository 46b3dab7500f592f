"""Controllers that users bring in a file."""

import json
import os
import unittest

import h5py
import numpy as np
from program import CONFIGS, SANITIZED, SPEC, Case, spec_with, without_comments

RESULTS = ["safe", "invariant", "delay", "trigger", "layer_size", "controller"]


def crossing(**changes):
    return dict(json.loads(without_comments((CONFIGS / "crossing.json").read_text())), **changes)


class Cases(Case):
    def analyzed(self, name, spec):
        self.write(f"{name}.json", dict(spec, name=name))
        return self.analyze(f"{name}.json")

    def export(self, results, file):
        result = self.run_program("export", results, "--format", "scs", "-o", file)
        self.assertEqual((result.returncode, result.stderr), (0, b""))

    def assert_same_results(self, one, other):
        with h5py.File(self.folder / one) as a, h5py.File(self.folder / other) as b:
            for name in RESULTS:
                self.assertTrue(np.array_equal(a[name][...], b[name][...]), name)

    def assert_verified(self, *arguments):
        result = self.run_program("verify", *arguments)
        self.assertEqual((result.returncode, result.stderr), (0, b""), result.stdout.decode())

    # A controller that was written comes back.

    def test_a_synthesised_controller_comes_back(self):
        spec = crossing(output={"controller": True})
        self.analyzed("base", spec)
        self.export("base.h5", "base.scs")
        for file in ("base.h5", "base.scs"):
            for synthesis in ("maximal", "given"):
                summary = self.analyzed("again", dict(spec, controller={"file": file, "synthesis": synthesis}))
                self.assertEqual(summary["controller"]["file"], file)
                with h5py.File(self.folder / "again.h5") as again, h5py.File(self.folder / "base.h5") as base:
                    self.assertTrue(np.array_equal(again["controller:file"][...], base["controller"][...]))
                # Outside K there are no pairs, so all that is lost is lost at once.
                self.assertEqual(summary["iterations"], 2)
                self.assert_same_results("again.h5", "base.h5")

    def test_a_controller_of_a_small_system_by_hand(self):
        states = [{"name": "x", "lower": 0, "upper": 3, "step": 1, "unit": "m"}]
        spec = spec_with(
            states=states,
            inputs=[{"name": "u", "values": [1, 0, -1]}],
            agents=[{"name": "a", "inputs": ["u"]}],
            dynamics={"time": "discrete", "period": 1, "unit": "s", "equations": {"x": "x + u"}},
            safe="x <= 2",
            controller={"file": "c.scs", "synthesis": "given"},
            output={"controller": True},
        )
        grid = "#TYPE:UNIFORMGRID\n#MEMBER:DIM\n1\n#VECTOR:ETA\n#BEGIN:1\n1\n#END\n"
        text = (
            "#SCOTS:v0.2\n#TYPE:STATICCONTROLLER\n#SCOTS:STATE_SPACE\n"
            + grid
            + "#VECTOR:LOWER_LEFT\n#BEGIN:1\n0\n#END\n#VECTOR:UPPER_RIGHT\n#BEGIN:1\n3\n#END\n#SCOTS:INPUT_SPACE\n"
            + grid
            + "#VECTOR:LOWER_LEFT\n#BEGIN:1\n-1\n#END\n#VECTOR:UPPER_RIGHT\n#BEGIN:1\n1\n#END\n"
            + "#TYPE:WINNINGDOMAIN\n#SCOTS:i (state) j_0 ... j_n (valid inputs)\n#MATRIX:DATA\n#BEGIN:4 3\n"
            # Inputs 0, 1, 2 are -1, 0, 1.
            + "0 1 2 \n1 0 \n2 1 2 \n3 0 1 2 \n#END\n"
        )
        self.write("c.scs", text)
        self.analyzed("small", spec)
        with h5py.File(self.folder / "small.h5") as file:
            # 2 may go to 3, which is not safe; 0 and 1 go to and fro.
            self.assertEqual(file["invariant"][...].tolist(), [1, 1, 0, 0])
            self.assertEqual(file["controller"][...].ravel().tolist(), [0b011, 0b100, 0, 0])
            self.assertEqual(file["controller:file"][...].ravel().tolist(), [0b011, 0b100, 0b011, 0b111])
        self.assert_verified("small.h5")
        # `maximal`: 2 keeps to what is safe.
        spec["controller"]["synthesis"] = "maximal"
        self.analyzed("small", spec)
        with h5py.File(self.folder / "small.h5") as file:
            self.assertEqual(file["invariant"][...].tolist(), [1, 1, 1, 0])
            self.assertEqual(file["controller"][...].ravel().tolist(), [0b011, 0b100, 0b010, 0])
        self.assert_verified("small.h5")
        # A rule besides.
        spec["controller"]["allow"] = "u != 0"
        self.analyzed("small", spec)
        with h5py.File(self.folder / "small.h5") as file:
            self.assertEqual(file["invariant"][...].tolist(), [1, 1, 0, 0])
            self.assertEqual(file["controller"][...].ravel().tolist(), [0b001, 0b100, 0, 0])
        self.assert_verified("small.h5")
        # A reachability game names one input a state: 0 and 1 go to 2, which stays.
        reach = text[: text.index("#BEGIN:4 3")] + "#BEGIN:4 1\n0 2\n1 2\n2 1\n#END\n"
        self.write("c.scs", reach)
        spec["controller"] = {"file": "c.scs", "synthesis": "given"}
        self.analyzed("small", spec)
        with h5py.File(self.folder / "small.h5") as file:
            self.assertEqual(file["invariant"][...].tolist(), [1, 1, 1, 0])
            self.assertEqual(file["controller"][...].ravel().tolist(), [0b001, 0b001, 0b010, 0])
        self.assert_verified("small.h5")

    # The results file needs no other.

    def test_results_are_complete_in_themselves(self):
        self.write("c.h5", (CONFIGS / "first_come.h5").read_bytes())
        for synthesis in ("maximal", "given"):
            spec = crossing(controller={"file": "c.h5", "synthesis": synthesis, "allow": "p1 < 9 or u2 >= -0.5"})
            self.analyzed("stored", dict(spec, output={"controller": True, "actions": True}))
            self.analyzed("computed", spec)
            os.rename(self.folder / "c.h5", self.folder / "gone.h5")
            for results in ("stored.h5", "computed.h5"):
                self.assert_verified(results)
                result = self.run_program(
                    "simulate", results, "--start", "random", "--runs", "40", "--steps", "30", "--policy", "adversarial"
                )
                self.assertEqual((result.returncode, result.stderr), (0, b""))
                self.assertIn("controller:file", self.run_program("info", results).stdout.decode())
            at = "p1=-6,v1=1,v2=1,p2=-9"
            answers = [
                json.loads(self.run_program("query", name, "--at", at, "--json").stdout)["partitions"]
                for name in ("stored.h5", "computed.h5")
            ]
            self.assertEqual(answers[0], answers[1])
            self.export("stored.h5", "stored.scs")
            self.export("computed.h5", "computed.scs")
            self.assertEqual(*((self.folder / f"{n}.scs").read_bytes() for n in ("stored", "computed")))
            os.rename(self.folder / "gone.h5", self.folder / "c.h5")

    def test_the_digest_tells_which_file_it_was(self):
        for settings in ((), ("--set", "controller.synthesis=given")):
            summary = self.analyze(str(CONFIGS / "crossing_first_come.json"), *settings, "-o", "out.h5")
            with h5py.File(self.folder / "out.h5") as file:
                self.assertEqual(file["controller:file"].attrs["sha256"], summary["controller"]["sha256"])
            text = self.run_program("info", "out.h5").stdout.decode()
            self.assertIn(f"controller SHA-256  {summary['controller']['sha256']}\n", text)
        self.assertEqual(summary["controller"]["pairs"], 152145)

    def test_equal_bytes_for_any_number_of_threads(self):
        files = []
        for threads in ("1", "2", "5"):
            self.analyze(str(CONFIGS / "crossing_first_come.json"), "--threads", threads, "-o", "out.h5")
            files.append((self.folder / "out.h5").read_bytes())
        self.assertEqual(files[0], files[1])
        self.assertEqual(files[0], files[2])

    def test_a_wrong_claim_is_found(self):
        self.analyze(str(CONFIGS / "crossing_first_come.json"))
        with h5py.File(self.folder / "crossing_first_come.h5", "r+") as file:
            # All pairs, not those of the file: then K and the layers are others.
            file["controller:file"][...] = np.full(file["controller:file"].shape, 255, "uint8")
        self.assertEqual(self.run_program("verify", "crossing_first_come.h5").returncode, 1)
        with h5py.File(self.folder / "crossing_first_come.h5", "r+") as file:
            del file["controller:file"]
        self.assert_fails(
            3, "missing or damaged (crossing_first_come.h5:/controller:file)", "verify", "crossing_first_come.h5"
        )

    # Where the file is.

    def test_the_path_starts_in_the_folder_of_the_spec(self):
        (self.folder / "below").mkdir()
        spec = json.dumps(crossing(controller={"file": "c.h5"}, name="out"))
        self.write("below/spec.json", spec)
        self.write("below/c.h5", (CONFIGS / "first_come.h5").read_bytes())
        first = self.analyze("below/spec.json")
        self.assert_fails(
            5, "cannot read the controller: No such file or directory (c.h5)", "analyze", "-", stdin=spec.encode()
        )
        self.write("c.h5", (CONFIGS / "first_come.h5").read_bytes())
        second = self.analyze("-", stdin=spec.encode())
        self.assertEqual(first["partitions"], second["partitions"])
        absolute = crossing(controller={"file": str(CONFIGS / "first_come.h5")}, name="out")
        self.write("below/spec.json", absolute)
        self.assertEqual(self.analyze("below/spec.json")["partitions"], first["partitions"])

    # What does not fit.

    def assert_refused(self, code, message, spec):
        self.write("spec.json", spec)
        self.assert_fails(code, message, "analyze", "spec.json")
        self.assert_fails(code, message, "validate", "spec.json")

    def test_files_that_are_no_controller(self):
        spec = spec_with(controller={"file": "c"})
        self.assert_refused(5, "cannot read the controller: No such file or directory (c)", spec)
        self.write("c", "x,y\n")
        self.assert_refused(
            3, "no controller: expected an HDF5 file or a SCOTS file, which begins with '#SCOTS:' (c)", spec
        )
        (self.folder / "c").unlink()
        (self.folder / "c").mkdir()
        self.assert_refused(5, "is a folder, expected a file with a controller (c)", spec)
        (self.folder / "c").rmdir()
        self.write("c", b"\x89HDF\r\n\x1a\n")
        self.assert_refused(3, "not a coordreq results file: it is not HDF5, or cut short (c)", spec)
        self.write("spec.json", SPEC)
        self.analyze("spec.json", "-o", "c")
        self.assert_refused(
            3,
            'holds no /controller: expected results of a spec with "output": {"controller": true} (c)',
            spec,
        )
        self.assert_refused(
            3,
            "expected the path of a file, found '' (/controller/file)",
            spec_with(controller={"file": ""}),
        )

    def test_other_grids(self):
        self.write("spec.json", spec_with(output={"controller": True}))
        self.analyze("spec.json", "-o", "c.h5")
        x, y = SPEC["states"]
        u, v = SPEC["inputs"]
        for changes, message in (
            ({"states": [y, x]}, "the axes are the states 'x y', expected 'y x' (c.h5:/controller)"),
            ({"inputs": [v, u]}, "the attribute inputs is 'u v', expected 'v u' (c.h5:/controller)"),
            ({"states": [x, dict(y, upper=5)]}, "found 5 grid points, expected 6 (c.h5:/y)"),
            ({"states": [x, dict(y, lower=1, upper=5)]}, "grid point 0 is 0, expected 1 (c.h5:/y)"),
            ({"inputs": [u, dict(v, values=[-1, 0, 2])]}, "grid point 2 is 1, expected 2 (c.h5:/v)"),
        ):
            spec = spec_with(controller={"file": "c.h5"}, **changes)
            self.assert_refused(3, message, spec)
        self.export("c.h5", "c.scs")
        for changes, message in (
            ({"states": [x, dict(y, upper=5)]}, "STATE_SPACE: UPPER_RIGHT of y is 4, expected 5 (c.scs, line 20)"),
            ({"inputs": [u, dict(v, values=[-1, 0, 2])]}, "SCOTS knows no such list of values as that of 'v' in the "
             "spec: expected evenly spaced ones (c.scs)"),
        ):  # fmt: skip
            self.assert_refused(3, message, spec_with(controller={"file": "c.scs"}, **changes))

    def test_a_list_that_is_damaged_further_on(self):
        self.write("spec.json", spec_with(output={"controller": True}))
        self.analyze("spec.json", "-o", "c.h5")
        self.export("c.h5", "c.scs")
        text = (self.folder / "c.scs").read_text()
        self.write("c.scs", text[: text.rindex("#END")] + "25 1 \n#END\n")
        self.write("spec.json", spec_with(controller={"file": "c.scs"}))
        lines = text.count("\n")
        self.assert_fails(
            3,
            f"WINNINGDOMAIN: found state 25, expected one below 25 (c.scs, line {lines})",
            "analyze",
            "spec.json",
        )
        with h5py.File(self.folder / "c.h5", "r+") as file:
            file["controller"][3, 2, 1] |= 0x80
        self.write("spec.json", spec_with(controller={"file": "c.h5"}))
        self.assert_fails(
            3,
            "cell 17 has a bit set beyond its 9 joint inputs (c.h5:/controller)",
            "analyze",
            "spec.json",
        )

    @unittest.skipIf(SANITIZED, "measures memory")
    def test_the_limit_of_memory_counts_the_file(self):
        def estimate():
            """The least of several: what a process holds when it begins differs by some half MiB."""
            runs = [self.run_program("validate", "spec.json", "--json").stdout for _ in range(8)]
            return min(json.loads(run)["memory_bytes"] for run in runs)

        spec = dict(crossing(), name="x")
        self.write("spec.json", spec)
        without = estimate()
        self.write("c.h5", (CONFIGS / "first_come.h5").read_bytes())
        self.write("spec.json", dict(spec, controller={"file": "c.h5"}))
        needed = estimate()
        # Bytes a cell, and for each joint input a row of 64 bits and its number.
        table = 21609 * 4 + 25 * 1029 * (8 + 4)
        self.assertGreaterEqual(needed - without, table)
        self.assertLess(needed - without, table + 2**20)  # pages, and groups of actions that are no longer shared

    # Requirements are judged under the controller.

    def judged(self, name, spec, cell):
        """Whether one cell is kept and tolerates two steps of silence: verdicts as the JSON summary has them."""
        axes = {"p1": range(-10, 11), "v1": np.arange(7) / 2, "v2": np.arange(7) / 2, "p2": range(-10, 11)}
        middle = {state: float(axis[k]) for (state, axis), k in zip(axes.items(), cell)}
        where = " and ".join(f"{x - 0.1:.1f} <= {state} and {state} <= {x + 0.1:.1f}" for state, x in middle.items())
        requirements = [{"name": "kept", "where": where, "invariant": True}, {"name": "silent", "where": where, "min_delay": 2}]
        self.write(f"{name}.json", dict(spec, name=name, requirements=requirements))
        result = self.run_program("analyze", f"{name}.json", "--json")
        verdicts = json.loads(result.stdout)["requirements"]
        self.assertEqual(result.returncode, 0 if all(verdict["holds"] for verdict in verdicts) else 1)
        self.assertEqual([verdict["cells"] for verdict in verdicts], [1, 1])
        return verdicts

    def test_requirements_are_judged_under_the_controller(self):
        (self.folder / "first_come.h5").write_bytes((CONFIGS / "first_come.h5").read_bytes())
        specs = {"plain": crossing(), "ruled": crossing(controller={"file": "first_come.h5", "synthesis": "maximal"})}
        kept, delay = {}, {}
        for name, spec in specs.items():
            self.analyzed(name, spec)
            with h5py.File(self.folder / f"{name}.h5") as file:
                kept[name], delay[name] = file["invariant"][...], file["delay"][0]
        cases = {
            "only breaking the rule helps": (kept["ruled"] == 0) & (delay["plain"] >= 2),
            "the rule buys silence": (delay["plain"] >= 0) & (delay["plain"] < 2) & (delay["ruled"] >= 2),
            "too little silence": (delay["ruled"] >= 0) & (delay["ruled"] < 2),
        }
        for case, cells in cases.items():
            cell = tuple(int(k) for k in np.argwhere(cells)[0])
            for name, spec in specs.items():
                with self.subTest(case=case, spec=name):
                    verdicts = self.judged(f"{name}_judged", spec, cell)
                    self.assertEqual([verdict["holds"] for verdict in verdicts], [kept[name][cell] == 1, delay[name][cell] >= 2])
                    self.assert_verified(f"{name}_judged.h5")
                    if name == "ruled":
                        self.assert_stories_keep_to_the_file(verdicts)

    def assert_stories_keep_to_the_file(self, verdicts):
        """What an agent does alone is part of something that the file lists, what all do together is listed."""
        with h5py.File(CONFIGS / "first_come.h5") as file:
            listed, axes = file["controller"][...], [file[state][...] for state in ("p1", "v1", "v2", "p2")]
            values = file["u1"][...]
        for step in [step for verdict in verdicts if not verdict["holds"] for step in verdict["counterexample"]["steps"]]:
            cell = tuple(int(np.argmin(abs(axis - x))) for axis, x in zip(axes, step["state"].values()))
            pairs = np.unpackbits(listed[cell], bitorder="little")[: len(values) ** 2].reshape(len(values), -1)
            one, other = (np.argmin(abs(values - x)) for x in (step["inputs"]["first"]["u1"], step["inputs"]["second"]["u2"]))
            self.assertTrue(pairs[one, other] if step["action"] == "evasive" else pairs[one].any() and pairs[:, other].any())


if __name__ == "__main__":
    unittest.main()
