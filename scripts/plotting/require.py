"""The values that tolerate a given silence: what 'coordreq require RESULTS ... --json' printed

For one state a bar over its domain, coloured where the limit holds; for two states their plane, coloured from the values on which
it holds. It holds for all values of the states that were not given. White: some cell does not keep the limit, or this is not known."""

import json
from dataclasses import dataclass

from matplotlib.patches import Rectangle

from . import style
from .errors import FileError, StreamError


@dataclass(frozen=True)
class Required:
    title: str
    note: str
    labels: list  # of one state or two
    ends: list  # of the domain: (worst value, best value) of each
    corners: list  # the worst values of each region that tolerates it
    intervals: list  # of one state: from, to


def add_arguments(_parser):
    """It has none of its own."""


def prepare(arguments):
    found = _read(arguments.file)
    try:
        over = found["over"]
        kind = found["kind"]
        value = kind.split("_", 1)[1]
        limit = f"{found[value]:g}" if value == "risk" else _steps(found[value], found["period"], found["period_unit"])
        notes = [f"{name} = {value:g}" for name, value in found["given"].items()]
        notes += [f"any {name}" for name in found["whatever"]]
        return Required(
            f"{found['name']}, {found['partition']}: {value.replace('_', ' ')} of at {'most' if kind.startswith('max') else 'least'} {limit}",
            ", ".join(notes),
            [f"{own['state']} [{own['unit']}]" if own["unit"] else own["state"] for own in over],
            [(own["worst_value"], own["best_value"]) for own in over],
            [tuple(corner) for corner in found["corners"]],
            [tuple(interval) for interval in found["intervals"]] if len(over) == 1 else [],
        )
    except (KeyError, TypeError) as error:
        raise _not_ours(arguments.file) from error


def _steps(steps, period, unit):
    time = f" ({steps * period:g} {unit})" if unit else ""
    return f"{steps} step{'' if steps == 1 else 's'}{time}"


def _read(path):
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except OSError as error:
        raise StreamError(f"cannot read the file: {error.strerror}", path) from error
    except ValueError as error:
        raise _not_ours(path) from error


def _not_ours(path):
    return FileError("expected what 'coordreq require ... --json' prints", path)


def draw(required, size=None):
    is_plane = len(required.ends) == 2
    figure = style.new_figure(size, (5.2, 4.4) if is_plane else (6.4, 1.9))
    axes = figure.subplots()
    ends = [*required.ends, (0, 1)][:2]
    for corner in required.corners if is_plane else []:
        sides = [best - value for value, (_, best) in zip(corner, ends)]
        axes.add_patch(Rectangle(corner, *sides, color=style.KINDS[2], linewidth=0))
    for low, high in required.intervals:
        axes.add_patch(Rectangle((low, 0), high - low, 1, color=style.KINDS[2], linewidth=0))
    if not (required.corners if is_plane else required.intervals):
        words = "nowhere, not even at the best end" if is_plane else "nowhere"
        axes.text(0.5, 0.5, words, transform=axes.transAxes, ha="center", va="center")
    axes.set_xlim(sorted(ends[0]))
    axes.set_ylim(sorted(ends[1]))
    axes.set_xlabel(style.plain(required.labels[0]))
    if is_plane:
        axes.set_ylabel(style.plain(required.labels[1]))
    else:
        axes.set_yticks([])
    style.add_title(figure, required.title, required.note)
    style.legend_below(figure, [(style.KINDS[2], "tolerated"), (style.FREE, "not everywhere beyond" if is_plane else "not everywhere")])
    return figure
