"""How all figures look. Colours: viridis for numbers of steps (perceptually uniform, readable for colour-blind people
and in grey), greys for cells that are lost, Okabe and Ito's palette for kinds."""

import textwrap

import matplotlib
import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap, Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.textpath import TextPath
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator

NOT_SAFE = "#7f7f7f"
NOT_INVARIANT = "#bdbdbd"
FREE = "#ffffff"
NO_PARTITION = "#000000"
KINDS = ["#0072b2", "#e69f00", "#009e73", "#d55e00", "#cc79a7", "#56b4e9", "#f0e442"]

_FEW_POINTS = 8  # with a tick each
_LEGEND_FONT = 8.33  # points, "small"
_MOTTLED = 0.02  # of the cells: more such are too many for lines
_LARGEST_RATIO = 5  # of the sides of a picture in scale


def plain(text):
    """A text as it is: a $ of a user is no formula."""
    return text.replace("$", r"\$")


def new_figure(size, default):
    """@param size (width, height) in inches that the user wants, None: `default`"""
    matplotlib.rcParams.update({"axes.titlesize": "medium", "figure.titlesize": "medium", "legend.fontsize": "small"})
    figure = Figure(figsize=size or default, layout="constrained")
    # So that a title stands off those of the panels, and the last tick of one panel off the first of the next.
    figure.get_layout_engine().set(h_pad=0.09, w_pad=0.09)
    return figure


def step_colors(most, way=False):
    """A colormap with a colour for each of the steps 0, ..., most, and its norm.

    @param way for steps of a way and not of silence: other colours, from near (pale) to far
    """
    levels = min(most + 1, 256)
    cmap = matplotlib.colormaps["viridis"].resampled(levels)
    if way:
        cmap = ListedColormap(matplotlib.colormaps["YlOrRd"](np.linspace(0.12, 1, levels)))
    return cmap, Normalize(-0.5, most + 0.5)


def whole_steps(most, ticks=10):
    """Some of the numbers 0 to `most`, for about so many ticks."""
    return [int(k) for k in MaxNLocator(ticks, integer=True, min_n_ticks=1).tick_values(0, most) if 0 <= k <= most]


def add_step_bar(figure, axes, most, label, results, location="right", shrink=1.0, pad=0.02, is_cut=False, way=False, unit="steps"):
    """A colour bar for steps, with times on its other side if the file has a unit of time.

    @param is_cut whether there are more steps, in the last colour
    @param unit what is counted, if not steps
    """
    cmap, norm = step_colors(most, way)
    place = {"location": location, "shrink": shrink, "fraction": 0.06, "pad": pad}
    place["extend"] = "max" if is_cut else "neither"
    bar = figure.colorbar(matplotlib.cm.ScalarMappable(norm, cmap), ax=axes, **place)
    steps = whole_steps(most)
    bar.ax.yaxis.set_major_locator(FixedLocator(steps))
    bar.ax.minorticks_off()
    bar.set_label(plain(f"{label} [{unit}]"))
    if results.period_unit and unit == "steps":
        period = results.period
        other = "left" if location == "right" else "right"
        times = bar.ax.secondary_yaxis(other, functions=(lambda k: k * period, lambda t: t / period))
        times.yaxis.set_major_locator(FixedLocator([k * period for k in steps]))
        times.yaxis.set_major_formatter(FuncFormatter(lambda t, _: plain(f"{t:g} {results.period_unit}")))
        times.tick_params(labelsize="small")
    return bar


def kind_image(axes, kinds, colors, extent):
    """Cells [x, y] of numbered kinds as an image; -1 is transparent."""
    cmap = ListedColormap(colors)
    norm = BoundaryNorm(np.arange(len(colors) + 1) - 0.5, len(colors))
    shown = np.ma.masked_equal(kinds.T, -1)
    return axes.imshow(shown, cmap=cmap, norm=norm, **_image(extent))


def step_image(axes, steps, most, extent, way=False):
    """Cells [x, y] of steps, a masked array."""
    cmap, norm = step_colors(most, way)
    return axes.imshow(steps.T, cmap=cmap, norm=norm, **_image(extent))


def power_image(axes, powers, cmap, norm, extent):
    """Cells [x, y] of powers of ten, a masked array."""
    return axes.imshow(powers.T, cmap=cmap, norm=norm, **_image(extent))


def add_power_bar(figure, axes, powers, cmap, norm, label, is_below):
    """A colour bar with a tick at each of these powers of ten.

    @param is_below whether there is something below the least of them, in the colour for that
    """
    place = {"fraction": 0.06, "pad": 0.02, "extend": "min" if is_below else "neither"}
    bar = figure.colorbar(matplotlib.cm.ScalarMappable(norm, cmap), ax=axes, **place)
    bar.ax.yaxis.set_major_locator(FixedLocator(powers))
    bar.ax.yaxis.set_major_formatter(FuncFormatter(lambda k, _: f"$10^{{{round(k)}}}$" if k < 0 else "1"))
    bar.ax.minorticks_off()
    bar.set_label(plain(label))
    return bar


def step_lines(axes, steps, most, cut, color="white"):
    """Lines where the ticks of the colour bar are, between cells; None for a single state, or without a line, or where they would
    cover much of the picture."""
    ticks = [k for k in whole_steps(most) if steps.min() < k <= steps.max()]
    if len(cut.axes) < 2 or min(steps.shape) < 2 or not ticks:
        return None
    if _is_mottled(np.ma.filled(steps, 0), ticks):
        return None
    centres = [(axis.edges[:-1] + axis.edges[1:]) / 2 for axis in cut.axes]
    return axes.contour(*centres, steps.T, levels=[k - 0.5 for k in ticks], colors=color, linewidths=0.6, alpha=0.7)


def _is_mottled(steps, ticks):
    """Whether many cells lie below a tick, and both neighbours above it, or the other way round."""
    changes = [np.sign(np.diff(np.digitize(steps, ticks), axis=axis)) for axis in (0, 1)]
    turns = changes[0][1:] * changes[0][:-1], changes[1][:, 1:] * changes[1][:, :-1]
    return sum((turn < 0).sum() for turn in turns) > _MOTTLED * steps.size


def _image(extent):
    return {"origin": "lower", "extent": extent, "interpolation": "nearest", "aspect": "auto"}


def extent_of(cut):
    """(left, right, bottom, top) of the faces of the cells; a single state gives a strip."""
    y = cut.axes[1].edges[[0, -1]] if len(cut.axes) > 1 else (0, 1)
    return (*cut.axes[0].edges[[0, -1]], *y)


def point_ticks(axis, points):
    """Ticks of an axis on which there is nothing between the points, which ascend: at points only.

    All of few points, else those where there are ticks anyway, else every so many.
    """
    points = np.asarray(points)
    if len(points) > _FEW_POINTS:
        usual = MaxNLocator(_FEW_POINTS, steps=[1, 2, 5, 10]).tick_values(points[0], points[-1])
        nearest = np.unique(np.abs(points[:, None] - usual).argmin(axis=0))
        near = np.abs(points[nearest, None] - usual).min(axis=1) < 1e-9 * np.ptp(points)
        every = range(0, len(points), -(-len(points) // _FEW_POINTS))
        points = points[nearest[near] if near.sum() > 2 else every]
    axis.set_major_locator(FixedLocator(points))


def label_plane(axes, cut):
    """Axes with units, in scale where that is possible: the same unit and sides that are not too different."""
    axes.set_xlabel(plain(cut.axes[0].label))
    for axis, along in zip(cut.axes, (axes.xaxis, axes.yaxis)):
        if axis.is_points:
            point_ticks(along, axis.points)
    if len(cut.axes) == 1:
        axes.set_yticks([])
        axes.set_box_aspect(0.15)
        return
    axes.set_ylabel(plain(cut.axes[1].label))
    left, right, bottom, top = extent_of(cut)
    ratio = (top - bottom) / (right - left)
    if cut.axes[0].unit == cut.axes[1].unit and 1 / _LARGEST_RATIO <= ratio <= _LARGEST_RATIO:
        axes.set_aspect("equal")


def add_title(figure, *lines):
    """@param lines those that are empty are left out, those that are too long go on below"""
    width = int(12 * figure.get_figwidth())  # letters, about
    figure.suptitle(plain("\n".join(textwrap.fill(line, width) for line in lines if line)))


def legend_above(axes, width):
    """A legend of what has a label between the axes and their title, where it covers nothing.

    @param width of the axes, inches, about
    @returns the height that it takes, points
    """
    handles, labels = axes.get_legend_handles_labels()
    if not handles:
        return 0
    letters = int(width * 72 / (0.6 * _LEGEND_FONT) - 8)  # that fit into a line beside the sign, about
    labels = [textwrap.fill(label, max(letters, 10)) for label in labels]
    columns = _legend_columns(labels, width * 72)
    place = {"loc": "lower center", "bbox_to_anchor": (0.5, 1), "borderaxespad": 0.2, "frameon": False}
    axes.legend(handles, labels, ncols=columns, columnspacing=1.5, **place)
    lines = max(sum(label.count("\n") + 1 for label in column) for column in np.array_split(labels, columns))
    return (1.5 * lines + 0.6) * _LEGEND_FONT


def _legend_columns(labels, width):
    """The most columns, filled one after another, that are not wider than so many points."""
    before = 4.3 * _LEGEND_FONT  # sign and gaps
    widths = [TextPath((0, 0), label, size=_LEGEND_FONT).get_extents().width + before for label in labels]
    fitting = (c for c in range(len(labels), 1, -1) if sum(map(max, np.array_split(widths, c))) <= width)
    return next(fitting, 1)


def legend_below(figure, entries):
    """@param entries (colour, text) of patches, or ready handles"""
    handles = [_patch(*entry) if isinstance(entry, tuple) else entry for entry in entries]
    if not handles:
        return
    columns = min(len(handles), max(1, int(figure.get_figwidth() / 1.5)))
    height = 0.08 + 0.22 * -(-len(handles) // columns)
    share = height / figure.get_figheight()
    figure.get_layout_engine().set(rect=(0, share, 1, 1 - share))
    figure.legend(handles=handles, loc="lower center", ncols=columns, frameon=False, borderaxespad=0.2)


def _patch(color, text):
    return Patch(facecolor=color, edgecolor="#444444", label=plain(text))
