"""The risk of a network that loses steps by chance, from the spec to every command that tells of it."""

import copy
import json
import unittest

import h5py
import numpy as np
from program import CONFIGS, Case, without_comments

# Slack to a brink: both 2 gives one back, both the same leaves it, else it costs one; without slack that is over it.
BRINK = {
    "coordreq": 1,
    "name": "brink",
    "states": [
        {"name": "d", "lower": 0, "upper": 3, "step": 1, "discrete": True,
         "outside": {"below": "unsafe", "above": "saturate"}}
    ],
    "inputs": [{"name": "u1", "values": [0, 1, 2]}, {"name": "u2", "values": [0, 1, 2]}],
    "agents": [{"name": "one", "inputs": ["u1"]}, {"name": "two", "inputs": ["u2"]}],
    "dynamics": {"time": "discrete", "period": 1, "unit": "s",
                 "equations": {"d": "if(u1 == u2, if(u1 == 2, d + 1, d), d - 1)"}},
    "safe": "true",
    "network": {"loss": 0.1},
    "risk": {"horizon": 5},
}


def example(name):
    return json.loads(without_comments((CONFIGS / name).read_text()))


def brink(**changes):
    return dict(copy.deepcopy(BRINK), **changes)


class Cases(Case):
    def results(self, spec, *arguments, code=0):
        self.write("spec.json", spec)
        result = self.run_program("analyze", "spec.json", "-o", "results.h5", "--json", *arguments)
        self.assertEqual(result.returncode, code, result.stderr)
        return json.loads(result.stdout)

    def risks(self):
        with h5py.File(self.folder / "results.h5") as file:
            return file["risk"][...], dict(file["risk"].attrs)

    def test_file(self):
        self.results(brink())
        risk, attributes = self.risks()
        self.assertEqual((risk.dtype, risk.shape), (np.float32, (2, 4)))
        np.testing.assert_allclose(risk[0], [0.3439, 0.3439, 0.271, 0.19], rtol=1e-6)
        self.assertEqual(attributes["horizon"], 5)
        self.assertAlmostEqual(attributes["rate"], 0.081, places=6)

    def test_of_equal_risks_the_cell_that_is_lost_first(self):
        spec = brink(safe="d < 3", network={"loss": 1}, requirements=[{"name": "r", "where": "true", "max_risk": 0.5}])
        spec["states"][0]["outside"] = "unsafe"
        spec["dynamics"]["equations"] = {"d": "if(u1 == u2, d, 3)"}
        (found,) = self.results(spec, code=1)["requirements"]
        self.assertEqual(found["counterexample"]["state"], {"d": 3})
        self.assertEqual(self.run_program("verify", "results.h5", "--strict").returncode, 0)
        for path in ("least_delay", "0/delay"):
            with h5py.File(self.folder / "results.h5", "r+") as file:
                file[f"counterexample/{path}"][0] = 1
            message = f"a delay where a risk is asked for (results.h5:/counterexample/{path})"
            self.assert_fails(3, message, "verify", "results.h5")
            with h5py.File(self.folder / "results.h5", "r+") as file:
                file[f"counterexample/{path}"][0] = 0

    def test_json(self):
        own = self.results(brink())["risk"]
        self.assertEqual((own["horizon"], [mode["name"] for mode in own["modes"]]), (5, ["up", "down"]))
        self.assertAlmostEqual(own["modes"][0]["worst"], 0.3439, places=6)
        self.assertAlmostEqual(own["modes"][0]["mean"], (2 * 0.3439 + 0.271 + 0.19) / 4, places=6)
        self.assertEqual(own["modes"][0]["within"], [0] * 13)

    def test_nothing_without_the_key(self):
        spec = brink()
        del spec["risk"]
        self.assertNotIn("risk", self.results(spec))
        with h5py.File(self.folder / "results.h5") as file:
            self.assertNotIn("risk", file)

    def test_empty_set(self):
        own = self.results(brink(safe="false"))["risk"]["modes"][0]
        self.assertEqual((own["worst"], own["mean"], own["within"]), (None, None, [0] * 13))

    def test_text(self):
        self.write("spec.json", brink(risk={"horizon": 5, "coordinated": "safest"}))
        text = self.run_program("analyze", "spec.json").stdout.decode()
        self.assertIn("\nnetwork loss: a step is lost with probability 0.1, 0.1 after a lost one\n", text)
        self.assertIn("\nrisk within 5 steps (5 s): connected agents choose the safest action\n", text)
        self.assertRegex(text, r"\n  up +0\.0119 +0\.0032[56] +0 +0 +0 +0 +3\n")
        self.assertIn("\n  With the network first in mode up: worst 0.0119, mean 0.00326.\n"
                      "  Beyond the horizon the risk grows by at most 0.00162 per step, 0.00162 per s.\n", text)

    def test_start_that_is_drawn(self):
        """The first step is lost as any other."""
        drawn = {"horizon": 5, "start": "drawn"}
        near = {"name": "near", "where": "0 <= d <= 1", "max_risk": 0.35}
        self.assertTrue(self.results(brink(requirements=[near]))["requirements"][0]["holds"])
        summary = self.results(brink(risk=drawn, requirements=[near]), code=1)
        risk, _ = self.risks()
        expected = 0.9 * risk[0].astype(float) + 0.1 * risk[1].astype(float)
        with h5py.File(self.folder / "results.h5") as file:
            stored = file["risk_drawn"][...]
        self.assertEqual((stored.dtype, stored.shape), (np.float32, (1, 4)))
        np.testing.assert_allclose(stored[0], expected, rtol=1e-6)
        self.assertTrue((stored[0] >= expected * (1 - 1e-15)).all())
        self.assertEqual(summary["risk"]["start"]["name"], "drawn")
        self.assertEqual(summary["risk"]["start"]["worst"], float(stored.max()))
        self.assertEqual(summary["requirements"][0]["greatest_risk"], float(stored[0, :2].max()))
        text = self.run_program("analyze", "spec.json").stdout.decode()
        self.assertIn("\n  With the mode of the first step drawn: worst 0.41, mean 0.304.\n", text)
        found = json.loads(self.run_program("query", "results.h5", "--at", "d=2", "--json").stdout)
        self.assertEqual(found["risk_drawn"], {"drawn": float(stored[0, 2])})
        verified = self.run_program("verify", "results.h5", "--full")
        self.assertEqual(verified.returncode, 0, verified.stdout)
        with h5py.File(self.folder / "results.h5", "r+") as file:
            file["risk_drawn"][0, 2] *= 0.999
        verified = self.run_program("verify", "results.h5")
        self.assertEqual(verified.returncode, 1, verified.stdout)
        self.assertIn(b"where the first step is drawn, expected", verified.stdout)

    def test_start_in_a_mode(self):
        down = {"horizon": 5, "start": "down"}
        limit = {"name": "far", "where": "d == 0", "max_risk": 0.35}
        self.assertTrue(self.results(brink(requirements=[limit]))["requirements"][0]["holds"])
        summary = self.results(brink(risk=down, requirements=[limit]), code=1)
        risk, _ = self.risks()
        self.assertEqual(summary["requirements"][0]["greatest_risk"], float(risk[1, 0]))
        self.assertEqual(summary["risk"]["start"], summary["risk"]["modes"][1])
        simulated = json.loads(self.run_program("simulate", "results.h5", "--lossy", "--from", "d=0", "--steps", "5",
                                                "--runs", "2", "--json").stdout)
        self.assertEqual(simulated["risk"], float(risk[1, 0]))

    def test_retransmission(self):
        """The bounded retransmission protocol: 16 chunks, each sent at most three times; a transmission and its
        acknowledgement are lost with 0.02 and 0.01. Then the chance of failure is 1 - (1 - p^3)^16."""
        p = 1 - 0.98 * 0.99
        spec = brink(
            name="brp", constants={"N": 16, "MAX": 2}, safe="true",
            states=[{"name": "chunk", "lower": 1, "upper": "N + 1", "step": 1, "discrete": True, "outside": "unsafe"},
                    {"name": "tries", "lower": 0, "upper": "MAX", "step": 1, "discrete": True, "outside": "unsafe"}],
            inputs=[{"name": "u", "values": [0, 1]}, {"name": "v", "values": [0, 1]}],
            agents=[{"name": "sender", "inputs": ["u"]}, {"name": "receiver", "inputs": ["v"]}],
            dynamics={"time": "discrete", "period": 1,
                      "equations": {"chunk": "if(u == v, min(chunk + 1, N + 1), chunk)",
                                    "tries": "if(chunk > N or u == v, 0, tries + 1)"}},
            network={"loss": "1 - 0.98*0.99"},
            risk={"horizon": 48, "coordinated": "safest", "start": "drawn"},
            requirements=[{"name": "start", "where": "chunk == 1 and tries == 0", "max_risk": 4.24e-4}])
        found = self.results(spec)["requirements"][0]
        self.assertAlmostEqual(found["greatest_risk"], 1 - (1 - p**3) ** 16, delta=1e-9)

    def test_unknown_start(self):
        self.write("spec.json", brink(risk={"horizon": 5, "start": "lost"}))
        self.assert_fails(3, "expected 'connected', 'drawn' or a mode of the network ('up', 'down'), found 'lost' "
                             "(/risk/start)", "analyze", "spec.json")

    def test_requirements(self):
        near = {"name": "near", "where": "0 <= d <= 1"}
        for limit, per, safest, holds in (
            (0.34391, None, False, True),
            (0.3438, None, False, False),
            (0.0119, None, True, False),  # 5 times the rate more
            (0.02, None, True, True),
            (1, "min", True, True),
            (0.05, "min", True, False),
        ):
            own = dict(near, max_risk=limit, **({"per": per} if per else {}))
            risk = {"horizon": 5, "coordinated": "safest" if safest else "any"}
            summary = self.results(brink(risk=risk, requirements=[own]), code=0 if holds else 1)
            found = summary["requirements"][0]
            self.assertEqual((found["holds"], found["kind"], found["max_risk"]), (holds, "max_risk", limit))
            rate = summary["risk"]["rate"]
            steps = 60 if per else 5 if safest else 0
            expected = min(1, summary["risk"]["modes"][0]["worst"] + steps * rate)
            self.assertAlmostEqual(found["greatest_risk"], expected)
            if not holds:
                self.assertEqual(found["counterexample"]["state"], {"d": 0})
                self.assertEqual((found["counterexample"]["steps"], found["counterexample"]["end"]), ([], "too_risky"))
            info = json.loads(self.run_program("info", "results.h5", "--json").stdout)
            self.assertEqual(info["requirements"][0]["greatest_risk"], found["greatest_risk"])
            verified = self.run_program("verify", "results.h5", "--full")
            self.assertEqual(verified.returncode, 0, verified.stdout)

    def test_requirement_text(self):
        own = {"name": "near", "where": "0 <= d <= 1", "max_risk": 1e-3, "per": "h"}
        self.write("spec.json", brink(requirements=[own]))
        text = self.run_program("analyze", "spec.json").stdout.decode()
        self.assertIn("\nrequirement near: risk at most 0.001 per h\n  FAILS: 2 of 2 cells fail, the worst at d = 0: it has a risk of 1.\n", text)

    def test_per_needs_a_unit_of_time(self):
        spec = brink(requirements=[{"name": "r", "where": "0 <= d <= 1", "max_risk": 0.5, "per": "h"}])
        del spec["dynamics"]["unit"]
        self.write("spec.json", spec)
        self.assert_fails(3, "'per' needs a unit of time under 'dynamics', found none (/requirements/0/per)",
                          "analyze", "spec.json")

    def test_query(self):
        self.results(brink())
        found = json.loads(self.run_program("query", "results.h5", "--at", "d=2", "--json").stdout)
        self.assertAlmostEqual(found["risk"]["up"], 0.271, places=6)
        text = self.run_program("query", "results.h5", "--at", "d=2").stdout.decode()
        self.assertIn("probability to leave the invariance set within 5 steps", text)

    def test_csv(self):
        self.results(brink())
        self.run_program("export", "results.h5", "--format", "csv", "-o", "table.csv")
        table = (self.folder / "table.csv").read_text().splitlines()
        self.assertIn("risk:up", table[0].split(","))

    def test_compare(self):
        self.results(brink())
        (self.folder / "results.h5").rename(self.folder / "before.h5")
        self.results(brink(network={"loss": 0.2}))
        result = self.run_program("compare", "before.h5", "results.h5")
        self.assertEqual(result.returncode, 1)
        self.assertIn("lost risk", result.stdout.decode())

    def test_equal_bytes_for_any_number_of_threads(self):
        spec = example("crossing_risk.json")
        spec["risk"] = {"horizon": 12}
        spec["requirements"] = []
        self.results(spec, "--threads", "1")
        one = (self.folder / "results.h5").read_bytes()
        self.results(spec, "--threads", "3")
        self.assertEqual((self.folder / "results.h5").read_bytes(), one)

    def test_figures_of_the_crossing(self):
        """Shares of K with a risk of at most 1e-9, 1e-6, 1e-4, 1e-2."""
        for loss, steps, shares in ((0.1, 60, [0.152, 0.328, 0.556, 0.734]), (0.01, 25, [0.593, 0.679, 0.735, 0.933])):
            spec = example("crossing.json")
            spec["network"] = {"loss": loss}
            spec["risk"] = {"horizon": steps, "coordinated": "safest"}
            summary = self.results(spec)
            within = summary["risk"]["modes"][0]["within"]
            found = [round(within[i] / summary["invariant"], 3) for i in (4, 7, 9, 11)]
            self.assertEqual(found, shares)

    def test_checkpoint(self):
        self.results(brink())
        whole = (self.folder / "results.h5").read_bytes()
        for _ in range(2):
            self.results(brink(), "--checkpoint", "state")
            self.assertEqual((self.folder / "results.h5").read_bytes(), whole)

    def test_simulation_leaves_as_often_as_is_to_be_expected(self):
        self.results(brink(risk={"horizon": 5, "coordinated": "safest"}))
        result = self.run_program(
            "simulate", "results.h5", "--from", "d=0", "--steps", "5", "--runs", "4000", "--lossy",
            "--policy", "adversarial", "--json",
        )
        self.assertEqual(result.returncode, 0, result.stderr)
        found = json.loads(result.stdout)
        self.assertEqual((found["network"], found["partition"]), ("loss", None))
        plain = self.run_program("simulate", "results.h5", "--from", "d=0", "--steps", "5", "--json")
        self.assertNotIn("network", json.loads(plain.stdout))
        left = found["outcomes"]["left_invariant"] / 4000
        self.assertLess(left, found["risk"] + 0.01)
        self.assertGreater(left, 0.002)

    def test_simulation_needs_numbers(self):
        spec = brink(network={"delay": 1})
        del spec["risk"]
        self.results(spec)
        self.assert_fails(2, "the spec has no network with probabilities (--lossy)",
                          "simulate", "results.h5", "--from", "d=0", "--steps", "5", "--lossy")

    def changed(self, change):
        with h5py.File(self.folder / "results.h5", "r+") as file:
            change(file["risk"])

    def test_verify_finds_a_risk_that_is_too_low(self):
        self.results(brink())
        self.assertEqual(self.run_program("verify", "results.h5").returncode, 0)

        def lower(risk):
            risk[0, 3] = 0.05

        self.changed(lower)
        result = self.run_program("verify", "results.h5")
        self.assertEqual(result.returncode, 1)
        self.assertIn("one more step gives", result.stdout.decode())

    def test_verify_finds_a_rate_that_is_too_low(self):
        self.results(brink())
        with h5py.File(self.folder / "results.h5", "r+") as file:
            file["risk"].attrs["rate"] = 0.07
        self.assertEqual(self.run_program("verify", "results.h5").returncode, 1)

    def test_verify_in_full_finds_another_horizon(self):
        self.results(brink(risk={"horizon": 4}))
        lower, attributes = self.risks()
        self.results(brink())
        with h5py.File(self.folder / "results.h5", "r+") as file:
            file["risk"][...] = lower
            file["risk"].attrs["rate"] = attributes["rate"]
        self.assertEqual(self.run_program("verify", "results.h5").returncode, 0)
        result = self.run_program("verify", "results.h5", "--full")
        self.assertEqual(result.returncode, 1)
        self.assertIn("risk within the horizon", result.stdout.decode())


if __name__ == "__main__":
    unittest.main()
