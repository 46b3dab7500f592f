"""What analyze prints and writes."""

import json
import os
import re
import subprocess
import unittest

from program import CONFIGS, PROGRAM, ROOT, SPEC, Case, spec_with, without_warnings

CIRCLE = str(CONFIGS / "circle.json")
GOLDEN = json.loads((ROOT / "tests/cli/circle_golden.json").read_text())


class Cases(Case):
    def check_circle(self, cells, safe):
        """The tables come from a brute-force computation in whole numbers, independent of this program."""
        text = (CONFIGS / "circle.json").read_text()
        modes = f'"cells": "{cells}", "safe": "{safe}"'
        summary = self.analyze("-", stdin=text.replace('"cells": "closed", "safe": "center"', modes).encode())
        partition = summary["partitions"][0]
        found = {key: summary[key] for key in ("safe", "invariant", "iterations")}
        found.update({key: partition[key] for key in ("F", "layers")})
        self.assertEqual(found, GOLDEN[f"{cells} {safe}"])
        self.assertEqual(summary["guarantee"], {"center": "samples-center", "inner": "samples"}[safe])
        self.assertEqual(partition["fixed_point"], 0)
        self.assertEqual(partition["max_delay_time"], (partition["F"] - 1) / 100)

    def test_circle_closed_center(self):
        self.check_circle("closed", "center")

    def test_circle_closed_inner(self):
        self.check_circle("closed", "inner")

    def test_circle_half_open_center(self):
        self.check_circle("half_open", "center")

    def test_circle_half_open_inner(self):
        self.check_circle("half_open", "inner")

    def test_circle_text(self):
        result = self.run_program("analyze", CIRCLE, "--threads", "2")
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        self.assertRegex(
            result.stdout.decode(),
            r"""^circle: 201 x 201 = 40,401 cells, 41 x 41 = 1,681 joint inputs
safe set        20,081 cells
invariance set  20,077 cells after 2 sweeps
guarantee       samples-center: checked every 0\.01 s only, where the centre of a cell is safe; between, x1 moves up to 0\.01 m

partition horizontal\|vertical
  layers                  20,077 19,421 17,869 16,717 15,533 14,317 \.\.\. 61 5 0
  fixed point             F = 29
  unbounded delay         0 cells
  half of K can tolerate  at least 8 steps \(0\.08 s\)
  90 % of K can tolerate  at least 1 step \(0\.01 s\)
  99 % of K can tolerate  not one step
  From the best state \(x1 = -0\.01, x2 = 0\), 28 steps \(0\.28 s\) without coordination are safe\.

results in circle\.h5 \([0-9.]+ s on 2 threads, [0-9.]+ MiB\)
$""",
        )
        self.assertEqual(self.files(), ["circle.h5"])

    def test_between_samples(self):
        """A vehicle of 4 m/s, sampled each second, gets past an obstacle of 2 m at the samples only."""
        vehicle = {
            "states": [
                {"name": "x", "lower": 0, "upper": 9, "step": 1, "outside": {"above": "safe"}},
            ],
            "inputs": [{"name": "u", "values": [4]}],
            "agents": [{"name": "a", "inputs": ["u"]}],
            "dynamics": {"time": "continuous", "period": 1, "equations": {"x": "u"}},
            "safe": "x <= 3.5 or x >= 5.5",
        }
        for between, cells, guarantee in ((False, 6, "samples"), (True, 4, "continuous")):
            abstraction = {"cells": "half_open", "between_samples": between}
            self.write("spec.json", spec_with(**vehicle, abstraction=abstraction))
            summary = self.analyze("spec.json")
            self.assertEqual((summary["invariant"], summary["guarantee"]), (cells, guarantee))
            info = json.loads(self.run_program("info", "small.h5", "--json").stdout)
            self.assertEqual(info["guarantee"], guarantee)
            validated = json.loads(self.run_program("validate", "spec.json", "--json").stdout)
            self.assertEqual(validated["guarantee"], guarantee)
        text = self.run_program("analyze", "spec.json").stdout.decode()
        self.assertIn("guarantee       continuous: at all times, for every point of a cell\n", text)
        abstraction["safe"] = "center"
        self.write("spec.json", spec_with(**vehicle, abstraction=abstraction))
        summary = self.analyze("spec.json")
        self.assertEqual((summary["invariant"], summary["guarantee"]), (4, "samples-center"))

    def test_best_states_at_the_edge_of_the_grid(self):
        """Who runs from a wall tolerates the more the farther away it is, as far as the grid goes."""
        spec = spec_with(
            states=[{"name": "x", "lower": 0, "upper": 9, "step": 1, "unit": "m", "outside": "saturate"}],
            dynamics=dict(SPEC["dynamics"], equations={"x": "x + u + v"}),
            safe="x >= 1",
        )
        self.write("spec.json", spec)
        (partition,) = self.analyze("spec.json")["partitions"]
        self.assertEqual(partition["best_at_edges"], [{"state": "x", "value": 9}])
        hint = "\n  All best states lie at the edge of the grid (x = 9): a larger domain may tolerate more.\n"
        self.assertIn(hint, self.run_program("analyze", "spec.json").stdout.decode())
        for changes in ({"outside": {"below": "saturate", "above": "safe"}}, {"discrete": True}):
            spec["states"][0].update(changes)
            self.write("spec.json", spec)
            self.assertEqual(self.analyze("spec.json")["partitions"][0]["best_at_edges"], [])
        self.assertEqual(self.analyze(str(CONFIGS / "circle.json"))["partitions"][0]["best_at_edges"], [])

    def test_silence_for_ever_because_runs_leave_through_a_safe_side(self):
        """A lane with a wall that nobody passes: before it all stay, behind it who goes on leaves."""
        lane = {
            "states": [{"name": "n", "lower": 0, "upper": 5, "step": 1, "discrete": True, "outside": {"above": "safe"}}],
            "inputs": [{"name": name, "values": [0, 1]} for name in "uv"],
            "dynamics": {"time": "discrete", "period": 1, "equations": {"n": "if(n <= 2, min(n + u + v, 2), n + u + v)"}},
            "safe": "true",
        }

        def partition(**changes):
            self.write("spec.json", spec_with(**{**lane, **changes}))
            (own,) = self.analyze("spec.json")["partitions"]
            return own["fixed_point"], own["leaving"]

        def line():
            return re.search("(?m)^  unbounded delay  +(.*)$", self.run_program("analyze", "spec.json").stdout.decode())[1]

        self.assertEqual(partition(), (6, 3))
        self.assertEqual(line(), "6 cells, of these 3 because they leave through a safe side")
        # Whoever goes on behind the wall is noticed, unless it leaves at once: only 5 leaves, by u = 1 or v = 1.
        noticed = {"name": "m", "lower": 0, "upper": 1, "step": 1, "discrete": True, "outside": "unsafe"}
        equations = {"n": "if(n <= 2, n, n + u)", "m": "if(n >= 3, u, 0)"}
        states = [*lane["states"], noticed]
        changes = {"states": states, "dynamics": dict(lane["dynamics"], equations=equations), "safe": "m == 0"}
        changes["inputs"] = [{"name": "u", "values": [0, 1]}, {"name": "v", "values": [0]}]
        self.assertEqual(partition(**changes), (6, 1))
        everywhere = dict(lane["dynamics"], equations={"n": "n + u + v"})
        self.assertEqual(partition(dynamics=everywhere), (6, 6))
        self.assertEqual(line(), "6 cells, because they leave through a safe side")
        self.assertEqual(partition(inputs=[{"name": name, "values": [0]} for name in "uv"]), (6, 0))
        self.assertEqual(line(), "6 cells, of these 0 because they leave through a safe side")
        # Nobody is ever silent; no side is safe.
        whole = {"partitions": [{"name": "both", "classes": [["a", "b"]]}]}
        self.assertEqual(partition(coordination=whole), (6, None))
        self.assertEqual(partition(states=[dict(lane["states"][0], outside={"above": "saturate"})]), (6, None))
        self.assertEqual(line(), "6 cells")

    def test_lane_change(self):
        summary = self.analyze(str(CONFIGS / "lane_change.json"))
        self.assertEqual((summary["cells"], summary["joint_inputs"]), (28, 4))
        self.assertEqual((summary["states"], summary["inputs"]), (28, 4))  # their older names
        self.assertEqual((summary["safe"], summary["invariant"], summary["iterations"]), (26, 26, 1))
        self.assertEqual(summary["partitions"][0]["layers"], [26, 20, 16, 12, 8, 4, 0])
        self.assertEqual(summary["partitions"][0]["F"], 6)
        self.assertEqual(summary["partitions"][0]["max_delay_time"], 5)

    def test_json_document(self):
        self.write("spec.json", SPEC)
        summary = self.analyze("spec.json", "-o", "out.h5", "--threads", "1")
        self.assertEqual(
            list(summary),
            [
                "name",
                "cells",
                "joint_inputs",
                "states",
                "inputs",
                "safe",
                "invariant",
                "iterations",
                "guarantee",
                "period",
                "period_unit",
                "connection_delay",
                "partitions",
                "coalition",
                "requirements",
                "tightness",
                "motion",
                "output",
                "threads",
                "seconds",
                "peak_memory_bytes",
                "work",
                "warnings",
            ],
        )
        self.assertEqual(
            list(summary["partitions"][0]),
            ["name", "classes", "F", "fixed_point", "leaving", "layers", "truncated", "never_without_connection", "max_delay_time", "best_state", "best_at_edges"],
        )
        self.assertEqual((summary["name"], summary["output"]), ("small", "out.h5"))
        self.assertEqual((summary["period"], summary["period_unit"]), (0.5, "s"))
        self.assertEqual((summary["requirements"], summary["tightness"], summary["threads"]), ([], None, 1))
        self.assertEqual(
            list(summary["seconds"]), ["abstraction", "safe set", "invariance", "layers a|b", "writing"]
        )
        self.assertTrue(all(seconds >= 0 for seconds in summary["seconds"].values()))
        self.assertEqual(list(summary["work"]), ["invariance", "layers a|b", "helpers"])
        self.assertEqual(list(summary["work"]["helpers"]), ["motion", "unseen motion"])
        for name in ("invariance", "layers a|b"):
            work = summary["work"][name]
            self.assertEqual(list(work), ["sweeps", "rows_visited", "rows_skipped"])
            self.assertGreater(work["rows_visited"], 0)
        self.assertGreater(summary["peak_memory_bytes"], 2**20)

    def test_threads_are_those_that_the_process_may_use(self):
        self.write("spec.json", spec_with())
        one = min(os.sched_getaffinity(0))
        command = ["taskset", "--cpu-list", str(one), PROGRAM, "analyze", "spec.json", "--json", "--quiet"]
        done = subprocess.run(command, cwd=self.folder, capture_output=True, check=True)
        self.assertEqual(json.loads(done.stdout)["threads"], 1)

    def test_max_delay_truncates(self):
        self.write(
            "spec.json",
            (CONFIGS / "circle.json")
            .read_text()
            .replace('"safe": "r2 <= R^2",', '"safe": "r2 <= R^2", "coordination": {"max_delay": 3},'),
        )
        partition = self.analyze("spec.json")["partitions"][0]
        self.assertEqual(partition["layers"], [20077, 19421, 17869, 16717])
        self.assertEqual(
            (partition["F"], partition["fixed_point"], partition["truncated"]), (None, None, True)
        )
        text = self.run_program("analyze", "spec.json").stdout.decode()
        self.assertRegex(text, r"  fixed point +not reached\n  unbounded delay +unknown\n")
        self.assertIn(
            "  Stopped at max_delay: 16,717 cells allow 3 steps (0.03 s) without coordination, "
            "perhaps more.\n",
            text,
        )

    def test_nothing_to_coordinate(self):
        self.write("spec.json", spec_with(safe="x <= 9"))
        text = self.run_program("analyze", "spec.json").stdout.decode()
        summary = self.analyze("spec.json")
        self.assertEqual(summary["partitions"][0]["layers"], [25])
        self.assertEqual((summary["partitions"][0]["F"], summary["partitions"][0]["fixed_point"]), (0, 25))
        self.assertIsNone(summary["partitions"][0]["max_delay_time"])
        self.assertIn("  The agents never need to coordinate: every delay is unbounded.\n", text)

    def test_some_delays_are_unbounded(self):
        # Only at x = 1 must the two agree (not both may push); at x = 3 nobody can move anything.
        self.write(
            "spec.json",
            spec_with(
                states=[{"name": "x", "lower": 0, "upper": 3, "step": 1, "discrete": True}],
                inputs=[{"name": "u", "values": [0, 1]}, {"name": "v", "values": [0, 1]}],
                dynamics={
                    "time": "discrete",
                    "period": 1,
                    "equations": {"x": "if(x == 1, if(u + v == 1, 1, 2), x)"},
                },
                safe="x != 2",
                abstraction={},
            ),
        )
        summary = self.analyze("spec.json")
        self.assertEqual(summary["partitions"][0]["layers"], [3, 2])
        text = self.run_program("analyze", "spec.json").stdout.decode()
        self.assertIn(
            "  From 2 cells (e.g. x = 0) the agents never need to coordinate; from the others not even one step without "
            "coordination is safe.\n",
            text,
        )

    def test_classes_of_several_agents_are_told_apart(self):
        agent = {name: {"name": name, "inputs": ["u" + name]} for name in "abc"}
        spec = spec_with(
            states=[{"name": name, "lower": 0, "upper": 7, "step": 1} for name in "xyz"],
            inputs=[{"name": "u" + name, "values": [-1, 0, 1]} for name in "abc"],
            agents=list(agent.values()),
            dynamics={"time": "discrete", "period": 1, "equations": {"x": "x + ua", "y": "y + ub", "z": "z + uc"}},
            safe="5 <= x + y + z <= 15",
            coordination={
                "partitions": [
                    {"name": "alone", "classes": []},
                    {"name": "pair", "classes": [["b", "a"]]},
                    {"name": "mesh", "classes": [["a", "b", "c"]]},
                ]
            },
        )
        self.write("spec.json", spec)
        sections = self.run_program("analyze", "spec.json").stdout.decode().split("\npartition ")
        self.assertRegex(sections[1], r"  From the best state \([^)]*\), \d steps without coordination are safe\.\n")
        self.assertRegex(
            sections[2], r"  From the best state \([^)]*\), \d steps without coordination between classes are safe\.\n"
        )
        self.assertIn("  All agents coordinate within every step, so every delay is unbounded.\n", sections[3])
        spec["safe"] = "z <= 5"
        self.write("spec.json", spec)
        sections = self.run_program("analyze", "spec.json").stdout.decode().split("\npartition ")
        self.assertIn("  The agents never need to coordinate: every delay is unbounded.\n", sections[1])
        self.assertIn("  The classes never need to coordinate: every delay is unbounded.\n", sections[2])

    def test_empty_safe_set_is_a_result(self):
        self.write("spec.json", spec_with(safe="x > 100"))
        result = self.run_program("analyze", "spec.json")
        self.assertEqual((result.returncode, without_warnings(result.stderr)), (0, b""))
        self.assertIn('\nThe safe set is empty: no cell satisfies "safe".\n', result.stdout.decode())
        summary = self.analyze("spec.json")
        self.assertEqual((summary["safe"], summary["invariant"]), (0, 0))
        self.assertEqual(summary["partitions"][0]["layers"], [0])
        self.assertEqual(self.files(), ["small.h5", "spec.json"])

    def test_empty_invariance_set_is_a_result(self):
        self.write(
            "spec.json",
            spec_with(
                dynamics={"time": "discrete", "period": 1, "equations": {"x": "x + 1 + 0*u", "y": "y + 0*v"}}
            ),
        )
        result = self.run_program("analyze", "spec.json")
        self.assertEqual((result.returncode, without_warnings(result.stderr)), (0, b""))
        self.assertIn(
            "\nThe invariance set is empty on this grid: no state can be kept safe, even if all agents always "
            "coordinate.\n",
            result.stdout.decode(),
        )
        summary = self.analyze("spec.json")
        self.assertEqual((summary["safe"], summary["invariant"]), (22, 0))

    def test_empty_invariance_set_of_a_given_controller(self):
        self.write("spec.json", spec_with(controller={"synthesis": "given", "allow": "u == 1"}))
        self.assertIn(
            "\nThe invariance set is empty on this grid: there is no state from which every allowed action keeps the "
            "system safe.\n",
            self.run_program("analyze", "spec.json").stdout.decode(),
        )

    def test_names_of_datasets_that_are_not_there(self):
        """A state called `mode`: no network, no such dataset. Constants have no dataset at all."""
        names = {"x": "mode", "y": "pair", "u": "action", "v": "agent"}
        spec = spec_with(
            states=[dict(state, name=names[state["name"]]) for state in SPEC["states"]],
            inputs=[dict(one, name=names[one["name"]]) for one in SPEC["inputs"]],
            agents=[{"name": "a", "inputs": ["action"]}, {"name": "b", "inputs": ["agent"]}],
            constants={"delay": 6, "trigger": 1},
            dynamics=dict(SPEC["dynamics"], equations={"mode": "mode + trigger*action", "pair": "pair + agent"}),
            safe="mode + pair <= delay",
        )
        self.write("named.json", spec)
        self.write("small.json", SPEC)
        named, small = self.analyze("named.json", "-o", "named.h5"), self.analyze("small.json", "-o", "small.h5")
        best = small["partitions"][0]["best_state"]
        small["partitions"][0]["best_state"] = {names[name]: value for name, value in best.items()}
        for edge in small["partitions"][0]["best_at_edges"]:
            edge["state"] = names[edge["state"]]
        self.assertEqual(named["partitions"], small["partitions"])
        for command in (
            ("query", "named.h5", "--at", "mode=1,pair=2"),
            ("verify", "named.h5"),
            ("simulate", "named.h5", "--from", "mode=1,pair=2", "--steps", "5", "-o", "runs.h5"),
            ("export", "named.h5", "--format", "csv", "-o", "named.csv"),
            ("export", "named.h5", "--format", "c-header", "-o", "named.h"),
            ("report", "named.h5", "-o", "named.html"),
        ):
            result = self.run_program(*command)
            self.assertEqual((result.returncode, result.stderr), (0, b""), command)

    def test_a_single_point_by_its_count(self):
        """As by its step."""
        point = {"name": "z", "lower": 2, "upper": 2, "discrete": True}
        force = {"name": "w", "lower": 0.5, "upper": 0.5}
        found = []
        for grid in ({"count": 1}, {"step": 0.5}):
            spec = spec_with(
                states=[*SPEC["states"], {**point, **grid}],
                inputs=[*SPEC["inputs"], {**force, **grid}],
                agents=[*SPEC["agents"], {"name": "c", "inputs": ["w"]}],
                dynamics=dict(SPEC["dynamics"], equations={"x": "x + u", "y": "y + 2*w*v", "z": "z"}),
                output={"controller": True},
            )
            self.write("point.json", spec)
            found.append(self.analyze("point.json"))
            exported = self.run_program("export", "small.h5", "--format", "scs", "-o", f"{len(found)}.scs")
            self.assertEqual((exported.returncode, exported.stderr), (0, b""))
        self.assertEqual(found[0]["partitions"], found[1]["partitions"])
        self.assertEqual((found[0]["cells"], found[0]["joint_inputs"]), (25, 9))

    def test_quiet_prints_nothing(self):
        self.assert_prints("", "analyze", CIRCLE, "--quiet")
        self.assertEqual(self.files(), ["circle.h5"])

    def test_quiet_json_prints_the_document(self):
        self.assertEqual(self.analyze(CIRCLE, "--quiet")["name"], "circle")

    def test_same_bytes_for_any_number_of_threads(self):
        for threads in ("1", "2", "5"):
            self.analyze(CIRCLE, "--threads", threads, "-o", f"{threads}.h5")
        first = (self.folder / "1.h5").read_bytes()
        self.assertEqual((self.folder / "2.h5").read_bytes(), first)
        self.assertEqual((self.folder / "5.h5").read_bytes(), first)

    def test_same_bytes_from_standard_input(self):
        self.analyze(CIRCLE, "-o", "file.h5")
        self.analyze("-", "-o", "stdin.h5", stdin=(CONFIGS / "circle.json").read_bytes())
        self.assertEqual((self.folder / "file.h5").read_bytes(), (self.folder / "stdin.h5").read_bytes())

    def test_existing_results_survive_a_failure(self):
        self.write("small.h5", "precious")
        self.write("spec.json", spec_with(safe="x <= nothing"))
        self.assertEqual(self.run_program("analyze", "spec.json").returncode, 3)
        self.assertEqual((self.folder / "small.h5").read_text(), "precious")
        self.write("spec.json", SPEC)
        self.assertEqual(self.run_program("analyze", "spec.json").returncode, 0)
        self.assertEqual((self.folder / "small.h5").read_bytes()[:4], b"\x89HDF")

    def test_output_folder_that_is_not_there(self):
        self.write("spec.json", SPEC)
        self.assert_fails(
            5, "the folder does not exist (nowhere)", "analyze", "spec.json", "-o", "nowhere/out.h5"
        )

    def test_output_that_is_a_folder(self):
        self.write("spec.json", SPEC)
        (self.folder / "out.h5").mkdir()
        self.assert_fails(
            5, "cannot write the results: this is a folder (out.h5)", "analyze", "spec.json", "-o", "out.h5"
        )

    def test_output_folder_that_is_not_writable(self):
        # Not even root may create a file there.
        self.write("spec.json", SPEC)
        result = self.run_program("analyze", "spec.json", "-o", "/sys/out.h5")
        self.assertRegex(
            result.stderr.decode(),
            r"^coordreq: error: cannot create a file in the folder: "
            r"(Permission denied|Read-only file system|Operation not permitted) \(/sys\)\n$",
        )
        self.assertEqual((result.returncode, result.stdout), (5, b""))

    def test_too_little_memory(self):
        self.write("spec.json", SPEC)
        result = self.run_program("analyze", "spec.json", "--max-memory", "1M")
        self.assertRegex(
            result.stderr.decode(),
            r"^coordreq: error: 25 cells need about [0-9.]+ MiB of memory, the limit is 1\.0 MiB \(--max-memory\)\n$",
        )
        self.assertEqual((result.returncode, result.stdout), (4, b""))
        self.assertEqual(self.files(), ["spec.json"])

    def test_too_many_cells(self):
        states = [dict(state, upper=1, step="1/1000000") for state in SPEC["states"]]
        self.write("spec.json", spec_with(states=states))
        result = self.run_program("analyze", "spec.json")
        self.assertRegex(
            result.stderr.decode(),
            r"^coordreq: error: 1,000,002,000,001 cells need about [0-9.]+ TiB of memory, the limit is [0-9.]+ [GT]iB "
            r"\(--max-memory\)\n$",
        )
        self.assertEqual((result.returncode, result.stdout), (4, b""))
        self.assertEqual(self.files(), ["spec.json"])


if __name__ == "__main__":
    unittest.main()
