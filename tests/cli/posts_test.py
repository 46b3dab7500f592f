"""Posts as a results file tells them: hardly wider than what is reached, and there wherever there is an answer."""

import itertools
import math
import unittest

import h5py
from program import Case


def state(name, middle, step, **keys):
    """Three grid points."""
    keys = {"outside": "saturate", **keys}
    return {"name": name, "lower": f"{middle} - {step}", "upper": f"{middle} + {step}", "step": step, **keys}


def spec(states, equations, period, inputs=(0,), time="continuous", disturbances=()):
    return {
        "coordreq": 1,
        "name": "posts",
        "states": states,
        "inputs": [{"name": "u", "values": list(inputs)}],
        "disturbances": [{"name": name, "lower": lower, "upper": upper} for name, lower, upper in disturbances],
        "agents": [{"name": "a", "inputs": ["u"]}],
        "dynamics": {"time": time, "period": period, "equations": equations},
        "safe": "true",
        "output": {"abstraction": True},
    }


def reached(slope, box, period, signals, steps=60):
    """The hull of ends of solutions from a box's corners, each signal a list of pieces, by Runge and Kutta."""
    ends = []
    for start, signal in itertools.product(itertools.product(*box), signals):
        x, h = list(start), period / steps
        for k in range(steps):
            w = signal[k * len(signal) // steps]
            k1 = slope(x, w)
            k2 = slope([a + h / 2 * b for a, b in zip(x, k1)], w)
            k3 = slope([a + h / 2 * b for a, b in zip(x, k2)], w)
            k4 = slope([a + h * b for a, b in zip(x, k3)], w)
            x = [a + h / 6 * (b + 2 * c + 2 * d + e) for a, b, c, d, e in zip(x, k1, k2, k3, k4)]
        ends.append(x)
    return [(min(values), max(values)) for values in zip(*ends)]


class Cases(Case):
    def posts(self, **index):
        """The range of indices that each state can have next, from the cell at these indices."""
        result = {}
        with h5py.File(self.folder / "o.h5") as file:
            for name, group in file["abstraction"].items():
                place = tuple(index.get(axis[0].name.strip("/"), 0) for axis in group["first"].dims)
                result[name] = (int(group["first"][place]), int(group["last"][place]))
        return result

    def assert_tight(self, slope, middles, steps, equations, period, signals=((None,),), inputs=(0,), disturbances=(), beyond=1):
        """The middle cell's post holds what is reached, and no more than so many cells beyond it."""
        names = list(equations)
        states = [state(*triple) for triple in zip(names, middles, steps)]
        self.write("s.json", spec(states, equations, period, inputs, disturbances=disturbances))
        self.analyze("s.json", "-o", "o.h5")
        found = self.posts(**{name: 1 for name in names})
        box = [(m - s / 2, m + s / 2) for m, s in zip(middles, steps)]
        for name, middle, step, (low, high) in zip(names, middles, steps, reached(slope, box, period, signals)):
            first, last = (math.ceil((end - middle) / step + 1 + side) for end, side in ((low, -0.5), (high, -0.5)))
            with self.subTest(state=name, reached=(low, high), post=found[name]):
                self.assertLessEqual(found[name][0], first)
                self.assertGreaterEqual(found[name][1], last - 1)
                self.assertGreaterEqual(found[name][0], first - 1 - beyond)
                self.assertLessEqual(found[name][1], last + beyond)

    def test_state_times_disturbance(self):
        self.assert_tight(
            lambda x, d: [d * d - d * x[0]],
            *((0,), (0.2,), {"x": "d^2 - d*x + 0.3*u"}, 1),
            signals=list(itertools.product((-1, 0.5, 2), repeat=3)),
            disturbances=[("d", -1, 2)],
        )

    def test_two_states_times_two_disturbances(self):
        corners = list(itertools.product((-1, 1), repeat=2))
        self.assert_tight(
            lambda x, w: [x[1] * w[0] + x[0] * w[1], -x[0] - w[0]],
            *((0.5, 0.3), (0.1, 0.1), {"x": "y*d + x*e", "y": "-x + u*d"}, 1),
            signals=list(itertools.product(corners, repeat=3)),
            inputs=(-1,),
            disturbances=[("d", -1, 1), ("e", -1, 1)],
            beyond=10,  # where they multiply both states, signals that differ for each end are not told apart
        )

    def test_a_turn_and_a_half(self):
        self.assert_tight(
            lambda x, _: [9 * x[1] + 1, -9 * math.sin(x[0])],
            *((0.8, 0.3), (0.1, 0.1), {"x": "9*y + u", "y": "-9*sin(x)"}, 1),
            inputs=(1,),
        )

    def test_friction(self):
        self.assert_tight(
            lambda x, _: [x[1], 0.25 - 0.5 * (1 if x[1] > 0 else -1)],
            *((0.05, 0.2), (0.1, 0.1), {"x": "y", "y": "u - 0.5*sign(y)"}, 0.8),
            inputs=(0.25,),
        )

    def assert_solved(self, states, equations, period, **changes):
        self.write("s.json", {**spec(states, equations, period, (-1, 1)), **changes})
        self.analyze("s.json", "-o", "o.h5", "--quiet")

    def test_what_leaves_before_it_escapes(self):
        unsafe = [{"name": name, "lower": -1, "upper": 1, "step": 0.25} for name in "xy"]
        self.assert_solved(unsafe, {"x": "0.1*y", "y": "-5*y^2 - 2"}, 1)
        pole = [{"name": "x", "lower": -1.6, "upper": 1.6, "step": 0.2}]
        self.assert_solved(pole, {"x": "u - 1/(2 + x)"}, 0.5)

    def test_stiff_systems(self):
        fine = [state(name, 0.5, 0.1) for name in "xy"]
        self.assert_solved(fine, {"x": "-1e5*(x - y)", "y": "u"}, 0.1)
        self.assert_solved(fine, {"x": "-1e5*(x - sin(y))", "y": "u"}, 0.1)

    def test_kinetics_of_robertson(self):
        """Solved for a while; for longer the rate is named that stands against it."""
        kinetics = [dict(state(name, 0.5, 0.5), origin=0.25, lower=0.25, upper=0.75) for name in "xyz"]
        equations = {"x": "-0.04*x + 1e4*y*z", "y": "0.04*x - 1e4*y*z - 3e7*y^2", "z": "3e7*y^2"}
        self.assert_solved(kinetics, equations, 0.001)
        self.write("s.json", spec(kinetics, equations, 1))
        result = self.run_program("analyze", "s.json", "-o", "o.h5")
        self.assertEqual(result.returncode, 3)
        self.assertIn(b"is too stiff near x = 0.25, y = 0.25, z = 0.25: it decays at a rate of 3e+07", result.stderr)

    def test_limits_count_only_where_they_are_reached(self):
        place = {"name": "p", "lower": -2, "upper": 2, "step": 0.5, "outside": "saturate"}
        speed = {"name": "v", "lower": -1, "upper": 1, "step": 0.25}
        found = []
        for outside in ("stop", "saturate"):
            self.assert_solved([place, {**speed, "outside": outside}], {"p": "v", "v": "u"}, 0.5)
            found.append([self.posts(p=4, v=v, u=u) for v in (3, 4, 5) for u in (0, 1)])
        self.assertEqual(*found)

    def test_shifts_as_far_as_indices_go(self):
        heading = {"name": "h", "lower": 0, "upper": 1, "count": 10, "outside": "periodic"}
        self.write("s.json", spec([heading], {"h": "h + 214748364.3"}, 1, time="discrete"))
        self.analyze("s.json", "-o", "o.h5", "--quiet")
        result = self.run_program("verify", "o.h5", "--strict")
        self.assertEqual((result.returncode, result.stderr), (0, b""), result.stdout)


if __name__ == "__main__":
    unittest.main()
