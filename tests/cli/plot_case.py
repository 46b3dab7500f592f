"""Figures of scripts/plot, drawn in this process so that a test can look at what is on them."""

import contextlib
import io
import json
import sys

import h5py
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from program import CONFIGS, ROOT, Case, without_comments

sys.path.insert(0, str(ROOT / "scripts"))
sys.dont_write_bytecode = True

from plotting.main import main, parse  # noqa: E402


class PlotCase(Case):
    def analyzed(self, spec):
        self.write("spec.json", spec)
        self.analyze("spec.json", "-o", "out.h5")

    def stored(self, name, file="out.h5"):
        with h5py.File(self.folder / file) as stored:
            return stored[name][...]

    def simulated(self, spec, *words):
        self.analyzed(spec)
        result = self.run_program("simulate", "out.h5", *words, "-o", "runs.h5")
        self.assertEqual((result.returncode, result.stderr), (0, b""))

    def rewrite(self, change):
        """What this version of the program does not write itself."""
        with h5py.File(self.folder / "out.h5", "r+") as file:
            change(file)

    def plotted(self, figure, *words, file="out.h5"):
        """What is drawn, and the drawing."""
        module, arguments = parse([figure, str(self.folder / file), "-o", "unused.png", *words])
        data = module.prepare(arguments)
        return data, module.draw(data)

    def assert_plot_fails(self, code, message, *words):
        """Exit code, one exact error line, and no file more than before."""
        before = self.files()
        errors = io.StringIO()
        with contextlib.chdir(self.folder), contextlib.redirect_stderr(errors):
            self.assertEqual(main(list(words)), code)
        self.assertEqual(errors.getvalue(), f"coordreq-plot: error: {message}\n")
        self.assertEqual(self.files(), before)

    def assert_arrays_equal(self, found, expected):
        np.testing.assert_array_equal(found, expected)


def example(config, **changes):
    return dict(json.loads(without_comments((CONFIGS / config).read_text())), **changes)


def titles(figure):
    """The text above the picture, and that above each panel."""
    texts = [figure._suptitle.get_text()] if figure._suptitle else []
    return texts + [axes.get_title() for axes in figure.axes if axes.get_title()]


def legend(figure):
    return [text.get_text() for text in figure.legends[0].get_texts()] if figure.legends else []


def labels(axes):
    return axes.get_xlabel(), axes.get_ylabel()


def drawn(figure):
    """All is where the layout puts it."""
    FigureCanvasAgg(figure).draw()
    return figure


def covered(figure):
    """The texts of legends that cover axes, titles or other legends of the picture."""
    drawn(figure)
    boxes = [axes.get_window_extent() for axes in figure.axes]
    boxes += [axes.title.get_window_extent() for axes in figure.axes if axes.get_title()]
    legends = [axes.get_legend() for axes in figure.axes if axes.get_legend()]
    found = [one for one in legends if any(one.get_window_extent().overlaps(box) for box in boxes)]
    found += [one for one in legends if not figure.bbox.containsx(one.get_window_extent().x1)]
    return [[text.get_text() for text in one.get_texts()] for one in found]
