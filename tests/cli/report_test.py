"""`coordreq report`: the file and what stands in it."""

import html
import json
import re
import unittest

import h5py
import numpy as np
from program import SPEC, spec_with
from report_case import FOUR, INFINITE, ReportCase, data_of, unpacked

class Cases(ReportCase):
    def text_of(self, page):
        """What stands before the pictures, as plain text."""
        start, end = page.index("<main>"), page.index('<section aria-labelledby="explore-title">')
        return html.unescape(re.sub(r"\s*\n\s*", "\n", re.sub(r"<[^>]*>", "", page[start:end])))

    def test_holds_every_value(self):
        data = data_of(self.report(FOUR))
        with h5py.File(self.folder / "out.h5") as file:
            for name, state in zip("p gear v q".split(), data["states"]):
                self.assertEqual((state["name"], state["points"]), (name, file[name][:].tolist()))
            (cells,) = data["sets"]
            self.assertIsNone(cells["shows"])
            self.assertEqual([len(i) for i in cells["indices"]], list(file["safe"].shape))
            for head, map in zip(data["maps"], cells["maps"]):
                stored = file["delay"][head["partition"]] if head["kind"] == "delay" else file["collision_time"][:]
                expected = np.where(stored == np.iinfo(stored.dtype).max, INFINITE, stored.astype(np.int64))
                np.testing.assert_array_equal(unpacked(map).reshape(stored.shape), expected)
            self.assertEqual(data["partitions"][0]["layers"], file["layer_size"][0][: len(data["partitions"][0]["layers"])].tolist())

    def test_answer_of_the_circle(self):
        text = self.text_of(self.report(self.example("circle.json")))
        self.assertIn(
            "The agents may be silent for 0.28 s (28 steps) from the best state (x1 = -0.01 m, x2 = 0 m).\n"
            "3.3 % of the states that can be kept safe need contact at once.\n"
            "Sharemay be silent\n"
            "90 % of the statesfor at least 0.01 s (1 step)\n"
            "50 % of the statesfor at least 0.08 s (8 steps)\n"
            "10 % of the statesfor at least 0.2 s (20 steps)\n"
            "1 % of the statesfor at least 0.25 s (25 steps)\n",
            text,
        )
        self.assertIn("The agents horizontal and vertical keep a system safe together and choose new actions every 0.01 s.", text)
        self.assertIn("A state is safe if r2 <= R^2, where r2 = x1^2 + x2^2, R = 0.8.", text)
        self.assertIn("20,081 of them are safe; from 20,077 of these", text)

    def test_title_shares_and_constants(self):
        """No round share of the states that is none of theirs, no constant that nothing depends on."""
        page = self.report(spec_with(description="A short one", constants={"R": 6, "b": 2, "c": "R + b"},
                                     definitions={"sum": "x + y", "other": "c"}, safe="sum <= R"))
        self.assertIn("<title>A short one</title>", page)
        text = self.text_of(page)
        self.assertIn("A short one\nsmall\n", text)
        self.assertIn("A state is safe if sum <= R, where sum = x + y, R = 6.", text)
        self.assertIn(
            "Sharemay be silent\n"
            "77 % of the statesfor at least 0.5 s (1 step)\n"
            "50 % of the statesfor at least 0.5 s (1 step)\n"
            "10 % of the statesfor at least 1 s (2 steps)\n",
            text,
        )
        self.assertIn("<title>small</title>", self.report(spec_with(description="long " * 30)))

    def test_answers_of_partitions(self):
        text = self.text_of(self.report(FOUR))
        self.assertRegex(text, r"Partition alone\nFrom [0-9.]+ % of the states the agents never need to talk to each other; "
                               r"from the best of the others \(p = .* m\) they may be silent for [0-9.]+ s")  # fmt: skip
        self.assertRegex(text, r"A connection takes 0.5 s \(1 step\) to establish: in [0-9.]+ % of the states")
        self.assertIn("Partition together\nAll agents coordinate within every step, so there is no silence to tolerate.", text)

    def test_answers_that_are_no_times(self):
        for changes, answer in (
            ({"safe": "false"}, "No state is safe."),
            ({"dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x + 9", "y": "y"}}},
             "No state can be kept safe, even if all agents always coordinate."),
            ({"coordination": {"max_delay": 1}}, "may be silent for 1 step, perhaps longer: the analysis stopped there."),
            ({"safe": "true", "dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x", "y": "y"}}},
             "The agents never need to talk to each other."),
            ({"safe": "x == 2 and y == 2 and x == 2",
              "dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x + u + v", "y": "y"}}},
             "From no state may the agents be silent, not even for one step."),
        ):  # fmt: skip
            if changes.get("coordination"):
                changes = dict(changes, dynamics={"time": "discrete", "period": 1, "equations": {"x": "x + u", "y": "y + v"}})
            with self.subTest(answer=answer):
                self.assertIn(answer, self.text_of(self.report(spec_with(**changes))))

    def test_says_what_it_wrote(self):
        self.write("spec.json", SPEC)
        self.analyze("spec.json", "-o", "out.h5")
        result = self.run_program("report", "out.h5")
        size = (self.folder / "small.html").stat().st_size
        self.assertEqual(result.stdout.decode(), f"report in small.html ({size / 1024:.0f} KiB)\n")
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        result = self.run_program("report", "out.h5", "-o", "other.html", "--json")
        self.assertEqual(json.loads(result.stdout),
                         {"output": "other.html", "bytes": size, "every_cell": True, "partitions": ["a|b"]})  # fmt: skip
        self.assertEqual((self.folder / "small.html").read_bytes(), (self.folder / "other.html").read_bytes())

    def test_file_that_cannot_be_written(self):
        self.write("spec.json", SPEC)
        self.analyze("spec.json", "-o", "out.h5")
        (self.folder / "taken.html").mkdir()
        before = self.files()
        self.assert_fails(5, "the folder does not exist (missing)", "report", "out.h5", "-o", "missing/page.html")
        result = self.run_program("report", "out.h5", "-o", "taken.html")
        self.assertEqual((result.returncode, result.stdout), (5, b""))
        self.assertEqual(self.files(), before)

    def test_damaged_results(self):
        self.write("out.h5", "no results")
        self.assertEqual(self.run_program("report", "out.h5", "-o", "page.html").returncode, 3)
        self.assertEqual(self.files(), ["out.h5"])

    def test_names_of_users_are_no_markup(self):
        evil = "</script></pre><script>document.title = 'taken'</script><img src=x onerror=alert(1)> & {{data}}"
        page = self.report(spec_with(description=evil, states=[dict(state, unit=evil) for state in SPEC["states"]]))
        self.assertEqual(len(re.findall("<script", page)), 2)
        self.assertNotIn("<img", page)
        self.assertIn(evil, html.unescape(page))


if __name__ == "__main__":
    unittest.main()
