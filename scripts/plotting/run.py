"""A simulation: trajectories, countdown, delay, margin and inputs over time

FILE comes from `coordreq simulate -o`. The delay is that of the current cell; the countdown of the agents never exceeds it. With
--plane x1,y1 --plane x2,y2 trajectories are drawn over these pairs of states in one plane, otherwise every state over time. Values
that are held until the next sample are drawn as steps; lines break at the seam of a periodic state. Dots are samples, if there are
not too many. Grey is unsafe: a margin below 0, and unsafe states if safety depends only on the states on the axes (over time: on
one of them, with the others as in the run)."""

import math
import textwrap

import numpy as np
from matplotlib.colors import ListedColormap

from . import style
from .path import Side, lone, path, stairs
from .run_samples import Curve, prepare, with_unit

__all__ = ["add_arguments", "draw", "prepare"]

_MARGIN, _COORDINATION = "#6a3d9a", "#b2182b"  # no colours of states or inputs
_GREY = ListedColormap([style.NOT_INVARIANT])
_FINE = 400  # points along an axis where it is asked what is not safe
_MOST_DOTS = 80
_STEP_TICKS = 6  # that have room one above another


def add_arguments(parser):
    parser.add_argument("--run", metavar="N", default="0", help="number of the run (default: 0)")
    text = "states to draw the trajectories over; once for each body that moves in the plane"
    parser.add_argument("--plane", action="append", default=[], metavar="STATE,STATE", help=text)


def draw(run, size=None):
    units = list(dict.fromkeys(curve.unit for curve in run.curves))
    input_units = list(dict.fromkeys(curve.unit for curve in run.inputs))
    figure = style.new_figure(size, (9.5, max(4.6 + 1.1 * len(input_units), 1 + 1.4 * len(units))))
    grid = figure.add_gridspec(1, 2, width_ratios=(1, 1.25))
    left = grid[0].subgridspec(len(units), 1)
    first = None
    for i, unit in enumerate(units):
        axes = figure.add_subplot(left[i], sharex=first)
        first = first or axes
        curves = [(k, curve) for k, curve in enumerate(run.curves) if curve.unit == unit]
        _draw_curves(axes, run, curves)
        _finish(axes, figure, len(units), 0.36, i + 1 == len(units))
    right = grid[1].subgridspec(2 + len(input_units), 1, height_ratios=[1.6, 1] + [1] * len(input_units))
    above = figure.add_subplot(right[0])
    _draw_steps(above, run)
    margin = figure.add_subplot(right[1], sharex=above)
    _draw_margin(margin, run)
    _finish(above, figure, 1, 0.45, False)
    _finish(margin, figure, 1, 0.45, not input_units)
    for i, unit in enumerate(input_units):
        axes = figure.add_subplot(right[2 + i], sharex=above)
        curves = [(len(run.curves) + k, curve) for k, curve in enumerate(run.inputs) if curve.unit == unit]
        _draw_inputs(axes, run, curves, unit)
        _finish(axes, figure, 2 + len(input_units), 0.45, i + 1 == len(input_units))
    style.add_title(figure, run.title, run.subtitle)
    return figure


def _finish(axes, figure, rows, width, is_last):
    letters = int(10 * figure.get_figheight() / rows)  # that fit along the axis, about
    axes.set_ylabel(textwrap.fill(axes.get_ylabel(), letters))
    style.legend_above(axes, width * figure.get_figwidth())
    if not is_last:
        axes.tick_params(labelbottom=False)
        axes.set_xlabel("")


def _look(i):
    """A colour and a stroke for each state and each input of the picture."""
    return style.KINDS[i % len(style.KINDS)], ("-", "--", ":")[i // len(style.KINDS) % 3]


def _draw_curves(axes, run, curves):
    for i, curve in curves:
        color, dashes = _look(i)
        pale = {"linewidth": 0.6, "marker": ".", "markersize": 5} if curve.jumps else {}
        axes.plot(*curve.path.T, dashes, color=color, label=style.plain(curve.label), **pale)
        axes.scatter(*lone(curve.path).T, s=9, color=color)
        _draw_samples(axes, curve, color)
        if run.flat:
            axes.plot(*curve.points[:1].T, "o", color=color, fillstyle="none")
            axes.plot(*curve.points[-1:].T, "s", color=color)
    if run.flat:
        color = _look(curves[0][0])[0] if len(curves) == 1 else "black"
        axes.plot([], [], "o", color=color, fillstyle="none", label="start")
        axes.plot([], [], "s", color=color, label="end")
    names = ", ".join(curve.label for _, curve in curves)
    axes.set_xlabel(style.plain(run.x_label))
    axes.set_ylabel(style.plain(run.y_label if run.flat else with_unit(names, curves[0][1].unit)))
    if run.in_scale:
        axes.set_aspect("equal", adjustable="datalim")
    for side, axis in enumerate((axes.xaxis, axes.yaxis)):
        _tick_points(axis, run.spec, [(curve.states[side], curve.points[:, side]) for _, curve in curves])
    axes.grid(alpha=0.3)
    (_shade_plane if run.flat else _shade_time)(axes, run, [curve for _, curve in curves])


def _draw_samples(axes, curve, color):
    if len(curve.points) <= _MOST_DOTS:
        axes.scatter(*curve.points.T, s=7, color=color, zorder=2.5)


def _draw_inputs(axes, run, curves, unit):
    # Wide lines first: those that lie under others are seen at both sides of them.
    for width, (i, curve) in zip(range(len(curves), 0, -1), curves):
        color, dashes = _look(i)
        axes.plot(*curve.path.T, dashes, color=color, linewidth=min(2 * width - 1, 5), label=style.plain(curve.label))
        _draw_samples(axes, curve, color)
    axes.set_ylabel(style.plain(with_unit("input", unit)))
    axes.set_xlabel(style.plain(with_unit("time", run.time_unit)))
    axes.grid(alpha=0.3)


def _shade_plane(axes, run, curves):
    """What is not safe, if that depends on nothing but the two states of one curve."""
    asked = set(run.spec.states_of_safe())
    over = [curve for curve in curves if asked and asked <= set(curve.states)]
    if len(over) == 1 and len(curves) == 1:
        # Also beyond the limits, which equal scales of both axes may widen.
        x, y = (np.linspace(3 * a - 2 * b, 3 * b - 2 * a, 3 * _FINE) for a, b in (axes.get_xlim(), axes.get_ylim()))
        _shade(axes, run, {over[0].states[0]: x, over[0].states[1]: y[:, None]}, (x, y))


def _shade_time(axes, run, curves):
    """What is not safe for the one state of the axes on which that depends, at each sample with the others as they are."""
    asked = run.spec.states_of_safe()
    over = [curve.states[1] for curve in curves if curve.states[1] in asked]
    if len(over) == 1 and len(run.steps.time) > 1:
        y = np.linspace(*axes.get_ylim(), _FINE)
        _shade(axes, run, {**run.trace, over[0]: y[:, None]}, (run.steps.time, y))


def _shade(axes, run, values, places):
    try:
        _, safe = run.spec.conditions({name: (at, at) for name, at in values.items()}).ask(run.spec.safe())
    except ValueError:
        return  # a formula that points do not decide
    limits = axes.get_xlim(), axes.get_ylim()
    unsafe = np.ma.masked_equal(~np.broadcast_to(safe, (len(places[1]), len(places[0]))), False)
    if unsafe.count():
        axes.pcolormesh(*places, unsafe, cmap=_GREY, shading="nearest", zorder=0, rasterized=True)
        axes.plot([], [], "s", color=style.NOT_INVARIANT, label="not safe")
    axes.set(xlim=limits[0], ylim=limits[1])
    axes.grid(alpha=0.3)  # which such an image takes away


def _tick_points(axis, spec, states):
    """@param states (name, values) of what is along the axis"""
    if not all(name is not None and spec.is_discrete(name) for name, _ in states):
        return
    grids = [spec.grid_between(name, values.min(), values.max()) for name, values in states]
    style.point_ticks(axis, sorted(set().union(*grids)))


def _draw_steps(axes, run):
    steps = run.steps
    both = np.concatenate([steps.countdown, steps.delay])
    highest = int(both[np.isfinite(both)].max(initial=0))
    never = highest + max(1, math.ceil(highest / 8))
    for values, label, options in (
        (steps.delay, "delay of the cell", {"color": style.NOT_SAFE, "linewidth": 1}),
        (steps.countdown, "countdown", {"color": "black"}),
    ):
        shown = np.where(np.isinf(values), never, values)
        axes.plot(*stairs(steps.time, shown, run.period).T, label=label, **options)
    zeros = np.zeros_like(steps.coordinated)
    marks = axes.plot(steps.coordinated, zeros, "|", color=_COORDINATION, markeredgewidth=1.5, label="coordinated step", clip_on=False)
    marks[0].set_in_layout(False)  # where there are none their place is nowhere
    axes.set_ylabel("steps")
    _step_ticks(axes, highest, never, np.isinf(both).any())
    axes.grid(alpha=0.3)


def _step_ticks(axes, highest, never, has_never):
    """Whole steps, and at the place of what never ends its name instead of a number."""
    top = never if has_never else max(highest, 1)
    steps = [k for k in style.whole_steps(highest, _STEP_TICKS) if not has_never or never - k > top / (2 * _STEP_TICKS)]
    axes.set_yticks(steps + [never] * bool(has_never), [f"{k}" for k in steps] + ["never"] * bool(has_never))
    axes.set_ylim(-0.05 * top, 1.05 * top)


def _draw_margin(axes, run):
    time, margin = run.steps.time, run.margin
    line = stairs(time, margin, run.period) if run.margin_jumps else path(Side(time), Side(margin))
    axes.plot(*line.T, color=_MARGIN)
    _draw_samples(axes, Curve("", np.stack([time, margin], axis=1), line, False, (), ""), _MARGIN)
    axes.axhline(0, color="black", linewidth=0.8)
    lowest = axes.get_ylim()[0]
    if lowest < 0:
        axes.axhspan(lowest, 0, color=style.NOT_INVARIANT, linewidth=0, zorder=0)
        axes.set_ylim(bottom=lowest)
    axes.set_ylabel("margin")
    axes.set_xlabel(style.plain(with_unit("time", run.time_unit)))
    axes.grid(alpha=0.3)
