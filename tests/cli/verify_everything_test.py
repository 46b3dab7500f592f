"""verify proves all of a file: whatever is changed in it is found, but for a short list of names that it says.

Every dataset and every attribute of every kind of file is changed in turn: one element, two that change places, all
of it; and several at once so that they still agree with each other.
"""

import shutil
import unittest

import h5py
import numpy as np
from program import Case, spec_with

EVERYTHING = {"controller": True, "actions": True, "layers": True, "abstraction": True}
# Named in docs/explanation/verification.md: where a file comes from and free text; what only HDF5's own bookkeeping looks at; and
# what a controller file lists, which is taken as given; and what was seen of a run of the system.
NOT_LOOKED_AT = {"long_name", "coordreq_version", "git_sha1", "REFERENCE_LIST"}
GIVEN = {"/controller:file", "/counterexample/seen"}
# Ranges that are only enclosures may be wider than they need be.
WIDER = {"/abstraction/v/last", "/abstraction/p/last"}
AXES = {"DIMENSION_LIST", "CLASS", "NAME", "_Netcdf4Dimid", "_Netcdf4Coordinates"}  # verify_test changes these


def finite(**changes):
    """Two carts that must not meet, with a goal, memories of what the agents know left out."""
    return spec_with(
        **dict(
            {
                "states": [
                    {"name": "x", "lower": 0, "upper": 5, "step": 1, "outside": "saturate"},
                    {"name": "y", "lower": 0, "upper": 5, "step": 1, "outside": {"below": "unsafe", "above": "saturate"}},
                ],
                "safe": "x != y",
                "controller": {"allow": "x + y <= 8 or u <= 0"},
                "output": EVERYTHING,
            },
            **changes,
        )
    )


LINKS = [{"name": "alone", "classes": []}, {"name": "both", "classes": [["a", "b"]]}]
KINDS = {
    "goal": finite(
        goal="x >= 4 and y <= 1",
        coordination={"partitions": LINKS, "connection_delay": 1, "horizon": 2, "convention": True},
        requirements=[
            {"name": "arrives", "where": "1.5 < x < 3.5 and 0.5 < y < 1.5", "max_arrival": 1},
            {"name": "quick", "where": "0.5 < x < 1.5 and 3.5 < y < 4.5", "min_approach_delay": 3, "partition": "alone"},
        ],
    ),
    "network": finite(
        coordination={"partitions": LINKS, "max_delay": 20},
        network={"burst": {"length": 1, "gap": 2}, "down": "alone"},
        requirements=[
            {"name": "stays", "where": "0.6 < x < 4.4 and 0.6 < y < 4.4", "invariant": True},
            {"name": "silence", "where": "0.6 < x < 1.4 and 3.6 < y < 4.4", "min_delay": 9, "partition": "alone"},
        ],
    ),
    "truncated": finite(
        goal="x >= 4 and y <= 1", coordination={"partitions": LINKS, "max_delay": 1, "horizon": 1, "convention": True}
    ),
    "over": finite(
        goal={"where": "x >= 4 and y <= 1", "then": "over"},
        states=[
            {"name": "x", "lower": 0, "upper": 5, "step": 1, "outside": "saturate"},
            {"name": "y", "lower": 0, "upper": 5, "step": 1, "outside": "unsafe"},
        ],
        agents=[{"name": "a", "inputs": ["u"], "sees": ["x"]}, {"name": "b", "inputs": ["v"]}],
        coordination={"partitions": LINKS, "connection_delay": 1, "horizon": 2, "convention": True},
        network={"loss": 0.25, "down": "alone"},
        risk={"horizon": 3},
        requirements=[{"name": "arrives", "where": "1.5 < x < 3.5 and 0.5 < y < 1.5", "max_arrival": 1}],
    ),
    "given": finite(
        controller={"synthesis": "given", "allow": "(x + y <= 8 or u <= 0) and (x < y - 1 or u <= 0) and (y < x - 1 or v <= 0)"}
    ),
    "enclosed": {
        "coordreq": 1,
        "name": "friction",
        "states": [
            {"name": "v", "lower": -1, "upper": 1, "step": 0.5, "measurement_error": 0.05, "outside": "saturate"},
            {"name": "p", "lower": -1, "upper": 1, "step": 0.5},
        ],
        "inputs": [{"name": "u", "values": [-1, 0, 1]}, {"name": "w", "values": [-1, 1]}],
        "disturbances": [{"name": "d", "lower": -0.1, "upper": 0.1}],
        "agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["w"]}],
        "dynamics": {"time": "continuous", "period": 0.25, "equations": {"v": "u + w - 0.5*v + d", "p": "v"}},
        "safe": "abs(p) <= 1",
        "output": EVERYTHING,
    },
    "file": finite(controller={"file": "first.scs"}),
    "remembered": finite(
        memory={"far": "within(2, x >= 4)"}, safe="x != y or far", controller={"allow": "u <= 0 or not far"}
    ),
    "between": finite(
        dynamics={"time": "continuous", "period": 1, "equations": {"x": "u", "y": "v"}},
        abstraction={"cells": "half_open", "safe": "center", "between_samples": True},
    ),
}


def datasets(file):
    found = []
    file.visititems(lambda name, item: found.append("/" + name) if isinstance(item, h5py.Dataset) else None)
    return [n for n in found if not file[n].attrs.get("NAME", b"").startswith(b"This is a netCDF dimension")]


class Cases(Case):
    tried = set()  # attributes with their values, rough changes of datasets: kinds of files have many in common

    def results(self, spec):
        self.write("spec.json", spec)
        result = self.run_program("analyze", "spec.json", "-o", "results.h5", "--quiet", "--threads", "1")
        self.assertIn(result.returncode, (0, 1), result.stderr.decode())
        return self.folder / "results.h5"

    def first_controller(self):
        """A file for the kind that begins with one."""
        self.results(finite())
        done = self.run_program("export", "results.h5", "--format", "scs", "-o", "first.scs")
        self.assertEqual((done.returncode, done.stderr), (0, b""))

    def verdict(self, path):
        return self.run_program("verify", str(path), "--quiet", "--threads", "1").returncode

    def assert_found(self, original, what, change):
        """@param change makes a change in an open file; @returns whether it did"""
        copy = self.folder / "changed.h5"
        shutil.copy(original, copy)
        with h5py.File(copy, "r+") as file:
            if not change(file):
                return 0
        self.assertIn(self.verdict(copy), (1, 3), what)
        return 1

    def check_kind(self, name):
        if name == "file":
            self.first_controller()
        original = self.results(KINDS[name])
        self.assertEqual(self.verdict(original), 0)
        with h5py.File(original) as file:
            names = datasets(file)
            objects = ["/"] + names
            attributes = {
                n: [(a, np.asarray(v).tobytes()) for a, v in file[n].attrs.items() if a not in NOT_LOOKED_AT | AXES] for n in objects
            }
        done = 0
        for path in names:
            if path in GIVEN:
                continue
            for change in self.dataset_changes():
                if name == "enclosed" and path in WIDER and change.__name__ == "one_more":
                    continue
                is_fine = change.__name__ in ("one_more", "two_exchanged")
                if not is_fine and not self.is_new(path, change.__name__):
                    continue
                with self.subTest(dataset=path, change=change.__name__):
                    done += self.assert_found(original, path, lambda file: change(file, path))
        for path, own in attributes.items():
            for attribute, value in own:
                if (path in GIVEN and attribute == "sha256") or not self.is_new(path, attribute, value):
                    continue
                with self.subTest(object=path, attribute=attribute):
                    done += self.assert_found(original, attribute, lambda file: self.other(file, path, attribute))
        self.assertGreater(done, len(names) // 2)

    def is_new(self, *change):
        if change in self.tried:
            return False
        self.tried.add(change)
        return True

    @staticmethod
    def dataset_changes():
        def put(file, path, values):
            if np.asarray(file[path][()]).tobytes() == values.tobytes():
                return False  # numbers or NaN as they were
            file[path][...] = values
            return True

        def one_more(file, path):
            values = np.array(file[path][()])
            if values.dtype.kind not in "iuf" or values.size == 0:
                return False
            place = values.size // 2
            values.reshape(-1)[place] += np.array(1, values.dtype)
            return put(file, path, values)

        def two_exchanged(file, path):
            values = np.array(file[path][()])
            flat = values.reshape(-1)
            if values.dtype.kind not in "iuf" or values.size < 2:
                return False
            plain = np.nan_to_num(flat, nan=-9)
            other = np.flatnonzero(plain != plain[-1])
            if not other.size:
                return False
            flat[-1], flat[other[-1]] = flat[other[-1]], flat[-1]
            return put(file, path, values)

        def all_zero(file, path):
            values = np.array(file[path][()])
            return values.dtype.kind in "iuf" and put(file, path, np.zeros_like(values))

        def all_seven(file, path):
            values = np.array(file[path][()])
            return values.dtype == np.uint8 and put(file, path, np.full_like(values, 7))

        def another_text(file, path):
            if file[path].dtype != object:
                return False
            texts = np.atleast_1d(file[path].asstr()[()]).astype(object)
            texts[0] = chr(ord(texts[0][0]) ^ 1) + texts[0][1:]
            file[path][()] = texts if file[path].shape else texts[0]
            return True

        return [one_more, two_exchanged, all_zero, all_seven, another_text]

    @staticmethod
    def other(file, path, attribute):
        value = file[path].attrs[attribute]
        if isinstance(value, (str, bytes)):
            text = value.decode() if isinstance(value, bytes) else value
            file[path].attrs.modify(attribute, text[:-1] + "?" if text else "?")
            return True
        values = np.atleast_1d(value)
        if values.dtype == object or values.dtype.kind not in "iuf" or not values.size:
            return False
        changed = values.copy()
        changed[-1] += np.array(1, values.dtype)
        file[path].attrs.modify(attribute, changed.reshape(np.shape(value)))
        return True

    def test_every_change_of_a_file_with_a_goal_is_found(self):
        self.check_kind("goal")

    def test_every_change_of_a_file_with_a_goal_that_ends_the_task_is_found(self):
        self.check_kind("over")

    def test_every_change_of_a_file_with_a_network_is_found(self):
        self.check_kind("network")

    def test_every_change_of_a_truncated_file_is_found(self):
        self.check_kind("truncated")

    def test_every_change_of_a_given_controller_s_file_is_found(self):
        self.check_kind("given")

    def test_every_change_of_a_file_of_enclosures_is_found(self):
        self.check_kind("enclosed")

    def test_every_change_of_a_file_that_begins_with_a_controller_is_found(self):
        self.check_kind("file")

    def test_every_change_of_a_file_with_a_memory_is_found(self):
        self.check_kind("remembered")

    def test_every_change_of_a_file_that_is_safe_between_the_samples_is_found(self):
        self.check_kind("between")

    def test_a_truncation_that_is_only_claimed_is_found(self):
        """F unknown, and layer sizes that would fit that."""
        original = self.results(KINDS["network"])
        with h5py.File(original) as file:
            indices = file["fixed_point_index"][:]
            sizes = file["layer_size"][:]
        self.assertTrue((indices >= 0).all())
        for p in range(len(indices)):

            def claim(file, p=p):
                file["fixed_point_index"][p] = -1
                file["layer_size"][p, :] = sizes[p]
                return True

            self.assert_found(original, f"partition {p}", claim)

    def test_an_approach_whose_truncation_is_only_claimed_is_found(self):
        original = self.results(KINDS["goal"])
        for p in range(2):

            def claim(file, p=p):
                file["approach_fixed_point_index"][p] = -1
                return True

            self.assert_found(original, f"partition {p}", claim)

    def test_cells_that_change_places_in_all_fields_are_found(self):
        """Delays, triggers, times and sets of two cells, so that all sizes stay as they are."""
        original = self.results(KINDS["goal"])
        with h5py.File(original) as file:
            delays = file["delay"][0].reshape(-1)
            shape = file["safe"].shape
            over_cells = [n for n in datasets(file) if file[n].shape[-2:] == shape or file[n].shape == shape]
        values = np.unique(delays)
        self.assertGreater(len(values), 2)
        for low, high in zip(values, values[1:]):
            first, second = np.flatnonzero(delays == low)[0], np.flatnonzero(delays == high)[0]

            def exchange(file, first=first, second=second):
                for name in over_cells:
                    data = np.array(file[name][()])
                    flat = data.reshape(-1, shape[0] * shape[1])
                    flat[:, [first, second]] = flat[:, [second, first]]
                    file[name][...] = data
                return True

            self.assert_found(original, f"{low} and {high}", exchange)


if __name__ == "__main__":
    unittest.main()
