"""`analyze A B ...`: several specs in one call, a line each."""

import json
import os
import re
import signal
import subprocess
import unittest
import xml.etree.ElementTree

from program import PROGRAM, SANITIZED, SPEC, Case, spec_with

MET = {"name": "there", "where": "x <= 0.1 and y <= 0.1 and x >= 0 and y >= 0", "min_delay": 1}
MISSED = {"name": "far", "where": "x >= 2.9 and x <= 3.1 and y >= 2.9 and y <= 3.1", "min_delay": 1}
# A requirement holds in one, fails in the other.
GOOD = spec_with(name="good", requirements=[dict(MET, where="x >= 0.9 and x <= 1.1 and y >= 0.9 and y <= 1.1")])
BAD = spec_with(name="bad", requirements=[*GOOD["requirements"], MISSED])

TABLE = """spec       cells  safe  invariant  requirements met   seconds    memory     F  unbounded  longest finite delay
good.json     25    22         22            1 of 1      SECS    MEMORY     4          0  3 steps (1.5 s)
none.json  error: no such file (none.json)
bad.json      25    22         22            1 of 2      SECS    MEMORY     4          0  3 steps (1.5 s)

requirement far: delay of a|b at least 1 step (0.5 s)
  FAILS in bad.json: 1 of 1 cell fails, the worst at x = 3, y = 3: it has a delay of 0 steps (0 s).

results in 2 files in the current folder
"""


class Cases(Case):
    def setUp(self):
        super().setUp()
        self.write("good.json", GOOD)
        self.write("bad.json", BAD)

    def table(self, *arguments, code, errors=""):
        result = self.run_program("analyze", *arguments)
        self.assertEqual((result.stderr.decode(), result.returncode), (errors, code))
        return re.sub(r"[0-9.]{4} +[0-9]+ MiB", "SECS    MEMORY", result.stdout.decode())

    def test_table(self):
        error = "coordreq: error: none.json: no such file (none.json)\n"
        table = self.table("good.json", "none.json", "bad.json", code=5, errors=error)
        self.assertEqual(table, TABLE)
        self.assertEqual(self.files(), ["bad.h5", "bad.json", "good.h5", "good.json"])

    def test_files_are_those_of_single_runs(self):
        self.run_program("analyze", "good.json", "-o", "single.h5")
        self.table("good.json", "bad.json", code=1)
        self.assertEqual((self.folder / "good.h5").read_bytes(), (self.folder / "single.h5").read_bytes())

    def test_json(self):
        result = self.run_program("analyze", "good.json", "none.json", "bad.json", "--json")
        self.assertEqual(result.returncode, 5)
        document = json.loads(result.stdout)
        self.assertEqual(document["exit_code"], 5)
        self.assertEqual([run["spec"] for run in document["runs"]], ["good.json", "none.json", "bad.json"])
        self.assertEqual([run["exit_code"] for run in document["runs"]], [0, 5, 1])
        self.assertEqual(document["runs"][1], {
            "spec": "none.json", "values": {}, "exit_code": 5, "error": "no such file (none.json)",
        })
        for run in (document["runs"][0], document["runs"][2]):
            single = json.loads(self.run_program("analyze", run["spec"], "--json").stdout)
            for summary in (run["summary"], single):
                for effort in ("seconds", "peak_memory_bytes"):
                    del summary[effort]
            self.assertEqual(run["summary"], single)

    def test_quiet_tells_errors_only(self):
        self.write("broken.json", "{")
        result = self.run_program("analyze", "broken.json", "good.json", "--quiet")
        self.assertEqual(result.stdout, b"")
        self.assertEqual(
            result.stderr.decode(),
            "coordreq: error: broken.json: expected a key in double quotes, found the end of the file "
            "(broken.json, line 1, column 2)\n",
        )
        self.assertEqual(result.returncode, 3)

    def test_output_folder(self):
        (self.folder / "out").mkdir()
        table = self.table("good.json", "bad.json", "-o", "out", code=1)
        self.assertTrue(table.endswith("\nresults in 2 files in out\n"))
        self.assertEqual(sorted(os.listdir(self.folder / "out")), ["bad.h5", "good.h5"])

    def test_settings_are_for_all(self):
        self.table("good.json", "bad.json", "--set", "states.x.upper=5", code=1)
        for name in ("good", "bad"):
            info = json.loads(self.run_program("info", f"{name}.h5", "--json").stdout)
            self.assertEqual(info["cells"], 30)

    def test_junit(self):
        self.table(
            *("good.json", "none.json", "bad.json", "--junit", "report.xml"),
            code=5,
            errors="coordreq: error: none.json: no such file (none.json)\n",
        )
        root = xml.etree.ElementTree.parse(self.folder / "report.xml").getroot()
        counts = ("tests", "failures", "errors")
        self.assertEqual([root.get(count) for count in counts], ["4", "1", "1"])
        found = [[suite.get("name"), *(suite.get(count) for count in counts)] for suite in root]
        self.assertEqual(
            found, [["good", "1", "0", "0"], ["none.json", "1", "0", "1"], ["bad", "2", "1", "0"]]
        )
        (error,) = root.iter("error")
        self.assertEqual(error.get("message"), "no such file (none.json)")
        self.assertEqual([case.get("name") for case in root[2]], ["there", "far"])

    def test_partitions_and_limits(self):
        apart = [{"name": f"{name}", "classes": []} for name in "p"]
        together = [{"name": "q", "classes": [["a", "b"]]}]
        self.write("all.json", spec_with(name="all", coordination={"partitions": "all"}))
        self.write("cut.json", spec_with(name="cut", coordination={"partitions": apart, "max_delay": 2}))
        self.write("two.json", spec_with(name="two", coordination={"partitions": [*together, *apart]}))
        lines = self.table("all.json", "cut.json", "two.json", code=0).splitlines()
        self.assertRegex(lines[1], r"  0 / 4 +22 / 0  - / 3 steps \(1\.5 s\)$")
        self.assertRegex(lines[2], r"  not reached +unknown  at least 2 steps \(1 s\)$")
        self.assertRegex(lines[3], r"  0 / 4 +22 / 0  - / 3 steps \(1\.5 s\)$")

    def test_lines_before_an_interrupt_are_there(self):
        axes = [{"name": name, "lower": 0, "upper": 3000, "step": 1} for name in "xy"]
        self.write("long.json", spec_with(name="long", states=axes, safe="x + y <= 3000"))
        process = subprocess.Popen(
            [PROGRAM, "analyze", "good.json", "long.json"],
            cwd=self.folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
        heading, first = process.stdout.readline(), process.stdout.readline()
        process.send_signal(signal.SIGINT)
        rest, errors = process.communicate(timeout=60)
        self.assertEqual((heading[:4], first[:9], rest), (b"spec", b"good.json", b""))
        self.assertEqual((errors, process.returncode), (b"coordreq: error: interrupted\n", 130))
        self.assertEqual(self.files(), ["bad.json", "good.h5", "good.json", "long.json"])

    def test_two_that_would_write_one_file(self):
        (self.folder / "sub").mkdir()
        self.write("sub/other.json", GOOD)
        self.assert_fails(
            2,
            "expected another file than the results of good.json, found 'good.h5' (--output)",
            *("analyze", "good.json", "sub/other.json"),
        )
        self.assert_fails(
            2,
            "expected another file than the results of bad.json, found './bad.h5' (--junit)",
            *("analyze", "good.json", "bad.json", "--junit", "./bad.h5"),
        )

    def test_output_that_is_no_folder(self):
        self.write("file.h5", "")
        for name in ("file.h5", "none"):
            with self.subTest(name=name):
                message = (
                    "expected a folder that exists, because there are several results files, "
                    f"found '{name}' (--output)"
                )
                self.assert_fails(2, message, "analyze", "good.json", "bad.json", "-o", name)

    def test_standard_input_twice(self):
        message = "standard input is named twice, expected one spec from it"
        self.assert_fails(2, message, "analyze", "-", "-", stdin=json.dumps(SPEC).encode())

    @unittest.skipIf(SANITIZED, "the program alone holds more than that")
    def test_limits_of_one_spec_do_not_stop_the_others(self):
        self.write("huge.json", spec_with(name="huge", states=[
            {"name": name, "lower": 0, "upper": 40000, "step": 1} for name in "xy"
        ]))
        result = self.run_program("analyze", "huge.json", "good.json", "--max-memory", "100M", "--json")
        document = json.loads(result.stdout)
        self.assertEqual([run["exit_code"] for run in document["runs"]], [4, 0])
        self.assertEqual((result.returncode, document["exit_code"]), (4, 4))
        self.assertEqual(self.files(), ["bad.json", "good.h5", "good.json", "huge.json"])


if __name__ == "__main__":
    unittest.main()
