"""Conventions: what agents may do who have agreed beforehand."""

import itertools
import json
import math
import unittest

import h5py
import numpy as np
import xarray
from program import CONFIGS, SPEC, Case, spec_with, without_comments

EVERYTHING = {"controller": True, "actions": True}


def example(name, **changes):
    spec = json.loads(without_comments((CONFIGS / f"{name}.json").read_text()))
    return dict(spec, coordination={"convention": True}, **changes)


def unpacked(dataset):
    bits = np.unpackbits(dataset[...], axis=-1, bitorder="little")[..., : dataset.attrs["actions"]]
    return bits.reshape(-1, bits.shape[-1])


class Agents:
    """Which action of each agent a joint input is."""

    def __init__(self, spec):
        values = [v["values"] if "values" in v else range(self.points(v)) for v in spec["inputs"]]
        names = [v["name"] for v in spec["inputs"]]
        joint = list(itertools.product(*(range(len(v)) for v in values)))
        self.names = [agent["name"] for agent in spec["agents"]]
        self.parts = []
        for agent in spec["agents"]:
            own = [i for i, name in enumerate(names) if name in agent["inputs"]]
            actions = list(itertools.product(*(range(len(values[i])) for i in own)))
            number = {action: a for a, action in enumerate(actions)}
            self.parts.append([number[tuple(u[i] for i in own)] for u in joint])
        self.counts = [max(parts) + 1 for parts in self.parts]

    @staticmethod
    def points(v):
        return round((v["upper"] - v["lower"]) / v["step"]) + 1

    def convention(self, admissible):
        """By the definition, one action after the other."""
        joint = {tuple(parts[u] for parts in self.parts) for u in np.flatnonzero(admissible)}
        if not joint:
            return [set() for _ in self.parts]
        seed = int(np.flatnonzero(admissible)[0])
        sets = [{parts[seed]} for parts in self.parts]
        for i, count in enumerate(self.counts):
            for action in range(count):
                others = itertools.product(*(sets[j] if j != i else {action} for j in range(len(sets))))
                if all(u in joint for u in others):
                    sets[i].add(action)
        return sets

    def projection(self, admissible, i):
        return {self.parts[i][u] for u in np.flatnonzero(admissible)}


class Cases(Case):
    def analyzed(self, spec, results="out.h5"):
        self.write("spec.json", spec)
        return self.analyze("spec.json", "-o", results)

    def assert_verified(self, results="out.h5"):
        result = self.run_program("verify", results)
        self.assertEqual((result.returncode, result.stderr), (0, b""), result.stdout.decode())
        return result.stdout.decode()

    def check(self, spec, stride):
        """Every so many cells against the definition, from the controller in the file."""
        summary = self.analyzed(dict(spec, output=EVERYTHING))
        agents = Agents(spec)
        self.assertEqual([own["agent"] for own in summary["convention"]], agents.names)
        with h5py.File(self.folder / "out.h5") as file:
            self.assertEqual(list(file["agent"].asstr()), agents.names)
            freedom = file["convention_freedom"][...].reshape(len(agents.names), -1)
            self.assertEqual(freedom.dtype, np.float32)
            invariant = file["invariant"][...].ravel() == 1
            self.assertTrue((np.isnan(freedom) == ~invariant).all())
            controller = unpacked(file["controller"])
            kept = [unpacked(file[f"actions:convention/{name}"]) for name in agents.names]
            for x in range(0, len(controller), stride):
                sets = agents.convention(controller[x])
                for i, own in enumerate(sets):
                    self.assertEqual(set(np.flatnonzero(kept[i][x])), own)
                    if own:
                        part = len(own) / len(agents.projection(controller[x], i))
                        self.assertEqual(freedom[i, x], np.float32(part))
            for own, values in zip(summary["convention"], freedom):
                values = values[invariant].astype(float)
                self.assertTrue(math.isclose(own["mean"], values.mean(), abs_tol=1e-7))
                self.assertEqual(own["full"], (values == 1).sum())
                bins = np.ceil(np.round(values * 10, 5)).astype(int)
                self.assertEqual(own["histogram"], [int((bins == k).sum()) for k in range(1, 11)])
        self.assertIn("convention actions", self.assert_verified())

    def test_it_is_what_the_definition_says(self):
        self.check(example("crossing"), 7)

    def test_three_agents_and_several_inputs_of_one(self):
        spec = spec_with(
            states=[dict(state, upper=9) for state in SPEC["states"]],
            inputs=[{"name": name, "values": [-1, 0, 1]} for name in "uvwz"],
            agents=[
                {"name": "a", "inputs": ["v"]},
                {"name": "b", "inputs": ["u", "w"]},
                {"name": "c", "inputs": ["z"]},
            ],
            dynamics={
                "time": "discrete",
                "period": 1,
                "equations": {"x": "x + u + v", "y": "y + v*w + z"},
            },
            safe="x + y <= 12",
            coordination={"convention": True},
        )
        self.check(spec, 1)

    def test_the_map_does_not_depend_on_how_the_engine_lays_out_states(self):
        spec = example("crossing")
        states = {state["name"]: state for state in spec["states"]}
        spec["states"] = [states[name] for name in ("p1", "p2", "v1", "v2")]
        self.analyzed(spec, "one.h5")
        self.analyzed(dict(spec, output={"actions": True}), "other.h5")
        with h5py.File(self.folder / "one.h5") as one, h5py.File(self.folder / "other.h5") as other:
            self.assertNotIn("actions:convention", one)
            a, b = one["convention_freedom"][...], other["convention_freedom"][...]
            self.assertTrue(np.array_equal(a, b, equal_nan=True))
        self.assert_verified("one.h5")

    def test_a_rule_leaves_less_to_agree_on(self):
        free = self.analyzed(example("crossing"))["convention"]
        ruled = self.analyzed(example("crossing", controller={"allow": "u1 >= 1"}))
        # With one action left in C(x) to one of them there is nothing to agree on.
        for own in ruled["convention"]:
            self.assertEqual((own["mean"], own["full"]), (1, ruled["invariant"]))
        self.assertTrue(all(own["mean"] < 1 for own in free))

    def test_an_empty_invariance_set(self):
        spec = spec_with(safe="x > 9", coordination={"convention": True}, output={"actions": True})
        summary = self.analyzed(spec)
        self.assertEqual(summary["invariant"], 0)
        for own in summary["convention"]:
            self.assertEqual((own["mean"], own["full"], own["histogram"]), (0, 0, [0] * 10))
        self.assert_verified()

    def test_xarray_opens_it(self):
        self.analyzed(example("crossing", output={"actions": True}))
        path = self.folder / "out.h5"
        with xarray.open_dataset(path, engine="h5netcdf") as data:
            self.assertEqual(data.convention_freedom.dims, ("agent", "p1", "v1", "v2", "p2"))
            second = data.convention_freedom.sel(agent="second", p1=-6, v1=1, v2=1, p2=-6)
            self.assertEqual(second.item(), np.float32(0.6))
        with xarray.open_dataset(path, engine="h5netcdf", group="actions:convention") as data:
            self.assertEqual(data.load()["second"].dims[-1], "second:byte")

    def test_query_shows_it(self):
        at = ("--at", "p1=-6,v1=1,v2=1,p2=-6")
        for output in ({}, {"actions": True}):
            self.analyzed(example("crossing", output=output))
            text = self.run_program("query", "out.h5", *at).stdout.decode()
            self.assertEqual(
                text.split("\n\n")[2],
                "convention\n  actions of first   all 5\n  actions of second  3 of 5: u2 = -1 ... 0\n",
            )
            answer = json.loads(self.run_program("query", "out.h5", *at, "--json").stdout)
            self.assertEqual([own["name"] for own in answer["convention"]], ["first", "second"])
            self.assertEqual(answer["convention"][1]["actions"], [0, 1, 2])
            self.assertEqual(answer["convention"][1]["values"], [[-1], [-0.5], [0]])
            csv = self.run_program("query", "out.h5", stdin=b"p1,v1,v2,p2\n-6,1,1,-6\n0,1,1,0\n99,1,1,0\n-99,1,1,0\n")
            header, *lines = csv.stdout.decode().splitlines()
            self.assertTrue(header.endswith(",convention:first,convention:second"))
            self.assertTrue(lines[0].endswith(",0 1 2 3 4,0 1 2"))
            for line in lines:
                self.assertEqual(line.count(","), header.count(","))
            outside = json.loads(self.run_program("query", "out.h5", "--at", "p1=99,v1=1,v2=1,p2=0", "--json").stdout)
            self.assertEqual(outside["convention"], [])

    def test_equal_bytes_for_any_number_of_threads(self):
        self.write("spec.json", example("crossing", output={"actions": True}))
        files, summaries = [], []
        for threads in ("1", "2", "7"):
            summaries.append(self.analyze("spec.json", "--threads", threads, "-o", "out.h5")["convention"])
            files.append((self.folder / "out.h5").read_bytes())
        self.assertEqual(files[0], files[1])
        self.assertEqual(files[0], files[2])
        self.assertEqual(summaries[0], summaries[1])
        self.assertEqual(summaries[0], summaries[2])

    def test_what_is_wrong_is_found(self):
        place = "p1 = -6, v1 = 1, v2 = 1, p2 = -6"
        index = (4, 2, 2, 4)
        for change, message in (
            (lambda f: f["convention_freedom"].__setitem__((1, *index), 1), f"{place}: second keeps 1, expected 3 of 5"),
            (lambda f: f["convention_freedom"].__setitem__((0, *index), np.nan), f"{place}: first keeps nan, expected 5"),
            (lambda f: f["actions:convention/second"].__setitem__(index, [0b01111]), f"{place}: not the actions of the"),
            (lambda f: f["actions:convention/first"].__setitem__(index, [0b01111]), f"{place}: not the actions of the"),
            (lambda f: f["actions:convention/first"].__setitem__(index, [0b111111]), f"{place}: not the actions of"),
            (lambda f: f["agent"].attrs.modify("NAME", "other"), "/agent: NAME is not as the spec says"),
        ):  # fmt: skip
            self.analyzed(example("crossing", output={"actions": True}))
            with h5py.File(self.folder / "out.h5", "r+") as file:
                change(file)
            result = self.run_program("verify", "out.h5")
            self.assertEqual(result.returncode, 1)
            self.assertIn(message, result.stdout.decode())
        self.analyzed(example("crossing"))
        with h5py.File(self.folder / "out.h5", "r+") as file:
            del file["convention_freedom"]
        self.assert_fails(3, "missing or damaged (out.h5:/convention_freedom)", "verify", "out.h5")

    def test_states_may_be_called_convention(self):
        spec = spec_with(
            states=[dict(SPEC["states"][0], name="convention"), SPEC["states"][1]],
            dynamics=dict(SPEC["dynamics"], equations={"convention": "convention + u", "y": "y + v"}),
            safe="convention + y <= 6",
            coordination={"convention": True, "partitions": [{"name": "convention", "classes": []}]},
            output={"actions": True},
        )
        self.analyzed(spec)
        self.assert_verified()


if __name__ == "__main__":
    unittest.main()
