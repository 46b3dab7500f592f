"""verify: right results hold, and every other bit that means something is found."""

import json
import re
import shutil
import unittest

import h5py
import numpy as np
from program import CONFIGS, SANITIZED, SPEC, Case, spec_with, without_comments

EVERYTHING = {"controller": True, "actions": True, "layers": True, "abstraction": True}
# What was seen of a run of the system, of which only a part is asked.
OBSERVED = {"/counterexample/seen"}
SMALL_TEXT = """check           checked  result
attributes           82  holds
sizes                 4  holds
layers a|b            6  holds
S                    25  holds
K                    25  holds
collision time       25  holds
delay a|b            25  holds
trigger a|b          25  holds

reachable sets: exact, from the corners of the cells

small.h5 holds (TIME)
"""


def config(name, **changes):
    return dict(json.loads(without_comments((CONFIGS / name).read_text())), **changes)


def flipped(array, place, bit):
    """The array with one bit of one element the other way."""
    data = np.array(array).copy()
    raw = data.reshape(-1).view(np.uint8)
    size = data.dtype.itemsize
    raw[place * size + bit // 8] ^= 1 << bit % 8
    return data


def other_text(text):
    """The text with one bit of its first letter the other way; another one if it is empty."""
    return chr(ord(text[0]) ^ 1) + text[1:] if text else "x"


class Cases(Case):
    def results(self, spec, *arguments):
        self.write("spec.json", spec)
        result = self.run_program("analyze", "spec.json", "-o", "results.h5", "--quiet", *arguments)
        self.assertEqual(result.stderr.decode(), "")
        self.assertEqual(result.returncode, 1 if spec.get("requirements") else 0)
        return self.folder / "results.h5"

    def verify(self, *arguments):
        return self.run_program("verify", *arguments)

    def assert_found(self, path, what):
        result = self.verify(str(path), "--quiet")
        self.assertIn(result.returncode, (1, 3), f"{what}: {result.stderr.decode()}")

    def test_text(self):
        self.write("small.json", SPEC)
        self.analyze("small.json")
        result = self.verify("small.h5", "--threads", "1")
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        text = re.sub(r"\([0-9.]+ s on 1 thread\)", "(TIME)", result.stdout.decode())
        self.assertEqual(text, SMALL_TEXT)

    def test_json(self):
        self.results(SPEC)
        result = self.verify("results.h5", "--json", "--threads", "2")
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        summary = json.loads(result.stdout)
        self.assertEqual(
            list(summary),
            ["file", "name", "holds", "verdict", "cells", "cells_checked", "reachable_sets", "between_samples",
             "not_independent", "taken_as_given", "confirmed", "posts_computed", "work", "checks", "threads", "seconds"],
        )  # fmt: skip
        self.assertEqual(summary["work"], {"spent": 0, "budget": 60 * 50_000_000, "left_open": 0})
        self.assertEqual((summary["name"], summary["holds"], summary["reachable_sets"]), ("small", True, "exact"))
        self.assertEqual((summary["verdict"], summary["confirmed"]), ("holds", {"reachable_sets": 0, "of": 0}))
        self.assertEqual(
            summary["checks"][3],
            {"check": "S", "status": "holds", "checked": 25, "wrong": 0, "not_confirmed": 0, "examples": [],
             "doubts": []},
        )

    def test_quiet(self):
        self.results(SPEC)
        self.assert_prints("", "verify", "results.h5", "--quiet")

    def test_what_is_wrong_is_said(self):
        path = self.results(SPEC)
        with h5py.File(path, "r+") as file:
            file["delay"][0, 1, 2] += 1
        result = self.verify("results.h5", "--threads", "1")
        self.assertEqual((result.returncode, result.stderr), (1, b""))
        text = result.stdout.decode()
        self.assertIn("\ndelay a|b\n  x = 0, y = 1: 2, expected 3\n  x = 1, y = 2: 2, expected 1\n", text)
        self.assertIn("\nlayers a|b\n  |Z_2|: 10, expected 11\n", text)
        self.assertRegex(text, r"\ndelay a\|b +25  2 wrong\n")
        self.assertRegex(text, r"\nresults\.h5 does not hold \([0-9.]+ s on 1 thread\)\n$")

    def test_sample(self):
        self.results(config("circle.json"))
        result = self.verify("results.h5", "--sample", "100", "--json")
        self.assertEqual(result.returncode, 0)
        summary = json.loads(result.stdout)
        self.assertEqual((summary["cells"], summary["cells_checked"]), (40401, 100))
        self.assertIn(b"100 of 40,401 cells of results.h5 hold", self.verify("results.h5", "--sample", "100").stdout)
        for wrong in ("0", "-1", "1.5", "many"):
            self.assert_fails(2, f"expected a whole number from 1, found '{wrong}' (--sample)", "verify", "results.h5",
                              "--sample", wrong)  # fmt: skip

    def test_no_results_file(self):
        self.write("results.h5", "not HDF5")
        self.assert_fails(
            3, "not a coordreq results file: it is not HDF5, or cut short (results.h5)", "verify", "results.h5"
        )
        self.assert_fails(5, "cannot read the results: No such file or directory (none.h5)", "verify", "none.h5")

    @unittest.skipIf(SANITIZED, "reading results alone needs more than that")
    def test_memory_is_refused_up_front(self):
        self.results(config("intersection.json"))
        result = self.verify("results.h5", "--max-memory", "50M")
        self.assertEqual((result.returncode, result.stdout), (4, b""))
        self.assertIn(b"verifying needs about", result.stderr)

    def check_example(self, name, basis, **changes):
        self.results(config(name, **changes))
        result = self.verify("results.h5", "--json")
        summary = json.loads(result.stdout)
        wrong = [check for check in summary["checks"] if check["status"] != "holds"]
        self.assertEqual((result.returncode, wrong), (0, []))
        self.assertEqual((summary["reachable_sets"], summary["not_independent"]), (basis, []))

    def test_exact_examples_hold(self):
        for name in ("circle.json", "lane_change.json", "platoon.json"):
            with self.subTest(example=name):
                self.check_example(name, "exact")

    def test_inner_safe_set_of_half_open_cells_holds(self):
        self.check_example("circle.json", "exact", abstraction={"cells": "half_open", "safe": "inner"})

    def test_gridworld_holds(self):
        self.check_example("gridworld_coarse.json", "exact")

    def test_intersection_and_load_hold(self):
        for name in ("intersection_coarse.json", "load.json"):
            with self.subTest(example=name):
                self.check_example(name, "computed")

    def test_aircraft_holds(self):
        spec = config("aircraft_coarse.json")
        spec["states"][0]["count"] = 12
        self.write("aircraft.json", dict(spec, output=EVERYTHING))
        self.analyze("aircraft.json", "-o", "aircraft.h5")
        result = self.verify("aircraft.h5", "--json")
        self.assertEqual((result.returncode, json.loads(result.stdout)["reachable_sets"]), (0, "stored"))

    def between_samples(self, name, **changes):
        spec = config(name, **changes)
        spec["abstraction"] = dict(spec.get("abstraction", {}), between_samples=True, safe="inner")
        return spec

    def test_the_way_between_the_samples_holds(self):
        for name, basis, tubes in (("circle.json", "exact", "exact"), ("load.json", "computed", "computed")):
            with self.subTest(example=name):
                self.results(self.between_samples(name))
                result = self.verify("results.h5", "--json")
                summary = json.loads(result.stdout)
                wrong = [check for check in summary["checks"] if check["status"] != "holds"]
                self.assertEqual((result.returncode, wrong), (0, []))
                self.assertEqual((summary["reachable_sets"], summary["between_samples"]), (basis, tubes))
                self.assertIn(b"\nbetween the samples: ", self.verify("results.h5", "--sample", "10").stdout)

    def test_a_result_that_forgot_the_way_between_the_samples_is_found(self):
        """Numbers of one analysis under the spec and the guarantee of the other one."""
        x = dict(SPEC["states"][0], outside={"below": "unsafe", "above": "safe"})
        equations = {"x": "u", "y": "v"}
        jumps = {
            "states": [x, SPEC["states"][1]],
            "inputs": [{"name": "u", "values": [1]}, SPEC["inputs"][1]],
            "dynamics": {"time": "continuous", "period": 2, "equations": equations},
            "safe": "x <= 0.5 or x >= 1.5",
        }
        asked = {"cells": "half_open", "between_samples": True}
        forgotten = self.results(spec_with(**jumps, abstraction=dict(asked, between_samples=False)))
        self.write("other.json", spec_with(**jumps, abstraction=asked))
        self.analyze("other.json", "-o", "other.h5")
        self.assertEqual(self.verify("other.h5", "--quiet").returncode, 0)
        with h5py.File(forgotten, "r+") as file, h5py.File(self.folder / "other.h5") as source:
            for name in ("spec", "spec_json"):
                file[name][()] = source[name][()]
            for name in ("spec_sha256", "guarantee"):
                file.attrs.modify(name, source.attrs[name])
        result = self.verify("results.h5")
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stdout.decode(), r"\nattributes +[0-9]+  holds\n")
        self.assertRegex(result.stdout.decode(), r"\nK +[0-9]+  [0-9]+ wrong\n")

    def test_another_guarantee_is_found(self):
        path = self.results(SPEC)
        with h5py.File(path, "r+") as file:
            file.attrs.modify("guarantee", "continuous")
        self.assertIn(b"attributes", self.verify("results.h5").stdout)
        self.assert_found(path, "guarantee")

    def flip_everything(self, spec):
        """One file after the other in which one bit of a dataset is the other way; all have to be found."""
        original = self.results(spec)
        self.assertEqual(self.verify("results.h5", "--quiet").returncode, 0)
        random = np.random.default_rng(20180410)
        copy = self.folder / "flipped.h5"
        for change in self.changes(original, random):
            shutil.copy(original, copy)
            with h5py.File(copy, "r+") as file:
                what = change(file)
            with self.subTest(change=what):
                self.assert_found(copy, what)

    def changes(self, path, random):
        """Functions that make one change in a dataset of an open file and say which; verify_everything_test changes attributes."""
        found = []
        with h5py.File(path) as file:
            names = []
            file.visit(lambda name: names.append("/" + name))
            for name in names:
                if isinstance(file[name], h5py.Dataset) and name not in OBSERVED:
                    found += self.dataset_changes(file[name], random)
        return found

    @staticmethod
    def dataset_changes(dataset, random, most=6):
        name = dataset.name
        if dataset.attrs.get("NAME", b"").startswith(b"This is a netCDF dimension"):
            return []  # holds no data
        if dataset.dtype == object:

            def change_text(file):
                values = np.atleast_1d(file[name].asstr()[()])
                values[-1] = other_text(values[-1])
                file[name][()] = values if file[name].shape else values[0]
                return name

            return [change_text]
        found = []
        for _ in range(most):
            place, bit = int(random.integers(dataset.size)), int(random.integers(8 * dataset.dtype.itemsize))

            def change(file, place=place, bit=bit):
                file[name][...] = flipped(file[name][...], place, bit)
                return f"{name}[{place}] bit {bit}"

            found.append(change)
        return found

    def test_every_flipped_bit_of_a_finite_system_is_found(self):
        partitions = [{"classes": []}, {"name": "both", "classes": [["right", "left"]]}]
        coordination = {"partitions": partitions, "connection_delay": 2}
        network = {"burst": {"length": 1, "gap": 2}, "down": "both", "resynthesise": True}
        self.flip_everything(
            config("lane_change.json", output=EVERYTHING, coordination=coordination, network=network)
        )

    def test_every_flipped_bit_of_a_disc_that_is_safe_between_the_samples_is_found(self):
        spec = self.between_samples("circle.json")
        for state in spec["states"]:
            state.update(step=0.1, outside={"below": "unsafe", "above": "saturate"})
        for action in spec["inputs"]:
            action["step"] = 0.5
        spec["dynamics"]["period"] = 0.1
        self.flip_everything(spec)

    def test_every_flipped_bit_of_requirements_is_found(self):
        """The first one holds, the second one ends at an edge, the third one outside the safe set."""
        box = "-0.4 < x < {} and -0.4 < y < {}"
        requirements = [
            {"name": "corner", "where": box.format(0.4, 0.4), "invariant": True},
            {"name": "silence", "where": box.format(2.4, 3.4), "min_delay": 4},
            {"name": "edge", "where": "x >= 2", "invariant": True},
        ]
        self.flip_everything(spec_with(requirements=requirements, controller={"allow": "x < 3 or u == 1"}))

    def test_axes_that_are_mixed_up_are_found(self):
        path = self.results(SPEC)
        with h5py.File(path, "r+") as file:
            file["safe"].dims[0].detach_scale(file["x"])
            file["safe"].dims[0].attach_scale(file["y"])
        self.assert_found(path, "axes of /safe")

    def test_flipped_bytes_of_the_file_are_found(self):
        """The data lie plainly in the file of a small system: any bit of it can be hit from outside."""
        path = self.results(spec_with(output=EVERYTHING))
        raw = path.read_bytes()
        random = np.random.default_rng(5)
        with h5py.File(path) as file:
            places = {}
            file.visititems(lambda name, item: places.update({name: item.id.get_offset()})
                            if isinstance(item, h5py.Dataset) else None)  # fmt: skip
            for name in ("safe", "invariant", "collision_time", "delay", "trigger", "controller", "x"):
                for _ in range(4):
                    place = places[name] + int(random.integers(file[name].size * file[name].dtype.itemsize))
                    changed = bytearray(raw)
                    changed[place] ^= 1 << int(random.integers(8))
                    copy = self.folder / "flipped.h5"
                    copy.write_bytes(changed)
                    with self.subTest(dataset=name, place=place):
                        self.assert_found(copy, name)

    def test_a_spec_of_other_numbers_is_found(self):
        """A result under the spec of another one, digest and all."""
        first = self.results(SPEC)
        other = self.folder / "other.h5"
        self.write("other.json", spec_with(safe="x + y <= 5"))
        self.analyze("other.json", "-o", "other.h5")
        with h5py.File(first, "r+") as file, h5py.File(other) as source:
            for name in ("spec", "spec_json"):
                file[name][()] = source[name][()]
            file.attrs.modify("spec_sha256", source.attrs["spec_sha256"])
        result = self.verify("results.h5")
        self.assertEqual(result.returncode, 1)
        self.assertIn(b"in S, but it is not safe", result.stdout)


    def test_deleted_parts_that_the_spec_asks_for_are_refused(self):
        original = self.results(spec_with(output=EVERYTHING))
        copy = self.folder / "less.h5"
        for name in ("abstraction", "controller", "layers", "actions"):
            shutil.copy(original, copy)
            with h5py.File(copy, "r+") as file:
                del file[name]
            with self.subTest(deleted=name):
                self.assert_found(copy, name)

    def test_an_axis_without_coordinates_that_holds_something_is_found(self):
        path = self.results(spec_with(output=EVERYTHING))
        copy = self.folder / "nan.h5"
        with h5py.File(path) as file:
            lengths = []
            file.visititems(lambda name, item: lengths.append(name)
                            if item.attrs.get("NAME", b"").startswith(b"This is a netCDF dimension") else None)  # fmt: skip
        self.assertTrue(lengths)
        for name in lengths:
            shutil.copy(path, copy)
            with h5py.File(copy, "r+") as file:
                file[name][...] = np.nan
            with self.subTest(axis=name):
                self.assert_found(copy, name)

    def friction(self, **changes):
        """Nonlinear, with a disturbance: its reachable sets are no exact hulls."""
        return dict({
            "coordreq": 1,
            "name": "friction",
            "states": [{"name": "v", "lower": -3, "upper": 3, "step": 0.25}],
            "inputs": [{"name": "a", "values": [-1, -0.5, 0, 0.5, 1]}],
            "disturbances": [{"name": "w", "lower": -0.2, "upper": 0.2}],
            "agents": [{"name": "one", "inputs": ["a"]}],
            "dynamics": {"time": "continuous", "period": 0.25, "equations": {"v": "a - 0.25*v*abs(v) + w"}},
            "safe": "abs(v) <= 2.6",
            "output": {"abstraction": True},
        }, **changes)  # fmt: skip

    def test_a_reachable_state_that_is_left_out_is_named(self):
        path = self.results(self.friction())
        with h5py.File(path, "r+") as file:
            file["abstraction/v/last"][4, 4] -= 1
        result = self.verify("results.h5", "--json")
        self.assertEqual(result.returncode, 1)
        finding = next(check for check in json.loads(result.stdout)["checks"] if check["check"] == "abstraction v")
        self.assertEqual((finding["status"], finding["wrong"]), ("wrong", 1))
        self.assertRegex(finding["examples"][0], r"^v = -2, a = 1: v .*, but from v = -?[0-9.]+, w = 0\.2 v gets to ")

    def test_what_is_not_confirmed_is_a_warning_and_with_strict_a_failure(self):
        self.results(self.friction())
        result = self.verify("results.h5", "--budget", "0")
        self.assertEqual(result.returncode, 0)
        self.assertRegex(result.stderr.decode(), r"^coordreq: warning: not confirmed: .* in 'abstraction v' \(results.h5\)\n$")
        self.assertIn(b"v = -3, a = -1: v ", result.stdout)
        self.assertIn(b"the budget ended", result.stdout)
        self.assertIn(b"holds, except for what is not confirmed", result.stdout)
        self.assertEqual(self.verify("results.h5", "--budget", "0", "--strict", "--quiet").returncode, 1)
        self.assertEqual(self.verify("results.h5", "--strict", "--quiet").returncode, 0)
        text = self.verify("results.h5").stdout.decode()
        self.assertIn("\nconfirmed: 125 of 125 reachable sets that are not exact\n", text)

    def fast(self, **changes):
        """What moves by millions of cells in a period, so that no number of steps of the same length follows it."""
        return {
            "coordreq": 1, "name": "fast",
            "states": [{"name": "x", "lower": -0.3, "upper": 0.2, "step": 0.1, "origin": 0, "outside": "stop"},
                       {"name": "y", "lower": 0, "upper": 3, "step": 1, "outside": "stop"}],
            "inputs": [{"name": "u", "values": ["1e-300"]}], "agents": [{"name": "one", "inputs": ["u"]}],
            "dynamics": {"time": "continuous", "period": 100, "equations": {"x": "1e8 + u*y/3", "y": "1e3*y*x"}},
            "safe": "true", "output": {"abstraction": True},
            **changes,
        }  # fmt: skip

    def test_work_is_bounded_and_told(self):
        self.results(self.fast())
        summary = json.loads(self.verify("results.h5", "--json").stdout)
        self.assertTrue(summary["holds"])
        self.assertLess(summary["confirmed"]["reachable_sets"], summary["confirmed"]["of"])
        # Sets without hope take a small part of the budget, so that it does not end.
        self.assertEqual(summary["work"]["left_open"], 0)
        self.assertLess(0, summary["work"]["spent"])
        self.assertLess(summary["work"]["spent"], summary["work"]["budget"] / 100)
        # A smaller one holds, but for what may be spent on a piece of each set that is begun.
        for seconds in (0.002, 0.01):
            result = self.verify("results.h5", "--json", "--budget", str(seconds))
            work = json.loads(result.stdout)["work"]
            self.assertEqual(work["budget"], round(seconds * 50_000_000))
            self.assertLess(work["spent"], 1.25 * work["budget"])
            self.assertGreater(work["left_open"], 0)
        text = self.verify("results.h5", "--budget", "0.01").stdout.decode()
        self.assertRegex(text, r"\nthe budget ended: [0-9]+ were not checked completely, see --budget\n")
        # Whatever the number of threads.
        spent = [json.loads(self.verify("results.h5", "--json", "--budget", "0.01", "--threads", n).stdout)["work"]
                 for n in "13"]  # fmt: skip
        self.assertEqual(spent[0], spent[1])

    def test_budgets_that_are_none(self):
        self.results(SPEC)
        for wrong in ("-1", "much", "1e999"):
            self.assert_fails(2, f"expected a number of seconds from 0, found '{wrong}' (--budget)", "verify",
                              "results.h5", "--budget", wrong)  # fmt: skip

    def test_a_sample_costs_as_much_as_it_looks_at(self):
        self.results(config("aircraft_coarse.json"))
        result = self.verify("results.h5", "--sample", "3", "--json")
        summary = json.loads(result.stdout)
        self.assertEqual(result.returncode, 0)
        self.assertEqual(summary["confirmed"]["of"], 3 * 2 * 9)  # cells, states that are not exact, joint inputs
        self.assertEqual(summary["confirmed"]["reachable_sets"], summary["confirmed"]["of"])

    def test_a_sample_of_many_cells_costs_no_more_than_one_of_few(self):
        """Reachable sets that are worked out, and those that are confirmed."""
        for between_samples in (False, True):
            costs = set()
            for step in (0.25, 0.0625):
                spec = spec_with(
                    states=[{"name": n, "lower": -2, "upper": 2, "step": step, "outside": "unsafe"} for n in "xy"],
                    inputs=[{"name": "u", "values": [-1, 0, 1]}],
                    agents=[{"name": "a", "inputs": ["u"]}],
                    dynamics={"time": "continuous", "period": 0.1, "equations": {"x": "y + 0.1*x^2", "y": "u - sin(x*y)"}},
                    safe="x^2 + y^2 <= 3",
                    abstraction={"between_samples": between_samples},
                )
                self.results(spec)
                summary = json.loads(self.verify("results.h5", "--sample", "5", "--json").stdout)
                self.assertEqual(summary["verdict"], "holds")
                costs.add((summary["posts_computed"], summary["confirmed"]["of"]))
                whole = json.loads(self.verify("results.h5", "--json").stdout)
                self.assertGreater(whole["posts_computed"], 10 * summary["posts_computed"])
            self.assertEqual(costs, {(5 * 2 * 3, 5 * 2 * 3)})  # cells, states, joint inputs


if __name__ == "__main__":
    unittest.main()
