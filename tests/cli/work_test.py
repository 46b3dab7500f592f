"""What is not the answer itself is small beside it: by counts of work, on the examples and on one large grid of each kind."""

import json
import unittest

from program import CONFIGS, ROOT, Case, without_comments

# Reads of tables and sets: half of one for each cell, or a number that no small problem notices. A cell or a solution may go
# beyond it before the search ends.
READS_OF_CELL, FEW_READS = 0.5, 110_000
# Rows of posts read to count the cells that leave, and rows visited to spread that, of the rows that the layers visit.
SHARE = 0.5
# Solutions that are followed from single points, whatever the size of a problem.
MOST_SOLUTIONS = 256 + 64 + 500
MOST_POSTS = 32


def crossing(step, inputs):
    """Two double integrators: boxes that are shifted."""
    spec = json.loads(without_comments((CONFIGS / "intersection_coarse.json").read_text(encoding="utf-8")))
    for state in spec["states"]:
        state["step"] = step
    for one in spec["inputs"]:
        one["step"] = inputs
    return spec


def three_alike(step):
    """Three vehicles that may change places."""
    spec = crossing(step, 0.5)
    for key in ("states", "inputs", "agents"):
        spec[key] = []
    spec["dynamics"]["equations"] = {}
    for i in "123":
        spec["states"].append({"name": "p" + i, "lower": -10, "upper": 10, "step": 2 * step, "outside": "saturate"})
        spec["states"].append({"name": "v" + i, "lower": 0, "upper": 3, "step": step, "outside": "saturate"})
        spec["inputs"].append({"name": "u" + i, "lower": -1, "upper": 1, "step": 1})
        spec["agents"].append({"name": "vehicle" + i, "inputs": ["u" + i]})
        spec["dynamics"]["equations"].update({"p" + i: "v" + i, "v" + i: f"u{i} - K*v{i}^2"})
    away = {i: f"abs(p{i}) >= 2" for i in "123"}
    spec["safe"] = " and ".join(f"({away[i]} or {away[j]})" for i, j in ("12", "13", "23"))
    return spec


class Cases(Case):
    def assert_helpers_are_small(self, spec):
        """@returns what helpers did"""
        result = self.run_program("analyze", str(spec), "--json", "--quiet")
        self.assertIn(result.returncode, (0, 1), result.stderr)  # 1: a requirement fails
        summary = json.loads(result.stdout)
        works = {name: work for name, work in summary["work"].items() if name != "helpers"}
        helpers = summary["work"]["helpers"]
        cells = summary["cells"]
        self.assertLessEqual(helpers.get("unseen motion", {}).get("reads", 0), READS_OF_CELL * cells + FEW_READS)
        self.assertLessEqual(helpers.get("unseen motion", {}).get("solutions", 0), MOST_SOLUTIONS)
        self.assertLessEqual(helpers["motion"]["solutions"], MOST_SOLUTIONS)
        self.assertLessEqual(helpers.get("tightness", {"posts": 0})["posts"], MOST_POSTS * len(summary["motion"]))
        for name, work in helpers.items():
            if not name.startswith("leaving cells "):
                continue
            layers = works[name.replace("leaving cells", "layers")]
            self.assertLessEqual(work["rows_near"], layers["rows_visited"])
            self.assertLessEqual(work["rows_read"], SHARE * layers["rows_visited"])
            self.assertLessEqual(work["rows_visited"], SHARE * layers["rows_visited"])
        return summary

    def test_of_the_examples(self):
        seen = set()
        for path in sorted(CONFIGS.glob("*.json")):
            if path.stem == "intersection":  # takes long; a coarser one is below
                continue
            with self.subTest(example=path.name):
                seen |= set(self.assert_helpers_are_small(path)["work"]["helpers"])
        self.assertLessEqual({"motion", "unseen motion", "tightness", "leaving cells first|second"}, seen)

    def test_of_large_grids(self):
        for name, spec in (("shifted", crossing(0.2, 0.2)), ("alike", three_alike(0.75))):
            with self.subTest(kind=name):
                summary = self.assert_helpers_are_small(self.folder / self.write("spec.json", spec))
                self.assertGreater(summary["cells"], 250_000)

    def test_counts_do_not_depend_on_threads(self):
        spec = self.folder / self.write("spec.json", crossing(0.5, 0.5))
        works = [self.analyze(str(spec), "--threads", threads)["work"] for threads in ("1", "3")]
        self.assertEqual(*works)

    def test_every_count_is_on_its_page(self):
        page = (ROOT / "docs/reference/outputs.md").read_text(encoding="utf-8")
        for word in ("helpers", "rows_near", "rows_read", "solutions", "reads", "trials", "posts"):
            self.assertIn(f"`{word}`", page)


if __name__ == "__main__":
    unittest.main()
