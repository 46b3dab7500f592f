"""Figures in three dimensions: what is lost, and how it grows with the connection delay."""

import itertools
import unittest

import numpy as np
from plot_case import PlotCase, drawn, example, labels, legend, titles
from program import SPEC, spec_with


class Cases(PlotCase):
    def test_unsafe3d_shows_the_surface_of_what_is_lost(self):
        self.analyzed(example("aircraft_coarse.json"))
        data, figure = self.plotted("unsafe3d", "--delays", "2,6", "--x", "x", "--y", "y", "--z", "h")
        # The file has them as h, y, x.
        lost = self.stored("invariant").transpose() == 0
        delay = self.stored("delay")[0].transpose()
        collision = self.stored("collision_time").transpose()
        self.assert_arrays_equal(data.collision.members, lost)
        self.assert_arrays_equal(data.collision.steps[lost], collision[lost])
        for panel, d in zip(data.growth, (2, 6)):
            self.assert_arrays_equal(panel.members, delay < d)
            self.assert_arrays_equal(panel.steps[delay >= 0], delay[delay >= 0])
            self.assertEqual(set(panel.steps[delay < 0]), {-1})
        for axes, panel in zip(figure.axes, [data.collision, *data.growth]):
            self.assertEqual(len(axes.collections[0].get_facecolor()), self.faces(panel.members, data.viewer))
        panels = ["outside K", "D = 2 steps (0.4 min)", "D = 6 steps (1.2 min)"]
        self.assertEqual(titles(figure), ["aircraft_coarse, first|second", *panels])
        self.assertEqual((*labels(figure.axes[0]), figure.axes[0].get_zlabel()), ("x [km]", "y [km]", "h [rad]"))
        # No label lies on the ticks of a bar, and at the corner of two axes neither has a number.
        drawn(figure)
        bars = [bar.get_tightbbox() for bar in figure.axes[3:]]
        for axes in figure.axes[:3]:
            labels_of_axes = [along.label.get_window_extent() for along in (axes.xaxis, axes.yaxis, axes.zaxis)]
            self.assertFalse(any(label.overlaps(bar) for label in labels_of_axes for bar in bars))
            self.assertFalse(axes.patch.get_visible())
            for ticks, ends in ((axes.get_xticks(), axes.get_xlim()), (axes.get_yticks(), axes.get_ylim())):
                self.assertGreater(len(ticks), 1)
                self.assertGreater(min(ticks) - ends[0], 0.05 * (ends[1] - ends[0]))
                self.assertGreater(ends[1] - max(ticks), 0.05 * (ends[1] - ends[0]))

    @staticmethod
    def faces(members, viewer):
        """By definition: pairs of a cell and a side whose neighbour towards the viewer is not a member."""
        count = 0
        for cell in np.argwhere(members):
            for dimension, side in enumerate(viewer):
                beyond = cell.copy()
                beyond[dimension] += side
                inside = 0 <= beyond[dimension] < members.shape[dimension]
                count += not (inside and members[tuple(beyond)])
        return count

    def test_faces_lie_between_a_member_and_what_is_none(self):
        from plotting.surface import visible_faces

        members = np.random.default_rng(7).random((4, 5, 6)) < 0.5
        padded = np.pad(members, 1)
        for viewer in itertools.product((1, -1), repeat=3):
            cells, corners, dimensions = visible_faces(members, viewer)
            self.assertEqual(len(cells), self.faces(members, viewer))
            for cell, quad, dimension in zip(cells, corners, dimensions):
                self.assertTrue(members[tuple(cell)])
                beyond = cell + 1
                beyond[dimension] += viewer[dimension]
                self.assertFalse(padded[tuple(beyond)])
                at = cell[dimension] + (viewer[dimension] > 0)
                self.assertEqual(set(quad[:, dimension]), {at})
                others = [d for d in range(3) if d != dimension]
                expected = set(itertools.product(*((cell[d], cell[d] + 1) for d in others)))
                self.assertEqual({tuple(corner) for corner in quad[:, others]}, expected)

    def test_unsafe3d_shows_k_where_what_is_lost_lies_around_it(self):
        states = [{"name": name, "lower": 0, "upper": 6, "step": 1, "outside": "unsafe"} for name in "xyz"]
        equations = {"x": "x + u", "y": "y + v", "z": "z"}
        band = "1 <= x <= 5 and 1 <= y <= 5 and 1 <= z <= 5"
        dynamics = {"time": "discrete", "period": 1, "equations": equations}
        self.analyzed(spec_with(states=states, dynamics=dynamics, safe=band))
        data, figure = self.plotted("unsafe3d", "--delays", "1,2")
        invariant, delay = self.stored("invariant") != 0, self.stored("delay")[0]
        self.assertEqual(invariant.sum(), 5**3)
        self.assert_arrays_equal(data.collision.members, invariant)
        for panel, d in zip(data.growth, (1, 2)):
            self.assert_arrays_equal(panel.members, delay >= d)
        self.assertEqual(titles(figure), ["small, a|b", "K", "tolerates 1 step", "tolerates 2 steps"])
        self.assertEqual(legend(figure), ["K", "unbounded delay"])
        for axes, panel in zip(figure.axes, [data.collision, *data.growth]):
            self.assertEqual(len(axes.collections[0].get_facecolor()), self.faces(panel.members, data.viewer))
        # Of what lies at one side of the domain only, the surface is shown.
        self.analyzed(spec_with(states=states, dynamics=dynamics, safe="x + y + z <= 14"))
        _, figure = self.plotted("unsafe3d", "--delays", "1")
        self.assertEqual(titles(figure)[1], "outside K")

    def test_unsafe3d_needs_three_states(self):
        self.analyzed(SPEC)
        words = ("unsafe3d", "out.h5", "-o", "a.png")
        self.assert_plot_fails(2, "the picture has 3 axes, found 2 states to draw", *words)
        view = "expected an elevation and an azimuth such as 24,-56, found '95,0' (--view)"
        self.assert_plot_fails(2, view, *words, "--view", "95,0")


if __name__ == "__main__":
    unittest.main()
