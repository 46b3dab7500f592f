"""verify finds what a program with a fault would have written: results of one spec under the name of another."""

import json
import unittest

import h5py
from program import Case, spec_with


def chain(below, **changes):
    """A place that a speed moves, which is held at its limits; nobody can change it."""
    return dict({
        "coordreq": 1,
        "name": "chain",
        "states": [
            {"name": "x", "lower": 0, "upper": 3, "step": 0.1, "outside": {"below": "unsafe", "above": "safe"}},
            {"name": "v", "lower": 0, "upper": 3, "step": 1, "outside": {"below": below, "above": "stop"}},
        ],
        "inputs": [{"name": "u", "values": [0]}],
        "agents": [{"name": "a", "inputs": ["u"]}],
        "dynamics": {"time": "continuous", "period": 1, "equations": {"x": "v", "v": "u"}},
        "safe": "true",
        "abstraction": {"safe": "center", "cells": "half_open"},
        "output": {"abstraction": True},
    }, **changes)  # fmt: skip


def measured(error):
    """A place that is measured with an error, moved by what is no exact hull."""
    return {
        "coordreq": 1,
        "name": "measured",
        "states": [
            {"name": "x", "lower": 0, "upper": 20, "step": 1, "outside": "unsafe", "measurement_error": error},
            {"name": "h", "lower": 0, "upper": 3, "step": 1, "outside": "saturate"},
        ],
        "inputs": [{"name": "u", "values": [-1, 0, 1]}, {"name": "v", "values": [-1, 0, 1]}],
        "agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
        "dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x + 0.35*sin(h) + 3*u", "h": "h + v"}},
        "safe": "true",
        "output": {"abstraction": True},
    }


class Cases(Case):
    def results(self, spec, name="results"):
        self.write(name + ".json", spec)
        result = self.run_program("analyze", name + ".json", "-o", name + ".h5", "--quiet")
        self.assertEqual(result.returncode, 0, result.stderr.decode())
        return self.folder / (name + ".h5")

    def verified(self, path):
        result = self.run_program("verify", str(path), "--json")
        return result.returncode, json.loads(result.stdout)

    def under_another_spec(self, found, asked):
        """The numbers of one analysis under the spec of the other."""
        path = self.results(found, "found")
        other = self.results(asked, "asked")
        with h5py.File(path, "r+") as file, h5py.File(other) as source:
            for name in ("spec", "spec_json"):
                file[name][()] = source[name][()]
            for name in ("spec_sha256", "guarantee"):
                file.attrs.modify(name, source.attrs[name])
        return path

    def assert_wrong(self, path, check):
        code, summary = self.verified(path)
        self.assertEqual(code, 1)
        found = {one["check"]: one["status"] for one in summary["checks"]}
        self.assertEqual(found["attributes"], "holds")
        self.assertEqual(found[check], "wrong", found)

    def test_a_measurement_error_that_counts_once_is_found(self):
        """Half the error counts twice as much as all of it does once."""
        self.assert_wrong(self.under_another_spec(measured(0.2), measured(0.4)), "abstraction x")

    def test_a_cell_at_a_limit_that_counts_as_a_whole_one_is_found(self):
        self.assert_wrong(self.under_another_spec(chain("saturate"), chain("stop")), "abstraction x")

    def test_limits_of_integrators_have_exact_posts_of_both_sides(self):
        code, summary = self.verified(self.results(chain("stop")))
        self.assertEqual((code, summary["verdict"], summary["reachable_sets"]), (0, "holds", "exact"))
        self.assertEqual(summary["not_independent"], [])

    def test_braking_to_a_stop_within_a_cell_is_exact(self):
        """At rest it stays at rest, and 2 m/s are gone after half a second of -4 m/s^2: no cell more at the face."""
        spec = chain(
            "stop",
            states=[{"name": "v", "lower": 0, "upper": 20, "step": 2, "outside": "stop"}],
            inputs=[{"name": "a", "values": [-4, 0]}],
            agents=[{"name": "one", "inputs": ["a"]}],
            dynamics={"time": "continuous", "period": 0.5, "equations": {"v": "a"}},
            abstraction={"cells": "half_open"},
        )
        path = self.results(spec)
        with h5py.File(path) as file:
            last = file["abstraction/v/last"][:, :]
        self.assertEqual((last[0].tolist(), last[1].tolist()), ([0, 0], [0, 1]))
        code, summary = self.verified(path)
        self.assertEqual((code, summary["verdict"], summary["reachable_sets"]), (0, "holds", "exact"))

    def test_drag_with_a_limit_has_enclosures_of_its_own(self):
        spec = chain(
            "stop",
            inputs=[{"name": "u", "values": [-1, 0, 1]}],
            dynamics={"time": "continuous", "period": 0.5, "equations": {"x": "v", "v": "u - 0.3*v*v"}},
        )
        code, summary = self.verified(self.results(spec))
        self.assertEqual((code, summary["not_independent"]), (0, []))
        self.assertGreater(summary["confirmed"]["reachable_sets"], 0.9 * summary["confirmed"]["of"])

    def test_a_reachable_state_beside_a_limit_that_is_left_out_is_not_confirmed(self):
        spec = chain(
            "stop",
            inputs=[{"name": "u", "values": [-1, 0, 1]}],
            dynamics={"time": "continuous", "period": 0.5, "equations": {"x": "v", "v": "u - 0.3*v*v"}},
        )
        path = self.results(spec)
        with h5py.File(path, "r+") as file:
            self.assertEqual(file["abstraction/v/last"][0, 2], 1)  # from rest with u = 1
            file["abstraction/v/last"][0, 2] = 0
        _, summary = self.verified(path)
        self.assertNotEqual(summary["verdict"], "holds")

    def test_what_may_pass_a_seam_that_jumps_is_confirmed(self):
        """A periodic state that an equation uses as a number: beyond its seam another formula holds."""
        spec = chain(
            "stop",
            states=[
                {"name": "x", "lower": 0, "upper": 4, "count": 8, "outside": "periodic"},
                {"name": "v", "lower": -2, "upper": 2, "step": 0.5, "outside": "saturate"},
            ],
            dynamics={"time": "continuous", "period": 0.2, "equations": {"x": "v", "v": "u - 0.1*x"}},
        )
        code, summary = self.verified(self.results(spec))
        self.assertEqual((code, summary["verdict"]), (0, "holds"))
        confirmed = summary["confirmed"]
        self.assertEqual(confirmed["reachable_sets"], confirmed["of"])

    def test_a_truncation_that_the_delays_do_not_show_is_found(self):
        """F unknown, with layers that go on as those of an iteration that was stopped would."""
        spec = spec_with(
            states=[{"name": "x", "lower": -10, "upper": 10, "step": 1, "outside": "unsafe"}],
            dynamics={"time": "discrete", "period": 1, "equations": {"x": "x + u + v"}},
            safe="true",
            coordination={"max_delay": 15},
        )
        path = self.results(spec)
        with h5py.File(path, "r+") as file:
            self.assertEqual(file["fixed_point_index"][0], 6)
            self.assertEqual(file["layer_size"][0].tolist(), [21, 17, 13, 9, 5, 1, 0])
            file["fixed_point_index"][0] = -1
            file["layer_size"][0, 6] = 1
        self.assert_wrong(path, "layers a|b")

    def test_a_pair_that_is_critical_in_the_wrong_cell_is_found_of_every_pair(self):
        spec = spec_with(
            inputs=[{"name": n, "values": [-1, 0, 1]} for n in "uvw"],
            agents=[{"name": n, "inputs": [i]} for n, i in zip("abc", "uvw")],
            dynamics={"time": "discrete", "period": 1, "equations": {"x": "x + u + w", "y": "y + v - w"}},
            coordination={"partitions": "all", "horizon": 1},
        )
        original = self.results(spec).read_bytes()
        with h5py.File(self.folder / "results.h5") as file:
            pairs = file["critical_pair"][()]
        self.assertEqual(len(pairs), 3)
        for pair in range(3):
            flat = pairs[pair].reshape(-1)
            self.assertTrue(flat.any() and not flat.all())
            copy = self.folder / "copy.h5"
            copy.write_bytes(original)
            with h5py.File(copy, "r+") as file:
                changed = flat.copy()
                changed[[flat.argmax(), flat.argmin()]] = changed[[flat.argmin(), flat.argmax()]]
                file["critical_pair"][pair, ...] = changed.reshape(pairs[pair].shape)
            self.assert_wrong(copy, "critical pairs")


if __name__ == "__main__":
    unittest.main()
