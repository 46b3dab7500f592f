"""A simulation: trajectories, and countdown, slack and margin over time

FILE is one that `coordreq simulate -o` wrote. The slack is the delay of the cell that the system is in: what the
agents would find if they looked; their countdown never exceeds it. With --plane x1,y1 --plane x2,y2 trajectories are
drawn over these pairs of states in one plane, else every state over time."""

import math
from dataclasses import dataclass

import numpy as np
from matplotlib.ticker import MaxNLocator

from . import style
from .errors import UsageError, quoted
from .results import StoredFile
from .values import whole_numbers

_NEVER = np.iinfo(np.int32).max
_COORDINATED = 1


@dataclass(frozen=True)
class Curve:
    label: str
    x: np.ndarray
    y: np.ndarray
    state: str  # name of what is along y
    unit: str  # curves of one unit share axes


@dataclass(frozen=True)
class Steps:
    """Numbers of steps over time; inf for ever, NaN below 0 (outside K)."""

    time: np.ndarray
    countdown: np.ndarray
    slack: np.ndarray
    coordinated: np.ndarray  # times of the steps that are coordinated


@dataclass(frozen=True)
class Run:
    title: str
    subtitle: str
    time_unit: str
    x_label: str
    y_label: str
    flat: bool  # trajectories are in a plane
    in_scale: bool
    curves: list[Curve]
    steps: Steps
    margin: np.ndarray


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
    curves = _plane_curves(planes, names, state) if planes else _time_curves(names, units, time, state)
    x_label, y_label, in_scale = _labels(planes, names, units, file.period_unit)
    return Run(
        title=f"{file.title}, {file.attribute('/', 'partition')}",
        subtitle=_subtitle(file, run),
        time_unit=file.period_unit,
        x_label=x_label,
        y_label=y_label,
        flat=bool(planes),
        in_scale=in_scale,
        curves=curves,
        steps=_steps(file, run, time),
        margin=file.read("/margin", (run, slice(samples))),
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


def _plane_curves(planes, names, state):
    return [Curve(f"{names[x]}, {names[y]}", state[:, x], state[:, y], names[y], "") for x, y in planes]


def _time_curves(names, units, time, state):
    return [Curve(name, time, state[:, i], name, units[i]) for i, name in enumerate(names)]


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
    countdown, slack = (_as_steps(file.read(name, part)) for name in ("/countdown", "/delay"))
    return Steps(time, countdown, slack, time[coordinated])


def _as_steps(values):
    return np.where(values == _NEVER, math.inf, np.where(values < 0, math.nan, values))


def draw(run, size=None):
    figure = style.new_figure(size, (9.5, 4.6))
    grid = figure.add_gridspec(2, 2, width_ratios=(1, 1.25), height_ratios=(1.6, 1))
    units = list(dict.fromkeys(curve.unit for curve in run.curves))
    left = grid[:, 0].subgridspec(len(units), 1)
    first = None
    for i, unit in enumerate(units):
        axes = figure.add_subplot(left[i], sharex=first)
        first = first or axes
        _draw_curves(axes, run, unit)
        if i + 1 < len(units):
            axes.tick_params(labelbottom=False)
            axes.set_xlabel("")
    above = figure.add_subplot(grid[0, 1])
    _draw_steps(above, run.steps)
    below = figure.add_subplot(grid[1, 1], sharex=above)
    _draw_margin(below, run)
    above.tick_params(labelbottom=False)
    style.add_title(figure, run.title, run.subtitle)
    return figure


def _draw_curves(axes, run, unit):
    names = [curve.state for curve in run.curves if curve.unit == unit]
    for i, curve in enumerate(run.curves):
        if curve.unit != unit:
            continue
        color = style.KINDS[i % len(style.KINDS)]
        dashes = ("-", "--", ":")[i // len(style.KINDS) % 3]
        axes.plot(curve.x, curve.y, dashes, color=color, label=style.plain(curve.label))
        if run.flat:
            axes.plot(curve.x[:1], curve.y[:1], "o", color=color, fillstyle="none")
            axes.plot(curve.x[-1:], curve.y[-1:], "s", color=color)
    axes.set_xlabel(style.plain(run.x_label))
    axes.set_ylabel(style.plain(run.y_label if run.flat else _with_unit(", ".join(names), unit)))
    if run.in_scale:
        axes.set_aspect("equal", adjustable="datalim")
    axes.legend(title="○ start  ■ end" if run.flat else None)
    axes.grid(alpha=0.3)


def ceiling_of(steps):
    """Where "never" is drawn: a little above all numbers of steps."""
    both = np.concatenate([steps.countdown, steps.slack])
    highest = both[np.isfinite(both)].max(initial=0)
    return highest + max(1, math.ceil(highest / 8))


def _draw_steps(axes, steps):
    ceiling = ceiling_of(steps)
    for values, label, options in (
        (steps.slack, "slack: delay of the cell", {"color": style.KINDS[1], "linewidth": 1}),
        (steps.countdown, "countdown", {"color": style.KINDS[0]}),
    ):
        shown = np.where(np.isinf(values), ceiling, values)
        axes.plot(steps.time, shown, drawstyle="steps-post", label=label, **options)
    zeros = np.zeros_like(steps.coordinated)
    axes.plot(steps.coordinated, zeros, "|", color="black", label="coordinated step", clip_on=False)
    axes.set_ylabel("steps")
    axes.yaxis.set_major_locator(MaxNLocator(integer=True))
    if np.isinf(steps.slack).any() or np.isinf(steps.countdown).any():
        axes.axhline(ceiling, color="#999999", linewidth=0.5, zorder=0)
        axes.text(1.01, ceiling, "never", transform=axes.get_yaxis_transform(), va="center", fontsize="small")
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncols=3, frameon=False)
    axes.grid(alpha=0.3)


def _draw_margin(axes, run):
    axes.plot(run.steps.time, run.margin, color=style.KINDS[2])
    axes.axhline(0, color="black", linewidth=0.8)
    axes.set_ylabel("margin")
    axes.set_xlabel(style.plain(_with_unit("time", run.time_unit)))
    axes.grid(alpha=0.3)
