"""From which values on so much silence is tolerated: what 'coordreq require RESULTS ... --json' printed

Of one state a bar over its domain, of two the plane of both: coloured where the delay is at least what was asked for,
whatever the states are that were not given; white where it is less in some cell, or not known to be more."""

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


def add_arguments(_parser):
    """It has none of its own."""


def prepare(arguments):
    found = _read(arguments.file)
    try:
        over = found["over"]
        unit, steps = found["period_unit"], found["delay"]
        time = f" ({steps * found['period']:g} {unit})" if unit else ""
        notes = [f"{name} = {value:g}" for name, value in found["given"].items()]
        notes += [f"any {name}" for name in found["whatever"]]
        return Required(
            f"{found['name']}, {found['partition']}: delay of at least {steps} step{'' if steps == 1 else 's'}{time}",
            ", ".join(notes),
            [f"{own['state']} [{own['unit']}]" if own["unit"] else own["state"] for own in over],
            [(own["worst_value"], own["best_value"]) for own in over],
            [tuple(corner) for corner in found["corners"]],
        )
    except (KeyError, TypeError) as error:
        raise _not_ours(arguments.file) from error


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
    for corner in required.corners:
        worst = [*corner, 0][:2]
        sides = [best - value for value, (_, best) in zip(worst, ends)]
        axes.add_patch(Rectangle(worst, *sides, color=style.KINDS[2], linewidth=0))
    if not required.corners:
        axes.text(0.5, 0.5, "nowhere, not even at the best end", transform=axes.transAxes, ha="center", va="center")
    axes.set_xlim(sorted(ends[0]))
    axes.set_ylim(sorted(ends[1]))
    axes.set_xlabel(style.plain(required.labels[0]))
    if is_plane:
        axes.set_ylabel(style.plain(required.labels[1]))
    else:
        axes.set_yticks([])
    style.add_title(figure, required.title, required.note)
    style.legend_below(figure, [(style.KINDS[2], "tolerated"), (style.FREE, "not everywhere beyond")])
    return figure
