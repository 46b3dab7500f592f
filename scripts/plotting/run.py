"""A simulation: trajectories, and countdown, delay and margin over time

FILE is one that `coordreq simulate -o` wrote. The delay is that of the cell that the system is in: what the agents
would find if they looked; their countdown never exceeds it. With --plane x1,y1 --plane x2,y2 trajectories are drawn
over these pairs of states in one plane, else every state over time. What keeps its value until the next sample is drawn
in steps, the last sample for one period more; lines break at the seam of a periodic state."""

import math
import textwrap
from dataclasses import dataclass

import numpy as np

from . import style
from .errors import UsageError, quoted
from .path import Side, lone, path, stairs
from .results import StoredFile
from .spec import Spec
from .values import whole_numbers

_NEVER = np.iinfo(np.int32).max
_COORDINATED = 1


@dataclass(frozen=True)
class Curve:
    label: str
    points: np.ndarray  # the samples, [n, 2]
    path: np.ndarray  # the line through them, see there
    jumps: bool  # straight from sample to sample, nothing lies between them
    states: tuple  # names of what is along x and y, None: time
    unit: str  # curves of one unit share axes


@dataclass(frozen=True)
class Steps:
    """Numbers of steps over time; inf for ever, NaN below 0 (outside K)."""

    time: np.ndarray
    countdown: np.ndarray
    delay: np.ndarray  # of the cell that the system is in
    coordinated: np.ndarray  # times of the steps that are coordinated


@dataclass(frozen=True)
class Run:
    title: str
    subtitle: str
    time_unit: str
    period: float
    x_label: str
    y_label: str
    flat: bool  # trajectories are in a plane
    in_scale: bool
    curves: list[Curve]
    steps: Steps
    margin: np.ndarray
    margin_jumps: bool
    spec: Spec


def add_arguments(parser):
    parser.add_argument("--run", metavar="N", default="0", help="number of the run (default: 0)")
    text = "states to draw the trajectories over; once for each body that moves in the plane"
    parser.add_argument("--plane", action="append", default=[], metavar="STATE,STATE", help=text)


def prepare(arguments):
    file = StoredFile(arguments.file, "coordreq-runs")
    run = _chosen_run(arguments.run, len(file.read("/run")))
    samples = int(file.read("/samples")[run])
    time = file.read("/time")[:samples]
    names = [str(name) for name in file.read("/state_name")]
    state = file.read("/state", (run, slice(samples)))
    units = [file.spec.units("states").get(name, "") for name in names]
    planes = [_parse_plane(text, names) for text in arguments.plane]
    sides = [Side(state[:, i], file.spec.jumps(name), file.spec.period(name)) for i, name in enumerate(names)]
    curves = _plane_curves(planes, names, sides) if planes else _time_curves(names, units, time, sides, file.period)
    x_label, y_label, in_scale = _labels(planes, names, units, file.period_unit)
    return Run(
        title=f"{file.title}, {file.attribute('/', 'partition')}",
        subtitle=_subtitle(file, run),
        time_unit=file.period_unit,
        period=file.period,
        x_label=x_label,
        y_label=y_label,
        flat=bool(planes),
        in_scale=in_scale,
        curves=curves,
        steps=_steps(file, run, time),
        margin=file.read("/margin", (run, slice(samples))),
        margin_jumps=file.spec.safe_jumps(),
        spec=file.spec,
    )


def _chosen_run(text, runs):
    (run,) = whole_numbers(text, "--run") if "," not in text else (-1,)
    if not 0 <= run < runs:
        raise UsageError(f"expected the number of one run, 0 to {runs - 1}, found '{text}'", "--run")
    return run


def _parse_plane(text, names):
    pair = [name.strip() for name in text.split(",")]
    if len(pair) != 2:
        raise UsageError(f"expected two states as in x1,y1, found '{text}'", "--plane")
    for name in pair:
        if name not in names:
            raise UsageError(f"'{name}' is no state, expected {quoted(names)}", "--plane")
    return [names.index(name) for name in pair]


def _plane_curves(planes, names, sides):
    curves = []
    for pair in planes:
        x, y = (sides[i] for i in pair)
        points = np.stack([x.values, y.values], axis=1)
        states = tuple(names[i] for i in pair)
        curves.append(Curve(", ".join(states), points, path(x, y), x.is_held and y.is_held, states, ""))
    return curves


def _time_curves(names, units, time, sides, period):
    curves = []
    for name, unit, side in zip(names, units, sides):
        line = stairs(time, side.values, period, side.period) if side.is_held else path(Side(time), side)
        curves.append(Curve(name, np.stack([time, side.values], axis=1), line, False, (None, name), unit))
    return curves


def _labels(planes, names, units, time_unit):
    """Of both axes, and whether they have one scale."""
    if not planes:
        return _with_unit("time", time_unit), "", False
    labels = []
    for side in (0, 1):
        dimensions = [plane[side] for plane in planes]
        found = sorted({units[i] for i in dimensions})
        labels.append(_with_unit(", ".join(names[i] for i in dimensions), "; ".join(filter(None, found))))
    return *labels, len({units[i] for plane in planes for i in plane}) == 1


def _with_unit(name, unit):
    return f"{name} [{unit}]" if unit else name


def _subtitle(file, run):
    outcomes = str(file.attribute("/outcome", "flag_meanings")).split()
    outcome = outcomes[int(file.read("/outcome")[run])].replace("_", " ")
    return f"run {run}, policy {file.attribute('/', 'policy')}, seed {file.attribute('/', 'seed')}: {outcome}"


def _steps(file, run, time):
    part = (run, slice(len(time)))
    coordinated = file.read("/coordinated", part) == _COORDINATED
    countdown, delay = (_as_steps(file.read(name, part)) for name in ("/countdown", "/delay"))
    return Steps(time, countdown, delay, time[coordinated])


def _as_steps(values):
    return np.where(values == _NEVER, math.inf, np.where(values < 0, math.nan, values))


def draw(run, size=None):
    units = list(dict.fromkeys(curve.unit for curve in run.curves))
    figure = style.new_figure(size, (9.5, max(4.6, 1 + 1.4 * len(units))))
    grid = figure.add_gridspec(2, 2, width_ratios=(1, 1.25), height_ratios=(1.6, 1))
    left = grid[:, 0].subgridspec(len(units), 1)
    first = None
    for i, unit in enumerate(units):
        axes = figure.add_subplot(left[i], sharex=first)
        first = first or axes
        _draw_curves(axes, run, unit)
        letters = int(10 * figure.get_figheight() / len(units))  # that fit along the axis, about
        axes.set_ylabel(textwrap.fill(axes.get_ylabel(), letters))
        style.legend_above(axes, 0.36 * figure.get_figwidth())
        if i + 1 < len(units):
            axes.tick_params(labelbottom=False)
            axes.set_xlabel("")
    above = figure.add_subplot(grid[0, 1])
    _draw_steps(above, run)
    style.legend_above(above, 0.45 * figure.get_figwidth())
    below = figure.add_subplot(grid[1, 1], sharex=above)
    _draw_margin(below, run)
    above.tick_params(labelbottom=False)
    style.add_title(figure, run.title, run.subtitle)
    return figure


def _draw_curves(axes, run, unit):
    curves = [curve for curve in run.curves if curve.unit == unit]
    for i, curve in enumerate(run.curves):
        if curve.unit != unit:
            continue
        color = style.KINDS[i % len(style.KINDS)]
        dashes = ("-", "--", ":")[i // len(style.KINDS) % 3]
        pale = {"linewidth": 0.6, "marker": ".", "markersize": 5} if curve.jumps else {}
        axes.plot(*curve.path.T, dashes, color=color, label=style.plain(curve.label), **pale)
        axes.scatter(*lone(curve.path).T, s=9, color=color)
        if run.flat:
            axes.plot(*curve.points[:1].T, "o", color=color, fillstyle="none")
            axes.plot(*curve.points[-1:].T, "s", color=color)
    if run.flat:
        axes.plot([], [], "o", color="black", fillstyle="none", label="start")
        axes.plot([], [], "s", color="black", label="end")
    names = ", ".join(curve.label for curve in curves)
    axes.set_xlabel(style.plain(run.x_label))
    axes.set_ylabel(style.plain(run.y_label if run.flat else _with_unit(names, unit)))
    if run.in_scale:
        axes.set_aspect("equal", adjustable="datalim")
    for side, axis in enumerate((axes.xaxis, axes.yaxis)):
        _tick_points(axis, run.spec, [(curve.states[side], curve.points[:, side]) for curve in curves])
    axes.grid(alpha=0.3)


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
        (steps.delay, "delay of the cell", {"color": style.KINDS[1], "linewidth": 1}),
        (steps.countdown, "countdown", {"color": style.KINDS[0]}),
    ):
        shown = np.where(np.isinf(values), never, values)
        axes.plot(*stairs(steps.time, shown, run.period).T, label=label, **options)
    zeros = np.zeros_like(steps.coordinated)
    marks = axes.plot(steps.coordinated, zeros, "|", color="black", label="coordinated step", clip_on=False)
    marks[0].set_in_layout(False)  # where there are none their place is nowhere
    axes.set_ylabel("steps")
    _step_ticks(axes, highest, never, np.isinf(both).any())
    axes.grid(alpha=0.3)


def _step_ticks(axes, highest, never, has_never):
    """Whole steps, and at the place of what never ends its name instead of a number."""
    steps = style.whole_steps(highest)
    axes.set_yticks(steps + [never] * has_never, [f"{k}" for k in steps] + ["never"] * has_never)
    top = never if has_never else max(highest, 1)
    axes.set_ylim(-0.05 * top, 1.05 * top)


def _draw_margin(axes, run):
    time, margin = run.steps.time, run.margin
    line = stairs(time, margin, run.period) if run.margin_jumps else path(Side(time), Side(margin))
    axes.plot(*line.T, color=style.KINDS[2])
    axes.axhline(0, color="black", linewidth=0.8)
    axes.set_ylabel("margin")
    axes.set_xlabel(style.plain(_with_unit("time", run.time_unit)))
    axes.grid(alpha=0.3)
