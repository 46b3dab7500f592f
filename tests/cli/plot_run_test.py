"""The figure of a simulation: lines that show only what the system did between its samples."""

import math
import unittest

import numpy as np
from plot_case import PlotCase, covered, example, labels, titles
from plotting.style import new_figure
from program import SPEC, spec_with

# A heater that is on or off, and where it may be on.
HEATER = spec_with(
    states=[
        {"name": "T", "lower": 14, "upper": 26, "step": 0.5, "unit": "degC"},
        {"name": "h", "lower": 0, "upper": 2, "step": 1, "discrete": True},
    ],
    definitions={"strong": "h - 1.5"},
    dynamics={
        "time": "continuous",
        "period": 0.5,
        "unit": "s",
        "equations": {"T": "h - 1 + u/4 + v/4"},
        "updates": {"h": "if(T < 19, 2, if(T > 21, 0, h))"},
    },
    safe="T >= 15 and T <= 25",
)
# Two that go round, by more in a step than they can go back.
RING = spec_with(
    states=[
        {"name": "a", "lower": 0, "upper": 4, "count": 8, "outside": "periodic"},
        {"name": "b", "lower": 0, "upper": 4, "count": 8, "outside": "periodic"},
    ],
    dynamics={"time": "continuous", "period": 1, "unit": "s", "equations": {"a": "0.75 + u/4", "b": "-0.75 + v/4"}},
    safe="true",
)


def at(line, time):
    """What the line shows at some times."""
    x, y = np.asarray(line.get_xydata()).T
    return np.interp(time, x, y)


class Cases(PlotCase):
    def state(self, run=0):
        samples = self.stored("samples", "runs.h5")[run]
        return self.stored("time", "runs.h5")[:samples], self.stored("state", "runs.h5")[run, :samples]

    def assert_held(self, line, time, values, period):
        """Until just before the next sample, and the last one as long as the others."""
        for share in (0.01, 0.99):
            np.testing.assert_allclose(at(line, time + share * period), values)
        self.assert_arrays_equal(line.get_xydata()[-1], [time[-1] + period, values[-1]])

    def test_run_shows_states_countdown_delay_and_margin(self):
        self.simulated(example("circle.json"), "--from", "x1=0.1,x2=0", "--steps", "50", "--runs", "2")
        data, figure = self.plotted("run", "--run", "1", file="runs.h5")
        time, state = self.state(1)
        curves, steps, margin, inputs = figure.axes
        self.assertEqual(labels(curves)[1], "x1, x2 [m]")
        for i, name in enumerate(("x1", "x2")):
            self.assertEqual(curves.lines[i].get_label(), name)
            self.assert_arrays_equal(curves.lines[i].get_xydata(), np.stack([time, state[:, i]], axis=1))
        delay, countdown, coordinated = steps.lines
        self.assertEqual([line.get_label() for line in (delay, countdown)], ["delay of the cell", "countdown"])
        self.assert_held(countdown, time, self.stored("countdown", "runs.h5")[1], 0.01)
        self.assert_held(delay, time, self.stored("delay", "runs.h5")[1], 0.01)
        self.assertTrue((data.steps.countdown <= data.steps.delay).all())
        self.assert_arrays_equal(coordinated.get_xdata(), time[self.stored("coordinated", "runs.h5")[1] == 1])
        self.assert_arrays_equal(margin.lines[0].get_ydata(), self.stored("margin", "runs.h5")[1])
        subtitle = "run 1, policy random, seed 1: completed"
        self.assertEqual(titles(figure), [f"circle, horizontal|vertical\n{subtitle}"])
        self.assertEqual((labels(curves)[0], labels(steps)[1]), ("time [s]", "steps"))
        self.assertEqual((labels(margin), labels(inputs)), (("", "margin"), ("time [s]", "input [m/s]")))
        used = self.stored("input", "runs.h5")[1, :-1]
        for line, values, name in zip(inputs.lines, used.T, ("u1", "u2"), strict=True):
            self.assertEqual(line.get_label(), name)
            self.assert_held(line, time[:-1], values, 0.01)
        self.assertEqual(covered(figure), [])
        for words, message in (
            (("--run", "2"), "expected the number of one run, 0 to 1, found '2' (--run)"),
            (("--run", "0,1"), "expected the number of one run, 0 to 1, found '0,1' (--run)"),
            (("--plane", "x1"), "expected two states such as x1,y1, found 'x1' (--plane)"),
            (("--plane", "x1,x3"), "'x3' is no state, expected 'x1' or 'x2' (--plane)"),
        ):
            self.assert_plot_fails(2, message, "run", "runs.h5", "-o", "a.png", *words)

    def test_each_thing_has_a_colour_of_its_own_and_samples_are_dots(self):
        self.simulated(example("tutorial/corridor_5.json"), "--from", "p1=5,v1=1,p2=12,v2=0", "--steps", "20")
        _, figure = self.plotted("run", file="runs.h5")
        lines = [line for axes in figure.axes for line in axes.lines if line.get_label()[0] != "_"]
        strokes = [(line.get_color(), line.get_linestyle()) for line in lines]
        # Four states, delay and countdown, coordination, two inputs; the margin has no label.
        self.assertEqual((len(strokes), len(set(strokes))), (9, 9))
        self.assertNotIn(figure.axes[3].lines[0].get_color(), [color for color, _ in strokes])
        time, state = self.state()
        dots = [one.get_offsets() for one in figure.axes[0].collections if len(one.get_offsets()) == len(time)]
        for found, i in zip(dots, (0, 2), strict=True):
            self.assert_arrays_equal(found, np.stack([time, state[:, i]], axis=1))

    @staticmethod
    def shaded(axes):
        """Where the picture is grey: the middles of the quads, and whether each is."""
        (mesh,) = [one for one in axes.collections if hasattr(one, "get_coordinates")]
        corners = mesh.get_coordinates()
        middles = (corners[1:, 1:] + corners[:-1, :-1]) / 2
        grey = ~np.ma.getmaskarray(mesh.get_array())
        return middles[..., 0], middles[..., 1], grey.reshape(middles.shape[:2])

    def test_what_is_not_safe_is_grey(self):
        self.simulated(example("circle.json"), "--from", "x1=0.55,x2=0.55", "--steps", "200")
        _, figure = self.plotted("run", "--plane", "x1,x2", file="runs.h5")
        x, y, grey = self.shaded(figure.axes[0])
        far = x**2 + y**2 - 0.64
        self.assertTrue(grey[far > 1e-3].all() and not grey[far < -1e-3].any() and grey.any())
        # Of one state over time; of two on one pair of axes it would be neither's.
        self.simulated(HEATER, "--from", "T=24,h=2", "--steps", "9")
        _, figure = self.plotted("run", file="runs.h5")
        _, warm, grey = self.shaded(figure.axes[0]) if figure.axes[0].get_ylim()[1] > 25 else (0, np.zeros(1), np.zeros(1))
        self.assert_arrays_equal(grey, warm > 25)
        self.simulated(SPEC, "--from", "x=1,y=1", "--steps", "12")
        _, figure = self.plotted("run", file="runs.h5")
        with self.assertRaises(ValueError):
            self.shaded(figure.axes[0])

    def test_run_has_axes_for_each_unit(self):
        self.simulated(example("load.json"), "--from", "v=0,p=0.5", "--steps", "20")
        data, figure = self.plotted("run", file="runs.h5")
        _, state = self.state()
        for axes, name, i in zip(figure.axes, ("v [m/s]", "p [m]"), (0, 1)):
            self.assertEqual((labels(axes)[1], len(axes.lines)), (name, 1))
            self.assert_arrays_equal(axes.lines[0].get_ydata(), state[:, i])
        self.assertEqual([labels(axes)[0] for axes in figure.axes[:2]], ["", "time [s]"])
        self.assertEqual(covered(figure), [])

    def test_run_in_a_plane_and_for_ever(self):
        start = "p1=-10,v1=0,v2=1.5,p2=10"
        self.simulated(example("intersection_coarse.json"), "--from", start, "--steps", "3")
        data, figure = self.plotted("run", "--plane", "p1,p2", file="runs.h5")
        _, state = self.state()
        self.assert_arrays_equal(figure.axes[0].lines[0].get_xydata(), state[:, [0, 3]])
        self.assertEqual(labels(figure.axes[0]), ("p1 [m]", "p2 [m]"))
        self.assertTrue(math.isinf(data.steps.delay[0]))
        steps = figure.axes[1]
        ticks = dict(zip((text.get_text() for text in steps.get_yticklabels()), steps.get_yticks()))
        self.assertEqual(list(ticks)[-1], "never")
        self.assertTrue(all(text == f"{tick}" for text, tick in list(ticks.items())[:-1]))
        self.assertEqual(steps.lines[0].get_ydata()[0], ticks["never"])
        texts = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
        self.assertEqual(texts, ["p1, p2", "start", "end"])
        # The signs have the colour of the curve.
        colors = {handle.get_color() for handle in figure.axes[0].get_legend_handles_labels()[0]}
        self.assertEqual(colors, {figure.axes[0].lines[0].get_color()})
        self.assertEqual(covered(figure), [])

    def test_inputs_that_are_equal_are_all_seen(self):
        self.simulated(example("crossing.json"), "--from", "p1=-9,v1=1,v2=1,p2=-6", "--steps", "6", "--policy", "adversarial")
        _, figure = self.plotted("run", file="runs.h5")
        widths = [line.get_linewidth() for line in figure.axes[-1].lines]
        self.assertEqual(len(widths), 2)
        self.assertGreater(widths[0], 2 * widths[1])

    def test_the_numbers_of_steps_have_room(self):
        from plotting.run import _step_ticks

        for highest in (0, 1, 5, 12, 18, 57, 1000):
            for has_never in (False, True):
                axes = new_figure(None, (6, 4)).add_subplot()
                never = highest + max(1, math.ceil(highest / 8))
                _step_ticks(axes, highest, never, has_never)
                ticks = axes.get_yticks()
                self.assertLessEqual(len(ticks), 9)
                if len(ticks) > 1:
                    low, high = axes.get_ylim()
                    self.assertGreater(min(np.diff(ticks)), (high - low) / 14, (highest, has_never))

    def test_a_run_without_coordination_fills_its_picture(self):
        self.simulated(HEATER, "--from", "T=19,h=1", "--steps", "9")
        _, figure = self.plotted("run", file="runs.h5")
        self.assertEqual(covered(figure), [])
        for axes in figure.axes:
            self.assertGreater(axes.get_position().width, 0.3)
            self.assertGreater(axes.get_position().height, 0.15)
        self.assertEqual([text.get_text() for text in figure.axes[2].get_yticklabels()], ["0", "never"])

    def test_all_is_held_in_discrete_time(self):
        self.simulated(SPEC, "--from", "x=1,y=1", "--steps", "12")
        _, figure = self.plotted("run", file="runs.h5")
        time, state = self.state()
        curves, _, margin, _ = figure.axes
        for i in (0, 1):
            self.assert_held(curves.lines[i], time, state[:, i], 0.5)
        self.assert_held(margin.lines[0], time, self.stored("margin", "runs.h5")[0], 0.5)
        # In the plane nothing lies between two samples: each has its mark.
        _, figure = self.plotted("run", "--plane", "x,y", file="runs.h5")
        line = figure.axes[0].lines[0]
        self.assertEqual(line.get_marker(), ".")
        is_new = np.append(True, (state[1:] != state[:-1]).any(axis=1))
        self.assert_arrays_equal(line.get_xydata(), state[is_new])

    def test_discrete_states_are_held_in_continuous_time(self):
        self.simulated(HEATER, "--from", "T=19,h=1", "--steps", "40")
        _, figure = self.plotted("run", file="runs.h5")
        time, state = self.state()
        warm, heater, _, margin, _ = figure.axes
        self.assert_arrays_equal(warm.lines[0].get_xydata(), np.stack([time, state[:, 0]], axis=1))
        self.assert_held(heater.lines[0], time, state[:, 1], 0.5)
        # Of its values there are ticks, and nowhere else.
        self.assertEqual(set(state[:, 1]), {0, 1, 2})
        self.assert_arrays_equal(heater.get_yticks(), [0, 1, 2])
        self.assert_arrays_equal(margin.lines[0].get_ydata(), self.stored("margin", "runs.h5")[0])
        # One moves, then the other jumps.
        for pair, i in (("T,h", [0, 1]), ("h,T", [1, 0])):
            _, figure = self.plotted("run", "--plane", pair, file="runs.h5")
            points = figure.axes[0].lines[0].get_xydata()
            self.assertTrue((np.diff(points, axis=0) == 0).any(axis=1).all())
            visited = {tuple(point) for point in points}
            self.assertLessEqual({tuple(point) for point in state[:, i]}, visited)
            corners = {(after[0], before[1]) for before, after in zip(state, state[1:])}
            self.assertLessEqual(corners, {(point[i[0]], point[i[1]]) for point in visited})

    def test_the_margin_is_held_if_it_depends_on_what_is(self):
        self.simulated(dict(HEATER, safe="T >= 15 and T <= 25 and strong <= 1"), "--from", "T=20,h=1", "--steps", "40")
        _, figure = self.plotted("run", file="runs.h5")
        time, _ = self.state()
        self.assert_held(figure.axes[3].lines[0], time, self.stored("margin", "runs.h5")[0], 0.5)

    def test_no_line_joins_the_sides_of_a_seam(self):
        self.simulated(RING, "--from", "a=0,b=0", "--steps", "40")
        time, state = self.state()
        crossings = np.abs(np.diff(state, axis=0)) > 2
        self.assertTrue(crossings.any(axis=0).all())
        for words, both in (((), crossings), (("--plane", "a,b"), crossings.any(axis=1)[:, None])):
            _, figure = self.plotted("run", *words, file="runs.h5")
            for line, crossed in zip(figure.axes[0].lines, both.T):
                points = line.get_xydata()
                self.assertEqual(np.isfinite(points).all(axis=1).sum(), len(time))
                # Each time it breaks.
                self.assertEqual(np.isnan(points).any(axis=1).sum(), crossed.sum())
                self.assertLess(np.nanmax(np.abs(np.diff(points, axis=0))), 2)


class Paths(unittest.TestCase):
    """The points of path() for two steps in which x moves by 1 and y from 0 to 5 and on to 3."""

    def points(self, x, y):
        from plotting.path import Side, path

        return np.where(np.isnan(found := path(Side([0, 1, 2], *x), Side([0, 5, 3], *y))), -1, found).tolist()

    def test_what_moves_goes_first(self):
        straight = [[0, 0], [1, 5], [2, 3]]
        self.assertEqual(self.points((), ()), straight)
        self.assertEqual(self.points((True,), (True,)), straight)
        self.assertEqual(self.points((), (True,)), [[0, 0], [1, 0], [1, 5], [2, 5], [2, 3]])
        self.assertEqual(self.points((True,), ()), [[0, 0], [0, 5], [1, 5], [1, 3], [2, 3]])

    def test_a_seam_breaks_the_line_where_it_is_crossed(self):
        none = [-1, -1]
        self.assertEqual(self.points((), (False, 6)), [[0, 0], none, [1, 5], [2, 3]])
        self.assertEqual(self.points((), (True, 6)), [[0, 0], [1, 0], none, [1, 5], [2, 5], [2, 3]])
        self.assertEqual(self.points((True,), (False, 6)), [[0, 0], none, [1, 5], [1, 3], [2, 3]])
        self.assertEqual(self.points((), (True, 10)), [[0, 0], [1, 0], [1, 5], [2, 5], [2, 3]])

    def test_what_stands_alone_is_found(self):
        from plotting.path import Side, lone, path, stairs

        time = Side([0, 1, 2, 3])
        self.assertEqual(lone(path(time, Side([0, 5, 0, 1], False, 6))).tolist(), [[0, 0], [1, 5]])
        self.assertEqual(lone(path(time, Side([0, 5, 0, 1]))).tolist(), [])
        self.assertEqual(lone(path(Side([0]), Side([4]))).tolist(), [[0, 4]])
        self.assertEqual(lone(stairs([0, 1], [0, 5], 1, 6)).tolist(), [])

    def test_the_last_value_is_held_for_a_step(self):
        from plotting.path import stairs

        self.assertEqual(stairs([0, 2], [5, 5], 2).tolist(), [[0, 5], [2, 5], [4, 5]])
        self.assertEqual(stairs([0], [5], 2).tolist(), [[0, 5], [2, 5]])


if __name__ == "__main__":
    unittest.main()
