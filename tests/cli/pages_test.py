"""What the pages of docs show is what happens."""

import json
import os
import pathlib
import re
import shlex
import subprocess
import unittest

import h5py
import numpy as np
from pages import DOCS, PAGES, PageCase, blocks
from program import CONFIGS, PROGRAM, ROOT, without_comments

GRIDS = (DOCS / "how-to/grids.md").read_text()
# How many sessions each page has, and the examples whose results they start from.
SESSIONS = {
    "how-to/coalitions.md": (2, []),
    "reference/commands.md": (1, []),
    "how-to/goals-and-memory.md": (4, []),
    "how-to/grids.md": (1, []),
    "how-to/logs.md": (1, ["crossing.json"]),
    "how-to/networks.md": (1, []),
    "reference/outputs.md": (4, ["tutorial/corridor_4.json"]),
    "how-to/queries.md": (2, ["circle.json"]),
    "reference/results.md": (1, ["circle.json"]),
    "how-to/risk.md": (3, []),
    "how-to/rules.md": (1, []),
    "how-to/simulation.md": (1, ["circle.json"]),
    "how-to/sweeps.md": (2, ["circle.json"]),
    "tutorial/README.md": (7, []),
}


def example(number):
    return (CONFIGS / f"tutorial/corridor_{number}.json").read_text()


class Cases(PageCase):
    def longest(self, spec):
        """Cells, and the longest silence in seconds."""
        self.write("spec.json", spec)
        summary = json.loads(self.run_program("analyze", "spec.json", "--json", "-o", "out.h5").stdout)
        return summary["cells"], summary["partitions"][0]["max_delay_time"]

    def test_sessions_of_coalitions(self):
        self.assert_sessions("how-to/coalitions.md")

    def test_sessions_of_commands(self):
        self.assert_sessions("reference/commands.md")

    def test_sessions_of_goals_and_memory(self):
        self.assert_sessions("how-to/goals-and-memory.md")

    def test_sessions_of_grids(self):
        self.assert_sessions("how-to/grids.md")

    def test_sessions_of_logs(self):
        self.assert_sessions("how-to/logs.md")

    def test_sessions_of_risk(self):
        self.assert_sessions("how-to/risk.md")

    def test_sessions_of_networks(self):
        self.assert_sessions("how-to/networks.md")

    def test_sessions_of_outputs(self):
        self.assert_sessions("reference/outputs.md")

    def test_sessions_of_queries(self):
        self.assert_sessions("how-to/queries.md")

    def test_sessions_of_results(self):
        self.assert_sessions("reference/results.md")

    def test_sessions_of_rules(self):
        self.assert_sessions("how-to/rules.md")

    def test_sessions_of_simulation(self):
        self.assert_sessions("how-to/simulation.md")

    def test_sessions_of_sweeps(self):
        self.assert_sessions("how-to/sweeps.md")

    def test_sessions_of_the_tutorial(self):
        self.assert_sessions("tutorial/README.md")

    def assert_sessions(self, page):
        count, prepared = SESSIONS[page]
        for config in prepared:
            self.analyze(str(CONFIGS / config))
        self.assert_sessions_happen(DOCS / page, count)

    def test_no_page_has_other_sessions(self):
        found = {str(page.relative_to(DOCS)): len(blocks(page, "console")) for page in DOCS.glob("**/*.md")}
        expected = {page: count for page, (count, _) in SESSIONS.items()}
        self.assertEqual({page: count for page, count in found.items() if count > 0}, expected)

    def test_spec(self):
        (spec,) = blocks(DOCS / "reference/spec.md", "jsonc")
        result = self.run_program("validate", "-", stdin=spec.encode())
        self.assertEqual((result.returncode, result.stderr), (0, b""))

    def test_python_of_results(self):
        self.analyze(str(CONFIGS / "circle.json"))
        self.assert_programs_print(DOCS / "reference/results.md", "(1, 201, 201) m\n")

    def test_notebook(self):
        self.analyze(str(CONFIGS / "tutorial/corridor_5.json"))
        self.assert_notebook_prints(DOCS / "how-to/python.md")
        self.assertTrue((self.folder / "silence.png").read_bytes().startswith(b"\x89PNG"))

    def test_lines_for_a_shell(self):
        """Those for the program and for scripts/plot run, on coarser grids where the page has a large one."""
        (self.folder / "configs").symlink_to(CONFIGS)
        (self.folder / "scripts").symlink_to(ROOT / "scripts")
        (self.folder / "intersection.json").symlink_to(CONFIGS / "intersection_coarse.json")
        self.analyze("intersection.json", "-o", "intersection.h5")
        self.analyze("configs/platoon_coalition.json")
        environment = dict(os.environ, PATH=f"{pathlib.Path(PROGRAM).parent}:{os.environ['PATH']}")
        lines = []
        for page in sorted(DOCS.glob("**/*.md")):
            text = re.sub(r"(?m)^ +", "", page.read_text())
            for block in re.findall(r"(?ms)^```sh\n(.*?)^```$", text):
                lines += re.findall(r"(?m)^(?:coordreq|scripts/plot) .*$", block)
        self.assertGreaterEqual(len(lines), 12)
        for line in lines:
            with self.subTest(line=line):
                line = line.replace("configs/intersection.json", "intersection.json -o intersection.h5")
                result = subprocess.run(
                    line, shell=True, cwd=self.folder, env=environment, capture_output=True, text=True
                )
                # Those with a JUnit report or a sweep are about requirements that fail, and so is an example.
                fails = any(word in line for word in ("--junit", "--sweep", "analyze configs/intersection_requirements.json"))
                self.assertEqual(result.returncode, int(fails), result.stderr)
                self.assertNotIn("error", result.stderr)
                for name in re.findall(r" (?:-o|--junit) (\S+)", line):
                    self.assertGreater((self.folder / name).stat().st_size, 0)

    def test_every_page_is_in_the_index(self):
        index = (DOCS / "README.md").read_text()
        for page in DOCS.glob("**/*.md"):
            if page != DOCS / "README.md":
                self.assertIn(f"({page.relative_to(DOCS)})", index)

    def test_words_of_the_program_are_its_words(self):
        """What the page for what looks wrong quotes stands in the sources."""
        page = (DOCS / "how-to/troubleshooting.md").read_text()
        sources = "".join(path.read_text() for room in ("app", "lib") for path in sorted((ROOT / room).glob("**/*.cpp")))
        sources = re.sub(r'"\s*\n\s*"', "", sources).replace('\\"', '"')
        quoted = re.findall(r'"([^"`]*)"', re.sub(r"`[^`]*`", "", page))
        self.assertGreater(len(quoted), 12)
        self.assertEqual([words for words in quoted if words.lower() not in sources.lower()], [])

    def test_parked_vehicles_are_as_the_page_on_modelling_has_them(self):
        position = {"name": "p", "lower": 0, "upper": 20, "step": 0.5, "outside": "saturate"}
        speed = {"name": "v", "lower": 0, "upper": 3, "step": 0.5, "outside": "saturate"}
        spec = {
            "coordreq": 1, "name": "park", "states": [position, speed], "inputs": [{"name": "a", "values": [-1, 0, 1]}],
            "agents": [{"name": "one", "inputs": ["a"]}],
            "dynamics": {"time": "continuous", "period": 0.5, "equations": {"p": "v", "v": "a"}}, "safe": "p <= 15",
        }  # fmt: skip
        found = {}
        for name, changes in (
            ("as it is", {}),
            ("half open", {"abstraction": {"cells": "half_open"}}),
            ("speed", {"states": [position, {**speed, "step": 0.25}]}),
            ("position", {"states": [{**position, "step": 0.05}, speed]}),
        ):
            self.write("spec.json", {**spec, **changes})
            found[name] = json.loads(self.run_program("analyze", "spec.json", "--json", "-o", "out.h5").stdout)["invariant"] > 0
        self.assertEqual(found, {"as it is": False, "half open": True, "speed": True, "position": False})

    def test_the_gap_of_two_drones_is_enough(self):
        (part,) = blocks(DOCS / "how-to/modelling.md", "json")
        spec = {**json.loads(without_comments(example(3))), **json.loads("{" + part + "}"), "safe": "gap >= 1"}
        whole = json.loads(without_comments(example(3)))
        self.assertEqual([self.longest(whole), self.longest(spec)], [(6561, 9), (81, 9)])

    def test_every_example_is_in_the_table(self):
        table = (CONFIGS / "README.md").read_text()
        for example in CONFIGS.glob("*.json"):
            self.assertIn(f"[{example.name}]({example.name})", table)

    def test_python_of_coalitions(self):
        self.analyze(str(CONFIGS / "platoon_coalition.json"))
        self.assert_programs_print(DOCS / "how-to/coalitions.md", "lead+middle|tail\n2880\n")

    def test_controller_of_rules(self):
        subprocess.run(["/usr/bin/python3", CONFIGS / "first_come.py"], cwd=self.folder, check=True)
        with h5py.File(self.folder / "first_come.h5") as written, h5py.File(CONFIGS / "first_come.h5") as stored:
            self.assertTrue(np.array_equal(written["controller"][...], stored["controller"][...]))

    def test_figures_of_the_crossing(self):
        rows = re.findall(r"(?m)^\| `(configs/crossing[^`]*)` \|[^|]*\| (.*) \|$", (DOCS / "how-to/rules.md").read_text())
        self.assertEqual(len(rows), 4)
        for command, figures in rows:
            config, *settings = shlex.split(command)
            summary = self.analyze(str(ROOT / config), *settings)
            (partition,) = summary["partitions"]
            layers, never = partition["layers"], partition["fixed_point"]
            half = max(k for k, size in enumerate(layers) if 2 * size >= layers[0])
            bears = "unbounded" if 2 * never >= layers[0] else f"{half} s"
            longest = f"{partition['F'] - 1} s" if partition["F"] > 0 else "-"
            self.assertEqual(figures.split(" | "), [f"{summary['invariant']:,}", bears, longest, f"{never:,}"])

    def test_figures_of_networks(self):
        rows = re.findall(r"(?m)^\| `(\{.*\})`.* \| ([0-9,]+) \| ([0-9,]+) \|$", (DOCS / "how-to/networks.md").read_text())
        self.assertEqual(len(rows), 6)
        spec = json.loads(without_comments((CONFIGS / "intersection_network.json").read_text()))
        for row in rows:
            network = json.loads(row[0].replace("\\|", "|"))
            for resynthesise, expected in zip((False, True), row[1:]):
                with self.subTest(network=network, resynthesise=resynthesise):
                    self.write("spec.json", dict(spec, network=dict(network, resynthesise=resynthesise)))
                    found = self.analyze("spec.json")["network"]
                    self.assertEqual(f"{found['modes'][0]['cells']:,}", expected)

    def test_specs_of_the_tutorial(self):
        whole, *parts = blocks(DOCS / "tutorial/README.md", "json")
        self.assertEqual(json.loads(whole), json.loads(without_comments(example(1))))
        self.assertEqual(len(parts), 5)
        for number, part in enumerate(parts, 2):
            spec = json.loads(without_comments(example(number)))
            for key, value in json.loads("{" + part + "}").items():
                self.assertEqual(value, spec[key], (number, key))
            # What a step does not show is as it was, but for what step 5 says that it leaves out.
            if number != 5:
                before = json.loads(without_comments(example(number - 1)))
                shown = {"name", *json.loads("{" + part + "}")}
                self.assertEqual({key: value for key, value in spec.items() if key not in shown},
                                 {key: value for key, value in before.items() if key not in shown})  # fmt: skip

    def test_steps_on_the_page_of_grids(self):
        rows = re.findall(r"(?m)^\| ([0-9.]+) m \| ([0-9,]+) \| ([0-9.]+) s \| ([0-9.]+) s \|$", GRIDS)
        self.assertEqual(len(rows), 6)
        for step, cells, closed, half_open in rows:
            for kind, expected in (("closed", closed), ("half_open", half_open)):
                spec = json.loads(without_comments(example(2)))
                spec["abstraction"] = {"cells": kind}
                for state in spec["states"]:
                    state["step"] = float(step)
                self.assertEqual(self.longest(spec), (int(cells.replace(",", "")), float(expected)))

    def test_draught_on_the_page_of_grids(self):
        rows = re.findall(r"(?m)^\| ([0-9.]+) m \| ([0-9.]+) s \|$", GRIDS)
        self.assertEqual(len(rows), 4)
        for step, expected in rows:
            for kind in ("closed", "half_open"):
                spec = json.loads(without_comments(example(4)))
                spec["abstraction"] = {"cells": kind}
                for state in spec["states"]:
                    state["step"] = float(step)
                self.assertEqual(self.longest(spec)[1], float(expected))

    def test_periods_on_the_page_of_grids(self):
        for period, expected in ((0.25, 4.5), (0.5, 6), (1, 7)):
            spec = json.loads(without_comments(example(2)))
            spec["dynamics"]["period"] = period
            self.assertEqual(self.longest(spec)[1], expected)
        self.assertIn("4.5 s with a period of 0.25 s, 6 s with 0.5 s and 7 s with 1 s", " ".join(GRIDS.split()))

    def test_files_that_they_name(self):
        for page in PAGES:
            with self.subTest(page=page):
                self.assert_files_exist(page)

    def test_a_vehicle_with_a_discrete_speed_stands_still(self):
        """What the page on grids says of speeds that are cells, and what it shows instead."""
        position = {"name": "p", "lower": -4, "upper": 4, "step": 0.5}
        speed = {"name": "v", "lower": 0, "upper": 2, "step": 1}
        parked = {}
        for kind, more, motion in (
            ("cells", {"outside": "saturate"}, {"equations": {"p": "v", "v": "a"}}),
            ("set-point", {"discrete": True}, {"equations": {"p": "v"}, "updates": {"v": "min(max(v + a, 0), 2)"}}),
        ):
            spec = {
                "coordreq": 1, "name": kind, "states": [position, {**speed, **more}],
                "inputs": [{"name": "a", "values": [0, 1]}], "agents": [{"name": "one", "inputs": ["a"]}],
                "dynamics": {"time": "continuous", "period": 1, **motion}, "safe": "p <= 3",
                "abstraction": {"cells": "half_open"},
            }  # fmt: skip
            self.write("spec.json", spec)
            self.run_program("analyze", "spec.json", "-o", "out.h5", "--quiet")
            answer = self.run_program("query", "out.h5", "--at", "p=2,v=0", "--json").stdout
            parked[kind] = json.loads(answer)["invariant"]
        self.assertEqual(parked, {"cells": False, "set-point": True})

    def test_a_disturbance_that_decides_a_discrete_state(self):
        """In a condition, as the spec reference tells, or by way of a state; elsewhere it is refused."""
        cell = {"name": "luck", "lower": 0, "upper": 0, "step": 2, "outside": "unsafe"}
        spec = {
            "coordreq": 1, "name": "luck",
            "states": [{"name": "n", "lower": 0, "upper": 3, "step": 1, "discrete": True, "outside": "saturate"}, cell],
            "inputs": [{"name": "take", "values": [0, 1]}], "agents": [{"name": "one", "inputs": ["take"]}],
            "disturbances": [{"name": "w", "lower": -0.5, "upper": 0.5}],
            "dynamics": {"time": "discrete", "period": 1, "equations": {"n": "n - take + if(luck > 0, 1, 0)", "luck": "w"}},
            "safe": "n <= 2", "output": {"abstraction": True},
        }  # fmt: skip
        self.write("spec.json", spec)
        self.analyze("spec.json", "-o", "out.h5")
        with h5py.File(self.folder / "out.h5") as file:
            self.assertEqual([int(file["abstraction/n"][side][1, 0, 0]) for side in ("first", "last")], [1, 2])
        self.assertEqual(self.run_program("verify", "out.h5", "--quiet").returncode, 0)
        spec["dynamics"]["equations"]["n"] = "n - take + if(w > 0, 1, 0)"
        self.write("spec.json", spec)
        self.analyze("spec.json", "-o", "out.h5")
        with h5py.File(self.folder / "out.h5") as file:
            self.assertEqual([int(file["abstraction/n"][side][1, 0]) for side in ("first", "last")], [1, 2])
        self.assertEqual(self.run_program("verify", "out.h5", "--quiet").returncode, 0)
        spec["dynamics"]["equations"]["n"] = "n - take + w + 1/2"
        self.write("spec.json", spec)
        result = self.run_program("analyze", "spec.json")
        self.assertIn(b"the next value of the discrete state 'n' can be a whole interval", result.stderr)

    def test_a_condition_on_angles_loses_the_cells_at_their_cut(self):
        spec = {
            "coordreq": 1, "name": "angle", "states": [{"name": n, "lower": -2, "upper": 2, "step": 0.5} for n in "xy"],
            "inputs": [{"name": "u", "values": [0]}], "agents": [{"name": "one", "inputs": ["u"]}],
            "dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x", "y": "y"}},
        }  # fmt: skip
        safe = []
        for condition in ("x*cos(pi) + y*sin(pi) >= cos(1)*sqrt(x^2 + y^2)", "cos(pi - atan2(y,x)) >= cos(1)"):
            self.write("spec.json", dict(spec, safe=condition))
            safe.append(self.analyze("spec.json")["safe"])
        self.assertEqual(safe, [20, 16])


if __name__ == "__main__":
    unittest.main()
