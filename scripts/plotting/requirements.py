"""How many cells tolerate how long without coordination, with the lines of the requirements

A histogram of the delay over the cells of the invariance set for each partition. A requirement is a line at the delay
that it asks for in its region, solid if it holds and dashed if it fails."""

from dataclasses import dataclass

import numpy as np

from . import style
from .errors import FileError, UsageError, quoted
from .results import Results

_MOST_PANELS = 6
_VERDICTS = "/counterexample/holds"


@dataclass(frozen=True)
class Line:
    name: str
    steps: int  # 0: the region must be in K
    holds: bool  # None: the file does not say


@dataclass(frozen=True)
class Histogram:
    partition: str
    cells: np.ndarray  # cells[k] have delay k
    unbounded: int  # -1: unknown, for the last of `cells` is a lower bound
    lines: list[Line]


@dataclass(frozen=True)
class Requirements:
    results: Results
    not_invariant: int  # cells of S outside K
    histograms: list[Histogram]


def add_arguments(parser):
    text = f"partition (default: all of them, {_MOST_PANELS} at most)"
    parser.add_argument("--partition", metavar="NAME", help=text)


def prepare(arguments):
    results = Results(arguments.file)
    chosen = range(len(results.partitions))
    if arguments.partition is not None:
        chosen = [results.partition(arguments.partition)]
    if len(chosen) > _MOST_PANELS:
        raise UsageError(f"{len(chosen)} partitions, expected --partition {quoted(results.partitions)}")
    lost = int(results.attribute("/safe", "cells")) - int(results.attribute("/invariant", "cells"))
    lines = _lines(results)
    return Requirements(results, lost, [_histogram(results, p, lines) for p in chosen])


def _lines(results):
    """[(number of the partition, or None for all, line), ...]; of the goal they ask no delay"""
    lines = []
    names = results.spec.canonical_partitions()
    verdicts = results.read(_VERDICTS) if _VERDICTS in results else []
    for i, requirement in enumerate(results.spec.requirements()):
        if any(key.startswith(("max_arrival", "min_approach_delay")) for key in requirement):
            continue
        name = requirement.get("partition")
        if name is not None:
            name = names.get(name, name)
            if name not in results.partitions:
                what = f"requirement '{requirement['name']}': no partition '{name}' in the file"
                raise FileError(what, results.path)
        holds = bool(verdicts[i]) if i < len(verdicts) else None
        number = None if name is None else results.partitions.index(name)
        lines.append((number, Line(requirement["name"], results.spec.required_steps(requirement), holds)))
    return lines


def _histogram(results, partition, lines):
    # Layer k holds the cells with delay at least k; past the fixed point sizes repeat.
    sizes = results.read("/layer_size", partition).astype(np.int64)
    last = int(results.read("/fixed_point_index")[partition])
    mine = [line for number, line in lines if number in (None, partition)]
    if last < 0:
        return Histogram(results.partitions[partition], np.append(-np.diff(sizes), sizes[-1]), -1, mine)
    return Histogram(results.partitions[partition], -np.diff(sizes[: last + 1]), int(sizes[last]), mine)


def draw(requirements, size=None):
    results = requirements.results
    count = len(requirements.histograms)
    figure = style.new_figure(size, (7.2, 0.9 + 2.9 * count))
    highest = max(max([len(h.cells)] + [line.steps for line in h.lines]) for h in requirements.histograms)
    panels = figure.subplots(count, 1, squeeze=False, sharex=True).flat
    for axes, histogram in zip(panels, requirements.histograms):
        _draw_histogram(axes, results, histogram, never_at(highest))
        axes.set_title(style.plain(histogram.partition))
        axes.set_ylabel("cells")
        axes.label_outer()
    figure.axes[count - 1].set_xlabel(style.plain(f"delay [{results.period_unit or 'steps'}]"))
    outside = f"{requirements.not_invariant:,} safe cells are not invariant" if requirements.not_invariant else ""
    style.add_title(figure, results.title, outside)
    return figure


def never_at(highest):
    """Where the bar of unbounded cells stands, in steps: right of all others."""
    return highest + 2 + highest // 20


def _draw_histogram(axes, results, histogram, never):
    unit = results.period if results.period_unit else 1.0
    steps = np.arange(len(histogram.cells))
    axes.bar(steps * unit, histogram.cells, width=0.9 * unit, color=style.KINDS[5], zorder=2)
    width = max(1, never // 40) * unit
    if histogram.unbounded > 0:
        axes.bar([never * unit], [histogram.unbounded], width=width, color=style.NOT_SAFE, zorder=2)
        _note(axes, never * unit, histogram.unbounded, "never")
    elif histogram.unbounded < 0:
        _note(axes, steps[-1] * unit, histogram.cells[-1], "at least")
    for i, line in enumerate(histogram.lines):
        color, dashes = style.KINDS[(3, 4, 0, 2, 1)[i % 5]], "--" if line.holds is False else "-"
        text = f"{line.name}: {results.seconds(line.steps)}" if line.steps else f"{line.name}: in K"
        text += {True: ", holds", False: ", FAILS", None: ""}[line.holds]
        # A cell with this delay is good enough, so the line is left of its bar.
        axes.axvline((line.steps - 0.5) * unit, color=color, linestyle=dashes, label=style.plain(text), zorder=3)
    axes.set_xlim(-unit, never * unit + 1.5 * width)
    axes.margins(y=0.15)
    axes.grid(axis="y", alpha=0.3)
    if histogram.lines:
        axes.legend()


def _note(axes, x, y, text):
    axes.annotate(text, (x, y), xytext=(0, 2), textcoords="offset points", ha="center", fontsize="small")
