"""What the tests of `coordreq report` share."""

import base64
import json
import re
import zlib

import numpy as np
from program import CONFIGS, Case, spec_with, without_comments

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
        result = self.run_program("report", "out.h5", "-o", name, "--quiet")
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, b"", b""))
        return (self.folder / name).read_text()

    def example(self, config):
        return json.loads(without_comments((CONFIGS / config).read_text()))
