"""The cheapest partition of each cell that is safe for the horizon without further contact

Over two states; --slice fixes the others. FILE needs "coordination": {"horizon": ...} in its spec."""

from dataclasses import dataclass

import matplotlib
import numpy as np

from . import style
from .cut import Cut, add_cut_arguments, make_cut
from .errors import FileError
from .results import Results

# Flags of /coalition that mean no partition, and their colours.
_FLAGS = {"not_safe": style.NOT_SAFE, "not_invariant": style.NOT_INVARIANT}
_MOST_NAMED = 16


@dataclass(frozen=True)
class Kind:
    text: str
    color: str


@dataclass(frozen=True)
class Coalition:
    cut: Cut
    kinds: list[Kind]  # those that occur
    cells: np.ndarray  # [x, y], numbers of `kinds`


def add_arguments(parser):
    add_cut_arguments(parser, 2)


def prepare(arguments):
    results = Results(arguments.file)
    if "/coalition" not in results:
        what = 'no /coalition in the file: analyse with "coordination": {"horizon": STEPS}'
        raise FileError(what, results.path)
    cut = make_cut(results, arguments, directions=2, fewest=1)
    values = cut.read("/coalition").astype(int)
    values = values.reshape(len(values), -1)
    kinds, numbers = _kinds(results, values)
    return Coalition(cut, kinds, numbers[values - values.min()])


def _kinds(results, values):
    """What occurs, flags first, and for each value from the least on the number of its kind."""
    found, counts = np.unique(values, return_counts=True)
    numbered = range(len(results.partitions))
    flags = {value: meaning for meaning, value in results.flags("/coalition").items() if value not in numbered}
    for value in found:
        if value not in flags and value not in numbered:
            raise FileError(f"no partition has the number {value} of /coalition", results.path)
    partitions = [value for value in found[np.argsort(-counts, kind="stable")] if value not in flags]
    named, others = sorted(partitions[:_MOST_NAMED]), partitions[_MOST_NAMED:]
    kinds = []
    numbers = np.zeros(found[-1] - found[0] + 1, dtype=int)
    for value in [value for value in found if value in flags]:
        numbers[value - found[0]] = len(kinds)
        kinds.append(Kind(flags[value].replace("_", " "), _FLAGS.get(flags[value], style.NO_PARTITION)))
    for value, color in zip(named, _colors(results, named)):
        numbers[value - found[0]] = len(kinds)
        kinds.append(Kind(results.partitions[value], color))
    if others:
        numbers[np.array(others) - found[0]] = len(kinds)
        kinds.append(Kind(f"{len(others)} other partitions", style.FREE))
    return kinds, numbers


def _colors(results, named):
    """Few partitions have the same colours in all pictures of the file."""
    if len(results.partitions) <= len(style.KINDS):
        return [style.KINDS[value] for value in named]
    if len(named) <= len(style.KINDS):
        return style.KINDS[: len(named)]
    shades = matplotlib.colormaps["viridis"](np.linspace(0, 1, len(named)))
    return [matplotlib.colors.to_hex(shade) for shade in shades]


def draw(coalition, size=None):
    figure = style.new_figure(size, (5.0, 5.0))
    axes = figure.add_subplot()
    colors = [kind.color for kind in coalition.kinds]
    style.kind_image(axes, coalition.cells, colors, style.extent_of(coalition.cut))
    style.label_plane(axes, coalition.cut)
    style.add_title(figure, _title(coalition.cut.results), coalition.cut.title)
    style.legend_below(figure, [(kind.color, kind.text) for kind in coalition.kinds])
    return figure


def _title(results):
    horizon = int(results.attribute("/coalition", "horizon", 0))
    return f"{results.title}, {results.seconds(horizon)} without further contact" if horizon else results.title
