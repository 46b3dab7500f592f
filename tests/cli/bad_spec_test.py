"""Every mistake in a spec is one line that says where it is, what was found and what was expected."""

import json
import unittest

from program import SPEC, Case, spec_with


def state(**changes):
    """A list of SPEC's states, the first one changed; a key set to None is left out."""
    first = {key: value for key, value in {**SPEC["states"][0], **changes}.items() if value is not None}
    return [first, SPEC["states"][1]]


class Cases(Case):
    def assert_rejected(self, message, spec, code=3):
        self.write("spec.json", spec)
        for command in ("validate", "analyze"):
            self.assert_fails(code, message, command, "spec.json")

    def test_good_spec_is_accepted(self):
        self.write("spec.json", SPEC)
        self.assertEqual(self.run_program("validate", "spec.json").returncode, 0)

    def test_file_that_is_not_there(self):
        self.assert_fails(5, "no such file (no.json)", "analyze", "no.json")

    def test_folder(self):
        self.assert_fails(5, "is a folder, expected a spec file (.)", "analyze", ".")

    def test_empty_file(self):
        self.assert_rejected("the file is empty, expected a spec (spec.json)", "")

    def test_empty_standard_input(self):
        self.assert_fails(3, "the file is empty, expected a spec (standard input)", "analyze", "-")

    def test_broken_json(self):
        self.assert_rejected(
            "expected a value, found 'circle' (spec.json, line 3, column 11)",
            '{\n  "coordreq": 1,\n  "name": circle\n}\n',
        )

    def test_text_after_the_document(self):
        self.assert_rejected(
            "expected the end of the file, found '{' (spec.json, line 2, column 1)",
            json.dumps(SPEC) + "\n{}\n",
        )

    def test_not_a_number(self):
        self.assert_rejected(
            "expected a value, found 'NaN' (spec.json, line 1, column 91)",
            json.dumps(spec_with(states=state(step=float("nan")))),
        )

    def test_not_utf8(self):
        self.assert_rejected(
            "expected UTF-8 text, found the byte 0xFF (spec.json, line 1, column 27)",
            b'{ "coordreq": 1, "name": "\xff" }',
        )

    def test_not_an_object(self):
        self.assert_rejected(
            "expected an object that describes a problem, found a list of 2 (top level)", "[1, 2]"
        )

    def test_another_format(self):
        self.assert_rejected("this program reads spec format 1, found 2 (/coordreq)", spec_with(coordreq=2))

    def test_unknown_key(self):
        self.assert_rejected("unknown key 'saef', did you mean 'safe'? (top level)", spec_with(saef="true"))

    def test_repeated_key(self):
        self.assert_rejected("repeated key 'name' (top level)", json.dumps(SPEC)[:-1] + ', "name": "again"}')

    def test_wrong_type(self):
        self.assert_rejected("expected a string with a condition, found 5 (/safe)", spec_with(safe=5))

    def test_missing_key(self):
        self.assert_rejected("missing key 'safe' (top level)", spec_with(safe=None))

    def test_missing_equation(self):
        self.assert_rejected(
            "missing equation for the state 'y' (/dynamics/equations)",
            spec_with(dynamics={"time": "discrete", "period": 1, "equations": {"x": "x + u"}}),
        )

    def test_input_of_no_agent(self):
        self.assert_rejected(
            "the input 'v' belongs to no agent (/agents)", spec_with(agents=[{"name": "a", "inputs": ["u"]}])
        )

    def test_input_of_two_agents(self):
        agents = [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v", "u"]}]
        self.assert_rejected(
            "the input 'u' belongs to the agent 'a' already (/agents/1/inputs/1)", spec_with(agents=agents)
        )

    def test_unknown_input_of_an_agent(self):
        self.assert_rejected(
            "'w' is not an input (/agents/2/inputs/0)",
            spec_with(agents=SPEC["agents"] + [{"name": "c", "inputs": ["w"]}]),
        )

    def test_undefined_name(self):
        self.assert_rejected("'z' is not defined (/safe, column 5)", spec_with(safe="x + z <= 6"))

    def test_cyclic_definition(self):
        self.assert_rejected(
            "cycle of definitions: p -> q -> p (/definitions/p)",
            spec_with(definitions={"p": "q + 1", "q": "2*p"}, safe="p <= 6"),
        )

    def test_wrong_number_of_arguments(self):
        self.assert_rejected(
            "min takes 2 or more arguments, found 1 (/safe, column 1)", spec_with(safe="min(x) <= 6")
        )

    def test_number_where_a_condition_is_wanted(self):
        self.assert_rejected(
            "expected a condition, found a number (/safe, column 1)", spec_with(safe="x + y")
        )

    def test_broken_expression(self):
        self.assert_rejected(
            "expected a number, a name or '(', found '<=' (/safe, column 5)", spec_with(safe="x + <= 6")
        )

    def test_step_zero(self):
        self.assert_rejected("expected a step > 0, found 0 (/states/0/step)", spec_with(states=state(step=0)))

    def test_step_negative(self):
        self.assert_rejected(
            "expected a step > 0, found -1 (/states/0/step)", spec_with(states=state(step=-1))
        )

    def test_step_not_finite(self):
        self.assert_rejected("'1/0' divides by zero (/states/0/step)", spec_with(states=state(step="1/0")))

    def test_step_beyond_every_number(self):
        text = json.dumps(SPEC).replace('"step": 1', '"step": 1e999', 1)
        self.assert_rejected(
            "number beyond the range of a double: '1e999' (spec.json, line 1, column 91)", text
        )

    def test_step_wider_than_the_range_leaves_one_point(self):
        self.write("spec.json", spec_with(states=state(step=7)))
        report = json.loads(self.run_program("validate", "spec.json", "--json").stdout)
        self.assertEqual([entry["points"] for entry in report["states"]], [1, 5])

    def test_no_step(self):
        self.assert_rejected(
            "missing key: one of 'step' or 'count' (/states/0)", spec_with(states=state(step=None))
        )

    def test_lower_above_upper(self):
        self.assert_rejected(
            "expected upper >= lower = 5, found 4 (/states/0/upper)", spec_with(states=state(lower=5))
        )

    def test_no_grid_point_in_the_range(self):
        self.assert_rejected(
            "no grid point 0 + k*1 lies in [0.25, 0.75] (/states/0)",
            spec_with(states=state(lower=0.25, upper=0.75)),
        )

    def test_duplicate_names(self):
        self.assert_rejected(
            "the name 'y' is taken, it stands at /states/0/name too (/states/1/name)",
            spec_with(states=state(name="y")),
        )

    def test_name_of_a_function(self):
        self.assert_rejected(
            "'sin' is a function or keyword, expected another name (/states/0/name)",
            spec_with(states=state(name="sin")),
        )

    def test_name_of_a_dataset(self):
        self.assert_rejected(
            "'delay' is a dataset of the results file, expected another name (/states/0/name)",
            spec_with(states=state(name="delay")),
        )

    def test_user_text_stays_on_one_line(self):
        self.assert_rejected(
            "expected an operator or the end, found U+001B (/safe, line 2, column 1)",
            spec_with(safe="x <= 6\n\x1b[31m"),
        )

    def test_expression_nested_too_deep(self):
        self.assert_rejected(
            "the expression is nested deeper than 1000 levels (/safe, column 1001)",
            spec_with(safe="(" * 10000 + "x" + ")" * 10000 + " <= 6"),
        )

    def test_document_nested_too_deep(self):
        self.assert_rejected(
            "nested deeper than 200 levels (spec.json, line 1, column 201)", "[" * 100000
        )

    def test_discrete_state_off_its_grid(self):
        states = state(discrete=True)
        dynamics = {"time": "discrete", "period": 1, "equations": {"x": "x + u/2", "y": "y + v"}}
        self.write("spec.json", spec_with(states=states, dynamics=dynamics))
        self.assert_fails(
            3,
            "the next value of the discrete state 'x' is -0.5 at x = 0, u = -1, expected 0 + k "
            "* 1 with an integer k "
            "(/dynamics/equations/x)",
            "analyze",
            "spec.json",
        )


if __name__ == "__main__":
    unittest.main()
