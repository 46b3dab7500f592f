"""Every mistake in a spec is one line that says where it is, what was found and what was expected."""

import json
import unittest

from program import CONFIGS, SPEC, Case, spec_with

FUNCTIONS = (
    "if, mod, pow, atan2, min, max, sin, cos, tan, asin, acos, atan, sinh, cosh, tanh, exp, log, sqrt, abs, sign, floor"
)


def state(**changes):
    """A list of SPEC's states, the first one changed; a key set to None is left out."""
    first = {key: value for key, value in {**SPEC["states"][0], **changes}.items() if value is not None}
    return [first, SPEC["states"][1]]


class Cases(Case):
    def test_a_number_with_its_unit(self):
        for text in ("30 km/h", "0.5 m/s^2"):
            self.write("spec.json", spec_with(dynamics=dict(SPEC["dynamics"], period=text)))
            message = f"expected a number, found '{text}': units are separate, in \"unit\" (/dynamics/period)"
            self.assert_fails(3, message, "validate", "spec.json")
        self.write("spec.json", spec_with(states=state(upper="4 m")))
        message = "expected a number, found '4 m': units are separate, in \"unit\" (/states/0/upper)"
        self.assert_fails(3, message, "validate", "spec.json")

    def test_times_have_units_of_time(self):
        """A time is one in any unit of time, where the spec has such a unit."""
        requirement = {"name": "r", "where": "x == 2 and y == 2"}
        for period, least, steps in (("500ms", "1 s", 2), ("0.5 s", "1500 ms", 3), ("0.5", "0.025min", 3), (0.5, "0.1 s", 1)):
            dynamics = dict(SPEC["dynamics"], period=period)
            self.write("spec.json", spec_with(dynamics=dynamics, requirements=[dict(requirement, min_delay_time=least)]))
            result = self.run_program("analyze", "spec.json", "--json", "-o", "out.h5")
            self.assertIn(result.returncode, (0, 1), result.stderr)
            found = json.loads(result.stdout)
            self.assertEqual((found["period"], found["requirements"][0]["min_delay"]), (0.5, steps), (period, least))
        hours = dict(SPEC["dynamics"], period="10 min", unit="h")
        self.write("spec.json", spec_with(dynamics=hours))
        self.run_program("analyze", "spec.json", "-o", "out.h5", "--quiet")
        self.assertAlmostEqual(json.loads(self.run_program("info", "out.h5", "--json").stdout)["period"], 1 / 6)
        for unit, end in ((None, "not given"), ("round", "'round'")):
            own = {key: value for key, value in dict(SPEC["dynamics"], unit=unit, period="500ms").items() if value is not None}
            self.write("spec.json", spec_with(dynamics=own))
            message = f"found '500ms', expected a number: \"unit\" of \"dynamics\" is {end} (/dynamics/period)"
            self.assert_fails(3, message, "validate", "spec.json")

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

    def test_results_in_place_of_a_spec(self):
        self.write("results.h5", (CONFIGS / "first_come.h5").read_bytes())
        self.assert_fails(3, "is HDF5 as results are, expected a spec (results.h5)", "analyze", "results.h5")

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

    def assert_all_are_told(self, messages, spec):
        """One line each, in this order."""
        self.write("spec.json", spec)
        for command in ("validate", "analyze"):
            result = self.run_program(command, "spec.json")
            self.assertEqual(result.stderr.decode().splitlines(), [f"coordreq: error: {text}" for text in messages])
            self.assertEqual((result.returncode, result.stdout), (3, b""))

    def test_several_errors_of_form(self):
        agents = [{"name": "a", "inputs": ["u"], "prefers": "0"}, {"nam": "b", "inputs": ["v"]}]
        self.assert_all_are_told(
            [
                "missing key 'dynamics' (top level)",
                "missing key 'safe' (top level)",
                "unknown key 'prefers', did you mean 'prefer'? (/agents/0)",
                "unknown key 'nam', did you mean 'name'? (/agents/1)",
                "expected a string, found 7 (/description)",
            ],
            spec_with(agents=agents, safe=None, dynamics=None, description=7),
        )

    def test_several_errors_of_meaning(self):
        equations = {"x": "x + w", "y": "atan3(y, v)"}
        requirements = [
            {"name": "near", "where": "x <", "invariant": True},
            {"name": "near", "where": "z < 1", "invariant": True},
        ]
        self.assert_all_are_told(
            [
                "expected a step > 0, found 0 (/states/0/step)",
                "expected upper >= lower = 1, found 0 (/disturbances/0/upper)",
                "'w' is not defined (/dynamics/equations/x, column 5)",
                f"'atan3' is not a function, expected one of {FUNCTIONS} (/dynamics/equations/y, column 1)",
                "expected a condition, found a number (/safe, column 1)",
                "expected a number, a name or '(', found the end (/requirements/0/where, column 4)",
                "the requirement 'near' is listed twice (/requirements/1/name)",
                "'z' is not defined (/requirements/1/where, column 1)",
            ],
            spec_with(
                states=state(step=0),
                disturbances=[{"name": "d", "lower": 1, "upper": 0}],
                dynamics={"time": "discrete", "period": 1, "equations": equations},
                safe="x + y",
                requirements=requirements,
            ),
        )

    def test_what_rests_on_an_error_is_not_told(self):
        self.assert_all_are_told(
            ["'q' is not defined (/definitions/a, column 1)", "'r' is not defined (/definitions/c, column 1)"],
            spec_with(definitions={"a": "q", "b": "a + 1", "c": "r"}, safe="b + c <= 6"),
        )

    def test_ten_errors_are_enough(self):
        requirements = [{"name": f"n{i}", "where": f"z{i} < 1", "invariant": True} for i in range(20)]
        self.assert_all_are_told(
            [f"'z{i}' is not defined (/requirements/{i}/where, column 1)" for i in range(10)],
            spec_with(requirements=requirements),
        )

    def test_several_errors_in_one_of_several_specs(self):
        self.write("good.json", SPEC)
        self.write("bad.json", spec_with(safe="z < 1", description=7, name=8))
        result = self.run_program("analyze", "good.json", "bad.json")
        name = (
            "a name of at most 200 letters, digits, blanks, '_', '.' and '-' that starts with none of ' ', '.' and '-' "
            "and does not end with ' '"
        )
        lines = ("expected a string, found 7 (/description)", f"expected {name}, found 8 (/name)")
        self.assertEqual(result.stderr.decode(), "".join(f"coordreq: error: bad.json: {line}\n" for line in lines))
        self.assertEqual(result.returncode, 3)

    def test_trailing_comma(self):
        text = '{\n  "coordreq": 1, // one\n  "name": "x", /* two */ // three\n}\n'
        self.assert_rejected("expected no comma before '}', found a trailing one (spec.json, line 3, column 14)", text)
        text = '{"states": [1, 2 , ]}'
        self.assert_rejected("expected no comma before ']', found a trailing one (spec.json, line 1, column 18)", text)
        text = '{"states": [,]}'
        self.assert_rejected("expected a value, found ',' (spec.json, line 1, column 13)", text)

    def test_bars_of_an_absolute_value(self):
        found = "expected a number, a name or '(', found"
        self.assert_rejected(f"{found} '|', did you mean 'abs(x - y)'? (/safe, column 1)", spec_with(safe="|x - y| <= 6"))
        self.assert_rejected(f"{found} '||', did you mean 'abs(...)'? (/safe, column 5)", spec_with(safe="1 + ||x| - 1| <= 6"))
        self.assert_rejected(
            "expected an operator or the end, found '|', did you mean '||'? (/safe, column 7)",
            spec_with(safe="x < 1 | y < 1"),
        )

    def test_undefined_name(self):
        self.assert_rejected("'z' is not defined (/safe, column 5)", spec_with(safe="x + z <= 6"))

    def test_name_that_is_almost_one(self):
        definitions = {"distance": "x - y", "far": "distence > 3"}
        self.assert_all_are_told(
            ["'distence' is not defined, did you mean 'distance'? (/definitions/far, column 1)"],
            spec_with(definitions=definitions),
        )
        self.assert_rejected(
            "'faster' is not defined, did you mean 'fastest'? (/states/0/upper, column 3)",
            spec_with(constants={"fastest": 2}, states=state(upper="2*faster")),
        )
        self.assert_rejected("'x1' is not defined (/safe, column 1)", spec_with(safe="x1 <= 6"))

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
