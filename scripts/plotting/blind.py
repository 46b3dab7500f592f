"""Silence with full observation and with own observations only, and the silent table of a class as a map

Delays over two states; --slice fixes the others. Beside them, over states that the class sees: the number of actions that its
table permits with --left steps of silence left, at the same values. FILE needs "sees" in its spec."""

from dataclasses import dataclass

import matplotlib
import numpy as np
from matplotlib.colors import to_hex

from . import style
from .cut import Cut, add_cut_arguments, make_cut
from .errors import FileError, UsageError, quoted
from .results import Results
from .values import named_values, whole_numbers

# Kinds of cells that are drawn in one colour, and -1 for those with steps to show.
NOT_SAFE, NOT_INVARIANT, FREE = range(3)
COLORS = (style.NOT_SAFE, style.NOT_INVARIANT, style.FREE)
_TEXTS = ("not safe", "safe, not invariant", "unbounded")


@dataclass(frozen=True)
class Panel:
    title: str
    kinds: np.ndarray  # [x, y]
    steps: np.ndarray  # masked where `kinds` says all


@dataclass(frozen=True)
class Table:
    cut: Cut  # over states that the class sees
    title: str
    allowed: np.ndarray  # [x, y] actions
    actions: int


@dataclass(frozen=True)
class Blind:
    cut: Cut
    partition: str
    panels: list[Panel]
    table: Table


def add_arguments(parser):
    add_cut_arguments(parser, 2)
    parser.add_argument("--partition", metavar="NAME", help="partition (default: the only one)")
    parser.add_argument("--class", dest="class_name", metavar="NAME", help="class of the table (default: the first)")
    parser.add_argument("--left", default="1", metavar="K", help="remaining steps of silence (default: 1)")


def prepare(arguments):
    results = Results(arguments.file)
    if "/blind_delay" not in results:
        raise FileError('no /blind_delay in the file: analyse with "sees"', results.path)
    partition = results.partition(arguments.partition)
    cut = make_cut(results, arguments, directions=2, fewest=1)
    panels = [
        panel_of("silence with full observation", cut.read("/delay", partition), results.flags("/delay")),
        panel_of("without", cut.read("/blind_delay", partition), results.flags("/blind_delay")),
    ]
    name = results.partitions[partition]
    return Blind(cut, name, panels, _table(results, name, arguments))


def panel_of(title, values, flags):
    values = values.reshape(len(values), -1).astype(int)
    kinds = np.full(values.shape, -1)
    outside = "not_invariant" if "not_invariant" in flags else "not_in_silence_set"
    for kind, word in enumerate(("not_safe", outside, "unbounded")):
        kinds[values == flags[word]] = kind
    return Panel(title, kinds, np.ma.masked_where(kinds >= 0, values))


def draw_panels(figure, grid, panels, cut, label):
    """Maps of steps beside one another, with a bar for all of them. @returns the kinds of cells that occur"""
    most = max([int(panel.steps.max()) for panel in panels if panel.steps.count()], default=0)
    for axes, panel in zip(grid, panels):
        style.kind_image(axes, panel.kinds, COLORS, style.extent_of(cut))
        style.step_image(axes, panel.steps, most, style.extent_of(cut))
        style.label_plane(axes, cut)
        axes.set_title(panel.title)
    if any(panel.steps.count() for panel in panels):
        style.add_step_bar(figure, list(grid[: len(panels)]), most, label, cut.results)
    return sorted({int(kind) for panel in panels for kind in np.unique(panel.kinds)} - {-1})


def _table(results, partition, arguments):
    group = f"/silent/{partition}"
    classes = [name for name in results.names(group) if ":" not in name] if group in results else []
    if not classes:
        raise UsageError(f"no class of '{partition}' has a silent table", "--partition")
    name = arguments.class_name or classes[0]
    if name not in classes:
        raise UsageError(f"no table of '{name}', expected {quoted(classes)}", "--class")
    (left,) = whole_numbers(arguments.left, "--left")[:1]
    if left < 1:
        raise UsageError("expected at least 1 step", "--left")
    path = f"{group}/{name}"
    by_name = {axis.name: axis for axis in results.states}
    seen = [by_name[axis] for axis in results.axes_of(path)[1:-1]]
    if not seen:
        raise UsageError(f"'{name}' sees no state: its table has no map; expected a class that sees one", "--class")
    slices = named_values(arguments.slice, "--slice")
    # Those that are not drawn beside it are cut only where there are more than two.
    free = [axis for axis in seen if axis.name not in slices] if len(seen) > 2 else seen
    if not 1 <= len(free) <= 2:
        raise UsageError(f"cut {quoted([axis.name for axis in seen])} to two states: expected --slice STATE=VALUE,...")
    index = tuple(slice(None) if axis in free else results.cell(axis, slices[axis.name], "--slice") for axis in seen)
    row = min(left, len(results.read("/silent_layer"))) - 1
    actions = int(results.attribute(path, "actions"))
    bits = np.unpackbits(results.read(path, (row, *index)), axis=-1, bitorder="little")[..., :actions]
    allowed = bits.sum(axis=-1)
    return Table(Cut(results, tuple(free), index), f"actions of {name}, {results.seconds(left)} left",
                 allowed.reshape(len(allowed), -1), actions)  # fmt: skip


def draw(blind, size=None):
    results, cut = blind.cut.results, blind.cut
    figure = style.new_figure(size, (13.6, 4.3))
    figure.get_layout_engine().set(w_pad=0.12)  # the bar of the delays stands beside the label of the table
    grid = figure.subplots(1, 3)
    found = draw_panels(figure, grid, blind.panels, cut, "delay")
    table = blind.table
    style.kind_image(grid[2], table.allowed, _shades(table.actions), style.extent_of(table.cut))
    style.label_plane(grid[2], table.cut)
    grid[2].set_title(style.plain(table.title))
    style.add_title(figure, f"{results.title}, {blind.partition}", cut.title)
    counts = [int(count) for count in np.unique(table.allowed)]
    shades = _shades(table.actions)
    style.legend_below(
        figure,
        [(COLORS[kind], _TEXTS[kind]) for kind in found]
        + [(shades[count], f"{count} of {table.actions} actions" if count else "unreachable") for count in counts],
    )
    return figure


def _shades(actions):
    """A colour for none, one, ..., all of the actions."""
    blues = matplotlib.colormaps["Blues"].resampled(actions + 2)
    return [style.NOT_INVARIANT, *(to_hex(blues(k + 1)) for k in range(1, actions + 1))]
