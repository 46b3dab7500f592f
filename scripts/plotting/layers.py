"""The delay map: how many steps without coordination each cell tolerates

Over two states; --slice fixes the others. With --snapshots 1,14,29 there is one panel for each k: cells that do not tolerate k
steps, coloured by their delay, around the layer Z_k. Colours are scaled to all cells, so that slices can be compared; with
--own-scale to the delays that are shown."""

from dataclasses import dataclass

import numpy as np

from . import style
from .cut import Cut, add_cut_arguments, make_cut
from .results import Results
from .values import whole_numbers

# Kinds of cells that are drawn in one colour, and -1 for those with a delay to show.
NOT_SAFE, NOT_INVARIANT, FREE = range(3)
_COLORS = (style.NOT_SAFE, style.NOT_INVARIANT, style.FREE)


@dataclass(frozen=True)
class Panel:
    k: int  # None: the whole map
    kinds: np.ndarray  # [x, y]
    delay: np.ndarray  # masked where `kinds` says all


@dataclass(frozen=True)
class Layers:
    cut: Cut
    partition: str
    panels: list[Panel]
    most: int  # largest finite delay of the partition, or of the slice
    truncated: bool

    @property
    def kinds(self):
        return {int(kind) for panel in self.panels for kind in np.unique(panel.kinds)}


def add_arguments(parser):
    add_cut_arguments(parser, 2)
    parser.add_argument("--partition", metavar="NAME", help="partition (default: the only one)")
    parser.add_argument("--own-scale", action="store_true", help="colours for the delays of this slice alone")
    parser.add_argument("--snapshots", metavar="K,...", help="layers to show, e.g. 1,14,29")


def prepare(arguments):
    results = Results(arguments.file)
    partition = results.partition(arguments.partition)
    snapshots = [None] if arguments.snapshots is None else whole_numbers(arguments.snapshots, "--snapshots")
    cut = make_cut(results, arguments, directions=2, fewest=1)
    delay = cut.read("/delay", partition)
    last = int(results.read("/fixed_point_index")[partition])
    truncated = last < 0
    if truncated:
        last = len(results.read("/layer")) - 1
    flags = results.flags("/delay")
    panels = [_panel(delay.reshape(len(delay), -1), k, flags) for k in snapshots]
    # A delay is below F unless it is unbounded; cut off, it may reach the last layer.
    most = max(last - (not truncated), 0)
    if arguments.own_scale:
        shown = max((int(panel.delay.max()) for panel in panels if panel.delay.count()), default=0)
        truncated, most = truncated and shown == most, shown
    return Layers(cut, results.partitions[partition], panels, most, truncated)


def _panel(delay, k, flags):
    kinds = np.full(delay.shape, -1)
    kinds[delay == flags["not_safe"]] = NOT_SAFE
    kinds[delay == flags["not_invariant"]] = NOT_INVARIANT
    kinds[delay >= (flags["unbounded"] if k is None else k)] = FREE
    return Panel(k, kinds, np.ma.masked_where(kinds >= 0, delay))


def draw(layers, size=None):
    results, cut = layers.cut.results, layers.cut
    count = len(layers.panels)
    columns = min(count, 3)
    rows = -(-count // columns)
    figure = style.new_figure(size, (1.6 + 3.4 * columns, 0.9 + 3.4 * rows))
    grid = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True)
    for axes, panel in zip(grid.flat, layers.panels):
        style.kind_image(axes, panel.kinds, _COLORS, style.extent_of(cut))
        style.step_image(axes, panel.delay, layers.most, style.extent_of(cut))
        style.label_plane(axes, cut)
        if panel.k is not None:
            axes.set_title(style.plain(f"k = {results.seconds(panel.k)}"))
    for axes in grid.flat[count:]:
        axes.set_visible(False)
    for axes in grid.flat:
        axes.label_outer()
    if any(panel.delay.count() for panel in layers.panels):
        style.add_step_bar(figure, list(grid.flat), layers.most, _label(layers), results)
    style.add_title(figure, f"{results.title}, {layers.partition}", cut.title)
    style.legend_below(figure, _legend(layers))
    return figure


def _label(layers):
    return f"delay; {layers.most} is at least {layers.most}" if layers.truncated else "delay"


def _legend(layers):
    free = "unbounded" if layers.panels[0].k is None else "tolerates k steps (Z_k)"
    texts = {NOT_SAFE: "not safe", NOT_INVARIANT: "safe, not invariant", FREE: free}
    return [(_COLORS[kind], texts[kind]) for kind in sorted(layers.kinds - {-1})]
