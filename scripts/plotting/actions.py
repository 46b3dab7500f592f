"""The joint inputs that the controller C and independent choice IND_C admit at a state

Over two inputs; --slice fixes the others. FILE needs "output": {"controller": true, "actions": true} in its spec."""

from dataclasses import dataclass

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import ListedColormap

from . import style
from .cut import add_cut_arguments, choose
from .errors import FileError, UsageError
from .results import Axis, Results
from .values import named_values, shown

_INDEPENDENT = "#bfd9ec"


@dataclass(frozen=True)
class Actions:
    """Masks [x, y] over the values of two inputs, which ascend."""

    title: str
    partition: str
    state: str
    fixed: str
    axes: tuple[Axis, Axis]
    x: np.ndarray
    y: np.ndarray
    controller: np.ndarray
    independent: np.ndarray


def add_arguments(parser):
    parser.add_argument("--at", required=True, metavar="STATE=VALUE,...", help="the state, e.g. x1=0.1,x2=1/3")
    parser.add_argument("--partition", metavar="NAME", help="partition (default: the only one)")
    add_cut_arguments(parser, 2, "input")


def prepare(arguments):
    results = Results(arguments.file)
    partition = results.partitions[results.partition(arguments.partition)]
    _check_stored(results)
    names = results.attribute("/controller", "inputs").split()
    inputs = [results.axis(name) for name in names]
    cell = results.cell_of(named_values([arguments.at], "--at"), "--at")
    chosen, slices = choose(names, arguments, directions=2, fewest=2, kind="input")
    drawn = [names.index(name) for name in chosen]
    index = tuple(_value_index(axis, slices[axis.name]) if axis.name in slices else slice(None) for axis in inputs)
    controller = _bits(results, "/controller", cell).reshape([len(axis.points) for axis in inputs])
    independent = _independent(results, partition, cell, inputs)
    order = [np.argsort(inputs[i].points, kind="stable") for i in drawn]

    def plane(mask):
        across = mask[index] if drawn[0] < drawn[1] else mask[index].T
        return across[np.ix_(*order)]

    values = zip(results.states, cell)
    fixed = ", ".join(axis.shown(shown(axis.points[i])) for axis, i in zip(inputs, index) if not isinstance(i, slice))
    return Actions(
        title=results.title,
        partition=partition,
        state=", ".join(axis.shown(shown(axis.points[i])) for axis, i in values),
        fixed=fixed,
        axes=(inputs[drawn[0]], inputs[drawn[1]]),
        x=inputs[drawn[0]].points[order[0]],
        y=inputs[drawn[1]].points[order[1]],
        controller=plane(controller),
        independent=plane(independent),
    )


def _check_stored(results):
    for name in ("controller", "actions"):
        if f"/{name}" not in results:
            what = f'no /{name} in the file: analyse with "output": {{"controller": true, "actions": true}}'
            raise FileError(what, results.path)


def _bits(results, name, cell):
    count = int(results.attribute(name, "actions"))
    return np.unpackbits(results.read(name, cell), bitorder="little")[:count].astype(bool)


def _independent(results, partition, cell, inputs):
    """IND_C(x), bool over all inputs: the product of what is stored of the classes."""
    names = [axis.name for axis in inputs]
    product = np.ones([len(axis.points) for axis in inputs], dtype=bool)
    group = f"/actions/{partition}"
    for name in results.names(group):
        dataset = f"{group}/{name}"
        of_class = results.attribute(dataset, "inputs", "").split()
        if not of_class:
            continue  # a dimension
        sizes = [len(inputs[names.index(one)].points) if one in of_class else 1 for one in names]
        product &= _bits(results, dataset, cell).reshape(sizes)
    return product


def _value_index(axis, value):
    nearest = int(np.abs(axis.points - float(value)).argmin())
    if not np.isclose(axis.points[nearest], float(value), rtol=1e-9, atol=1e-12):
        raise UsageError(f"{axis.name} takes no value {shown(value)}", "--slice")
    return nearest


def draw(actions, size=None):
    figure = style.new_figure(size, (5.6, 5.6))
    axes = figure.add_subplot()
    edges = [_between(values) for values in (actions.x, actions.y)]
    mesh = np.ma.masked_equal(actions.independent.astype(int), 0)
    axes.pcolormesh(*edges, mesh.T, cmap=ListedColormap([_INDEPENDENT]))
    segments = outline(actions.independent, *edges)
    axes.add_collection(LineCollection(segments, colors="black", linestyles="--", linewidths=1))
    x, y = np.meshgrid(actions.x, actions.y, indexing="ij")
    area = _dot_area(figure, actions)
    axes.scatter(x, y, s=area / 6, c="#bbbbbb", linewidths=0)
    admitted = actions.controller
    axes.scatter(x[admitted], y[admitted], s=area, c=style.KINDS[0], linewidths=0)
    axes.set_xlim(*edges[0][[0, -1]])
    axes.set_ylim(*edges[1][[0, -1]])
    style.point_ticks(axes.xaxis, actions.x)
    style.point_ticks(axes.yaxis, actions.y)
    axes.set_xlabel(style.plain(actions.axes[0].label))
    axes.set_ylabel(style.plain(actions.axes[1].label))
    if actions.axes[0].unit == actions.axes[1].unit:
        axes.set_aspect("equal", adjustable="box")
    style.add_title(figure, f"{actions.title}, {actions.partition}", f"at {actions.state}", actions.fixed)
    counts = (style.KINDS[0], "C(x)", actions.controller), (_INDEPENDENT, "IND_C(x)", actions.independent)
    style.legend_below(figure, [(color, f"{name}: {mask.sum()} of {mask.size}") for color, name, mask in counts])
    return figure


def _dot_area(figure, actions):
    """Points squared, so that neighbours do not touch."""
    between = min(figure.get_size_inches()) * 72 * 0.75 / max(len(actions.x), len(actions.y))
    return min(max(between * 0.6, 1), 12) ** 2


def _between(values):
    """Borders between ascending values, one more than there are."""
    if len(values) == 1:
        return values[0] + np.array([-0.5, 0.5])
    middle = (values[1:] + values[:-1]) / 2
    return np.concatenate([[1.5 * values[0] - 0.5 * values[1]], middle, [1.5 * values[-1] - 0.5 * values[-2]]])


def outline(mask, x_edges, y_edges):
    """Segments ((x, y), (x, y)) between what is in the mask [x, y] and what is not."""
    padded = np.pad(mask, 1)
    across_x = np.argwhere(padded[1:, 1:-1] != padded[:-1, 1:-1])
    across_y = np.argwhere(padded[1:-1, 1:] != padded[1:-1, :-1])
    segments = [((x_edges[i], y_edges[j]), (x_edges[i], y_edges[j + 1])) for i, j in across_x]
    return segments + [((x_edges[i], y_edges[j]), (x_edges[i + 1], y_edges[j])) for i, j in across_y]
