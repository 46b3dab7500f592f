"""What the pages beside the examples show is what happens."""

import json
import os
import pathlib
import re
import subprocess
import unittest

from program import CONFIGS, PROGRAM, ROOT, Case, without_comments

PAGES = sorted(CONFIGS.glob("**/*.md"))
TUTORIAL = (CONFIGS / "tutorial/README.md").read_text()
GRIDS = (CONFIGS / "grids.md").read_text()


def example(number):
    return (CONFIGS / f"tutorial/corridor_{number}.json").read_text()


class Cases(Case):
    def longest(self, spec):
        """Cells, and the longest silence in seconds."""
        self.write("spec.json", spec)
        summary = json.loads(self.run_program("analyze", "spec.json", "--json", "-o", "out.h5").stdout)
        return summary["states"], summary["partitions"][0]["max_delay_time"]

    def test_sessions_of_the_tutorial(self):
        (self.folder / "configs").symlink_to(CONFIGS)
        environment = dict(os.environ, PATH=f"{pathlib.Path(PROGRAM).parent}:{os.environ['PATH']}")
        sessions = re.findall(r"(?ms)^```console\n\$ ([^\n]*)\n(.*?)^```$", TUTORIAL)
        self.assertEqual(len(sessions), 9)
        for command, expected in sessions:
            result = subprocess.run(
                command,
                shell=True,
                cwd=self.folder,
                env=environment,
                text=True,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
            )
            self.assertEqual(self.without_effort(result.stdout), self.without_effort(expected))

    @staticmethod
    def without_effort(text):
        return re.sub(r"\([0-9.]+ s on [0-9]+ threads?(, [0-9.]+ MiB)?\)", "(effort)", text)

    def test_specs_of_the_tutorial(self):
        whole, *parts = re.findall(r"(?ms)^```json\n(.*?)^```$", TUTORIAL)
        self.assertEqual(json.loads(whole), json.loads(without_comments(example(1))))
        second = json.loads(without_comments(example(2)))
        self.assertEqual(json.loads(parts[0]), second["states"][0])
        fourth = json.loads(without_comments(example(4)))
        part = json.loads("{" + parts[1] + "}")
        self.assertEqual(part["disturbances"], fourth["disturbances"])
        self.assertEqual(part["abstraction"], fourth["abstraction"])
        self.assertEqual(part["dynamics"]["equations"], fourth["dynamics"]["equations"])

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
        self.assertIn("4.5 s with a period of 0.25 s,\n   6 s with 0.5 s and 7 s with 1 s".replace("\n   ", " "),
                      " ".join(GRIDS.split()))

    def test_links(self):
        for page in PAGES:
            for target in re.findall(r"\]\(([^)#]+)\)", page.read_text()):
                self.assertTrue((page.parent / target).exists(), f"{page.name}: {target}")
            for path in re.findall(r"`((?:configs|scripts|app|lib|tests)/[\w./]*)", page.read_text()):
                self.assertTrue((ROOT / path).exists(), path)


if __name__ == "__main__":
    unittest.main()
