"""What is not the answer itself is small beside it: by counts of work, on the examples and on one large grid of each kind."""

import json
import unittest

from program import CONFIGS, ROOT, Case, without_comments

# Reads of tables and sets: a sixteenth of one for each cell, or a number that no small problem notices: three for each cell, but
# between these. A cell or a solution may go beyond it before the search ends.
READS_OF_CELL, READS_OF_FEW_CELLS = 0.0625, 3
FEW_READS, MANY_READS, MORE_READS = 20_000, 100_000, 10_000
# Rows of posts read to count the cells that leave, and rows visited to spread that, of the rows that the layers visit.
SHARE_READ, SHARE_VISITED = 0.4, 0.1
# Solutions that are followed from single points, whatever the size of a problem.
MOST_STARTS, MOST_FOLLOWED = 128 + 16, 500
MOST_POSTS = 12


def variant(name, step, inputs):
    """An example with other steps of its states, but for those given by a count, and of its inputs."""
    spec = json.loads(without_comments((CONFIGS / f"{name}.json").read_text(encoding="utf-8")))
    for state in spec["states"]:
        if "step" in state:
            state["step"] = step
    for one in spec["inputs"]:
        one["step"] = inputs
    return spec


def crossing(step, inputs):
    """Two double integrators: boxes that are shifted."""
    return variant("intersection_coarse", step, inputs)


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
        unseen = helpers.get("unseen motion", {"reads": 0, "solutions": 0})
        few = min(max(READS_OF_FEW_CELLS * cells, FEW_READS), MANY_READS)
        self.assertLessEqual(unseen["reads"], max(READS_OF_CELL * cells, few) + MORE_READS)
        self.assertLessEqual(unseen["solutions"], MOST_FOLLOWED)
        self.assertLessEqual(helpers["motion"]["solutions"], MOST_STARTS)
        self.assertLessEqual(helpers.get("tightness", {"posts": 0})["posts"], MOST_POSTS * len(summary["motion"]))
        for name, work in helpers.items():
            if not name.startswith("leaving cells "):
                continue
            layers = works[name.replace("leaving cells", "layers")]
            self.assertLessEqual(work["rows_near"], layers["rows_visited"])
            self.assertLessEqual(work["rows_read"], SHARE_READ * layers["rows_visited"])
            self.assertLessEqual(work["rows_visited"], SHARE_VISITED * layers["rows_visited"])
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
        """One of each kind: boxes that are shifted, agents that are alike, moves of single cells, motion that is added up."""
        kinds = {
            "intersection": crossing(0.2, 0.2),
            "three vehicles": three_alike(0.75),
            "gridworld": variant("gridworld", 0.008, 0.2),
            "aircraft": variant("aircraft", 0.25, 0.5),
        }
        for name, spec in kinds.items():
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
