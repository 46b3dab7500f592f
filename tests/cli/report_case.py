"""What the tests of `coordreq report` share."""

import base64
import html
import json
import re
import zlib

import numpy as np
from program import CONFIGS, Case, spec_with, without_comments

# Names of the rows of the page, and of the lines of `query`.
ROWS = {
    "Safe set": "safe set",
    "Invariance set": "invariance set",
    "Leaves the safe set": "leaves the safe set",
    "Delay": "delay",
    "Connect in": "connect in",
}
# What some files have only, named alike.
FURTHER_ROWS = {"Cheapest partition", "Critical pairs", "Safe in"}

INFINITE = np.iinfo(np.int64).max

# Two positions, a speed and a gear: cells that are not safe, cannot be kept safe, never need contact, and with a
# connection delay must be connected already.
FOUR = spec_with(
    name="four",
    states=[
        {"name": "p", "lower": -3, "upper": 3, "step": 0.5, "unit": "m", "outside": {"above": "safe"}},
        {"name": "gear", "lower": 1, "upper": 2, "step": 1, "discrete": True, "outside": "saturate"},
        {"name": "v", "lower": 0, "upper": 1, "step": 0.5, "unit": "m/s", "outside": "saturate"},
        {"name": "q", "lower": -3, "upper": 3, "step": 0.5, "unit": "m", "outside": {"above": "safe"}},
    ],
    inputs=[{"name": "a", "values": [-0.5, 0, 0.5]}, {"name": "s", "values": [-1, 1]}, {"name": "b", "values": [0, 0.5]}],
    agents=[{"name": "first", "inputs": ["a", "s"]}, {"name": "second", "inputs": ["b"]}],
    dynamics={"time": "discrete", "period": 0.5, "unit": "s",
              "equations": {"p": "p + v", "v": "v + a", "gear": "gear + s", "q": "q + b*gear"}},
    safe="max(abs(p), abs(q)) >= 1",
    coordination={"connection_delay": 1, "partitions": [
        {"name": "alone", "classes": [["first"], ["second"]]}, {"name": "together", "classes": [["first", "second"]]}]},
)  # fmt: skip


def data_of(page):
    return json.loads(re.search(r'(?s)<script type="application/json" id="data">(.*?)</script>', page).group(1))


def unpacked(packed):
    codes = np.frombuffer(zlib.decompress(base64.b64decode(packed["data"])), dtype=f"<u{packed['bytes']}")
    values = codes.astype(np.int64) - 3
    values[codes == np.iinfo(codes.dtype).max] = INFINITE
    return values


def packed(values):
    codes = np.where(values == INFINITE, 255, values + 3).astype(np.uint8)
    return {"bytes": 1, "data": base64.b64encode(zlib.compress(codes.tobytes())).decode()}


class ReportCase(Case):
    def report(self, spec, name="page.html"):
        self.write("spec.json", spec)
        self.analyze("spec.json", "-o", "out.h5")
        return self.page(name)

    def report_that_fails(self, spec):
        """A report on a spec of which some requirement fails."""
        self.write("spec.json", spec)
        result = self.run_program("analyze", "spec.json", "-o", "out.h5", "--quiet")
        self.assertEqual((result.returncode, result.stdout, result.stderr), (1, b"", b""))
        return self.page("page.html")

    def page(self, name):
        result = self.run_program("report", "out.h5", "-o", name, "--quiet")
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, b"", b""))
        return (self.folder / name).read_text()

    def example(self, config):
        return json.loads(without_comments((CONFIGS / config).read_text()))

    def words_of(self, page):
        """What stands before the pictures, with a blank wherever there is a tag."""
        start, end = page.index("<main>"), page.index('<section aria-labelledby="explore-title">')
        return " ".join(html.unescape(re.sub(r"<[^>]*>", " ", page[start:end])).split())


class PageCase(ReportCase):
    """A report in `self.browser`."""

    def open(self, name="page.html", **options):
        self.browser.open(self.folder / name, **options)

    def assert_is_quiet(self):
        """Nothing was logged, and nothing asked for but the file."""
        self.assertEqual(self.browser.complaints, [])
        self.assertEqual([url for url in self.browser.requests if not url.startswith("data:")],
                         [(self.folder / "page.html").resolve().as_uri()])  # fmt: skip

    def cell(self):
        rows = self.browser.run("[...document.querySelectorAll('#cell tr')].map((row) => [row.cells[0].innerText, row.cells[1].innerText])")
        return dict(rows)

    def box(self, selector):
        return self.browser.run(
            f"(() => {{ const element = document.querySelector({json.dumps(selector)}); element.scrollIntoView({{block: 'center'}});"
            " const box = element.getBoundingClientRect(); return [box.left, box.top, box.width, box.height]; })()"
        )

    def point(self, across, up):
        """Points at a place in the frame of the picture, from 0 to 1; returns the colour there."""
        left, top, width, height = self.box("#picture")
        # Room for the axes, as picture.js has it.
        x, y = left + 62 + across * (width - 76), top + 8 + (1 - up) * (height - 56)
        top_left = (int(x - left), int(y - top))
        colour = self.browser.run(
            "(() => { const context = document.createElement('canvas').getContext('2d', {willReadFrequently: true});"
            f" context.drawImage(document.getElementById('picture'), {top_left[0]}, {top_left[1]}, 1, 1, 0, 0, 1, 1);"
            " return [...context.getImageData(0, 0, 1, 1).data].slice(0, 3); })()"
        )
        self.browser.point(x, y)
        return colour

    def assert_is_answer(self, cell, partition):
        """The page says of a cell what `query` says of its centre."""
        at = ",".join(re.sub(r" = (\S+)( [^,]*)?$", r"=\1", part) for part in cell["Centre"].split(", "))
        result = self.run_program("query", "out.h5", "--at", at)
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        general, *partitions = result.stdout.decode().split("\npartition ")
        (own,) = [text for text in partitions if text.split("\n")[0] == partition]
        said = {name.strip(): text for name, text in re.findall(r"(?m)^(\s*\S.*?)  +(\S.*)$", general + own)}
        self.assertTrue(said["cell"].startswith(cell["Cell"] + ":"), (said["cell"], cell["Cell"]))
        self.assertEqual({row: cell[row] for row in ROWS}, {row: said[line] for row, line in ROWS.items()})
        further = dict(re.findall(r"(?m)^  (\S.*?)  +(\S.*)$", partitions[-1]))
        for row in FURTHER_ROWS & cell.keys():
            self.assertEqual(cell[row], further.get(row.lower(), "-"))

    def assert_picture_changes(self, act):
        shown = "document.getElementById('picture').toDataURL()"
        before = self.browser.run(shown)
        act()
        self.assertTrue(self.browser.run(shown) != before)

    def focus(self, selector):
        self.browser.run(f"document.querySelector({json.dumps(selector)}).focus()")

    def select(self, name, value):
        self.browser.run(f"(() => {{ const field = document.getElementById('{name}'); field.value = '{value}';"
                         " field.dispatchEvent(new Event('change')); })()")  # fmt: skip
