"""The network as an automaton, from the spec to every command that tells of it."""

import json
import re
import unittest

import h5py
import numpy as np
import xarray
from program import SPEC, Case, spec_with

HARD = {"weakly_hard": {"misses": 1, "window": 3}}
# Two agents that must not both be in the middle, and can always agree.
CROSSING = spec_with(name="crossing", safe="x + y <= 6 and (x != 2 or y != 2)")


def crossing(**network):
    return dict(CROSSING, network=network)


class Cases(Case):
    def results(self, spec, *arguments):
        self.write("spec.json", spec)
        return self.analyze("spec.json", "-o", "results.h5", *arguments)

    def network_safe(self, spec):
        self.results(spec)
        with h5py.File(self.folder / "results.h5") as file:
            return file["network_safe"][...], file["delay"][0]

    def test_text(self):
        self.write("spec.json", crossing(**HARD, resynthesise=True))
        result = self.run_program("analyze", "spec.json")
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        self.assertIn(
            """
network weakly_hard: at most 1 of any 3 steps lost
  mode  connected  safe cells
  11    a+b                20
  10    a|b                11
  01    a+b                21
  Beginning in mode 11, agents with robust re-synthesis stay safe from 20 of 21 cells; beginning in any mode, from 11.
""",
            result.stdout.decode(),
        )

    def test_meanings(self):
        modes = [{"name": "up", "partition": "b+a"}]
        for network, meaning in (
            ({"delay": 1}, "delay: connected after 1 step"),
            ({"burst": {"length": 3, "gap": 2}}, "burst: at most 3 steps lost in a row, at least 2 connected between"),
            ({"modes": modes, "transitions": [["up", "up"]]}, "automaton: 1 mode with given transitions"),
        ):
            with self.subTest(network=network):
                self.write("spec.json", dict(SPEC, network=network))
                result = self.run_program("analyze", "spec.json")
                self.assertIn(f"\nnetwork {meaning}\n", result.stdout.decode())

    def test_json(self):
        summary = self.results(crossing(**HARD, resynthesise=True))
        self.assertEqual(
            summary["network"],
            {
                "kind": "weakly_hard",
                "actions": "independent",
                "resynthesise": True,
                "initial": "11",
                "modes": [
                    {"name": "11", "partition": "a+b", "cells": 20},
                    {"name": "10", "partition": "a|b", "cells": 11},
                    {"name": "01", "partition": "a+b", "cells": 21},
                ],
                "cells_in_every_mode": 11,
            },
        )
        self.assertIn("network", summary["seconds"])
        self.assertEqual(list(summary["work"]["network"]), ["sweeps", "rows_visited", "rows_skipped"])
        self.assertNotIn("network", self.results(SPEC))

    def test_file(self):
        self.results(crossing(**HARD, resynthesise=True))
        with xarray.open_dataset(self.folder / "results.h5", engine="h5netcdf") as data:
            self.assertEqual(data.network_safe.dims, ("mode", "x", "y"))
            self.assertEqual(list(data.mode.values), ["11", "10", "01"])
            self.assertEqual(data.network_safe.dtype, np.uint8)
            self.assertEqual(data.network_safe.sel(mode="10").sum().item(), 11)
            self.assertEqual(list(data.network_safe.attrs["cells"]), [20, 11, 21])
            self.assertEqual(list(data.network_safe.attrs["flag_values"]), [0, 1])
            self.assertEqual(data.network_safe.attrs["flag_meanings"], "not_safe safe")

    def test_a_delay_of_d_steps_leaves_the_cells_that_bear_d(self):
        network_safe, delay = self.network_safe(dict(SPEC, network={"delay": 4}))
        self.assertGreater(len(np.unique(delay)), 3)
        for steps in range(5):
            np.testing.assert_array_equal(network_safe[4 - steps], delay >= steps)

    def test_states_in_another_order_than_the_engine_has(self):
        """The engine puts the longest shifted state last; the file keeps the order of the spec."""
        long = dict(SPEC["states"][0], upper=6)
        spec = dict(CROSSING, states=[long, SPEC["states"][1]], network={"delay": 1})
        network_safe, delay = self.network_safe(spec)
        self.assertEqual(network_safe.shape, (2, 7, 5))
        np.testing.assert_array_equal(network_safe[0], delay >= 1)

    def test_up_and_down_name_partitions(self):
        """With the partitions exchanged nobody is connected once the delay is over."""
        network_safe, delay = self.network_safe(dict(SPEC, network={"delay": 2, "up": "a|b", "down": "a+b"}))
        np.testing.assert_array_equal(network_safe[2], delay == np.iinfo(delay.dtype).max)

    def test_equal_bytes_for_any_number_of_threads(self):
        for resynthesise in (False, True):
            spec = crossing(burst={"length": 1, "gap": 2}, resynthesise=resynthesise)
            self.results(spec, "--threads", "1")
            one = (self.folder / "results.h5").read_bytes()
            self.results(spec, "--threads", "3")
            self.assertEqual((self.folder / "results.h5").read_bytes(), one)

    # agents that follow a rule

    def by_rule(self, rule, **network):
        return crossing(**network, actions="silence") | {"silence": {"actions": rule}}

    def test_a_delay_of_d_steps_leaves_the_cells_whose_silence_by_rule_is_d(self):
        for rule in ({"a": "u <= 0"}, {"a": "u == 1", "b": "v == 0"}, {"b": "v == -1"}):
            summary = self.results(self.by_rule(rule, delay=4))
            self.assertEqual(summary["network"]["actions"], "silence")
            self.assertNotIn("network", [warning["kind"] for warning in summary["warnings"]])
            with h5py.File(self.folder / "results.h5") as file:
                network_safe, silence = file["network_safe"][...], file["silence"][0]
            self.assertGreater(len(np.unique(silence)), 2)
            for steps in range(5):
                np.testing.assert_array_equal(network_safe[4 - steps], silence >= steps)
            code, checks = self.verified()
            self.assertEqual((code, checks["network"]["status"]), (0, "holds"))

    def test_text_where_a_rule_is_followed(self):
        self.write("spec.json", self.by_rule({"a": "u <= 0"}, **HARD))
        result = self.run_program("analyze", "spec.json")
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        text = result.stdout.decode()
        self.assertIn("\n  Beginning in mode 11, agents under the communication-loss rule stay safe from ", text)

    def test_a_rule_that_the_network_leaves_aside_is_named(self):
        self.write("spec.json", crossing(**HARD) | {"silence": {"actions": {"a": "u <= 0"}}})
        result = self.run_program("analyze", "spec.json")
        self.assertEqual(
            (result.returncode, result.stderr),
            (
                0,
                b"coordreq: warning: the safe sets of the network do not use the communication-loss rule; set "
                b'"actions": "silence" if agents follow it in lost steps, else "independent" (/network)\n',
            ),
        )
        chosen = crossing(**HARD, actions="independent") | {"silence": {"actions": {"a": "u <= 0"}}}
        self.write("spec.json", chosen)
        self.assertEqual(self.run_program("analyze", "spec.json", "--force").stderr, b"")

    def test_verify_finds_every_wrong_bit_where_a_rule_is_followed(self):
        self.results(self.by_rule({"a": "u == 1", "b": "v == 0"}, delay=1))
        with h5py.File(self.folder / "results.h5") as file:
            right = file["network_safe"][...]
        self.assertTrue(0 < right[0].sum() < right[1].sum())
        for place in np.ndindex(*right.shape):
            wrong = right.copy()
            wrong[place] ^= 1

            def edit(file, wrong=wrong):
                file["network_safe"][...] = wrong
                file["network_safe"].attrs["cells"] = wrong.sum(axis=(1, 2)).astype(np.uint64)

            self.change(edit)
            code, checks = self.verified()
            self.assertEqual((code, checks["network"]["status"]), (1, "wrong"), place)

    def test_info(self):
        self.results(crossing(**HARD, resynthesise=True))
        result = self.run_program("info", "results.h5")
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        text = result.stdout.decode()
        self.assertIn("\nmode of the network  safe cells\n11                           20\n", text)
        self.assertIn("\n  /mode\n  /network_safe\n", text)
        info = json.loads(self.run_program("info", "results.h5", "--json").stdout)
        self.assertEqual(info["modes"][1], {"name": "10", "cells": 11})

    def test_many_modes_are_cut_short_for_people(self):
        self.results(crossing(delay=20))
        for command in (("analyze", "spec.json", "-o", "results.h5"), ("info", "results.h5")):
            self.assertIn("\n  ... and 9 more modes\n", self.run_program(*command).stdout.decode())

    def test_query(self):
        self.results(crossing(**HARD, resynthesise=True))
        with h5py.File(self.folder / "results.h5") as file:
            safe = file["network_safe"][...]
        x, y = map(int, np.argwhere((safe[0] == 1) & (safe[1] == 0))[0])
        at = ("query", "results.h5", "--at", f"x={x},y={y}")
        self.assertTrue(
            self.run_program(*at).stdout.decode().endswith(
                "\n\nnetwork weakly_hard: at most 1 of any 3 steps lost\n  safe in  2 of 3 modes: 11, 01\n"
            )
        )
        self.assertEqual(json.loads(self.run_program(*at, "--json").stdout)["safe_modes"], ["11", "01"])
        outside = self.run_program("query", "results.h5", "--at", "x=9,y=0", "--json")
        self.assertIsNone(json.loads(outside.stdout)["safe_modes"])
        result = self.run_program("query", "results.h5", stdin=f"x,y\n{x},{y}\n9,9\n".encode())
        header, line, beyond = (row.split(",") for row in result.stdout.decode().splitlines())
        self.assertEqual((header[-1], line[-1], beyond[-1]), ("safe_modes", "11 01", ""))
        self.assertEqual((len(line), len(beyond)), (len(header), len(header)))

    def test_query_of_all_and_none(self):
        self.results(crossing(**HARD))
        text = self.run_program("query", "results.h5", "--at", "x=2,y=2").stdout.decode()
        self.assertTrue(text.endswith("  safe in  no mode\n"))
        self.results(dict(SPEC, network={"delay": 1}))
        text = self.run_program("query", "results.h5", "--at", "x=0,y=0").stdout.decode()
        self.assertTrue(text.endswith("network delay: connected after 1 step\n  safe in  all 2 modes\n"))

    def test_validate(self):
        self.write("spec.json", crossing(**HARD))
        self.assertRegex(self.run_program("validate", "spec.json").stdout.decode(), r"\nmodes of the network +3\n")
        report = json.loads(self.run_program("validate", "spec.json", "--json").stdout)
        self.assertEqual(report["modes"], ["11", "10", "01"])

    def test_memory_of_all_modes_is_refused_up_front(self):
        states = [dict(state, upper=999) for state in SPEC["states"]]
        spec = dict(SPEC, states=states, network={"weakly_hard": {"misses": 2, "window": 91}})
        self.write("spec.json", spec)
        result = self.run_program("analyze", "spec.json", "--max-memory", "300M")
        self.assertEqual((result.returncode, result.stdout), (4, b""))
        # 4,095 sets of 1000 rows of 16 words.
        need = re.search(rb"need about ([0-9.]+) MiB of memory", result.stderr)
        self.assertTrue(500 < float(need.group(1)) < 800, result.stderr)

    def test_errors(self):
        for code, message, network in (
            (3, "the mode 'm' has no successor (/network/modes/1)",
             {"modes": [{"name": "n", "partition": "a|b"}, {"name": "m", "partition": "a|b"}],
              "transitions": [["n", "m"]]}),
            (3, "'modes' and 'up' exclude each other (/network)",
             {"modes": [{"name": "m", "partition": "a|b"}], "transitions": [["m", "m"]], "up": "a+b"}),
            (3, 'the spec has no communication-loss rule, expected the key \'silence\' or "independent" (/network/actions)',
             {"delay": 1, "actions": "silence"}),
            (3, 'expected "independent" or "silence", found \'rule\' (/network/actions)', {"delay": 1, "actions": "rule"}),
            (4, "more than 4096 modes, the most that are possible (/network/weakly_hard)",
             {"weakly_hard": {"misses": 7, "window": 16}}),
        ):  # fmt: skip
            with self.subTest(message=message):
                self.write("spec.json", dict(SPEC, network=network))
                self.assert_fails(code, message, "analyze", "spec.json")

    def test_a_rule_and_robust_resynthesis_exclude_each_other(self):
        self.write("spec.json", self.by_rule({"a": "u <= 0"}, **HARD, resynthesise=True))
        self.assert_fails(
            3,
            'agents with robust re-synthesis follow no rule, expected "independent" (/network/actions)',
            "analyze",
            "spec.json",
        )

    def verified(self):
        result = self.run_program("verify", "results.h5", "--json", "--threads", "1")
        return result.returncode, {check["check"]: check for check in json.loads(result.stdout)["checks"]}

    def change(self, edit):
        with h5py.File(self.folder / "results.h5", "r+") as file:
            edit(file)

    def test_verify(self):
        for network in (HARD, dict(HARD, resynthesise=True), {"delay": 3}):
            self.results(crossing(**network))
            code, checks = self.verified()
            self.assertEqual((code, checks["network"]["status"]), (0, "holds"))
            self.assertEqual(checks["network"]["checked"], 25 * (4 if "delay" in network else 3))

    def test_verify_finds_every_wrong_bit(self):
        self.results(crossing(delay=1))
        with h5py.File(self.folder / "results.h5") as file:
            right = file["network_safe"][...]
        for place in np.ndindex(*right.shape):
            wrong = right.copy()
            wrong[place] ^= 1

            def edit(file, wrong=wrong):
                file["network_safe"][...] = wrong
                file["network_safe"].attrs["cells"] = wrong.sum(axis=(1, 2)).astype(np.uint64)

            self.change(edit)
            code, checks = self.verified()
            self.assertEqual((code, checks["network"]["status"]), (1, "wrong"), place)

    def test_verify_finds_more_than_care_can_keep(self):
        self.results(crossing(**HARD, resynthesise=True))
        self.change(lambda file: file["network_safe"].write_direct(np.ones((3, 5, 5), np.uint8)))
        code, checks = self.verified()
        self.assertEqual((code, checks["network"]["status"], checks["sizes"]["wrong"]), (1, "wrong", 3))
        self.assertIn("x = 2, y = 2, mode 11: safe, but not in K", checks["network"]["examples"][0] + "".join(
            checks["network"]["examples"]))  # fmt: skip

    def test_a_file_that_does_not_fit_its_spec(self):
        self.results(crossing(**HARD))
        self.change(lambda file: file["mode"].__setitem__(0, "00"))
        result = self.run_program("query", "results.h5", "--at", "x=0,y=0")
        self.assertEqual(
            (result.returncode, result.stderr),
            (3, b"coordreq: error: the names are not those of the spec (results.h5:/mode)\n"),
        )


if __name__ == "__main__":
    unittest.main()
