"""Silence without a rule, and under the communication-loss rule

Over two states; --slice fixes the others. FILE needs "silence" in its spec."""

from dataclasses import dataclass

from . import style
from .blind import COLORS, Panel, draw_panels, panel_of
from .cut import Cut, add_cut_arguments, make_cut
from .errors import FileError
from .results import Results


@dataclass(frozen=True)
class Silence:
    cut: Cut
    partition: str
    panels: list[Panel]
    texts: tuple[str, str, str]


def add_arguments(parser):
    add_cut_arguments(parser, 2)
    parser.add_argument("--partition", metavar="NAME", help="partition (default: the only one)")


def prepare(arguments):
    results = Results(arguments.file)
    if "/silence" not in results:
        raise FileError('no /silence in the file: analyse with "silence"', results.path)
    partition = results.partition(arguments.partition)
    cut = make_cut(results, arguments, directions=2, fewest=1)
    panels = [
        panel_of("without a rule", cut.read("/delay", partition), results.flags("/delay")),
        panel_of("with the communication-loss rule", cut.read("/silence", partition), results.flags("/silence")),
    ]
    outside = "safe, but outside the silence set" if "/silence_set" in results else "safe, not invariant"
    return Silence(cut, results.partitions[partition], panels, ("not safe", outside, "unbounded"))


def draw(silence, size=None):
    figure = style.new_figure(size, (9.6, 4.3))
    grid = figure.subplots(1, 2)
    found = draw_panels(figure, grid, silence.panels, silence.cut, "silence")
    style.add_title(figure, f"{silence.cut.results.title}, {silence.partition}", silence.cut.title)
    style.legend_below(figure, [(COLORS[kind], silence.texts[kind]) for kind in found])
    return figure
