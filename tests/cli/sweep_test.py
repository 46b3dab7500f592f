"""`--sweep PATH=V1,V2`: one analysis a combination of values, and a table."""

import json
import os
import re
import unittest
import xml.etree.ElementTree

from program import SPEC, Case, spec_with, without_warnings

SWEPT = spec_with(constants={"R": 6}, safe="x + y <= R")

TABLE = """constants.R  states.x.step  cells  safe  invariant  requirements met   seconds    memory     F  unbounded  longest finite delay
6            1                 25    22         22                 -      SECS    MEMORY     4          0  3 steps (1.5 s)
6            0              error: expected a step > 0, found 0 (/states/0/step; set by states.x.step=0)
4            1                 25    15         15                 -      SECS    MEMORY     3          0  2 steps (1 s)
4            0              error: expected a step > 0, found 0 (/states/0/step; set by states.x.step=0)

no results files: --output names a folder for them
"""


class Cases(Case):
    def setUp(self):
        super().setUp()
        self.write("spec.json", SWEPT)

    def document(self, *arguments, code=0):
        result = self.run_program("analyze", "spec.json", *arguments, "--json")
        self.assertEqual((without_warnings(result.stderr), result.returncode), (b"", code))
        return json.loads(result.stdout)

    def test_table(self):
        result = self.run_program("analyze", "spec.json", "--sweep", "constants.R=6,4", "--sweep", "states.x.step=1,0")
        table = re.sub(r"[0-9.]{4} +[0-9]+ MiB", "SECS    MEMORY", result.stdout.decode())
        self.assertEqual(table, TABLE)
        self.assertEqual(
            result.stderr.decode(),
            "coordreq: error: spec.json constants.R=6 states.x.step=0: expected a step > 0, found 0 (/states/0/step)\n"
            "coordreq: error: spec.json constants.R=4 states.x.step=0: expected a step > 0, found 0 (/states/0/step)\n",
        )
        self.assertEqual(result.returncode, 3)
        self.assertEqual(self.files(), ["spec.json"])

    def test_each_run_is_what_set_gives(self):
        document = self.document("--sweep", "constants.R=6,9/2", "--sweep", "states.x.step=1,0.5")
        values = [run["values"] for run in document["runs"]]
        self.assertEqual(
            values,
            [
                {"constants.R": 6, "states.x.step": 1},
                {"constants.R": 6, "states.x.step": 0.5},
                {"constants.R": "9/2", "states.x.step": 1},
                {"constants.R": "9/2", "states.x.step": 0.5},
            ],
        )
        for run in document["runs"]:
            settings = [f"--set={path}={value}" for path, value in run["values"].items()]
            single = self.analyze("spec.json", *settings)
            self.assertIsNone(run["summary"].pop("output"))
            for summary in (run["summary"], single):
                for effort in ("seconds", "peak_memory_bytes", "output"):
                    summary.pop(effort, None)
            self.assertEqual(run["summary"], single)

    def test_results_files(self):
        (self.folder / "out").mkdir()
        document = self.document("--sweep", "constants.R=6,9/2", "--set", "states.y.upper=5", "-o", "out")
        names = ["small_constants.R=6.h5", "small_constants.R=9_2.h5"]
        self.assertEqual(sorted(os.listdir(self.folder / "out")), names)
        self.assertEqual([run["summary"]["output"] for run in document["runs"]], [f"out/{name}" for name in names])
        for name in names:
            self.assertEqual(self.run_program("verify", f"out/{name}").returncode, 0)
        self.analyze("spec.json", "--set", "states.y.upper=5", "--set", "constants.R=9/2", "-o", "single.h5")
        self.assertEqual((self.folder / "out" / names[1]).read_bytes(), (self.folder / "single.h5").read_bytes())

    def test_commas_inside_of_values(self):
        document = self.document("--sweep", "inputs.0.values=[-1, 0, 1],[0]", "--sweep", "constants.R=min(5,6),5")
        self.assertEqual([run["summary"]["inputs"] for run in document["runs"]], [9, 9, 3, 3])
        self.assertEqual(document["runs"][0]["values"], {"inputs.0.values": [-1, 0, 1], "constants.R": "min(5,6)"})
        self.assertEqual(document["runs"][0]["summary"]["safe"], document["runs"][1]["summary"]["safe"])

    def test_several_specs(self):
        self.write("other.json", dict(SWEPT, name="other"))
        result = self.run_program("analyze", "spec.json", "other.json", "--sweep", "constants.R=6,4", "--json")
        runs = json.loads(result.stdout)["runs"]
        self.assertEqual(
            [(run["spec"], run["values"]["constants.R"]) for run in runs],
            [("spec.json", 6), ("spec.json", 4), ("other.json", 6), ("other.json", 4)],
        )

    def test_requirements(self):
        requirement = {"name": "near", "where": "x <= 0.1 and y <= 0.1 and x > -0.4 and y > -0.4", "min_delay": 2}
        self.write("spec.json", dict(SWEPT, requirements=[requirement]))
        document = self.document("--sweep", "constants.R=6,1", "--junit", "report.xml", code=1)
        self.assertEqual([run["exit_code"] for run in document["runs"]], [0, 1])
        root = xml.etree.ElementTree.parse(self.folder / "report.xml").getroot()
        self.assertEqual(
            [(suite.get("name"), suite.get("failures")) for suite in root],
            [("small constants.R=6", "0"), ("small constants.R=1", "1")],
        )

    def test_standard_input(self):
        result = self.run_program(
            "analyze", "-", "--sweep", "constants.R=6,4", "--json", stdin=json.dumps(SWEPT).encode()
        )
        self.assertEqual([run["summary"]["safe"] for run in json.loads(result.stdout)["runs"]], [22, 15])

    def test_no_sweep(self):
        for sweep in ("constants.R", "constants.R=", "constants.R=1,,2", "=1,2"):
            with self.subTest(sweep=sweep):
                message = (
                    f"expected PATH=VALUE,VALUE, e.g. states.0.step=0.02,0.01, found '{sweep}' (--sweep)"
                )
                self.assert_fails(2, message, "analyze", "spec.json", "--sweep", sweep)

    def test_one_place_twice(self):
        sweep = ("--sweep", "constants.R=1", "--sweep", "constants.R=2")
        self.assert_fails(2, "'constants.R' is swept twice (--sweep)", "analyze", "spec.json", *sweep)

    def test_too_many_combinations(self):
        values = ",".join(str(i) for i in range(101))
        sweep = ("--sweep", f"constants.R={values}", "--sweep", f"states.x.upper={values}")
        self.assert_fails(
            2, "expected at most 10000 combinations, found more (--sweep)", "analyze", "spec.json", *sweep
        )

    def test_values_that_give_one_file_name(self):
        (self.folder / "out").mkdir()
        self.assert_fails(
            2,
            "expected another file than the results of spec.json constants.R=9/2, "
            "found 'out/small_constants.R=9_2.h5' (--output)",
            *("analyze", "spec.json", "--sweep", "constants.R=9/2,9*2", "-o", "out"),
        )

    def test_place_that_is_not_there(self):
        result = self.run_program("analyze", "spec.json", "--sweep", "constants.r=1")
        self.assertEqual(result.returncode, 2)
        self.assertIn("error: 'r' is not one of the constants, did you mean 'R'? (constants.r)\n", result.stdout.decode())


if __name__ == "__main__":
    unittest.main()
