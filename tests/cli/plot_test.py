"""What figures of scripts/plot show is what the results file holds."""

import json
import unittest

import numpy as np
from plot_case import PlotCase, covered, drawn, example, labels, legend, titles
from program import SPEC, spec_with

UNBOUNDED = np.iinfo(np.int16).max


class Cases(PlotCase):
    # actions

    def test_actions_are_the_staircase_of_the_paper(self):
        spec = example("circle.json", output={"controller": True, "actions": True})
        spec["dynamics"]["period"] = 0.02
        self.analyzed(spec)
        data, figure = self.plotted("actions", "--at", "x1=-0.62,x2=-1/2")
        u = self.stored("u1")
        i, j = (int(np.abs(self.stored(name) - x).argmin()) for name, x in (("x1", -0.62), ("x2", -0.5)))
        bits = np.unpackbits(self.stored("controller")[i, j], bitorder="little")[: len(u) ** 2]
        allowed = {(u[k // len(u)], u[k % len(u)]) for k in np.flatnonzero(bits)}
        points = {tuple(point) for point in figure.axes[0].collections[-1].get_offsets()}
        self.assertEqual(points, allowed)
        # Stairs: less of u1 asks for more of u2, in several steps; and IND_C is more than C.
        least = [min(b for a, b in allowed if a == one) for one in sorted({a for a, _ in allowed})]
        self.assertEqual(least, sorted(least, reverse=True))
        self.assertEqual(len(set(least)), 3)
        box = {a for a, _ in allowed}, {b for _, b in allowed}
        self.assert_arrays_equal(data.independent, np.outer(np.isin(u, list(box[0])), np.isin(u, list(box[1]))))
        self.assertEqual((data.controller.sum(), data.independent.sum()), (600, 900))
        self.assertEqual(titles(figure), ["circle, horizontal|vertical\nat x1 = -0.62 m, x2 = -0.5 m"])
        self.assertEqual(labels(figure.axes[0]), ("u1 [m/s]", "u2 [m/s]"))
        self.assertEqual(legend(figure), ["C(x): 600 of 1681", "IND_C(x): 900 of 1681"])

    def test_actions_over_two_of_several_inputs(self):
        values = {"u": [1, -1, 0], "v": [-1, 0, 1], "w": [0, 1]}
        self.analyzed(
            spec_with(
                inputs=[{"name": name, "values": several} for name, several in values.items()],
                agents=[{"name": "a", "inputs": ["w"]}, {"name": "b", "inputs": ["u", "v"]}],
                dynamics=dict(SPEC["dynamics"], equations={"x": "x + u - w", "y": "y + v + w"}),
                output={"controller": True, "actions": True},
            )
        )
        at = ("--at", "x=3,y=3")
        data, figure = self.plotted("actions", *at, "--slice", "v=1", "--x", "w")
        bits = np.unpackbits(self.stored("controller")[3, 3], bitorder="little")[:18].reshape(3, 3, 2)
        independent = bits.any(axis=(0, 1))[None, None, :] & bits.any(axis=2)[:, :, None]
        self.assertGreater(independent.sum(), bits.sum())
        order = [1, 2, 0]
        self.assert_arrays_equal(data.controller, bits[order, 2, :].T)
        self.assert_arrays_equal(data.independent, independent[order, 2, :].T)
        self.assert_arrays_equal(data.y, [-1, 0, 1])
        points = {tuple(point) for point in figure.axes[0].collections[-1].get_offsets()}
        u, w = np.nonzero(bits[:, 2, :])
        self.assertEqual(points, set(zip(w, np.array([1, -1, 0])[u])))
        self.assertEqual(titles(figure), ["small, a|b\nat x = 3 m, y = 3 m\nv = 1"])
        self.assertEqual(labels(figure.axes[0]), ("w", "u"))
        for words, message in (
            (at, "cut 1 of 'u', 'v' or 'w': expected --slice INPUT=VALUE,..."),
            ((*at, "--slice", "v=1,w=0"), "the picture has 2 axes, found 1 input to draw"),
            ((*at, "--slice", "v=0.5"), "v takes no value 0.5 (--slice)"),
            ((*at, "--slice", "x=0.5"), "'x' is no input, expected 'u', 'v' or 'w' (--slice)"),
            (("--at", "x=3"), "no value for the state 'y' (--at)"),
            (("--at", "x=3,y=9"), "y = 9 is outside of the domain (--at)"),
        ):
            self.assert_plot_fails(2, message, "actions", "out.h5", "-o", "a.png", *words)

    def test_actions_need_what_is_stored_on_request(self):
        self.analyzed(SPEC)
        what = 'analyse with "output": {"controller": true, "actions": true} (out.h5)'
        words = ("actions", "out.h5", "-o", "a.png", "--at", "x=3,y=3")
        self.assert_plot_fails(3, f"no /controller in the file: {what}", *words)
        self.analyzed(spec_with(output={"controller": True}))
        self.assert_plot_fails(3, f"no /actions in the file: {what}", *words)

    # layers

    def test_layers_are_the_delays(self):
        self.analyzed(example("circle.json"))
        _, figure = self.plotted("layers")
        delay = self.stored("delay")[0]
        kinds, steps = figure.axes[0].images
        # Images are rows of pixels from below: [x2, x1].
        shown = steps.get_array()
        self.assert_arrays_equal(shown.mask, (delay < 0).T)
        self.assert_arrays_equal(shown.compressed(), delay.T[delay.T >= 0])
        self.assert_arrays_equal(kinds.get_array().filled(-1), np.select([delay == -2, delay == -1], [0, 1], -1).T)
        for edge, expected in zip(steps.get_extent(), (-1.005, 1.005) * 2):
            self.assertAlmostEqual(edge, expected, 12)
        self.assertEqual(steps.get_clim(), (-0.5, 28.5))
        self.assertEqual(labels(figure.axes[0]), ("x1 [m]", "x2 [m]"))
        self.assertEqual(labels(figure.axes[1])[1], "delay [steps]")
        self.assertEqual(titles(figure), ["circle, horizontal|vertical"])
        self.assertEqual(legend(figure), ["not safe", "safe, not invariant"])

    def test_snapshots_show_what_left_before_k(self):
        self.analyzed(example("circle.json"))
        _, figure = self.plotted("layers", "--snapshots", "1,14,29")
        delay = self.stored("delay")[0].T
        for axes, k in zip(figure.axes, (1, 14, 29)):
            kinds, steps = axes.images
            left = (0 <= delay) & (delay < k)
            self.assert_arrays_equal(steps.get_array().mask, ~left)
            self.assert_arrays_equal(steps.get_array().compressed(), delay[left])
            self.assert_arrays_equal(kinds.get_array().filled(-1) == 2, delay >= k)
        self.assertEqual(titles(figure)[1:], ["k = 1 step (0.01 s)", "k = 14 steps (0.14 s)", "k = 29 steps (0.29 s)"])
        self.assertEqual(legend(figure), ["not safe", "safe, not invariant", "tolerates k steps (Z_k)"])

    def test_no_title_covers_another(self):
        self.analyzed(example("intersection_coarse.json"))
        cut = ("--slice", "v1=1,v2=2", "--snapshots", "1,2,3")
        for words in ((), ("--size", "12x3.5"), ("--size", "9x4")):
            _, figure = self.plotted("layers", *cut, *words)
            drawn(figure)
            above = figure._suptitle.get_window_extent()
            for axes in figure.axes[:3]:
                self.assertFalse(axes.title.get_window_extent().overlaps(above), words)
            ticks = [axes.xaxis.get_tightbbox() for axes in figure.axes[:3]]
            self.assertFalse(any(one.overlaps(next_one) for one, next_one in zip(ticks, ticks[1:])), words)

    def test_a_slice_may_have_a_scale_of_its_own(self):
        self.analyzed(example("intersection_coarse.json"))
        cut = ("--slice", "v1=1,v2=2", "--snapshots", "3")
        all_cells, own = (self.plotted("layers", *cut, *words)[0].most for words in ((), ("--own-scale",)))
        self.assertEqual(all_cells, self.stored("fixed_point_index")[0] - 1)
        self.assertEqual(own, 2)
        self.assertGreater(all_cells, own)

    def test_slices_of_more_dimensions(self):
        partitions = [{"classes": []}, {"name": "both", "classes": [["first", "second"]]}]
        self.analyzed(example("intersection_coarse.json", coordination={"partitions": partitions}))
        delay = self.stored("delay")
        v1, v2 = (int(np.abs(self.stored(name) - v).argmin()) for name, v in (("v1", 1), ("v2", 2)))
        cut = ("--slice", "v1=1", "--slice", "v2=2")
        data, figure = self.plotted("layers", *cut, "--x", "p2", "--partition", "first|second")
        shown = data.panels[0].delay
        self.assert_arrays_equal(shown.filled(UNBOUNDED), np.where(shown.mask, UNBOUNDED, delay[0, :, v1, v2, :].T))
        self.assert_arrays_equal(data.panels[0].kinds == 2, delay[0, :, v1, v2, :].T == UNBOUNDED)
        # p2 to the right, p1 upwards.
        image = figure.axes[0].images[1].get_array()
        self.assert_arrays_equal(image.compressed(), delay[0, :, v1, v2, :][~image.mask])
        self.assertEqual(titles(figure), ["intersection_coarse, first|second\nv1 = 1 m/s, v2 = 2 m/s"])
        self.assertEqual(labels(figure.axes[0]), ("p2 [m]", "p1 [m]"))
        # All together are never silent too long, under the given name or the canonical one.
        for name in ("both", "first+second"):
            data, figure = self.plotted("layers", *cut, "--partition", name)
            self.assertEqual((data.partition, data.kinds), ("both", {0, 1, 2}))
            self.assertEqual(legend(figure)[2], "unbounded")

    def test_values_are_found_in_their_cells_as_query_finds_them(self):
        self.analyzed(
            spec_with(
                states=[
                    {"name": "h", "lower": "-pi", "upper": "pi", "count": 5, "outside": "periodic"},
                    {"name": "y", "lower": -0.7, "upper": 0.7, "step": 0.1},
                    {"name": "gear", "lower": 1, "upper": 2, "step": 1, "discrete": True},
                ],
                dynamics=dict(SPEC["dynamics"], equations={"h": "h + u*pi/5", "y": "y + v/10", "gear": "gear"}),
                safe="true",
            )
        )
        # The cell [a, b), and a period of 2 pi.
        for text, index in (("0.05", 8), ("1/20 - 10^-9", 7), ("-0.75", 0)):
            data, _ = self.plotted("layers", "--slice", f"y={text}")
            self.assertEqual(data.cut.index[1], index)
        for text, index in (("pi/2", 4), ("-3/2*pi", 4), ("9/10*pi", 0), ("11/10*pi", 0)):
            data, _ = self.plotted("layers", "--slice", f"h={text}")
            self.assertEqual(data.cut.index[0], index)
        for text, message in (
            ("gear=1.5", "gear = 1.5 is outside of the domain (--slice)"),
            ("y=0.75", "y = 0.75 is outside of the domain (--slice)"),
            ("y=0.1x", "expected a number, found '0.1x' (--slice, y)"),
            ("y=a", "'a' is not defined (--slice, y)"),
            ("y", "expected NAME=VALUE, found 'y' (--slice)"),
            ("y=1,y=2", "'y' is given twice (--slice)"),
            ("z=1", "'z' is no state, expected 'h', 'y' or 'gear' (--slice)"),
            ("h=0 --x h", "'h' is cut (--x)"),
            ("h=0 --x y --y y", "'y' is drawn twice (--x)"),
            ("h=0 --x z", "'z' is no state, expected 'h', 'y' or 'gear' (--x)"),
            ("h=0,y=0,gear=1", "the picture has 1 axes, found 0 states to draw"),
        ):
            self.assert_plot_fails(2, message, "layers", "out.h5", "-o", "a.png", "--slice", *text.split())

    def test_a_single_state_is_a_strip_and_a_cut_off_delay_says_so(self):
        self.analyzed(
            spec_with(
                states=[{"name": "x", "lower": 0, "upper": 20, "step": 1, "unit": "m"}],
                dynamics={"time": "discrete", "period": 1, "equations": {"x": "x + u + v"}},
                safe="x >= 2 and x <= 17",
                coordination={"max_delay": 2},
            )
        )
        data, figure = self.plotted("layers")
        delay = self.stored("delay")[0]
        self.assertEqual(delay.max(), 2)
        self.assert_arrays_equal(data.panels[0].delay.filled(-1)[:, 0], np.where(delay < 0, -1, delay))
        self.assertEqual(labels(figure.axes[0]), ("x [m]", ""))
        self.assertEqual(labels(figure.axes[1])[1], "delay; 2 is at least 2 [steps]")
        data, figure = self.plotted("requirements")
        self.assert_arrays_equal(data.histograms[0].cells, [(delay == k).sum() for k in range(3)])
        self.assertEqual([text.get_text() for text in figure.axes[0].texts], ["at least"])

    def test_axes_of_points_have_ticks_at_points_only(self):
        states = [
            {"name": "x", "lower": 0, "upper": 2, "step": 1, "discrete": True},
            {"name": "y", "lower": 0, "upper": 1.5, "step": 0.5, "discrete": True},
            {"name": "z", "lower": 0, "upper": 20, "step": 2.5, "discrete": True},
        ]
        equations = {"x": "x + u", "y": "y + v/2", "z": "z"}
        dynamics = dict(SPEC["dynamics"], equations=equations)
        output = {"controller": True, "actions": True}
        self.analyzed(spec_with(states=states, dynamics=dynamics, safe="x + y <= 3", output=output))
        _, figure = self.plotted("layers", "--slice", "z=0")
        self.assert_arrays_equal(figure.axes[0].get_xticks(), [0, 1, 2])
        self.assert_arrays_equal(figure.axes[0].get_yticks(), [0, 0.5, 1, 1.5])
        _, figure = self.plotted("unsafe3d")
        axes = figure.axes[0]
        self.assert_arrays_equal(axes.get_xticks(), [0, 1, 2])
        self.assert_arrays_equal(axes.get_zticks(), [0, 5, 10, 15, 20])
        _, figure = self.plotted("actions", "--at", "x=1,y=0.5,z=0")
        self.assert_arrays_equal(figure.axes[0].get_xticks(), [-1, 0, 1])

    def test_ticks_of_many_points_are_some_of_them(self):
        from matplotlib.figure import Figure
        from plotting.style import point_ticks

        for points, expected in (
            (range(11), [0, 2, 4, 6, 8, 10]),
            (range(-3, 40), [0, 10, 20, 30]),
            ([7], [7]),
            (np.arange(10) / 3 + 0.1, np.array([0, 2, 4, 6, 8]) / 3 + 0.1),
        ):
            axis = Figure().add_subplot().xaxis
            point_ticks(axis, points)
            np.testing.assert_allclose(axis.get_majorticklocs(), expected)

    def test_colour_bars_have_whole_steps_with_their_times(self):
        self.analyzed(SPEC)
        data, figure = self.plotted("layers")
        bar = figure.axes[1]
        drawn(figure)
        steps = bar.get_yticks()
        self.assertEqual([step % 1 for step in steps], [0] * len(steps))
        self.assertTrue((0 <= min(steps)) and (max(steps) <= data.most))
        (times,) = bar.child_axes
        np.testing.assert_allclose(times.get_yticks(), steps * 0.5)
        self.assertEqual([text.get_text() for text in times.get_yticklabels()][:2], ["0 s", f"{steps[1] * 0.5:g} s"])

    # coalition

    def test_coalition_has_a_colour_for_each_partition(self):
        partitions = [{"classes": []}, {"name": "both", "classes": [["a", "b"]]}]
        self.analyzed(spec_with(coordination={"partitions": partitions}))
        words = ("coalition", "out.h5", "-o", "a.png")
        missing = 'no /coalition in the file: analyse with "coordination": {"horizon": STEPS} (out.h5)'
        self.assert_plot_fails(3, missing, *words)
        values = np.array([[0, 0, 1, 1, -1]] * 3 + [[1, 1, 1, -2, -2], [0, -3, -3, -2, -2]])

        def change(file):
            file["coalition"] = values
            file["coalition"].attrs["flag_values"] = [-2, -1, -3]
            file["coalition"].attrs["flag_meanings"] = "not_safe not_invariant no_partition_suffices"
            file["coalition"].attrs["horizon"] = 3

        self.rewrite(change)
        data, figure = self.plotted("coalition")
        texts = {-3: "no partition suffices", -2: "not safe", -1: "not invariant", 0: "a|b", 1: "both"}
        found = np.vectorize(lambda kind: data.kinds[kind].text)(data.cells)
        self.assert_arrays_equal(found, np.vectorize(texts.get)(values))
        self.assert_arrays_equal(figure.axes[0].images[0].get_array(), data.cells.T)
        self.assertEqual(legend(figure), list(texts.values()))
        self.assertEqual(titles(figure), ["small, 3 steps (1.5 s) without further contact"])
        self.assertEqual(len({kind.color for kind in data.kinds}), 5)
        self.assertEqual(labels(figure.axes[0]), ("x [m]", "y [m]"))
        values[0, 0] = 2
        self.analyzed(spec_with(coordination={"partitions": partitions}))
        self.rewrite(change)
        self.assert_plot_fails(3, "no partition has the number 2 of /coalition (out.h5)", *words)

    # goal

    def test_goal_is_readable_where_the_way_is_long(self):
        self.analyzed(spec_with(goal="x <= 1 and y <= 1"))
        arrival = np.arange(25).reshape(5, 5) * 40
        delay = np.full((5, 5), 3)
        delay[0, 0], delay[4, 4] = UNBOUNDED, -4

        def change(file):
            file["arrival"][...] = arrival
            file["approach_delay"][...] = delay

        self.rewrite(change)
        _, figure = self.plotted("goal")
        way, silence = figure.axes[:2]
        # The image of the steps lies above that of the kinds. Each is read at a bar of its own, up to its greatest.
        shown = [axes.images[1] for axes in (way, silence)]
        self.assert_arrays_equal(shown[0].get_array(), arrival.T)
        self.assertEqual([image.norm.vmax for image in shown], [960.5, 3.5])
        self.assertEqual(titles(figure)[1:], ["time to the goal\nup to 960 steps (480 s)",
                                              "silence that costs no time\nup to 3 steps (1.5 s)"])  # fmt: skip
        self.assertNotEqual(*(image.cmap for image in shown))  # two quantities, two maps
        # Lines at ticks of the bar, of many steps only.
        self.assertEqual([len(axes.collections) > 0 for axes in (way, silence)], [True, False])

    def test_goal_keeps_colours_for_what_is_usual(self):
        self.analyzed(spec_with(states=[{**SPEC["states"][0], "upper": 59}, {**SPEC["states"][1], "upper": 59}],
                                safe="true", goal="x <= 1 and y <= 1"))  # fmt: skip
        arrival = np.add.outer(np.arange(60), np.arange(60))
        arrival[50, 50:] = 20000
        self.rewrite(lambda file: file["arrival"].__setitem__(..., arrival))
        data, figure = self.plotted("goal")
        self.assertEqual((data.panels[0].shown, data.panels[0].most), (108, 20000))
        self.assertEqual(figure.axes[0].images[1].norm.vmax, 108.5)
        self.assertIn("up to 20000 steps (10000 s)", titles(figure)[1])

    def test_goal_says_in_one_line_that_silence_costs_no_time(self):
        self.analyzed(spec_with(goal="x <= 1 and y <= 1"))
        self.rewrite(lambda file: file["approach_delay"].__setitem__(..., UNBOUNDED))
        data, figure = self.plotted("goal")
        self.assertEqual([panel.title for panel in data.panels], ["time to the goal"])
        self.assertTrue(titles(figure)[0].endswith("\nsilence costs no time"))

    def test_goal_has_no_lines_around_single_cells(self):
        steps = np.add.outer(np.arange(5), np.arange(5)) * 5
        mottled = np.where(np.indices((5, 5)).sum(0) % 2, steps, 0)
        for arrival, has_lines in ((steps, True), (mottled, False)):
            self.analyzed(spec_with(goal="x <= 1 and y <= 1"))
            self.rewrite(lambda file, arrival=arrival: file["arrival"].__setitem__(..., arrival))
            _, figure = self.plotted("goal")
            self.assertEqual(len(figure.axes[0].collections) > 0, has_lines)

    # risk

    def test_risk_is_by_powers_of_ten(self):
        self.analyzed(example("crossing.json", network={"loss": 0.01}, risk={"horizon": 10}))
        data, figure = self.plotted("risk", "--slice", "v1=1,v2=1", "--mode", "down", "--mode", "up")
        stored, invariant = self.stored("risk")[:, :, 2, 2, :], self.stored("invariant")[:, 2, 2, :]
        self.assertEqual([panel.mode for panel in data.panels], ["down", "up"])
        for panel, risk in zip(data.panels, stored[::-1]):
            self.assert_arrays_equal(panel.powers.mask, (invariant == 0) | (risk == 0))
            shown = ~panel.powers.mask
            np.testing.assert_allclose(10 ** panel.powers.data[shown], risk[shown], rtol=1e-6)
        self.assertEqual(titles(figure), ["crossing, risk within 10 steps (10 s)\nv1 = 1 m/s, v2 = 1 m/s",
                                          "mode down", "mode up"])  # fmt: skip
        # Levels at powers of ten, up to 1.
        boundaries = figure.axes[0].images[1].norm.boundaries
        self.assert_arrays_equal(np.diff(boundaries), 1)
        self.assertEqual(boundaries[-1], 0)
        self.assertEqual(legend(figure), ["not safe", "safe, not invariant"])

    def test_risk_below_all_levels_has_a_colour_of_its_own(self):
        self.analyzed(example("crossing.json", network={"loss": 1e-13}, risk={"horizon": 10}))
        _, figure = self.plotted("risk", "--slice", "v1=1,v2=1", "--mode", "up")
        image = figure.axes[0].images[1]
        lowest = image.norm.boundaries[0]
        self.assertEqual(lowest, -12)
        self.assertLess(image.get_array().min(), lowest)
        below, first = (image.cmap(image.norm(power)) for power in (lowest - 0.5, lowest + 0.5))
        self.assertNotEqual(below, first)
        self.assertEqual(figure.axes[-1]._colorbar.extend, "min")
        # Where nothing lies below, the bar does not say that something does.
        self.analyzed(example("crossing.json", network={"loss": 0.01}, risk={"horizon": 10}))
        _, figure = self.plotted("risk", "--slice", "v1=1,v2=1", "--mode", "down")
        self.assertEqual(figure.axes[-1]._colorbar.extend, "neither")

    def test_risk_names_what_is_missing(self):
        self.analyzed(SPEC)
        self.assert_plot_fails(3, "no /risk in the file: analyse with a \"risk\" (out.h5)", "risk", "out.h5", "-o", "a.png")

    # blind

    def test_blind_names_a_class_that_sees_nothing(self):
        agents = [{"name": "a", "inputs": ["u"], "sees": []}, {"name": "b", "inputs": ["v"], "sees": ["y"]}]
        self.analyzed(spec_with(agents=agents))
        message = "'a' sees no state: its table has no map; expected a class that sees one (--class)"
        self.assert_plot_fails(2, message, "blind", "out.h5", "-o", "a.png")
        data, _ = self.plotted("blind", "--class", "b")
        self.assertEqual([axis.name for axis in data.table.cut.axes], ["y"])

    # sweep

    def test_sweep_shows_the_risk_by_the_value_in_order(self):
        self.write("spec.json", example("crossing.json", network={"loss": 0.01}, risk={"horizon": 10}))
        result = self.run_program("analyze", "spec.json", "--sweep", "network.loss=0.1,1/1000,0.01", "--json")
        self.write("losses.json", result.stdout.decode())
        data, figure = self.plotted("sweep", file="losses.json")
        self.assert_arrays_equal(data.values, [0.001, 0.01, 0.1])
        runs = {run["values"]["network.loss"]: run["summary"] for run in json.loads(result.stdout)["runs"]}
        for place, value in enumerate(["1/1000", 0.01, 0.1]):
            mode = runs[value]["risk"]["modes"][0]
            self.assertEqual((data.mean[place], data.worst[place]), (mode["mean"], mode["worst"]))
            within = [mode["within"][i] / runs[value]["invariant"] for i in (4, 7, 9, 11)]
            np.testing.assert_allclose(data.shares[place], within)
        self.assertEqual(titles(figure), ["crossing, risk within 10 steps"])

    def test_sweep_names_what_is_wrong(self):
        self.write("spec.json", SPEC)
        for words, message in (
            (("--sweep", "dynamics.period=1,2"), 'no run has a risk: sweep a spec with a "risk"'),
            (("--sweep", "dynamics.period=1", "--sweep", "name=a"), "expected one swept value, found 2"),
            ((), "expected what 'coordreq analyze --sweep ... --json' prints"),
        ):
            self.write("losses.json", self.run_program("analyze", "spec.json", *words, "--json").stdout.decode())
            self.assert_plot_fails(3, message + " (losses.json)", "sweep", "losses.json", "-o", "a.png")

    # require

    def test_require_shows_what_is_tolerated(self):
        self.write("spec.json", example("crossing.json"))
        self.analyze("spec.json", "-o", "out.h5")
        for words, ends in (
            (("--over", "p1", "--given", "v1=1,v2=1,p2=-8"), [(-10.5, 10.5)]),
            (("--over", "p1,p2", "--given", "v1=2,v2=1", "--best", "small,large"), [(10.5, -10.5), (-10.5, 10.5)]),
        ):
            result = self.run_program("require", "out.h5", "--delay", "2s", *words, "--json")
            self.write("found.json", result.stdout.decode())
            data, figure = self.plotted("require", file="found.json")
            self.assertEqual(data.ends, ends)
            self.assertEqual([list(corner) for corner in data.corners], json.loads(result.stdout)["corners"])
            shapes = data.corners if len(ends) == 2 else data.intervals
            self.assertEqual(len(figure.axes[0].patches), len(shapes))
            self.assertEqual(data.title, "crossing, first|second: delay of at least 2 steps (2 s)")
            for patch, shape in zip(figure.axes[0].patches, shapes):
                reached = {patch.get_x() + patch.get_width(), patch.get_x()}
                self.assertEqual(reached, {shape[0], ends[0][1] if len(ends) == 2 else shape[1]})

    def test_require_says_where_nothing_is_tolerated(self):
        self.write("spec.json", example("crossing.json"))
        self.analyze("spec.json", "-o", "out.h5")
        words = ("--delay", "12s", "--over", "v1", "--given", "p1=-3,v2=3,p2=-3", "--best", "small")
        self.write("found.json", self.run_program("require", "out.h5", *words, "--json").stdout.decode())
        data, figure = self.plotted("require", file="found.json")
        self.assertEqual(data.corners, [])
        self.assertEqual([text.get_text() for text in figure.axes[0].texts], ["nowhere"])
        self.assertEqual(covered(figure), [])

    def test_require_names_what_is_wrong(self):
        for text in ("{}", "[", "[]"):
            self.write("found.json", text)
            message = "expected what 'coordreq require ... --json' prints (found.json)"
            self.assert_plot_fails(3, message, "require", "found.json", "-o", "a.png")


if __name__ == "__main__":
    unittest.main()
