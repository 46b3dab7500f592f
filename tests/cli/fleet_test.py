"""Pairs of a fleet: what the page says of them, and query --least."""

import json
import re
import unittest

from pages import DOCS, blocks
from program import SPEC, Case, spec_with


class Cases(Case):
    def test_lanes_for_two_are_none_for_three(self):
        page = DOCS / "how-to/fleets.md"
        (pair,) = blocks(page, "json")
        three = json.loads(pair)
        three["inputs"].append({"name": "u3", "values": [0, 1]})
        three["agents"].append({"name": "three", "inputs": ["u3"]})
        three["dynamics"]["equations"] = json.loads(re.search(r'Three agents with `("e": .*?)` cannot', page.read_text())[1].join("{}"))
        sizes = []
        for spec in (pair, json.dumps(three)):
            self.write("spec.json", spec)
            sizes.append(self.analyze("spec.json", "-o", "out.h5")["invariant"])
        self.assertEqual(sizes, [1, 0])

    def test_results_without_silence(self):
        self.write("spec.json", SPEC)
        self.analyze("spec.json", "-o", "out.h5")
        missing = "the results have no silence, expected those of a spec with the key 'silence' (--least)"
        self.assert_fails(2, missing, "query", "out.h5", "--least", stdin=b"x,y\n1,1\n")

    def test_wrong_usage(self):
        self.write("spec.json", SPEC)
        self.analyze("spec.json", "-o", "out.h5")
        for arguments, message in (
            (("--least", "--at", "x=1,y=1"), "expected --at or --least, found both (--least)"),
            (("--least", "--extra"), "one answer for all pairs, expected no --extra (--extra)"),
            (("--at-least", "3"), "expected --least with it (--at-least)"),
            (("--partition", "a|b"), "all partitions are shown, expected it with --least only (--partition)"),
            (("--least", "--at-least", "-1"), "the results have no silence, expected those of a spec with the key 'silence' (--least)"),
        ):
            with self.subTest(arguments=arguments):
                self.assert_fails(2, message, "query", "out.h5", *arguments)


if __name__ == "__main__":
    unittest.main()
