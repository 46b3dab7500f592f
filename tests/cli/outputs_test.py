"""Everything that a results file can hold, against a computation in plain Python that shares no code."""

import itertools
import json
import unittest

import h5py
import numpy as np
import xarray
from program import CONFIGS, Case, without_comments

EVERYTHING = {"controller": True, "actions": True, "layers": True, "abstraction": True}
NEVER = 32767


def example(name):
    spec = json.loads(without_comments((CONFIGS / name).read_text()))
    return dict(spec, output=EVERYTHING)


class LaneChange:
    """configs/lane_change.json by hand: states (distance, left lane, right lane), one input an agent."""

    shape = (7, 2, 2)
    states = list(itertools.product(*map(range, shape)))
    inputs = list(itertools.product((0, 1), (0, 1)))

    def __init__(self):
        self.safe = {x for x in self.states if x[0] >= 1 or x[1] != x[2]}
        self.invariant = set(self.safe)
        while any(not self.admissible(x) for x in self.invariant):
            self.invariant = {x for x in self.invariant if self.admissible(x)}
        self.controller = {x: self.admissible(x) if x in self.invariant else [] for x in self.states}

    @staticmethod
    def step(x, u):
        return (max(x[0] - 1, 0), x[1] ^ u[0], x[2] ^ u[1])

    def admissible(self, x):
        return [u for u in self.inputs if self.step(x, u) in self.invariant]

    def actions(self, x, agent):
        return sorted({u[agent] for u in self.controller[x]})

    def layers(self, together):
        layers = [self.invariant]
        while True:
            following = {
                x
                for x in layers[-1]
                if all(self.step(x, u) in layers[-1] for u in self.choices(x, together))
            }
            if following == layers[-1]:
                return layers
            layers.append(following)

    def choices(self, x, together):
        if together:
            return self.controller[x]
        return itertools.product(self.actions(x, 0), self.actions(x, 1))


class Cases(Case):
    def analyze_spec(self, spec, *arguments):
        self.write("spec.json", spec)
        return self.analyze("spec.json", *arguments)

    def check_bits(self, dataset, actions, expected):
        """`expected`: state -> numbers of the actions whose bits are set."""
        self.assertEqual(dataset.attrs["actions"], actions)
        bits = np.unpackbits(dataset[...], axis=-1, bitorder="little")
        self.assertEqual(bits.shape, (*LaneChange.shape, 8))
        for x in LaneChange.states:
            self.assertEqual(list(np.flatnonzero(bits[x])), expected(x), x)

    def test_every_dataset_of_the_lane_change(self):
        partitions = [{"classes": []}, {"name": "both", "classes": [["right", "left"]]}]
        coordination = {"partitions": partitions, "connection_delay": 2}
        self.analyze_spec(dict(example("lane_change.json"), coordination=coordination), "-o", "out.h5")
        model = LaneChange()
        with h5py.File(self.folder / "out.h5") as file:
            for x in model.states:
                self.assertEqual((file["safe"][x], file["invariant"][x]), (x in model.safe, x in model.invariant))
                self.assertEqual(file["collision_time"][x], NEVER if x in model.safe else 0)
            self.check_bits(file["controller"], 4, lambda x: [2 * u + v for u, v in model.controller[x]])
            for p, together in enumerate((False, True)):
                self.check_partition(file, p, model.layers(together))
            self.check_bits(file["actions/left|right/left"], 2, lambda x: model.actions(x, 0))
            self.check_bits(file["actions/left|right/right"], 2, lambda x: model.actions(x, 1))
            self.check_bits(
                file["actions/both/left+right"], 4, lambda x: [2 * u + v for u, v in model.controller[x]]
            )
            # Before `outside` is applied: at distance 0 the next one is -1.
            for end in ("first", "last"):
                self.assertEqual(list(file[f"abstraction/distance/{end}"]), [-1, 0, 1, 2, 3, 4, 5])
                self.assertEqual(file[f"abstraction/left_lane/{end}"][...].tolist(), [[0, 1], [1, 0]])

    def check_partition(self, file, p, layers):
        sizes = [len(layer) for layer in layers]
        self.assertEqual(file["fixed_point_index"][p], len(layers) - 1)
        self.assertEqual(list(file["layer_size"][p, : len(sizes)]), sizes)
        self.assertTrue((file["layer_size"][p, len(sizes) :] == sizes[-1]).all())
        name = file["partition"].asstr()[p]
        start, cell = file[f"layers/{name}/start"][...], file[f"layers/{name}/cell"][...]
        self.assertEqual(len(start), len(layers) + 1)
        for k, layer in enumerate(layers):
            members = sorted(layer - layers[k + 1]) if k + 1 < len(layers) else sorted(layer)
            linear = [int(np.ravel_multi_index(x, LaneChange.shape)) for x in members]
            self.assertEqual(cell[start[k] : start[k + 1]].tolist(), linear)
            for x in members:
                delay = NEVER if k + 1 == len(layers) else k
                trigger = NEVER if delay == NEVER else delay - 2 if delay >= 2 else -3
                self.assertEqual((file["delay"][(p, *x)], file["trigger"][(p, *x)]), (delay, trigger), x)
        for x in set(LaneChange.states) - layers[0]:
            self.assertEqual((file["delay"][(p, *x)], file["trigger"][(p, *x)]), (-2, -2), x)

    def test_same_bytes_for_any_number_of_threads_with_everything(self):
        spec = dict(example("circle.json"), abstraction={"cells": "half_open", "safe": "inner"})
        for state in spec["states"]:
            state["step"] = 0.03
        spec["dynamics"]["period"] = 0.03
        spec["coordination"] = {"partitions": [{"classes": []}, {"classes": [["horizontal", "vertical"]]}]}
        files = []
        for threads in ("1", "2", "7"):
            self.analyze_spec(spec, "--threads", threads, "-o", "out.h5")
            files.append((self.folder / "out.h5").read_bytes())
        self.assertEqual(files[0], files[1])
        self.assertEqual(files[0], files[2])

    def test_xarray_opens_every_group(self):
        self.analyze_spec(example("lane_change.json"), "-o", "out.h5")
        axes = {
            "/": ("controller", ("distance", "left_lane", "right_lane", "controller:byte")),
            "/layers/left|right": ("cell", ("position",)),
            "/actions/left|right": ("left", ("distance", "left_lane", "right_lane", "left:byte")),
            "/abstraction/left_lane": ("first", ("left_lane", "left_change")),
        }
        for group, (name, dimensions) in axes.items():
            with xarray.open_dataset(self.folder / "out.h5", engine="h5netcdf", group=group) as data:
                self.assertEqual(data.load()[name].dims, dimensions)

    def test_nothing_more_than_asked_for(self):
        self.write("spec.json", dict(example("lane_change.json"), output={"layers": True}))
        self.analyze("spec.json")
        with h5py.File(self.folder / "lane_change.h5") as file:
            self.assertEqual(
                [name for name in file if isinstance(file[name], h5py.Group) or name == "controller"],
                ["layers"],
            )


if __name__ == "__main__":
    unittest.main()
