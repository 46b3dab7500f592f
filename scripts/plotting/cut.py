"""Slices of the state space: which axes are drawn, and at which cells of the others."""

from dataclasses import dataclass

from .errors import UsageError, quoted
from .results import Axis
from .values import named_values, shown

_DIRECTIONS = ("x", "y", "z")


@dataclass(frozen=True)
class Cut:
    """`index` has a number for each state that is cut, and slice(None) for each that is drawn."""

    results: object
    axes: tuple[Axis, ...]
    index: tuple

    def read(self, name, partition=None):
        """The cells of the cut, [x, y, ...] in the order of `axes`."""
        first = () if partition is None else (partition,)
        cells = self.results.read(name, first + self.index)
        drawn = [axis.name for axis, at in zip(self.results.states, self.index) if isinstance(at, slice)]
        return cells.transpose([drawn.index(axis.name) for axis in self.axes])

    @property
    def title(self):
        """ "v1 = 2.8 m/s, v2 = 2.8 m/s", the centres of the cells; empty if nothing is cut."""
        at = zip(self.results.states, self.index)
        return ", ".join(axis.shown(shown(axis.points[i])) for axis, i in at if not isinstance(i, slice))


def add_cut_arguments(parser, directions, kind="state"):
    metavar = kind.upper()
    text = f"value of a {kind} that is not drawn; may be repeated"
    parser.add_argument("--slice", action="append", default=[], metavar=f"{metavar}=VALUE,...", help=text)
    for direction in _DIRECTIONS[:directions]:
        text = f"{kind} along the {direction} axis (default: the next one that is not cut)"
        parser.add_argument(f"--{direction}", metavar=metavar, help=text)


def choose(names, arguments, directions, fewest, kind):
    """Which of the names are drawn, x first, and the values at which the others are cut.

    @param kind "state" or "input"
    @throws UsageError if not `fewest` to `directions` of them are left to draw
    """
    slices = named_values(arguments.slice, "--slice")
    chosen = {d: getattr(arguments, d) for d in _DIRECTIONS[:directions] if getattr(arguments, d) is not None}
    for option, name in [("--slice", name) for name in slices] + [(f"--{d}", n) for d, n in chosen.items()]:
        if name not in names:
            raise UsageError(f"'{name}' is no {kind}, expected {quoted(names)}", option)
    for d, name in chosen.items():
        if name in slices or list(chosen.values()).count(name) > 1:
            raise UsageError(f"'{name}' is {'cut' if name in slices else 'drawn twice'}", f"--{d}")
    rest = [name for name in names if name not in slices and name not in chosen.values()]
    left = len(chosen) + len(rest)
    if left > directions:
        raise UsageError(f"cut {left - directions} of {quoted(rest)}: expected --slice {kind.upper()}=VALUE,...")
    if left < fewest:
        raise UsageError(f"the picture has {fewest} axes, found {left} {kind}{'' if left == 1 else 's'} to draw")
    return [chosen.get(d) or rest.pop(0) for d in _DIRECTIONS[:directions] if d in chosen or rest], slices


def make_cut(results, arguments, directions, fewest):
    """The cut that the arguments describe, over `fewest` to `directions` states."""
    by_name = {axis.name: axis for axis in results.states}
    given = named_values(arguments.slice, "--slice").keys() | {getattr(arguments, d) for d in _DIRECTIONS[:directions]}
    kept = [name for name in by_name if results.spec.is_kept(name) and name not in given]
    arguments.slice = [*arguments.slice, *(f"{name}=0" for name in kept)]
    names, slices = choose(list(by_name), arguments, directions, fewest, "state")
    index = tuple(
        results.cell(axis, slices[axis.name], "--slice") if axis.name in slices else slice(None)
        for axis in results.states
    )
    return Cut(results, tuple(by_name[name] for name in names), index)
