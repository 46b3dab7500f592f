"""A histogram of the delay over the cells of the invariance set, with the requirements

One panel for each partition. A requirement is a line at the delay that it asks for, through the bar of the cells with this delay:
solid if it holds, dashed if it fails. The cells of its region are bars of its colour. Cells with unbounded delay have a bar of
their own on the right. The number of cells is on a logarithmic scale where regions would otherwise be too small to see."""

import math
from dataclasses import dataclass, replace

import numpy as np

from . import style
from .errors import FileError, UsageError, quoted
from .results import Results

_MOST_PANELS = 6
_AT_ONCE = 2**21  # cells
_SMALL = 0.05  # of the highest bar, what could not be seen beside it
_ALL = "#cfe3f1"
_COLORS = [style.KINDS[i] for i in (3, 4, 0, 2, 1)]
_VERDICTS = "/counterexample/holds"


@dataclass(frozen=True)
class Region:
    """The cells that may meet `where`, as they are in one partition."""

    cells: np.ndarray  # cells[k] have delay k
    unbounded: int
    lost: int  # outside K


@dataclass(frozen=True)
class Line:
    name: str
    steps: int  # 0: the region must be in K
    holds: bool  # None: the file does not say
    region: Region = None  # None: it cannot be told from the spec


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
        lines.append((number, Line(requirement["name"], results.spec.required_steps(requirement), holds), requirement))
    return lines


def _region(results, partition, where):
    """None for what boxes of states do not decide, such as a memory."""
    axes, boxes = results.states, results.spec.boxes(results.states)
    first = axes[0].name
    shape = [len(axis.points) for axis in axes]
    rows = max(1, _AT_ONCE * shape[0] // math.prod(shape))
    unbounded = results.flags("/delay")["unbounded"]
    cells, lost, free = np.zeros(1, dtype=np.int64), 0, 0
    for begin in range(0, shape[0], rows):
        part = slice(begin, begin + rows)
        here = {**boxes, first: tuple(side[part] for side in boxes[first])}
        try:
            may, _ = results.spec.conditions(here).ask(where)
        except ValueError:
            return None
        delay = results.read("/delay", (partition, part))
        found = delay[np.broadcast_to(may, delay.shape)].astype(np.int64)
        lost += int((found < 0).sum())
        free += int((found == unbounded).sum())
        counts = np.bincount(found[(found >= 0) & (found != unbounded)], minlength=len(cells))
        counts[: len(cells)] += cells
        cells = counts
    return Region(cells, free, lost)


def _histogram(results, partition, lines):
    # Layer k holds the cells with delay at least k; past the fixed point sizes repeat.
    sizes = results.read("/layer_size", partition).astype(np.int64)
    last = int(results.read("/fixed_point_index")[partition])
    mine = [replace(line, region=_region(results, partition, requirement["where"]))
            for number, line, requirement in lines if number in (None, partition)]  # fmt: skip
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
    axes.bar(steps * unit, histogram.cells, width=0.9 * unit, color=_ALL, zorder=2, label="cells of K")
    wide = 0.9 * _never_width(never) * unit
    if histogram.unbounded > 0:
        axes.bar([never * unit], [histogram.unbounded], width=wide, color=style.NOT_INVARIANT, zorder=2)
    elif histogram.unbounded < 0:
        place = {"xytext": (0, 2), "textcoords": "offset points", "ha": "center", "fontsize": "small"}
        axes.annotate("at least", (steps[-1] * unit, histogram.cells[-1]), **place)
    shaded = [line for line in histogram.lines if line.region]
    for i, line in enumerate(histogram.lines):
        color, dashes = _COLORS[i % len(_COLORS)], "--" if line.holds is False else "-"
        axes.axvline(line.steps * unit, color=color, linestyle=dashes, label=style.plain(_text(results, line)), zorder=4)
        if line.region:
            _draw_region(axes, line.region, color, unit, never, wide, shaded.index(line), len(shaded))
    if _are_small(shaded, histogram):
        axes.set_yscale("log")
        axes.set_ylim(bottom=0.5)
    axes.margins(y=0.15)
    axes.grid(axis="y", alpha=0.3)


def _draw_region(axes, region, color, unit, never, wide, i, count):
    """Bars beside those of other regions, within the width of the bar of all cells."""
    for places, cells, width in (
        (np.arange(len(region.cells)) * unit, region.cells, 0.9 * unit),
        (np.array([never * unit]), np.array([region.unbounded]), wide),
    ):
        at = places - width / 2 + (i + 0.5) * width / count
        axes.bar(at[cells > 0], cells[cells > 0], width=width / count, color=color, alpha=0.75, zorder=3)


def _are_small(lines, histogram):
    """Whether the bars of the regions would vanish beside those of all cells."""
    most = [max(line.region.cells.max(), line.region.unbounded) for line in lines]
    return any(0 < one < _SMALL * max(histogram.cells.max(initial=0), histogram.unbounded) for one in most)


def _text(results, line):
    text = f"{line.name}: {results.seconds(line.steps)}" if line.steps else f"{line.name}: in K"
    text += {True: ", holds", False: ", FAILS", None: ""}[line.holds]
    if line.region:
        count = int(line.region.cells.sum()) + line.region.unbounded + line.region.lost
        text += f"; {count:,} cell{'' if count == 1 else 's'}"
        text += f", {line.region.lost:,} outside K" if line.region.lost else ""
    return text
