"""How many cells tolerate how long without coordination, with the lines of the requirements

A histogram of the delay over the cells of the invariance set for each partition. A requirement is a line at the delay
that it asks for in its region, through the bar of the cells with just that delay; it is solid if it holds and dashed if
it fails. Cells that never need to coordinate have a bar of their own on the right."""

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

    @property
    def highest(self):
        """The largest number of steps with a bar or a line."""
        ends = [len(histogram.cells) - 1 for histogram in self.histograms]
        return max([0, *ends, *(line.steps for histogram in self.histograms for line in histogram.lines)])


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
        if any(key.startswith(("max_arrival", "min_approach_delay", "min_blind_delay", "min_silence")) for key in requirement):
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
    height = 0.9 + sum(2.7 + 0.18 * len(histogram.lines) for histogram in requirements.histograms)
    figure = style.new_figure(size, (7.2, height))
    width = figure.get_figwidth() - 0.9
    panels = figure.subplots(count, 1, squeeze=False, sharex=True).flat
    for axes, histogram in zip(panels, requirements.histograms):
        _draw_histogram(axes, results, histogram, never_at(requirements.highest))
        axes.set_title(style.plain(histogram.partition), pad=6 + style.legend_above(axes, width))
        axes.set_ylabel("cells")
        axes.label_outer()
    last = figure.axes[count - 1]
    _delay_axis(last, requirements)
    last.set_xlabel(style.plain(f"delay [{results.period_unit or 'steps'}]"))
    outside = f"{requirements.not_invariant:,} safe cells are not invariant" if requirements.not_invariant else ""
    style.add_title(figure, results.title, outside)
    return figure


def never_at(highest):
    """Where the bar of unbounded cells stands, in steps: right of all others."""
    return highest + 2 + highest // 12


def _unit(results):
    """Of the axis: the length of a step."""
    return results.period if results.period_unit else 1.0


def _delay_axis(axes, requirements):
    """Ticks where bars stand: at numbers of steps, and at what is beyond all of them."""
    unit, highest, never = _unit(requirements.results), requirements.highest, never_at(requirements.highest)
    has_never = any(histogram.unbounded > 0 for histogram in requirements.histograms)
    ticks = style.whole_steps(highest)
    labels = [f"{k * unit:.6g}" for k in ticks]
    axes.set_xticks([k * unit for k in ticks + [never] * has_never], labels + ["never"] * has_never)
    right = never + 1.5 * _never_width(never) if has_never else highest + 1
    axes.set_xlim(-unit, right * unit)


def _never_width(never):
    return max(1, never // 40)


def _draw_histogram(axes, results, histogram, never):
    unit = _unit(results)
    steps = np.arange(len(histogram.cells))
    axes.bar(steps * unit, histogram.cells, width=0.9 * unit, color=style.KINDS[5], zorder=2)
    if histogram.unbounded > 0:
        width = 0.9 * _never_width(never) * unit
        axes.bar([never * unit], [histogram.unbounded], width=width, color=style.NOT_SAFE, zorder=2)
    elif histogram.unbounded < 0:
        place = {"xytext": (0, 2), "textcoords": "offset points", "ha": "center", "fontsize": "small"}
        axes.annotate("at least", (steps[-1] * unit, histogram.cells[-1]), **place)
    for i, line in enumerate(histogram.lines):
        color, dashes = style.KINDS[(3, 4, 0, 2, 1)[i % 5]], "--" if line.holds is False else "-"
        text = f"{line.name}: {results.seconds(line.steps)}" if line.steps else f"{line.name}: in K"
        text += {True: ", holds", False: ", FAILS", None: ""}[line.holds]
        axes.axvline(line.steps * unit, color=color, linestyle=dashes, label=style.plain(text), zorder=3)
    axes.margins(y=0.15)
    axes.grid(axis="y", alpha=0.3)
