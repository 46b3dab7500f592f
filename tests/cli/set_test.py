"""`--set PATH=VALUE`: another value in the spec, before it is checked."""

import hashlib
import json
import unittest

import h5py
from program import CONFIGS, SPEC, Case, without_comments

COMMENTED = json.dumps(SPEC, indent=2).replace('"safe":', '// what must hold\n  "safe":')


class Cases(Case):
    def stored_spec(self, path="small.h5"):
        """The text in a results file, whose digest it must fit."""
        with h5py.File(self.folder / path) as file:
            text = file["spec"][()].decode()
            self.assertEqual(file.attrs["spec_sha256"], hashlib.sha256(text.encode()).hexdigest())
        return text

    def test_a_refinement_divides_all_steps(self):
        self.write("spec.json", COMMENTED)
        refined = self.analyze("spec.json", "--refine", "2")
        self.assertEqual(refined["cells"], 81)
        self.assertEqual([state["step"] for state in json.loads(self.stored_spec())["states"]], [0.5, 0.5])
        by_hand = self.analyze("spec.json", "--set", "states.0.step=0.5", "--set", "states.1.step=1/2")
        for key in ("cells", "safe", "invariant", "iterations", "partitions"):
            self.assertEqual(refined[key], by_hand[key])
        # It comes last, and 1 changes nothing.
        self.assertEqual(self.analyze("spec.json", "--refine", "2", "--set", "states.0.step=2")["cells"], 45)
        self.assertEqual(self.analyze("spec.json", "--refine", "1")["cells"], 25)
        self.assertEqual(json.loads(self.run_program("validate", "spec.json", "--refine", "3", "--json").stdout)["cells"], 169)

    def test_sweeps_of_refinements(self):
        self.write("spec.json", COMMENTED)
        document = json.loads(
            self.run_program("analyze", "spec.json", "--sweep", "refine=1,2,4", "--json", "-o", ".").stdout
        )
        self.assertEqual([run["summary"]["cells"] for run in document["runs"]], [25, 81, 289])
        self.assertEqual([run["values"] for run in document["runs"]], [{"refine": n} for n in (1, 2, 4)])
        self.assertEqual(self.files(), [*(f"small_refine={n}.h5" for n in (1, 2, 4)), "spec.json"])

    def test_refinements_that_are_none(self):
        self.write("spec.json", COMMENTED)
        for value in ("0", "1.5", "x", "1000001"):
            message = f"expected a whole number from 1 to 1000000, found '{value}'"
            self.assert_fails(2, f"{message} (--refine)", "analyze", "spec.json", "--refine", value)
        result = self.run_program("analyze", "spec.json", "--refine", "2", "--sweep", "refine=1,2")
        self.assertEqual(result.returncode, 2)
        self.assertIn(b"expected one refinement, found --refine and --sweep refine", result.stderr)

    def test_file_has_the_spec_that_was_analysed(self):
        self.write("spec.json", COMMENTED)
        summary = self.analyze("spec.json", "--set", "states.0.step=0.5", "--set", "safe=x + y <= 5")
        self.assertEqual(summary["cells"], 45)
        expected = COMMENTED.replace('"step": 1', '"step": 0.5', 1).replace("x + y <= 6", "x + y <= 5")
        self.assertEqual(json.loads(self.stored_spec()), json.loads(without_comments(expected)))
        self.assertEqual((self.folder / "spec.json").read_text(), COMMENTED)
        self.assertEqual(self.run_program("verify", "small.h5").returncode, 0)

    def test_equals_the_spec_that_says_so(self):
        self.write("spec.json", COMMENTED)
        self.analyze("spec.json", "--set", "safe=x + y <= 5", "-o", "a.h5")
        self.write("other.json", self.stored_spec("a.h5"))
        self.analyze("other.json", "-o", "b.h5")
        self.assertEqual((self.folder / "a.h5").read_bytes(), (self.folder / "b.h5").read_bytes())

    def test_names_and_pointers(self):
        self.write("spec.json", SPEC)
        for path in ("states.1.upper", "states.y.upper", "/states/1/upper"):
            with self.subTest(path=path):
                self.assertEqual(self.analyze("spec.json", "--set", f"{path}=6")["cells"], 35)

    def test_the_last_one_counts(self):
        self.write("spec.json", SPEC)
        arguments = ("--set", "states.y.upper=6", "--set", "states.y.upper=7")
        self.assertEqual(self.analyze("spec.json", *arguments)["cells"], 40)

    def test_optional_keys_may_be_added(self):
        self.write("spec.json", SPEC)
        summary = self.analyze("spec.json", "--set", "coordination.max_delay=1", "--set", "output.layers=true")
        self.assertTrue(summary["partitions"][0]["truncated"])
        with h5py.File(self.folder / "small.h5") as file:
            self.assertIn("layers", file)

    def test_validate(self):
        result = self.run_program("validate", str(CONFIGS / "circle.json"), "--json", "--set", "constants.R=1/2")
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        self.assertEqual(json.loads(result.stdout)["cells"], 40401)

    def test_standard_input(self):
        text = json.dumps(SPEC).encode()
        self.assertEqual(self.analyze("-", "--set", "states.y.upper=6", stdin=text)["cells"], 35)

    def test_values(self):
        """JSON is taken as JSON, everything else as text."""
        self.write("spec.json", SPEC)
        for value in ("2", "2.0", "4/2", '"4/2"', "sqrt(4)"):
            with self.subTest(value=value):
                self.assertEqual(self.analyze("spec.json", "--set", f"states.x.step={value}")["cells"], 15)
        self.assert_fails(
            3,
            "expected a string with a condition, found true (/safe)",
            *("validate", "spec.json", "--set", "safe=true"),
        )
        result = self.run_program("validate", "spec.json", "--set", 'safe="true"')
        self.assertEqual((result.returncode, result.stderr), (0, b""))

    def test_no_such_place(self):
        self.write("spec.json", dict(SPEC, constants={"R": 1}))
        for setting, message in (
            ("states.2.step=1", "no '2' in states, expected 'x' or 'y', or a number from 0 to 1 (states.2.step)"),
            ("states.z.step=1", "no 'z' in states, expected 'x' or 'y', or a number from 0 to 1 (states.z.step)"),
            ("name.first=1", "no 'first' in name: it is '\"small\"' (name.first)"),
            ("constants.r=1", "'r' is not one of the constants, did you mean 'R'? (constants.r)"),
        ):
            with self.subTest(setting=setting):
                self.assert_fails(2, message, "analyze", "spec.json", "--set", setting)

    def test_constant_of_a_spec_without_any(self):
        self.write("spec.json", SPEC)
        message = "'q' is not one of the constants: there are none (constants.q)"
        self.assert_fails(2, message, "analyze", "spec.json", "--set", "constants.q=1")

    def test_text_that_is_not_utf8(self):
        self.write("spec.json", SPEC)
        for setting in (b"\xff=1", b"constants.\xff=1", b"/\xff=1"):
            with self.subTest(setting=setting):
                path = setting[:-2].decode(errors="backslashreplace")
                message = f"expected UTF-8 text as the path, found '{path}'"
                self.assert_fails(2, message, "validate", "spec.json", "--set", setting)
                result = self.run_program("analyze", "spec.json", "--quiet", "--sweep", setting + b",2")
                self.assertEqual((result.returncode, result.stdout), (2, b""))
                self.assertIn(message, result.stderr.decode())
        message = "expected UTF-8 text as the value (name)"
        self.assert_fails(2, message, "validate", "spec.json", "--set", b"name=\xff")

    def test_misspelt_keys(self):
        self.write("spec.json", SPEC)
        for setting, message in (
            ("states.0.stpe=1", "unknown key 'stpe', did you mean 'step'? (/states/0)"),
            ("stats.0.step=1", "unknown key 'stats', did you mean 'states'? (top level)"),
        ):
            with self.subTest(setting=setting):
                self.assert_fails(3, message, "analyze", "spec.json", "--set", setting)

    def test_no_setting(self):
        for setting in ("constants.R", "=1", ""):
            with self.subTest(setting=setting):
                message = f"expected PATH=VALUE, e.g. constants.R=0.7, found '{setting}' (--set)"
                self.assert_fails(2, message, "analyze", "spec.json", "--set", setting)
        self.write("spec.json", SPEC)
        self.assert_fails(
            2,
            "expected keys with dots between, e.g. states.0.step, found 'states..step'",
            *("analyze", "spec.json", "--set", "states..step=1"),
        )
        self.assert_fails(
            2,
            "expected JSON, since it starts like it, found '[1' (inputs.0.values)",
            *("analyze", "spec.json", "--set", "inputs.0.values=[1"),
        )

    def test_value_that_the_spec_cannot_have(self):
        self.write("spec.json", SPEC)
        self.assert_fails(
            3,
            "expected a step > 0, found -1 (/states/0/step)",
            *("analyze", "spec.json", "--set", "states.0.step=-1"),
        )


if __name__ == "__main__":
    unittest.main()
