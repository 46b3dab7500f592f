"""The unsafe region in three dimensions, and its growth with the connection delay

First the cells outside the invariance set K, coloured by the collision time (with full coordination). Then for each connection
delay D the cells that do not tolerate D steps without coordination, coloured by their delay. If the unsafe region surrounds K and
would hide it, the complements are drawn: K, and the cells that tolerate D steps. Three states are drawn; --slice fixes the others."""

import math
from dataclasses import dataclass

import matplotlib
import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from . import style
from .cut import Cut, add_cut_arguments, make_cut
from .errors import UsageError
from .results import Results
from .surface import visible_faces
from .values import whole_numbers

_VIEW = (24.0, -56.0)
_ONE_COLOR, _UNBOUNDED = -1, -2
_INVARIANT, _FREE = style.KINDS[0], "#f2f2f2"
_LIGHT = (0.93, 0.85, 1.0)  # of faces across each dimension
_LABEL_PAD = {"x": 9, "y": 9, "z": 4}  # points
_BAR = {"shrink": 0.6, "pad": 0.1}  # so far from axes whose labels the layout does not see
_HIDING = 0.5  # share of the visible sides of the domain from which on the unsafe region hides K
_WIDEST = 3  # longest side of the drawn box over the shortest


@dataclass(frozen=True)
class Panel:
    title: str
    members: np.ndarray  # bool [x, y, z]
    steps: np.ndarray  # [x, y, z], colours of the members; _ONE_COLOR, _UNBOUNDED: no number


@dataclass(frozen=True)
class Unsafe:
    cut: Cut
    partition: str
    collision: Panel
    growth: list[Panel]
    view: tuple[float, float]  # elevation and azimuth, degrees
    is_inside: bool  # K and what tolerates D is drawn, and not what does not

    @property
    def viewer(self):
        return _viewer(self.view)

    @property
    def most_collision(self):
        return _most(self.collision)

    @property
    def most_delay(self):
        return max(map(_most, self.growth), default=0)


def _viewer(view):
    """For each axis the end that the viewer sees, 1 or -1."""
    elevation, azimuth = map(math.radians, view)
    return tuple(1 if end >= 0 else -1 for end in (math.cos(azimuth), math.sin(azimuth), elevation))


def _hides(outside, view):
    """Whether cells cover so much of the sides of the domain that what they lie around is not seen."""
    sides = [np.take(outside, -1 if end > 0 else 0, axis=axis) for axis, end in enumerate(_viewer(view))]
    covered = [side.mean() for side in sides]
    return not outside.all() and min(covered) > 0 and sum(covered) / len(covered) > _HIDING


def _most(panel):
    return int(panel.steps[panel.members].max(initial=0))


def add_arguments(parser):
    add_cut_arguments(parser, 3)
    parser.add_argument("--partition", metavar="NAME", help="partition (default: the only one)")
    text = "connection delays D in steps, e.g. 5,10 (default: two between 0 and F)"
    parser.add_argument("--delays", metavar="D,...", help=text)
    text = "elevation (-90 to 90) and azimuth of the viewer in degrees (default: 24,-56)"
    parser.add_argument("--view", metavar="E,A", help=text)


def prepare(arguments):
    results = Results(arguments.file)
    partition = results.partition(arguments.partition)
    delays = None if arguments.delays is None else whole_numbers(arguments.delays, "--delays")
    view = _VIEW if arguments.view is None else _parse_view(arguments.view)
    cut = make_cut(results, arguments, directions=3, fewest=3)
    if delays is None:
        last = len(results.read("/layer")) - 1
        delays = sorted({-(-last // 6), -(-last // 2)})
    outside = cut.read("/invariant") == 0
    delay = cut.read("/delay", partition).astype(int)
    steps = np.where(outside, _ONE_COLOR, delay)
    is_inside = _hides(outside, view)
    if is_inside:
        steps[delay == results.flags("/delay")["unbounded"]] = _UNBOUNDED
        first = Panel("K", ~outside, np.full(outside.shape, _ONE_COLOR))
        growth = [Panel(f"tolerates {results.seconds(d)}", delay >= d, steps) for d in delays]
    else:
        first = Panel("outside K", outside, cut.read("/collision_time").astype(int))
        growth = [Panel(f"D = {results.seconds(d)}", delay < d, steps) for d in delays]
    return Unsafe(cut, results.partitions[partition], first, growth, view, is_inside)


def _parse_view(text):
    try:
        elevation, azimuth = map(float, text.split(","))
    except ValueError:
        elevation = math.nan
    if not -90 <= elevation <= 90 or not math.isfinite(azimuth):
        raise UsageError(f"expected an elevation and an azimuth such as 24,-56, found '{text}'", "--view")
    return elevation, azimuth


def draw(unsafe, size=None):
    results, cut = unsafe.cut.results, unsafe.cut
    count = 1 + len(unsafe.growth)
    columns = min(count, 3)
    rows = -(-count // columns)
    figure = style.new_figure(size, (4.3 * columns + 0.6, 4.0 * rows + 0.4))
    places = [figure.add_subplot(rows, columns, i + 1, projection="3d") for i in range(count)]
    for axes, panel in zip(places, [unsafe.collision, *unsafe.growth]):
        most = unsafe.most_collision if panel is unsafe.collision else unsafe.most_delay
        _draw_cells(axes, unsafe, panel, most)
        _label_axes(axes, cut, unsafe.view)
        axes.set_title(style.plain(panel.title))
    if not unsafe.is_inside:
        style.add_step_bar(figure, places[:1], unsafe.most_collision, "collision within", results, location="left", **_BAR)
    if any((panel.members & (panel.steps >= 0)).any() for panel in unsafe.growth):
        style.add_step_bar(figure, places[1:], unsafe.most_delay, "delay", results, **_BAR)
    style.add_title(figure, f"{results.title}, {unsafe.partition}", cut.title)
    style.legend_below(figure, _entries(unsafe))
    return figure


def _entries(unsafe):
    growth = any(panel.members.any() for panel in unsafe.growth)
    if not unsafe.is_inside:
        return [(style.NOT_INVARIANT, "not invariant")] if growth else []
    unbounded = any((panel.steps[panel.members] == _UNBOUNDED).any() for panel in unsafe.growth)
    return [(_INVARIANT, "K")] + [(_FREE, "unbounded delay")] * unbounded


def _draw_cells(axes, unsafe, panel, most):
    cells, corners, dimensions = visible_faces(panel.members, unsafe.viewer)
    edges = [axis.edges for axis in unsafe.cut.axes]
    polygons = np.stack([edges[i][corners[:, :, i]] for i in range(3)], axis=-1)
    cmap, norm = style.step_colors(most)
    steps = panel.steps[tuple(cells.T)]
    colors = cmap(norm(steps))
    colors[steps == _ONE_COLOR] = matplotlib.colors.to_rgba(_INVARIANT if unsafe.is_inside else style.NOT_INVARIANT)
    colors[steps == _UNBOUNDED] = matplotlib.colors.to_rgba(_FREE)
    colors[:, :3] *= np.array(_LIGHT)[dimensions][:, None]
    faces = Poly3DCollection(polygons, facecolors=colors, edgecolors=colors, linewidths=0.2, rasterized=True)
    axes.add_collection3d(faces)


def _ticks(first, last):
    return [t for t in matplotlib.ticker.MaxNLocator(5).tick_values(first, last) if first <= t <= last]


def _inner_ticks(first, last):
    """Without those at the ends, where the numbers of two axes meet."""
    ticks, gap = _ticks(first, last), 0.08 * (last - first)
    return [t for t in ticks if first + gap < t < last - gap] or ticks


def _label_axes(axes, cut, view):
    axes.set_proj_type("ortho")
    axes.view_init(*view)
    lengths = []
    for name, axis in zip("xyz", cut.axes):
        ends = axis.edges[[0, -1]]
        lengths.append(ends[1] - ends[0])
        getattr(axes, f"set_{name}lim")(*ends)
        getattr(axes, f"set_{name}label")(style.plain(axis.label), labelpad=_LABEL_PAD[name])
        along = getattr(axes, f"{name}axis")
        along.set_major_locator(matplotlib.ticker.FixedLocator(_inner_ticks(*ends) if name != "z" else _ticks(*ends)))
        along.set_tick_params(pad=0)
        if axis.is_points:
            style.point_ticks(along, axis.points)
    if len({axis.unit for axis in cut.axes}) > 1 or max(lengths) > _WIDEST * min(lengths):
        lengths = (1, 1, 1)
    axes.set_box_aspect(lengths, zoom=0.92)
    axes.patch.set_visible(False)  # or it covers the label of the panel before
