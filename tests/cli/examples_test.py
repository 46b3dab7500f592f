"""Every problem in configs/ is a working example."""

import json
import re
import shlex
import unittest

from program import CONFIGS, ROOT, Case, without_comments, without_warnings

EXAMPLES = sorted(CONFIGS.glob("*.json"))


class Cases(Case):
    def test_every_example_says_what_it_shows(self):
        for path in EXAMPLES:
            with self.subTest(example=path.name):
                text = path.read_text()
                self.assertTrue(text.startswith("// "))
                self.assertIn("description", json.loads(without_comments(text)))

    def test_settings_that_examples_show_are_valid(self):
        commands = [
            shlex.split(command)
            for path in EXAMPLES
            for command in re.findall(r"(?m)^// +coordreq analyze (.* --set .*)$", path.read_text())
        ]
        self.assertEqual(len(commands), 9)
        for example, *settings in commands:
            with self.subTest(example=example, settings=settings):
                result = self.run_program("validate", str(ROOT / example), *settings)
                self.assertEqual((result.returncode, without_warnings(result.stderr)), (0, b""))

    def test_validate_circle(self):
        result = self.run_program("validate", str(CONFIGS / "circle.json"))
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        self.assertRegex(
            result.stdout.decode(),
            r"""^circle: the spec is valid

state  points  unit  outside  moves in a period at most  next value depends on
x1        201  m     unsafe   1 cell \(0\.498 %\)           x1, u1
x2        201  m     unsafe   1 cell \(0\.498 %\)           x2, u2

input  points  unit
u1         41  m/s
u2         41  m/s

cells              40,401
joint inputs       1,681
partitions         horizontal\|vertical
reachable sets     exact interval hulls
guarantee          samples-center: checked every 0\.01 s only, where the centre of a cell is safe; between, x1 moves up to 0\.01 m
memory of analyze  about [0-9.]+ MiB
time of analyze    (less than a second|about [0-9.]+ s)
$""",
        )
        self.assertEqual(self.files(), [])

    def test_validate_json(self):
        result = self.run_program(
            "validate", "-", "--json", stdin=(CONFIGS / "lane_change.json").read_bytes()
        )
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        report = json.loads(result.stdout)
        self.assertEqual(
            list(report),
            [
                "name",
                "cells",
                "joint_inputs",
                "states",
                "inputs",
                "rows",
                "partitions",
                "exact",
                "motion",
                "guarantee",
                "memory_bytes",
                "seconds",
                "warnings",
            ],
        )
        self.assertEqual((report["name"], report["cells"], report["joint_inputs"]), ("lane_change", 28, 4))
        self.assertEqual(
            report["states"][1],
            {
                "name": "left_lane",
                "unit": "",
                "points": 2,
                "outside": {"below": "unsafe", "above": "unsafe"},
                "depends_on": {"states": ["left_lane"], "inputs": ["left_change"], "disturbances": []},
                "shift": False,
                "sum": False,
                "table_entries": 4,
                "table_bytes": 32,
            },
        )
        self.assertEqual(report["inputs"][0], {"name": "left_change", "unit": "", "points": 2})
        rows = report["rows"]
        self.assertEqual((len(rows["across"] + rows["along"]), rows["count"]), (len(report["states"]), rows["drawn"]))
        self.assertLessEqual(rows["different"], rows["drawn"])

    def test_validate_tells_along_which_states_few_rows_are_different(self):
        result = self.run_program("validate", str(CONFIGS / "gridworld.json"), "--verbose")
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        self.assertIn(b"across x1, x2, along y1, y2; of 64 drawn 2 different\n", result.stdout)

    def test_validate_tells_shifts_from_full_tables(self):
        result = self.run_program("validate", str(CONFIGS / "platoon.json"), "--verbose")
        self.assertEqual((result.returncode, without_warnings(result.stderr)), (0, b""))
        table = result.stdout.decode().split("\n\n")[1]
        self.assertEqual(
            table,
            """state  points  unit  outside                       moves in a period at most  table  entries    memory  next value depends on
v1          5  m/s   saturate                      1.05 cells (21 %)          shift        3  24 bytes  v1, u1, gust
v2          5  m/s   saturate                      1.05 cells (21 %)          shift        3  24 bytes  v2, u2, gust
v3          5  m/s   saturate                      1.05 cells (21 %)          shift        3  24 bytes  v3, u3, gust
gap12      39  m     unsafe below, saturate above  6 cells (15.4 %)           shift      225   1.8 KiB  v1, v2, gap12, u1, u2, gust
gap23      39  m     unsafe below, saturate above  6 cells (15.4 %)           shift      225   1.8 KiB  v2, v3, gap23, u2, u3, gust""",
        )

    def test_validate_quiet(self):
        self.assert_prints("", "validate", str(CONFIGS / "circle.json"), "--quiet")

    def test_schema_is_a_json_schema(self):
        result = self.run_program("schema")
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        schema = json.loads(result.stdout)
        self.assertEqual(schema["$schema"], "http://json-schema.org/draft-07/schema#")
        self.assertEqual(schema, json.loads((ROOT / "lib/spec/schema.json").read_text()))


if __name__ == "__main__":
    unittest.main()
