"""The line through samples: what holds its value until the next one jumps there, and a seam is no motion."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Side:
    """What is along one axis of a picture, a value a sample."""

    values: np.ndarray
    is_held: bool = False  # until the next sample
    period: float = np.inf  # after which the values start again

    def crosses(self):
        """Between which neighbours the short way leads through the seam."""
        if np.isinf(self.period):
            return np.zeros(len(self.values) - 1, dtype=bool)
        return np.abs(np.diff(self.values)) > self.period / 2


def path(x, y):
    """Points [n, 2] of the line: in each step first what moves does so, then what is held jumps.

    NaN where the line breaks, which is at seams. With both held it leads straight from sample to sample.
    """
    samples = np.stack([x.values, y.values], axis=1).astype(float)
    is_held = np.array([x.is_held, y.is_held])
    crosses = np.stack([x.crosses(), y.crosses()], axis=1)
    moved = np.where(is_held, samples[:-1], samples[1:])
    moved[(crosses & ~is_held).any(axis=1)] = np.nan
    jumped = moved.copy()
    jumped[(crosses & is_held).any(axis=1)] = np.nan
    points = np.stack([samples[:-1], moved, jumped], axis=1).reshape(-1, 2)
    points = np.concatenate([points, samples[-1:]])
    is_same = (points[1:] == points[:-1]) | (np.isnan(points[1:]) & np.isnan(points[:-1]))
    return points[np.append(True, ~is_same.all(axis=1))]


def stairs(time, values, length, period=np.inf):
    """The path of what is held over time, the last value for one more step of this length."""
    x, y = np.append(time, time[-1] + length), np.append(values, values[-1])
    return path(Side(x), Side(y, True, period))


def lone(points):
    """The points of a path that no line reaches: breaks, or nothing, on both of their sides."""
    ends = np.isnan(points).any(axis=1)
    return points[~ends & np.append(True, ends[:-1]) & np.append(ends[1:], True)]
