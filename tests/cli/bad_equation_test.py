"""Equations that are undefined, blow up or are too stiff: one line with the state, the place and the expression."""

import json
import unittest

from program import SPEC, Case, spec_with


def system(equation, time="discrete", period=0.1, disturbance=1, effort=200, **changes):
    """One state x from -2 to 2, an input u of -1, 0 and 1, and a disturbance w."""
    state = {"name": "x", "lower": -2, "upper": 2, "step": 0.5, **changes}
    return spec_with(
        states=[{key: value for key, value in state.items() if value is not None}],
        inputs=SPEC["inputs"][:1],
        agents=SPEC["agents"][:1],
        disturbances=[{"name": "w", "lower": -disturbance, "upper": disturbance}],
        dynamics={"time": time, "period": period, "equations": {"x": equation}},
        safe="true",
        abstraction={**SPEC["abstraction"], "effort": effort},
    )


class Cases(Case):
    def assert_undefined(self, equation, place, reason, **options):
        message = f"the equation of 'x', '{equation}', is not defined everywhere near {place}: {reason}"
        self.assert_refused(message, equation, **options)

    def assert_may_escape(self, equation, place, **options):
        message = (
            f"the solution of 'x', with the equation '{equation}', may escape to infinity within one period "
            f"near {place}, or change too fast to be followed that long"
        )
        self.assert_refused(message, equation, time="continuous", **options)

    def assert_refused(self, message, equation, **options):
        with self.subTest(equation=equation):
            self.write("spec.json", system(equation, **options))
            self.assert_fails(3, f"{message} (/dynamics/equations/x)", "analyze", "spec.json")

    def assert_good(self, equation, **options):
        with self.subTest(equation=equation):
            return self.analyze("-", stdin=json.dumps(system(equation, **options)).encode())

    def test_division_by_zero(self):
        for time in ("discrete", "continuous"):
            self.assert_undefined("1/x", "x = 0", "division by a number in [-0.25, 0.25]", time=time)
            self.assert_undefined("sin(x)/x", "x = 0", "division by a number in [-0.25, 0.25]", time=time)
        self.assert_undefined("x^-2", "x = 0", "a number in [-0.25, 0.25] to the power of -2")
        self.assert_undefined("1/min(x, u)", "x = 0, u = 0", "division by a number in [-0.25, 0]")
        self.assert_undefined("1/sign(x)", "x = 0", "division by a number in [-1, 1]")

    def test_division_by_zero_at_a_face(self):
        domain = {"lower": 1, "upper": 5, "step": 2, "origin": 1}
        self.assert_undefined("1/x", "x = 1", "division by a number in [0, 2]", **domain)
        self.assert_undefined("1/x", "x = 1", "division by a number in [0, 2]", time="continuous", **domain)
        self.assert_good("1/x", **{**domain, "step": 1})

    def test_zero_by_zero(self):
        self.assert_refused("the equation of 'x', 'x + 0/0', is not defined or not finite", "x + 0/0")
        self.assert_refused("the equation of 'x', 'x*u/u', is not defined or not finite at u = 0", "x*u/u")

    def test_roots_and_logarithms(self):
        self.assert_undefined("sqrt(x) + u", "x = -2, u = -1", "square root of a number in [-2.25, -1.75]")
        self.assert_undefined("x^0.5", "x = -2", "a number in [-2.25, -1.75] to the power of 0.5")
        self.assert_undefined("log(abs(x))", "x = 0", "logarithm of a number in [0, 0.25]")
        self.assert_undefined("asin(x/2)", "x = -2", "asin of a number in [-1.125, -0.875]")
        self.assert_undefined("tan(x)", "x = -1.5", "tan of a number in [-1.75, -1.25]")
        self.assert_refused("the equation of 'x', 'log(0) + x', is not defined or not finite", "log(0) + x")

    def test_root_at_zero(self):
        tank = {"lower": 0.25, "upper": 2.25, "step": 0.5, "origin": 0.25}
        self.assert_good("sqrt(x)", **tank)
        # A tank that runs empty: where it may, the root needs a floor.
        self.write("spec.json", system("u - 2*sqrt(x)", time="continuous", **tank))
        result = self.run_program("analyze", "spec.json")
        self.assertEqual(result.returncode, 3)
        self.assertIn(
            "'u - 2*sqrt(x)', is not defined everywhere near x = 0.25, u = -1: square root of a number in [-",
            result.stderr.decode(),
        )
        self.assert_good("u - 2*sqrt(max(x, 0))", time="continuous", **tank)

    def test_branches_are_taken_with_their_whole_cell_unless_it_is_divided(self):
        equation = "if(abs(x) > 0.1, 1/x, 10)"
        self.assert_good(equation)
        self.assert_undefined(equation, "x = 0", "division by a number in [-0.25, 0.25]", effort=0)
        self.assert_good("if(abs(x) > 0.3, 1/x, 10)", effort=0)

    def test_measurement_error_reaches_beyond_the_cell(self):
        domain = {"lower": 1, "upper": 3, "step": 1, "origin": 0}
        self.assert_good("log(x)", **domain)
        self.assert_undefined(
            "log(x)", "x = 1", "logarithm of a number in [-0.25, 2.25]", measurement_error=0.75, **domain
        )

    def test_overflow(self):
        self.assert_refused("the next value of 'x', 'exp(1000*x)', has no bound near x = 0.5", "exp(1000*x)")
        self.assert_refused("the next value of 'x', '2^2^2^2^x', has no bound near x = 1.5", "2^2^2^2^x")
        self.assert_refused(
            "the next value of 'x', 'x^2*w*1e10', has no bound near x = -2", "x^2*w*1e10", disturbance=1e308
        )
        # Rational numbers do not overflow; all of it is far outside.
        self.assertEqual(self.assert_good("w*1e10", disturbance=1e308)["invariant"], 0)

    def test_finite_escape(self):
        self.assert_may_escape("x^2 + u", "x = 0.5, u = 1", period=1, outside="saturate")
        self.assert_may_escape("exp(1000*x)", "x = 0")
        # With unsafe sides the state has left before it escapes.
        self.assertGreater(self.assert_good("x^2 + u", time="continuous", period=1)["invariant"], 0)

    def test_stiff(self):
        for equation, period in (("-1e3*x + u", 1), ("-1e6*x + u", 1), ("-1e9*x + sin(x)", 10)):
            self.assert_good(equation, time="continuous", period=period)

    def test_extreme_periods(self):
        for period in (5e-324, 1e-12, 1e300):
            self.assert_good("sin(x) + u", time="continuous", period=period)

    def test_huge_disturbances(self):
        for size in (1e4, 1e300):
            found = self.assert_good("sin(x) + w + u", time="continuous", disturbance=size)
            self.assertEqual(found["invariant"], 0)

    def test_turning_very_fast(self):
        heading = {"step": None, "count": 8, "outside": "periodic"}
        found = self.assert_good("1e9*u", time="continuous", **heading)
        self.assertEqual(found["invariant"], 8)
        self.assert_may_escape("1e300*u*cos(x)", "x = -2, u = -1", **heading)

    def test_undefined_controller(self):
        spec = system("x + u")
        for allow, place in (("1/x > 0", 0), ("sqrt(x) >= 0", -2), ("u/x <= 1 or x > 1", 0)):
            with self.subTest(allow=allow):
                self.write("spec.json", {**spec, "controller": {"allow": allow}})
                result = self.run_program("analyze", "spec.json")
                self.assertEqual(result.returncode, 3)
                self.assertIn(f"'allow' cannot be decided at x = {place}", result.stderr.decode())

    def test_too_many_cells(self):
        self.write("spec.json", system("sin(x) + u", step=1e-5))
        result = self.run_program("analyze", "spec.json", "--max-memory", "1M")
        self.assertEqual((result.returncode, result.stdout), (4, b""))
        self.assertRegex(
            result.stderr.decode(),
            r"^coordreq: error: [0-9,]+ cells need about [0-9.]+ MiB of memory, the limit is 1\.0 MiB "
            r"\(--max-memory\)\n$",
        )
        self.write("spec.json", system("sin(x) + u", step=1e-9))
        self.assert_fails(
            4, "4000000001 grid points, at most 2147483646 are possible (/states/0)", "analyze", "spec.json"
        )


if __name__ == "__main__":
    unittest.main()
