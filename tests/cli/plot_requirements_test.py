"""The histogram of delays with the lines of the requirements: all stands at its delay, and no text covers anything."""

import json
import unittest

import numpy as np
from plot_case import PlotCase, covered, example, labels, titles
from program import spec_with

UNBOUNDED = np.iinfo(np.int16).max


class Cases(PlotCase):
    def test_requirements_are_lines_in_the_histogram_of_delays(self):
        spec = example("circle.json")
        self.analyzed(spec)
        required = [
            {"name": "costs $5 // not a comment", "where": "r2 <= 0.01", "min_delay": 20},
            {"name": "time", "where": "true", "min_delay_time": "R/8 + 0.001", "partition": "horizontal|vertical"},
            {"name": "start", "where": "r2 <= 0.25", "invariant": True},
        ]
        text = "// a comment\n/* another\n one */" + json.dumps(dict(spec, requirements=required))

        def change(file):
            del file["spec"]
            file["spec"] = text

        self.rewrite(change)
        data, figure = self.plotted("requirements")
        delay = self.stored("delay")[0]
        axes = figure.axes[0]
        bars = axes.containers[0].patches
        heights = [bar.get_height() for bar in bars]
        self.assertEqual(heights, [(delay == k).sum() for k in range(29)])
        middles = [bar.get_x() + bar.get_width() / 2 for bar in bars]
        np.testing.assert_allclose(middles, np.arange(29) * 0.01, atol=1e-12)
        np.testing.assert_allclose([line.get_xdata()[0] for line in axes.lines], [0.2, 0.11, 0], atol=1e-12)
        texts = [text.get_text() for text in axes.get_legend().get_texts()]
        # Cells that may meet the disc: those whose nearest point is in it.
        near = np.maximum(abs(np.arange(-100, 101)) * 0.01 - 0.005, 0)
        square = np.add.outer(near**2, near**2)
        counts = [(square <= r2 + 1e-12).sum() for r2 in (0.01, 0.25)]
        first = rf"costs \$5 // not a comment: 20 steps (0.2 s); {counts[0]:,} cells"
        lost = (delay < 0).sum()
        second = f"time: 11 steps (0.11 s); 40,401 cells, {lost:,} outside K"
        self.assertEqual(texts, [first, second, f"start: in K; {counts[1]:,} cells", "cells of K"])
        # Their bars share the width of that of all cells.
        region = [bar for bar in axes.containers[1].patches]
        inside = delay[square <= 0.01 + 1e-12]
        self.assertEqual({round(bar.get_height()) for bar in region}, set(np.bincount(inside)) - {0})
        self.assertAlmostEqual(region[0].get_width(), bars[0].get_width() / 3, 12)
        self.assertEqual(axes.get_yscale(), "linear")
        self.assertEqual(titles(figure), ["circle\n4 safe cells are not invariant", "horizontal|vertical"])
        self.assertEqual(labels(axes), ("delay [s]", "cells"))
        self.assertEqual(covered(figure), [])
        # Ticks are where bars are, and without unbounded cells there is no place for them.
        ticks = axes.get_xticks()
        self.assertEqual([text.get_text() for text in axes.get_xticklabels()], [f"{tick:.6g}" for tick in ticks])
        self.assertTrue(all(np.isclose(middles, tick, atol=1e-12).any() for tick in ticks))
        self.assertGreater(len(ticks), 4)

    def test_requirements_that_hold_and_fail(self):
        required = [
            {"name": "good", "where": "x <= 0.1 and y <= 0.1 and x > -0.4 and y > -0.4", "min_delay": 3},
            {"name": "no delay is asked for", "where": "true", "max_arrival": 0},
            {"name": "bad", "where": "x >= 3 and y >= 2.6", "min_delay": 2},
        ]
        self.write("spec.json", spec_with(requirements=required, goal="x <= 1"))
        self.assertEqual(self.run_program("analyze", "spec.json", "-o", "out.h5").returncode, 1)
        data, figure = self.plotted("requirements")
        axes = figure.axes[0]
        texts = [text.get_text() for text in axes.get_legend().get_texts()]
        self.assertEqual(texts, ["good: 3 steps (1.5 s), holds; 1 cell", "bad: 2 steps (1 s), FAILS; 4 cells, 3 outside K", "cells of K"])
        self.assertEqual([line.get_linestyle() for line in axes.lines], ["-", "--"])
        self.assertEqual(covered(figure), [])

    def test_small_regions_can_be_seen_and_are_those_of_the_program(self):
        self.write("spec.json", example("intersection_requirements.json"))
        self.assertEqual(self.run_program("analyze", "spec.json", "-o", "out.h5").returncode, 1)
        data, figure = self.plotted("requirements")
        found = [line.region.cells.sum() + line.region.unbounded + line.region.lost for line in data.histograms[0].lines]
        self.assert_arrays_equal(found, self.stored("counterexample/cells"))
        failing = data.histograms[0].lines[2]
        self.assert_arrays_equal(failing.region.cells[: failing.steps].sum(), self.stored("counterexample/failing")[2])
        self.assertEqual(figure.axes[0].get_yscale(), "log")
        self.assertEqual(covered(figure), [])

    def test_conditions_over_boxes_hold_where_some_or_all_points_do(self):
        from plotting.condition import Conditions

        random = np.random.default_rng(3)
        low = random.uniform(-2, 2, (2, 300))
        high = low + random.uniform(0, 1.5, (2, 300))
        share = random.random((40, 2, 300))
        points = low + share * (high - low)
        formulas = {"r2": "x^2 + y^2", "near": "r2 <= R^2", "R": "3/4"}
        for text in ("x < y", "near or x >= 1", "not near and -1 <= y < 1", "abs(x - y) > 0.5", "min(x, y) * max(x, -y) >= 0.1",
                     "x / (y + 3) <= 0.2", "sin(2*x) + cos(3*y) > 0.7", "if(x > 0, y, -y) >= 0.3", "sqrt(abs(x)) != y", "x^3 - 2*x >= y"):  # fmt: skip
            may, must = Conditions({"x": (low[0], high[0]), "y": (low[1], high[1])}, formulas).ask(text)
            true, same = Conditions({"x": (points[:, 0],) * 2, "y": (points[:, 1],) * 2}, formulas).ask(text)
            self.assert_arrays_equal(true, same)  # points decide
            self.assertTrue(may[true.any(axis=0)].all(), text)
            self.assertTrue(true[:, must].all(), text)
            self.assertTrue(0 < may.sum() and must.sum() < 300, text)
        for text in ("past >= 1", "x", "x <", "y ^ x > 1"):
            with self.assertRaises(ValueError):
                Conditions({"x": (low[0], high[0]), "y": (low[1], high[1])}, formulas).ask(text)

    def test_many_long_requirements_cover_nothing(self):
        required = [{"name": f"{i}: {'as long as it gets ' * i}", "where": "true", "min_delay": i} for i in range(1, 9)]
        self.write("spec.json", spec_with(requirements=required))
        self.assertEqual(self.run_program("analyze", "spec.json", "-o", "out.h5").returncode, 1)
        _, figure = self.plotted("requirements")
        self.assertEqual(len(figure.axes[0].get_legend().get_texts()), 9)
        self.assertEqual(covered(figure), [])

    def test_requirements_of_several_partitions(self):
        partitions = [{"classes": []}, {"name": "both", "classes": [["b", "a"]]}]
        spec = spec_with(coordination={"partitions": partitions})
        self.analyzed(spec)
        required = [{"name": "one", "where": "true", "partition": "a+b", "min_delay": 3}]

        def change(file):
            del file["spec"]
            file["spec"] = json.dumps(dict(spec, requirements=required))

        self.rewrite(change)
        data, figure = self.plotted("requirements")
        delay = self.stored("delay")
        for p, histogram in enumerate(data.histograms):
            self.assertEqual(histogram.unbounded, (delay[p] == UNBOUNDED).sum())
            self.assert_arrays_equal(histogram.cells, [(delay[p] == k).sum() for k in range(len(histogram.cells))])
            self.assertEqual(histogram.cells.sum() + histogram.unbounded, (delay[p] >= 0).sum())
        self.assertEqual([[line.name for line in histogram.lines] for histogram in data.histograms], [[], ["one"]])
        # What is unbounded has a place of its own, and a tick there that says so.
        axes = figure.axes[1]
        bar = axes.patches[-1]
        self.assertEqual(bar.get_height(), data.histograms[1].unbounded)
        self.assertAlmostEqual(bar.get_x() + bar.get_width() / 2, axes.get_xticks()[-1], 12)
        self.assertEqual([text.get_text() for text in axes.get_xticklabels()][-1], "never")
        self.assertGreater(bar.get_x(), data.highest * 0.5 + 0.5)
        self.assertEqual(covered(figure), [])
        data, figure = self.plotted("requirements", "--partition", "a|b")
        self.assertEqual([histogram.partition for histogram in data.histograms], ["a|b"])


if __name__ == "__main__":
    unittest.main()
