"""The risk over a swept value: what 'coordreq analyze --sweep PATH=V1,V2 --json' printed

Left: the mean and the worst risk over the invariance set. Right: the share of the set whose risk is small enough. Both are for the
initial mode of the network. FILE needs runs of a spec with a "risk" and one swept value."""

import json
import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from . import style
from .errors import FileError, StreamError

_THRESHOLDS = [0.0] + [10.0**power for power in range(-12, 0)]  # of `within`
_SHOWN = (4, 7, 9, 11)


@dataclass(frozen=True)
class Sweep:
    name: str  # of the spec
    path: str  # what is swept
    values: np.ndarray  # [run], ascending
    horizon: int
    mean: np.ndarray  # [run]
    worst: np.ndarray  # [run]
    shares: np.ndarray  # [run, threshold shown]


def add_arguments(_parser):
    """It has none of its own."""


def prepare(arguments):
    runs = _runs(arguments.file)
    paths = {path for run in runs for path in run["values"]}
    if len(paths) != 1:
        raise FileError(f"expected one swept value, found {len(paths)}", arguments.file)
    path = paths.pop()
    done = [run["summary"] for run in runs if "risk" in run.get("summary", {})]
    values = [_number(run["values"][path], arguments.file) for run in runs if "risk" in run.get("summary", {})]
    if not done:
        raise FileError('no run has a risk: sweep a spec with a "risk"', arguments.file)
    order = np.argsort(values, kind="stable")
    modes = [done[i]["risk"]["modes"][0] for i in order]
    cells = np.array([max(1, done[i]["invariant"]) for i in order])
    return Sweep(
        done[0]["name"],
        path,
        np.array(values)[order],
        done[0]["risk"]["horizon"],
        np.array([_risk(mode["mean"]) for mode in modes]),
        np.array([_risk(mode["worst"]) for mode in modes]),
        np.array([[mode["within"][i] for i in _SHOWN] for mode in modes]) / cells[:, None],
    )


def _runs(path):
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)["runs"]
    except OSError as error:
        raise StreamError(f"cannot read the file: {error.strerror}", path) from error
    except (ValueError, KeyError, TypeError) as error:
        raise FileError("expected what 'coordreq analyze --sweep ... --json' prints", path) from error


def _number(value, path):
    """Of a value as it was swept: a number, or a text such as 1/3."""
    try:
        return float(Fraction(str(value)))
    except (ValueError, ZeroDivisionError) as error:
        raise FileError(f"expected numbers as swept values, found '{value}'", path) from error


def _risk(number):
    """Nothing where K is empty."""
    return math.nan if number is None else number


def draw(sweep, size=None):
    figure = style.new_figure(size, (8.4, 3.8))
    risks, shares = figure.subplots(1, 2)
    for values, label, color in ((sweep.worst, "worst", style.KINDS[3]), (sweep.mean, "mean", style.KINDS[0])):
        risks.plot(sweep.values, np.ma.masked_less_equal(values, 0), marker="o", color=color, label=label)
    if np.nanmax(sweep.worst, initial=0) > 0:
        risks.set_yscale("log")
    risks.set_ylabel("risk")
    for column, place in enumerate(_SHOWN):
        label = f"at most {_THRESHOLDS[place]:.0e}"
        shares.plot(sweep.values, 100 * sweep.shares[:, column], marker="o", color=style.KINDS[column], label=label)
    shares.set_ylabel("part of the invariance set [%]")
    shares.set_ylim(-3, 103)
    for axes in (risks, shares):
        if sweep.values.min() > 0 and sweep.values.max() > sweep.values.min():
            axes.set_xscale("log")
        axes.set_xlabel(style.plain(sweep.path))
        axes.grid(True, linewidth=0.4, color=style.NOT_INVARIANT)
        axes.legend()
    style.add_title(figure, f"{sweep.name}, risk within {sweep.horizon} steps")
    return figure
