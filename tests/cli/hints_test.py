"""What goes wrong at first: signs and names of other languages, tables of other countries, missing options, errors as JSON."""

import json
import unittest

from program import CONFIGS, SPEC, Case, spec_with, without_comments, without_places


class Cases(Case):
    def message(self, *arguments, stdin=b"", code=3):
        result = self.run_program(*arguments, stdin=stdin)
        self.assertEqual((result.returncode, result.stdout), (code, b""), result.stderr.decode())
        return without_places(result.stderr).decode()

    def test_names_in_other_capitals(self):
        for name in ("X", "Y"):
            with self.subTest(name=name):
                self.write("spec.json", spec_with(safe=f"{name} <= 6"))
                self.assertIn(f"'{name}' is not defined, did you mean '{name.lower()}'?", self.message("validate", "spec.json"))
        self.write("spec.json", spec_with(constants={"limit": 6}, safe="x + y <= LIMIT"))
        self.assertIn("'LIMIT' is not defined, did you mean 'limit'?", self.message("validate", "spec.json"))
        # A name of two letters differs from many others by one.
        self.write("spec.json", spec_with(safe="z <= 6"))
        self.assertIn("'z' is not defined (", self.message("validate", "spec.json"))

    def test_truth_values_of_python(self):
        self.write("spec.json", spec_with(safe="True"))
        self.assertIn("'True' is not defined, did you mean 'true'?", self.message("validate", "spec.json"))
        text = json.dumps(spec_with(abstraction={"between_samples": True}))
        for word, meant in (("True", "true"), ("TRUE", "true"), ("False", "false"), ("None", "null")):
            with self.subTest(word=word):
                self.write("spec.json", text.replace('"between_samples": true', f'"between_samples": {word}'))
                self.assertIn(f"expected a value, found '{word}', did you mean '{meant}'?", self.message("validate", "spec.json"))

    def test_signs_of_mathematics(self):
        for sign, meant, code in (("≤", "<=", "2264"), ("≥", ">=", "2265"), ("≠", "!=", "2260"), ("−", "-", "2212"), ("·", "*", "00B7"),
                                  ("∧", "and", "2227")):  # fmt: skip
            with self.subTest(sign=sign):
                self.write("spec.json", json.dumps(spec_with(safe=f"x {sign} 6"), ensure_ascii=False))
                self.assertIn(f"expected an operator or the end, found U+{code}, did you mean '{meant}'?", self.message("validate", "spec.json"))
        self.write("spec.json", spec_with(safe="x é 6"))
        self.assertIn("found U+00E9 (", self.message("validate", "spec.json"))

    def test_settings_without_the_way_to_them(self):
        self.write("spec.json", spec_with(constants={"vmax": 1}))
        for path, meant in (("vmax", "constants.vmax"), ("x.step", "states.x.step"), ("u.values", "inputs.u.values"), ("a.prefer", "agents.a.prefer")):
            with self.subTest(path=path):
                message = f"coordreq: error: no key '{path.split('.')[0]}' in the spec, did you mean '{meant}'? ({path})\n"
                self.assertEqual(self.message("validate", "spec.json", "--set", f"{path}=2", code=2), message)
        result = self.run_program("analyze", "spec.json", "--sweep", "vmax=1,2", "--quiet")
        self.assertEqual(result.returncode, 2)
        self.assertEqual(result.stderr.decode().count("did you mean 'constants.vmax'? (vmax)\n"), 2)
        # Keys that a spec may have are added to it.
        self.assertEqual(self.run_program("validate", "spec.json", "--set", "description=text").returncode, 0)

    def test_tables_of_other_countries(self):
        self.write("spec.json", SPEC)
        self.analyze("spec.json", "-o", "out.h5")
        for command in (("judge", "out.h5"), ("query", "out.h5")):
            for table, message in (
                ("x;y\n1;2\n", "expected commas between columns and points in numbers, found semicolons (standard input, line 1)"),
                ("x\ty\n1\t2\n", "expected commas between columns and points in numbers, found tabs (standard input, line 1)"),
                ("x,y\n1,5,2,5\n", "expected 2 values, found 4; numbers need a decimal point, not a comma (standard input, line 2)"),
                ("x,y\n1\n", "expected 2 values, found 1 (standard input, line 2)"),
                ('x,y\n"1,5",2\n', "expected a decimal point, found '1,5' (standard input, line 2, x)"),
            ):
                with self.subTest(command=command, table=table):
                    result = self.run_program(*command, stdin=table.encode())
                    self.assertEqual(result.stderr.decode(), f"coordreq: error: {message}\n")
                    self.assertEqual(result.returncode, 2)

    def test_missing_options_are_named(self):
        self.write("spec.json", SPEC)
        self.analyze("spec.json", "-o", "out.h5")
        limits = "or one of --silence, --blind, --approach, --arrival and --risk"
        self.assert_fails(2, f"missing --delay N, the silence to be tolerated, {limits}", "require", "out.h5", "--over", "x")
        self.assert_fails(2, "missing --over STATE, the state over which to search", "require", "out.h5", "--delay", "1")

    # errors as JSON

    def test_an_error_is_a_document_too(self):
        self.write("spec.json", SPEC)
        self.analyze("spec.json", "-o", "out.h5")
        self.write("bad.json", spec_with(safe="z <= 6", name="bad name"))
        for code, arguments in (
            (2, ("analyze", "--json")),
            (2, ("analyze", "spec.json", "--json", "--threads", "no")),
            (3, ("validate", "bad.json", "--json")),
            (3, ("analyze", "bad.json", "--json")),
            (3, ("info", "spec.json", "--json")),
            (4, ("analyze", "spec.json", "--json", "--max-memory", "1M")),
            (5, ("analyze", "none.json", "--json")),
            (2, ("query", "out.h5", "--at", "x=1", "--json")),
            (2, ("judge", "out.h5", "--json")),
        ):
            with self.subTest(arguments=arguments):
                result = self.run_program(*arguments)
                self.assertEqual(result.returncode, code)
                self.assertNotEqual(result.stderr, b"")
                self.assert_is_error(result, code)

    def test_without_json_an_error_is_a_line_alone(self):
        result = self.run_program("analyze", "none.json")
        self.assertEqual((result.returncode, result.stdout), (5, b""))

    def test_an_error_follows_no_answer(self):
        """Lines that are there already stay lines of one kind."""
        self.write("spec.json", SPEC)
        self.analyze("spec.json", "-o", "out.h5")
        result = self.run_program("query", "out.h5", "--json", stdin=b'{"x": 1, "y": 1}\n{"x": 1}\n')
        self.assertEqual(result.returncode, 2)
        (line,) = result.stdout.splitlines()
        self.assertNotIn("error", json.loads(line))

    # reasons in sweeps

    def test_a_sweep_says_why_requirements_fail(self):
        self.write("spec.json", json.loads(without_comments((CONFIGS / "crossing.json").read_text())))
        requirement = {"name": "slow", "where": "-10 <= p1 <= -8 and 0 <= v1 <= 1 and 0 <= v2 <= 1 and -10 <= p2 <= -8", "min_delay": 2}
        self.write("spec.json", {**json.loads((self.folder / "spec.json").read_text()), "requirements": [requirement]})
        result = self.run_program("analyze", "spec.json", "--sweep", "requirements.0.min_delay=1,20")
        self.assertEqual(result.returncode, 1)
        text = result.stdout.decode()
        (line,) = [line for line in text.splitlines() if line.startswith("requirement slow: ")]
        self.assertTrue(line.endswith("at least 20 steps (20 s)"), line)
        self.assertRegex(text, r"\n  FAILS in spec.json requirements.0.min_delay=20: \d+ of \d+ cells fail, the worst at ")
        self.assertNotIn("min_delay=1:", text)

    def test_a_sweep_tells_a_requirement_once_and_counts_what_fails_beyond_ten_runs(self):
        missed = {"name": "far", "where": "x >= 2.9 and x <= 3.1 and y >= 2.9 and y <= 3.1", "min_delay": 1}
        self.write("spec.json", spec_with(constants={"most": 6}, safe="x + y <= most", requirements=[missed]))
        values = [6 + k / 100 for k in range(12)]
        text = self.run_program("analyze", "spec.json", "--sweep", "constants.most=" + ",".join(map(str, values))).stdout.decode()
        told = text[text.index("\nrequirement far: ") :].splitlines()[2:]
        self.assertEqual([line.split(":")[0] for line in told[:10]], [f"  FAILS in spec.json constants.most={value}" for value in values[:10]])
        self.assertEqual(told[10:12], ["  FAILS in 2 more of the 12 runs.", ""])


if __name__ == "__main__":
    unittest.main()
