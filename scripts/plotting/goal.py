"""Worst-case time to the goal, and the silence that costs no time

Over two states; --slice fixes the others. FILE needs a "goal" in its spec."""

from dataclasses import dataclass

import numpy as np

from . import style
from .cut import Cut, add_cut_arguments, make_cut
from .errors import FileError
from .results import Results

# Kinds of cells that are drawn in one colour, and -1 for those with steps to show.
NOT_SAFE, NOT_INVARIANT, NO_WAY, FREE = range(4)
_COLORS = (style.NOT_SAFE, style.NOT_INVARIANT, style.NO_PARTITION, style.FREE)
_TEXTS = ("not safe", "safe, not invariant", "goal cannot be forced", "unbounded silence, in time")

# Where so few cells take so many times as long as the others, these share the colours.
_FEW = 0.02
_FAR = 3
# Of the way, by what follows arrival: what the cells hold, what that is counted in, and the label of the bar.
_WAYS = {"stay": ("samples outside the goal", "samples", "outside the goal"), "return": ("time to the next visit", "steps", "to the next visit")}
_USUAL_WAY = ("time to the goal", "steps", "to the goal")
_FEW_LINES = 12  # of more steps than that lines are drawn at some


@dataclass(frozen=True)
class Panel:
    title: str
    counts: str  # "steps" or "samples"
    label: str  # of the bar
    way: bool  # steps of a way, and not of silence
    kinds: np.ndarray  # [x, y]
    steps: np.ndarray  # masked where `kinds` says all

    @property
    def most(self):
        """Steps of any cell."""
        return int(self.steps.max()) if self.steps.count() else 0

    @property
    def is_free(self):
        """Of silence: unbounded wherever there is a way."""
        return not self.steps.count() and bool((self.kinds == FREE).any())

    @property
    def shown(self):
        """Steps with a colour of their own; all others have that of the greatest."""
        if not self.steps.count():
            return 0
        usual = int(np.quantile(self.steps.compressed(), 1 - _FEW, method="higher"))
        return usual if 0 < _FAR * usual < self.most else self.most


@dataclass(frozen=True)
class Goal:
    cut: Cut
    partition: str
    panels: list[Panel]


def add_arguments(parser):
    add_cut_arguments(parser, 2)
    parser.add_argument("--partition", metavar="NAME", help="partition (default: the only one)")


def prepare(arguments):
    results = Results(arguments.file)
    if "/arrival" not in results:
        raise FileError('no /arrival in the file: analyse with a "goal"', results.path)
    partition = results.partition(arguments.partition)
    cut = make_cut(results, arguments, directions=2, fewest=1)
    way = _panel(_WAYS.get(results.spec.goal_then, _USUAL_WAY), True, cut.read("/arrival"), results.flags("/arrival"))
    words = ("silence that costs no time", "steps", "silence")
    silence = _panel(words, False, cut.read("/approach_delay", partition), results.flags("/approach_delay"))
    return Goal(cut, results.partitions[partition], [way] if silence.is_free else [way, silence])


def _panel(words, way, values, flags):
    values = values.reshape(len(values), -1).astype(int)
    kinds = np.full(values.shape, -1)
    kinds[values == flags["not_safe"]] = NOT_SAFE
    kinds[values == flags["not_invariant"]] = NOT_INVARIANT
    kinds[values == flags["goal_cannot_be_forced"]] = NO_WAY
    if "unbounded" in flags:
        kinds[values == flags["unbounded"]] = FREE
    return Panel(*words, way, kinds, np.ma.masked_where(kinds >= 0, values))


def _lines(axes, panel, cut):
    return style.step_lines(axes, panel.steps, panel.shown, cut, "black" if panel.way else "white")


def draw(goal, size=None):
    """Each panel has colours and a scale of its own: the way may take a hundred times as long as silence may last. Where silence
    never costs time, one line says so."""
    results, cut = goal.cut.results, goal.cut
    figure = style.new_figure(size, (0.8 + 4.4 * len(goal.panels), 4.3))
    grid = figure.subplots(1, len(goal.panels), squeeze=False, sharex=True, sharey=True)
    for axes, panel in zip(grid.flat, goal.panels):
        style.kind_image(axes, panel.kinds, _COLORS, style.extent_of(cut))
        style.step_image(axes, panel.steps, panel.shown, style.extent_of(cut), panel.way)
        style.label_plane(axes, cut)
        most = results.seconds(panel.most) if panel.counts == "steps" else panel.most
        axes.set_title(f"{panel.title}\nup to {most}" if panel.steps.count() else panel.title)
    for axes in grid.flat:
        axes.label_outer()
    for axes, panel in zip(grid.flat, goal.panels):
        if panel.steps.count():
            lines = _lines(axes, panel, cut) if panel.shown > _FEW_LINES else None
            bar = style.add_step_bar(
                figure, axes, panel.shown, panel.label, results, is_cut=panel.shown < panel.most, way=panel.way, unit=panel.counts
            )
            if lines is not None:
                bar.add_lines(lines)
    free = "" if len(goal.panels) > 1 else "silence costs no time"
    style.add_title(figure, f"{results.title}, {goal.partition}", cut.title, free)
    found = {int(kind) for panel in goal.panels for kind in np.unique(panel.kinds)}
    style.legend_below(figure, [(_COLORS[kind], _TEXTS[kind]) for kind in sorted(found - {-1})])
    return figure
