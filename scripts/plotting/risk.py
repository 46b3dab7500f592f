"""The probability of leaving the invariance set within the horizon, in powers of ten

Over two states; --slice fixes the others. One panel for each mode of the network. FILE needs a "risk" in its spec."""

from dataclasses import dataclass

import matplotlib
import numpy as np
from matplotlib.colors import BoundaryNorm

from . import style
from .cut import Cut, add_cut_arguments, make_cut
from .errors import FileError, UsageError, quoted
from .results import Results

# Kinds of cells that are drawn in one colour, and -1 for those with a risk to show.
NOT_SAFE, NOT_INVARIANT, NO_RISK = range(3)
_COLORS = (style.NOT_SAFE, style.NOT_INVARIANT, style.FREE)
_TEXTS = ("not safe", "safe, not invariant", "no risk")

_LEAST = -12  # power of ten below which all risks share a colour,
_BELOW = "#fff7d6"  # this one
_MOST_MODES = 4  # drawn without being named


@dataclass(frozen=True)
class Panel:
    mode: str
    kinds: np.ndarray  # [x, y]
    powers: np.ndarray  # log10 of the risk, masked where `kinds` says all


@dataclass(frozen=True)
class Risk:
    cut: Cut
    horizon: int
    panels: list[Panel]


def add_arguments(parser):
    add_cut_arguments(parser, 2)
    text = f"mode of the network; may be repeated (default: the first {_MOST_MODES})"
    parser.add_argument("--mode", action="append", default=[], metavar="NAME", help=text)


def prepare(arguments):
    results = Results(arguments.file)
    if "/risk" not in results:
        raise FileError('no /risk in the file: analyse with a "risk"', results.path)
    modes = [str(name) for name in results.read("/mode")]
    for name in arguments.mode:
        if name not in modes:
            raise UsageError(f"no mode '{name}', expected {quoted(modes)}", "--mode")
    cut = make_cut(results, arguments, directions=2, fewest=1)
    safe, invariant = (_flat(cut.read(name)) != 0 for name in ("/safe", "/invariant"))
    shown = arguments.mode or modes[:_MOST_MODES]
    panels = [_panel(name, _flat(cut.read("/risk", modes.index(name))), safe, invariant) for name in shown]
    return Risk(cut, int(results.attribute("/risk", "horizon")), panels)


def _flat(cells):
    return cells.reshape(len(cells), -1)


def _panel(mode, risks, safe, invariant):
    kinds = np.full(risks.shape, -1)
    kinds[invariant & (risks == 0)] = NO_RISK
    kinds[~invariant] = NOT_INVARIANT
    kinds[~safe] = NOT_SAFE
    with np.errstate(divide="ignore"):
        powers = np.log10(risks.astype(float))
    return Panel(mode, kinds, np.ma.masked_where(kinds >= 0, powers))


def draw(risk, size=None):
    results, cut = risk.cut.results, risk.cut
    figure = style.new_figure(size, (1.2 + 3.9 * len(risk.panels), 4.3))
    grid = figure.subplots(1, len(risk.panels), squeeze=False, sharex=True, sharey=True)
    levels = _levels(risk.panels)
    cmap = matplotlib.colormaps["viridis_r"].resampled(len(levels) - 1).with_extremes(under=_BELOW)
    norm = BoundaryNorm(levels, len(levels) - 1)
    for axes, panel in zip(grid.flat, risk.panels):
        style.kind_image(axes, panel.kinds, _COLORS, style.extent_of(cut))
        style.power_image(axes, panel.powers, cmap, norm, style.extent_of(cut))
        style.label_plane(axes, cut)
        axes.set_title(style.plain(f"mode {panel.mode}"))
    for axes in grid.flat:
        axes.label_outer()
    if any(panel.powers.count() for panel in risk.panels):
        is_below = any(panel.powers.min() < levels[0] for panel in risk.panels if panel.powers.count())
        style.add_power_bar(figure, list(grid.flat), levels, cmap, norm, "risk", is_below)
    style.add_title(figure, f"{results.title}, risk within {results.seconds(risk.horizon)}", cut.title)
    found = {int(kind) for panel in risk.panels for kind in np.unique(panel.kinds)}
    style.legend_below(figure, [(_COLORS[kind], _TEXTS[kind]) for kind in sorted(found - {-1})])
    return figure


def _levels(panels):
    """Powers of ten from one that is below all risks, or the least one that is told apart, to 1."""
    least = min((panel.powers.min() for panel in panels if panel.powers.count()), default=0)
    return list(range(max(_LEAST, min(-1, int(np.floor(least)))), 1))
