"""What a picture of a simulation shows, read from a file of `simulate -o`."""

import math
from dataclasses import dataclass

import numpy as np

from .errors import UsageError, quoted
from .path import Side, path, stairs
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
    inputs: list[Curve]
    trace: dict  # state name -> its samples
    steps: Steps
    margin: np.ndarray
    margin_jumps: bool
    spec: Spec


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
        inputs=_inputs(file, run, time),
        trace=dict(zip(names, state.T)),
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
        raise UsageError(f"expected two states such as x1,y1, found '{text}'", "--plane")
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


def _inputs(file, run, time):
    """Held from each sample to the next; after the last one there is none."""
    curves, units = [], file.spec.units("inputs")
    values = file.read("/input", (run, slice(len(time) - 1)))
    for i, name in enumerate(str(name) for name in file.read("/input_name")):
        held = values[:, i]
        line = stairs(time[:-1], held, file.period) if len(held) else np.empty((0, 2))
        curves.append(Curve(name, np.stack([time[:-1], held], axis=1), line, False, (None, name), units.get(name, "")))
    return curves


def _labels(planes, names, units, time_unit):
    """Of both axes, and whether they have one scale."""
    if not planes:
        return with_unit("time", time_unit), "", False
    labels = []
    for side in (0, 1):
        dimensions = [plane[side] for plane in planes]
        found = sorted({units[i] for i in dimensions})
        labels.append(with_unit(", ".join(names[i] for i in dimensions), "; ".join(filter(None, found))))
    return *labels, len({units[i] for plane in planes for i in plane}) == 1


def with_unit(name, unit):
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
