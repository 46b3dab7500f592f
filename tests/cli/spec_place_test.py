"""Errors of a spec name the line and column of the value that they are about, or what has set it."""

import json
import unittest

from program import SPEC, Case, spec_with

# Line 1 is the brace; comments and a key with a quote in it come before what is wrong.
COMMENTED = """{
  // "states": nothing
  "coordreq": 1, "name": "small",  /* "safe":
  5 */ "description": "a \\"safe\\": {[ b",
  "states": [
    { "name": "x", "lower": 0, "upper": 4, "step": 1, "unit": "m" },
    { "name": "y", "lower": 0, "upper": 4, "unit": "m",
      "step": 1 }
  ],
  "inputs": [{ "name": "u", "values": [-1, 0, 1] }, { "name": "v", "values": [-1, 0, 1] }],
  "agents": [{ "name": "a", "inputs": ["u"] }, { "name": "b", "inputs": ["v"] }],
  "dynamics": { "time": "discrete", "period": 0.5, "unit": "s",
    "equations": { "x": "x + u", "y": "y + v" } },
  "safe": "x + y <= 6"
}
"""


class Cases(Case):
    shows_places = True

    def assert_said(self, text, *messages, settings=()):
        self.write("spec.json", text)
        for command in ("validate", "analyze"):
            result = self.run_program(command, "spec.json", *settings)
            errors = [line for line in result.stderr.decode().splitlines() if not line.startswith("coordreq: warning: ")]
            self.assertEqual(errors, [f"coordreq: error: {message}" for message in messages])
            self.assertEqual(result.returncode, 3)

    def test_a_value_in_a_text_with_comments(self):
        self.assert_said(
            COMMENTED.replace('"step": 1 }', '"step": -1 }'),
            "expected a step > 0, found -1 (/states/1/step; line 8, column 15)",
        )

    def test_columns_are_those_of_characters(self):
        text = COMMENTED.replace('"coordreq": 1', '/* \u00e9\u00e9 */ "coordreq": 2')
        self.assert_said(text, "this program reads spec format 1, found 2 (/coordreq; line 3, column 24)")
        self.assert_said("\ufeff" + text, "this program reads spec format 1, found 2 (/coordreq; line 3, column 24)")

    def test_an_object_or_a_list(self):
        text = COMMENTED.replace(', "y": "y + v"', "")
        self.assert_said(text, "missing equation for the state 'y' (/dynamics/equations; line 13, column 18)")

    def test_a_place_in_an_expression_stays(self):
        self.assert_said(
            COMMENTED.replace("x + y <= 6", "x + + <= 6"),
            "expected a number, a name or '(', found '<=' (/safe, column 7; line 14, column 11)",
        )

    def test_several_errors(self):
        text = COMMENTED.replace('"x + u"', '"x + q"').replace("x + y <= 6", "x + p <= 6")
        self.write("spec.json", text)
        lines = self.run_program("validate", "spec.json").stderr.decode().splitlines()
        self.assertEqual([line.split("; ")[1] for line in lines], ["line 13, column 25)", "line 14, column 11)"])

    def test_what_shows_only_when_the_system_is_built(self):
        """A discrete state that would not come to a point of its grid."""
        text = COMMENTED.replace('"step": 1 }', '"step": 1, "discrete": true }').replace("y + v", "y + v/2")
        self.write("spec.json", text)
        for command in ("validate", "analyze"):
            result = self.run_program(command, "spec.json")
            self.assertEqual(result.returncode, 3)
            self.assertTrue(result.stderr.endswith(b" (/dynamics/equations/y; line 13, column 39)\n"), result.stderr)

    def test_a_key_that_needs_an_escape(self):
        text = COMMENTED.replace('"coordreq": 1,', '"coordreq": 1, "constants": { "a/b": 1 },')
        self.write("spec.json", text)
        line = self.run_program("validate", "spec.json").stderr.decode()
        self.assertTrue(line.endswith("; line 3, column 38)\n") or "/constants)" in line or "; line 3, column 31)" in line, line)

    def test_what_is_not_there_or_no_value_has_no_place(self):
        self.assert_said(
            COMMENTED.replace('"safe": "x', '"saef": "x'),
            "unknown key 'saef', did you mean 'safe'? (top level)",
        )
        self.assert_said("{\n", "expected a key in double quotes, found the end of the file (spec.json, line 2, column 1)")

    def test_a_value_that_was_set_says_by_what(self):
        message = "expected a step > 0, found -1 (/states/1/step; set by states.y.step=-1)"
        self.assert_said(COMMENTED, message, settings=("--set", "states.y.step=-1"))
        # What was not set stands where it stands in the file, not in the text with the settings.
        text = COMMENTED.replace("x + y <= 6", "x + p <= 6")
        self.assert_said(
            text, "'p' is not defined (/safe, column 5; line 14, column 11)", settings=("--set", "states.y.step=2")
        )

    def test_a_sweep_says_so_in_its_label(self):
        self.write("spec.json", json.dumps(SPEC))
        result = self.run_program("analyze", "spec.json", "--sweep", "states.0.step=1,-1")
        self.assertEqual(
            [line for line in result.stderr.decode().splitlines() if "error" in line],
            [
                "coordreq: error: spec.json states.0.step=-1: expected a step > 0, found -1 "
                "(/states/0/step; set by states.0.step=-1)"
            ],
        )

    def test_standard_input(self):
        text = json.dumps(spec_with(safe=5), indent=1).encode()
        result = self.run_program("validate", "-", stdin=text)
        line = 1 + text[: text.index(b'"safe"')].count(b"\n")
        self.assertEqual(
            result.stderr.decode(),
            f"coordreq: error: expected a string with a condition, found 5 (/safe; line {line}, column 10)\n",
        )


if __name__ == "__main__":
    unittest.main()
