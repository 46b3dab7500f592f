"""Who must talk to whom: all partitions, the coalition map, connections that take time."""

import itertools
import json
import shutil
import unittest
from fractions import Fraction

import h5py
import numpy as np
import xarray
from program import CONFIGS, SPEC, Case, spec_with, without_comments

PLATOON = str(CONFIGS / "platoon_coalition.json")
NONE, UNSAFE, LOST = -3, -2, -1

# Three agents in a corridor each; neighbours must not both be at its upper end.
CORRIDORS = dict(
    states=[{"name": name, "lower": 0, "upper": 3, "step": 1, "outside": "saturate"} for name in "xyz"],
    inputs=[{"name": name, "values": [-1, 0, 1]} for name in "uvw"],
    agents=[{"name": agent, "inputs": [name]} for agent, name in zip("abc", "uvw")],
    dynamics={
        "time": "discrete",
        "period": 0.5,
        "unit": "s",
        "equations": {"x": "x + u", "y": "y + v", "z": "z + w"},
    },
    safe="(x < 3 or y < 3) and (y < 3 or z < 3)",
)
ONE = {
    "states": SPEC["states"][:1],
    "inputs": SPEC["inputs"][:1],
    "agents": SPEC["agents"][:1],
    "dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x + u"}},
    "safe": "x >= 1",
}


def corridors(**coordination):
    return spec_with(**CORRIDORS, coordination=coordination)


def classes_of(name):
    return [set(members.split("+")) for members in name.split("|")]


def network_cost(name, costs):
    """The cheapest of all graphs whose components are the classes."""
    total = Fraction(0)
    for members in classes_of(name):
        links = list(itertools.combinations(sorted(members), 2))
        trees = []
        for chosen in itertools.combinations(links, len(members) - 1):
            reached = {min(members)}
            for _ in members:
                reached |= {agent for link in chosen if reached & set(link) for agent in link}
            if reached == members:
                trees.append(sum((costs.get(frozenset(link), Fraction(1)) for link in chosen), Fraction(0)))
        total += min(trees)
    return total


def expected_maps(delay, safe, invariant, names, agents, horizon, costs):
    """/coalition and /critical_pair cell by cell, as the contract words it."""
    pairs = list(itertools.combinations(agents, 2))
    coalition = np.where(safe == 0, UNSAFE, np.where(invariant == 0, LOST, NONE))
    critical = np.zeros((len(pairs), *safe.shape), dtype=np.uint8)
    cost = [network_cost(name, costs) for name in names]

    def preference(p):
        return cost[p], max(len(members) for members in classes_of(names[p])), names[p]

    for cell in zip(*np.nonzero(invariant)):
        enough = [p for p in range(len(names)) if delay[(p, *cell)] >= horizon]
        if not enough:
            continue
        coalition[cell] = min(enough, key=preference)
        cheapest = [p for p in enough if cost[p] == cost[coalition[cell]]]
        for i, pair in enumerate(pairs):
            critical[(i, *cell)] = all(
                any(set(pair) <= members for members in classes_of(names[p])) for p in cheapest
            )
    return coalition, critical


class Cases(Case):
    def results(self, spec, *arguments):
        """The summary of an analysis to out.h5."""
        self.write("spec.json", spec)
        return self.analyze("spec.json", "-o", "out.h5", *arguments)

    def check_maps(self, spec):
        summary = self.results(spec)
        agents = [agent["name"] for agent in spec["agents"]]
        costs = {
            frozenset(link["agents"]): Fraction(str(link["cost"]))
            for link in spec["coordination"].get("link_cost", [])
        }
        with h5py.File(self.folder / "out.h5") as file:
            names = [name.decode() for name in file["partition"]]
            horizon = file["coalition"].attrs["horizon"]
            coalition, critical = expected_maps(
                *(file[name][:] for name in ("delay", "safe", "invariant")), names, agents, horizon, costs
            )
            np.testing.assert_array_equal(file["coalition"][:], coalition)
            np.testing.assert_array_equal(file["critical_pair"][:], critical)
            self.assertEqual(file["coalition"].dtype, np.int16)
            self.assertEqual(file["critical_pair"].dtype, np.uint8)
            pairs = ["+".join(pair) for pair in itertools.combinations(agents, 2)]
            self.assertEqual([pair.decode() for pair in file["pair"]], pairs)
        counts = {name: int((coalition == p).sum()) for p, name in enumerate(names)}
        critical_counts = [{"name": pair, "cells": int(critical[i].sum())} for i, pair in enumerate(pairs)]
        shown = summary["coalition"]
        self.assertEqual({one["name"]: one["cells"] for one in shown["partitions"]}, counts)
        self.assertEqual(
            {one["name"]: one["cost"] for one in shown["partitions"]},
            {name: float(network_cost(name, costs)) for name in names},
        )
        self.assertEqual(shown["no_partition_suffices"], (coalition == NONE).sum())
        self.assertEqual(shown["critical_pairs"], critical_counts)
        info = json.loads(self.run_program("info", "out.h5", "--json").stdout)["coalition"]
        self.assertEqual(
            info,
            {
                "horizon": horizon,
                "partitions": [{"name": name, "cells": counts[name]} for name in names],
                "no_partition_suffices": (coalition == NONE).sum(),
                "critical_pairs": critical_counts,
            },
        )
        result = self.run_program("verify", "out.h5", "--quiet")
        self.assertEqual(result.returncode, 0, result.stderr)
        return summary

    def test_all_partitions(self):
        summary = self.results(corridors(partitions="all"))
        names = ["a+b+c", "a+b|c", "a+c|b", "a|b+c", "a|b|c"]
        self.assertEqual([partition["name"] for partition in summary["partitions"]], names)
        self.assertIsNone(summary["coalition"])
        with h5py.File(self.folder / "out.h5") as file:
            together = file["delay"][:]
        for number, name in enumerate(names):
            partitions = [{"classes": [sorted(members) for members in classes_of(name)]}]
            one = self.results(corridors(partitions=partitions))["partitions"][0]
            self.assertEqual(one, summary["partitions"][number])
            with h5py.File(self.folder / "out.h5") as file:
                np.testing.assert_array_equal(file["delay"][0], together[number])
        self.assertEqual(summary["work"]["layers a+b+c"]["rows_visited"], 0)

    def test_any_order_of_partitions_gives_the_same(self):
        partitions = [[["a"], ["b"], ["c"]], [["a", "b"], ["c"]], [["a", "b", "c"]], [["a"], ["b", "c"]]]
        delays = {}
        for order in (partitions, partitions[::-1]):
            self.results(corridors(partitions=[{"classes": classes} for classes in order]))
            with h5py.File(self.folder / "out.h5") as file:
                for number, name in enumerate(file["partition"]):
                    np.testing.assert_array_equal(
                        delays.setdefault(name, file["delay"][number]), file["delay"][number]
                    )

    def test_too_many_agents(self):
        names = [f"a{i}" for i in range(8)]
        spec = spec_with(
            inputs=[{"name": f"u_{name}", "values": [0]} for name in names],
            agents=[{"name": name, "inputs": [f"u_{name}"]} for name in names],
            dynamics={"time": "discrete", "period": 1, "equations": {"x": "x", "y": "y"}},
            coordination={"partitions": "all"},
        )
        self.write("spec.json", spec)
        message = (
            "'all' is possible for at most 7 agents, which have 877 partitions, found 8 agents; "
            "expected a list of partitions (/coordination/partitions)"
        )
        for command in ("analyze", "validate"):
            self.assert_fails(4, message, command, "spec.json")

    def test_maps(self):
        self.check_maps(corridors(partitions="all", horizon=1))
        costs = [{"agents": ["b", "a"], "cost": 2.5}, {"agents": ["a", "c"], "cost": "1/3"}]
        self.check_maps(corridors(partitions="all", horizon_time=0.9, link_cost=costs))
        self.check_maps(corridors(partitions="all", horizon=0))

    def test_maps_of_platoon(self):
        self.check_maps(json.loads(without_comments((CONFIGS / "platoon_coalition.json").read_text())))

    def test_maps_of_listed_partitions(self):
        partitions = [{"classes": []}, {"name": "right", "classes": [["b", "c"]]}]
        summary = self.results(corridors(partitions=partitions, horizon=3, max_delay=3))
        without = summary["coalition"]["no_partition_suffices"]
        self.assertGreater(without, 0)
        with h5py.File(self.folder / "out.h5") as file:
            self.assertEqual((file["coalition"][:] == NONE).sum(), without)
            self.assertEqual(file["critical_pair"][:][:, file["coalition"][:] == NONE].sum(), 0)
        text = self.run_program("analyze", "spec.json").stdout.decode()
        self.assertRegex(text, rf"\n  none of those listed suffices +{without} cells\n")
        self.assertEqual(self.run_program("verify", "out.h5", "--quiet").returncode, 0)

    def test_attributes(self):
        self.results(corridors(partitions="all", horizon=1))
        with h5py.File(self.folder / "out.h5") as file:
            self.assertEqual(list(file["coalition"].attrs["flag_values"]), [NONE, UNSAFE, LOST])
            self.assertEqual(
                file["coalition"].attrs["flag_meanings"], "no_partition_suffices not_safe not_invariant"
            )
            self.assertEqual(file["critical_pair"].attrs["flag_meanings"], "not_critical critical")
        with xarray.open_dataset(self.folder / "out.h5", engine="h5netcdf") as data:
            self.assertEqual(data.coalition.dims, ("x", "y", "z"))
            self.assertEqual(data.critical_pair.dims, ("pair", "x", "y", "z"))
            self.assertEqual(list(data.pair.values), ["a+b", "a+c", "b+c"])

    def test_equal_bytes_for_any_number_of_threads(self):
        spec = corridors(partitions="all", horizon=1)
        self.results(spec, "--threads", "1")
        one = (self.folder / "out.h5").read_bytes()
        self.results(spec, "--threads", "3")
        self.assertEqual((self.folder / "out.h5").read_bytes(), one)

    def test_one_agent(self):
        summary = self.results(spec_with(**ONE, coordination={"partitions": "all", "horizon": 5}))
        self.assertEqual(summary["coalition"]["partitions"], [{"name": "a", "cost": 0, "cells": 4}])
        self.assertEqual(summary["coalition"]["critical_pairs"], [])
        with h5py.File(self.folder / "out.h5") as file:
            self.assertEqual(list(file["coalition"]), [UNSAFE, 0, 0, 0, 0])
            self.assertNotIn("pair", file)
            self.assertNotIn("critical_pair", file)
        self.assertEqual(self.run_program("verify", "out.h5", "--quiet").returncode, 0)

    def test_horizons_that_layers_do_not_reach(self):
        self.write("spec.json", corridors(max_delay=3, horizon=4))
        message = "expected a horizon of at most max_delay = 3 steps, found 4 steps (/coordination/horizon)"
        self.assert_fails(3, message, "analyze", "spec.json")
        self.write("spec.json", corridors(link_cost=[{"agents": ["a", "b"], "cost": 2}]))
        message = (
            "'link_cost' is for the coalition map, expected 'horizon' or 'horizon_time' beside it "
            "(/coordination/link_cost)"
        )
        self.assert_fails(3, message, "validate", "spec.json")

    def test_query(self):
        partitions = [{"classes": []}, {"classes": [["b", "c"]]}]
        self.results(corridors(partitions=partitions, horizon=2))
        answers = {}
        for x, y, z in ((0, 0, 0), (0, 2, 2), (2, 2, 2), (3, 3, 0)):
            at = f"x={x},y={y},z={z}"
            text = self.run_program("query", "out.h5", "--at", at).stdout.decode()
            answer = json.loads(self.run_program("query", "out.h5", "--at", at, "--json").stdout)
            answers[x, y, z] = text[text.index("\n2 steps") + 1 :], answer["coalition"]
        text = "2 steps (1 s) without further contact\n  cheapest partition  "
        self.assertEqual(
            answers,
            {
                (0, 0, 0): (
                    f"{text}a|b|c\n  critical pairs      none\n",
                    {"horizon": 2, "partition": "a|b|c", "status": "partition", "critical_pairs": []},
                ),
                (0, 2, 2): (
                    f"{text}a|b+c\n  critical pairs      b+c\n",
                    {"horizon": 2, "partition": "a|b+c", "status": "partition", "critical_pairs": ["b+c"]},
                ),
                (2, 2, 2): (
                    f"{text}none: no partition of the file suffices\n",
                    {
                        "horizon": 2,
                        "partition": None,
                        "status": "no_partition_suffices",
                        "critical_pairs": [],
                    },
                ),
                (3, 3, 0): (
                    f"{text}none\n",
                    {"horizon": 2, "partition": None, "status": "not_safe", "critical_pairs": []},
                ),
            },
        )
        result = self.run_program("query", "out.h5", stdin=b"x,y,z\n0,2,2\n2,2,2\n")
        lines = result.stdout.decode().splitlines()
        self.assertTrue(lines[0].endswith(",coalition,critical_pairs"))
        self.assertTrue(lines[1].endswith(",1,b+c"))
        self.assertTrue(lines[2].endswith(",-3,"))

    def test_connection_delay(self):
        alone = r"  connection +takes 2 steps \(1 s\) to establish: must exist already in {} cells, or be requested at once in {} more\n"
        table = r"a\|b\|c .* {} cells\nA connection takes 2 steps \(1 s\) to establish\.\n"
        for partitions, shown in (([{"classes": []}], alone), ("all", table)):
            summary = self.results(corridors(partitions=partitions, connection_delay=2))
            self.assertEqual(summary["connection_delay"], 2)
            with h5py.File(self.folder / "out.h5") as file:
                delay, trigger = file["delay"][:], file["trigger"][:]
            other = np.where((delay < 0) | (delay == 32767), delay, delay - 2)
            expected = np.where((delay >= 0) & (delay < 2), -3, other)
            np.testing.assert_array_equal(trigger, expected)
            bound = [int((trigger[p] == -3).sum()) for p in range(len(trigger))]
            self.assertEqual([one["never_without_connection"] for one in summary["partitions"]], bound)
            self.assertGreater(bound[-1], 0)
            text = self.run_program("analyze", "spec.json").stdout.decode()
            self.assertRegex(text, shown.format(bound[-1], (delay[-1] == 2).sum()))

    def test_connection_delay_beyond_max_delay(self):
        spec = corridors(connection_delay=2, max_delay=1)
        summary = self.results(spec)
        self.assertEqual(summary["partitions"][0]["never_without_connection"], summary["invariant"])
        text = self.run_program("analyze", "spec.json").stdout.decode()
        self.assertRegex(text, rf"  connection .*: must exist already in at most {summary['invariant']} cells, ")

    def test_verify_finds_other_coalitions(self):
        self.results(corridors(partitions="all", horizon=1))

        def changed(change):
            shutil.copy(self.folder / "out.h5", self.folder / "other.h5")
            with h5py.File(self.folder / "other.h5", "r+") as file:
                change(file)
            return self.run_program("verify", "other.h5")

        def other_partition(file):
            file["coalition"][2, 2, 2] = 0 if file["coalition"][2, 2, 2] != 0 else 1

        def other_pair(file):
            file["critical_pair"][1, 2, 2, 2] = 1 - file["critical_pair"][1, 2, 2, 2]

        for change, check in (
            (other_partition, "coalition "),
            (other_pair, "critical pairs "),
            (lambda file: file["coalition"].attrs.modify("cells", np.arange(5)), "coalition "),
            (lambda file: file["critical_pair"].attrs.modify("cells", np.arange(3)), "critical pairs "),
            (lambda file: file["coalition"].attrs.__delitem__("cells"), "coalition "),
            (lambda file: file["critical_pair"].attrs.__delitem__("cells"), "critical pairs "),
            (lambda file: file["coalition"].attrs.modify("horizon", 2), "attributes "),
        ):
            result = changed(change)
            self.assertEqual(result.returncode, 1)
            wrong = [line for line in result.stdout.decode().splitlines() if line.endswith("wrong")]
            self.assertEqual(len(wrong), 1)
            self.assertTrue(wrong[0].startswith(check), wrong)
        result = changed(lambda file: file.__delitem__("critical_pair"))
        self.assertEqual(result.returncode, 3)
        result = changed(lambda file: file["coalition"].__setitem__((0, 0, 0), 5))
        self.assertEqual(result.returncode, 3)
        self.assertIn(b"found 5, expected at most 4", result.stderr)

    def test_validate_counts_the_maps(self):
        def estimate(**coordination):
            spec = corridors(**coordination)
            # So many cells that it does not matter what is told differs by from run to run.
            spec["states"] = [dict(state, lower=0, upper=199) for state in spec["states"]]
            self.write("spec.json", spec)
            return json.loads(self.run_program("validate", "spec.json", "--json").stdout)

        few, all_of_them = estimate(), estimate(partitions="all")
        self.assertEqual(len(all_of_them["partitions"]), 5)
        self.assertGreater(all_of_them["memory_bytes"], few["memory_bytes"])
        self.assertGreater(estimate(partitions="all", horizon=1)["memory_bytes"], all_of_them["memory_bytes"])


if __name__ == "__main__":
    unittest.main()
