"""Published problems of reach and stay, solved once more: on the same cells, with the exact maps of their modes."""

import unittest

import h5py
import numpy
from program import CONFIGS, Case

MOST = 32767  # of int16: cannot be forced
EDGE = 1e-7  # of a cell; what is not further beyond a face ends there: it does not meet the next cell [a, b)


def exponential(matrix):
    """Of a small matrix: squares of its series."""
    small, term, total = matrix / 1024, numpy.eye(len(matrix)), numpy.eye(len(matrix))
    for k in range(1, 20):
        term = term @ small / k
        total = total + term
    return numpy.linalg.matrix_power(total, 1024)


def affine(matrix, constant, period):
    """M and c of the map x -> M x + c that an affine equation makes in one period."""
    both = numpy.zeros((3, 3))
    both[:2, :2], both[:2, 2] = matrix, constant
    both = exponential(both * period)
    return both[:2, :2], both[:2, 2]


class Grid:
    """Cells [a, b) of two states in a domain, by their lower faces."""

    def __init__(self, lower, step, shape):
        self.lower, self.step, self.shape = numpy.array(lower), numpy.array(step), shape
        self.centres = numpy.stack(numpy.meshgrid(*(lower[d] + step[d] * (numpy.arange(shape[d]) + 0.5) for d in (0, 1)), indexing="ij"), -1)

    def box(self, lower, upper):
        """Cells within a box whose faces are faces of cells."""
        return ((self.centres > lower) & (self.centres < upper)).all(-1)

    def post(self, mode):
        """Of the image of each cell under a mode: the corners of its hull among the sums of inside(), and the cells that it meets;
        more than there are if it leaves the domain."""
        matrix, constant = mode
        middle = (self.centres @ matrix.T + constant - self.lower) / self.step
        radius = numpy.abs(matrix * self.step / self.step[:, None]).sum(1) / 2 - EDGE
        first, last = numpy.floor(middle - radius).astype(int), numpy.ceil(middle + radius).astype(int)
        size = numpy.where(((first >= 0) & (last <= self.shape)).all(-1), (last - first).prod(-1), self.centres.size)
        ends = [end.clip(0, self.shape) for end in (first, last)]
        return [x[..., 0] * (self.shape[1] + 1) + y[..., 1] for x in ends for y in ends], size

    def inside(self, cells, posts):
        """Cells with one of the posts in `cells`."""
        sums = numpy.zeros((self.shape[0] + 1, self.shape[1] + 1), int)
        sums[1:, 1:] = cells.cumsum(0).cumsum(1)
        sums = sums.ravel()
        return numpy.any([sums[both] - sums[lower] - sums[upper] + sums[none] == size for (none, lower, upper, both), size in posts], 0)


def fixed_point(cells, step):
    while True:
        after = step(cells)
        if (after == cells).all():
            return cells
        cells = after


def arrival(grid, safe, goal, modes):
    """Samples outside the goal that some choice of modes bounds, by nested fixed points: V_k may lose k of them."""
    posts = [grid.post(mode) for mode in modes]

    def controllable(cells):
        return safe & grid.inside(cells, posts)

    invariant = fixed_point(safe, controllable)
    lost = numpy.full(grid.shape, MOST)
    before = numpy.zeros(grid.shape, bool)
    for k in range(MOST):
        nearer = controllable(before) & invariant
        cells = fixed_point(invariant, lambda kept: (nearer | (goal & controllable(kept))) & invariant)
        if (cells == before).all() and k > 0:
            return lost, invariant
        lost[cells & ~before] = k
        before = cells


def converter():
    xl, xc, rl, rc, r0 = 3, 70, 0.05, 0.005, 1
    charge = (1 / 3, 0)
    closed = [[-rl / xl, 0], [0, -1 / (xc * (r0 + rc))]]
    opened = [[-(rl + r0 * rc / (r0 + rc)) / xl, -r0 / (r0 + rc) / xl], [r0 / (r0 + rc) / xc, -1 / (r0 + rc) / xc]]
    return [affine(numpy.array(matrix), charge, 0.5) for matrix in (closed, opened)]


def rooms():
    r1, r2, outside = 0.002, 0.1, 16
    off = affine(numpy.array([[-r1, 0], [0, 0]]), (r1 * outside, 0), 10)
    return [off] + [affine(numpy.array([[-r1, r1], [0, 0]]), (0, burner * r2), 10) for burner in (-1, 0, 1)]


class Cases(Case):
    def assert_solved(self, example, grid, safe, goal, modes):
        """@returns the cells that win and those that do not leave the safe set"""
        result = self.run_program("analyze", str(CONFIGS / example), "-o", "r.h5", "--quiet")
        self.assertEqual(result.returncode, 0, result.stderr.decode())
        lost, invariant = arrival(grid, safe, goal, modes)
        with h5py.File(self.folder / "r.h5") as file:
            self.assertTrue((file["invariant"][...].astype(bool) == invariant).all())
            self.assertTrue((file["arrival"][...][invariant] == lost[invariant]).all())
        return (lost < MOST).sum(), invariant.sum()

    def test_boost_converter(self):
        grid = Grid((0.65, 0.99), (0.005, 0.001), (200, 200))
        safe, goal = numpy.ones(grid.shape, bool), grid.box((1.1, 1.08), (1.6, 1.18))
        self.assertEqual(self.assert_solved("dcdc.json", grid, safe, goal, converter()), (37433, 37465))

    def test_room_with_four_modes(self):
        grid = Grid((10, 12), (0.05, 0.5), (360, 36))
        safe, goal = ~grid.box((22, 26), (28, 30)), grid.box((18, 20), (20, 22))
        self.assertEqual(self.assert_solved("heating.json", grid, safe, goal, rooms()), (12000, 12000))


if __name__ == "__main__":
    unittest.main()
