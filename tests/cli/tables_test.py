"""Functions that a spec gives by points, in itself or in a CSV file beside it."""

import bisect
import csv
import itertools
import json
import math
import unittest

import h5py
import numpy as np
from posts_test import reached
from program import SPEC, Case, spec_with, without_warnings

DRAG = {"x": [-4, -1, 0, 0.5, 2, 4], "value": [-4, -0.75, 0, 0.25, 2, 6]}
MAP = {"x": [-4, 0, 1, 4], "y": [-4, -0.5, 4], "value": [[1, 0, -1, 2], [0, 0.5, 1, -1], [2, 1, 0, 1]]}


def between(points, values, x):
    x = min(max(x, points[0]), points[-1])
    i = min(max(bisect.bisect_right(points, x), 1), len(points) - 1)
    return values[i - 1] + (values[i] - values[i - 1]) * (x - points[i - 1]) / (points[i] - points[i - 1])


def of_map(x, y):
    return between(MAP["y"], [between(MAP["x"], row, x) for row in MAP["value"]], y)


def system(equations, tables, time="continuous", period=0.25, step=0.5, disturbance=0.1, **changes):
    """States from -2.5 to 2.5, an input u of -1, 0 and 1, and a disturbance w."""
    return spec_with(**{
        "states": [{"name": name, "lower": -2.5, "upper": 2.5, "step": step} for name in equations],
        "inputs": SPEC["inputs"][:1],
        "agents": SPEC["agents"][:1],
        "disturbances": [{"name": "w", "lower": -disturbance, "upper": disturbance}],
        "dynamics": {"time": time, "period": period, "equations": equations},
        "tables": tables,
        "safe": "abs(x) <= 2",
        "output": {"abstraction": True, "controller": True},
        **changes,
    })  # fmt: skip


class Cases(Case):
    def contents(self, file):
        """All datasets but the spec."""
        found = {}
        with h5py.File(self.folder / file) as root:
            root.visititems(lambda name, item: found.update({name: item[...]} if isinstance(item, h5py.Dataset) else {}))
        return {name: value for name, value in found.items() if name not in ("spec", "spec_json")}

    def assert_same_results(self, one, other):
        self.write("one.json", one)
        self.write("other.json", other)
        for name in ("one", "other"):
            self.analyze(f"{name}.json", "-o", f"{name}.h5")
        one, other = self.contents("one.h5"), self.contents("other.h5")
        self.assertEqual(one.keys(), other.keys())
        for name, value in one.items():
            self.assertEqual(value.tobytes(), other[name].tobytes(), name)

    def assert_confirmed(self, file):
        result = self.run_program("verify", file)
        self.assertEqual((result.returncode, result.stderr), (0, b""), result.stdout.decode())

    def test_a_table_that_says_the_same_gives_the_same(self):
        tables = {
            "size": {"x": [-9, 0, 9], "value": [9, 0, 9], "outside": "clamp"},
            "least": {"x": [-9, "1/2", 9], "value": [-9, 0.5, 0.5], "outside": "clamp"},
            "most": {"x": [-9, -1, 9], "value": [-1, -1, 9], "outside": "clamp"},
        }
        calls = {
            "size(x)": "abs(max(min(x, 9), -9))",
            "least(x)": "min(max(min(x, 9), -9), 1/2)",
            "most(x)": "max(-1, max(min(x, 9), -9))",
        }
        for time, call in itertools.product(("continuous", "discrete"), (*calls, "x - size(x)*least(x)")):
            # What lies beyond the table is out of reach, so that its ends make no difference.
            in_full = short = call
            for own, function in calls.items():
                in_full = in_full.replace(own, function)
                short = short.replace(own, function.replace("max(min(x, 9), -9)", "x"))
            for written in (in_full, short):
                with self.subTest(time=time, call=call, written=written):
                    self.assert_same_results(
                        system({"x": f"u + w - ({call})"}, tables, time), system({"x": f"u + w - ({written})"}, None, time)
                    )

    def test_points_on_a_line_are_that_line(self):
        table = {"x": [-9, -1, 3, 9], "value": [-17, -1, 7, 19], "outside": "clamp"}
        self.assert_same_results(
            system({"x": "u + w + line(x)"}, {"line": table}, "discrete"),
            system({"x": "u + w + 2*max(min(x, 9), -9) + 1"}, None, "discrete"),
        )

    def assert_covers(self, spec, slope, effort=0):
        """Solutions from corners, kinks and points between them end in the posts, by Runge and Kutta."""
        self.write("s.json", dict(spec, abstraction={"effort": effort}))
        self.analyze("s.json", "-o", "s.h5")
        self.assert_confirmed("s.h5")
        names = [state["name"] for state in spec["states"]]
        period, step = spec["dynamics"]["period"], spec["states"][0]["step"]
        places = np.arange(math.ceil(-2.5 / step), math.floor(2.5 / step) + 1) * step
        with h5py.File(self.folder / "s.h5") as file:
            posts = {}
            for name, group in file["abstraction"].items():
                axes = [axis[0].name.strip("/") for axis in group["first"].dims]
                posts[name] = (axes, group["first"][...], group["last"][...])
        kinks = [*DRAG["x"], *MAP["x"], *MAP["y"]]
        for cell in itertools.product(range(len(places)), repeat=len(names)):
            box = [(places[k] - step / 2, places[k] + step / 2) for k in cell]
            points = [[low, high, *(kink for kink in kinks if low < kink < high)] for low, high in box]
            for number, u in enumerate((-1, 0, 1)):
                ends = reached(lambda x, w, u=u: slope(x, u, w), points, period, [(-0.1,), (0.1,), (-0.1, 0.1)], 30)
                for name, (low, high) in zip(names, ends):
                    axes, first, last = posts[name]
                    index = dict(zip(names, cell), u=number)
                    place = tuple(index[axis] for axis in axes)
                    tiny = 1e-4  # of the error of Runge and Kutta at kinks
                    lowest = math.ceil((low + tiny - places[0]) / step - 0.5)
                    highest = math.floor((high - tiny - places[0]) / step + 0.5)
                    self.assertLessEqual(first[place], max(lowest, -1), (cell, u, name))
                    self.assertGreaterEqual(last[place], min(highest, len(places)), (cell, u, name))

    def test_solutions_over_kinks_are_covered(self):
        self.assert_covers(
            system({"x": "u + w - drag(x)"}, {"drag": DRAG}), lambda x, u, w: [u + w - between(DRAG["x"], DRAG["value"], x[0])]
        )

    def test_solutions_over_a_table_of_two_variables_are_covered(self):
        self.assert_covers(
            system({"x": "u + map(x, y)", "y": "w - 0.5*map(y, x)"}, {"map": MAP}, step=1),
            lambda x, u, w: [u + of_map(*x), w - 0.5 * of_map(x[1], x[0])],
        )

    def test_discrete_time_is_exact(self):
        points = {"x": [-2.5, -1, 0.5, 2.5], "value": [0, 1.5, -1.5, 0.5]}
        spec = system({"x": "t(x) + u"}, {"t": points}, "discrete", disturbance=0)
        spec["states"][0]["discrete"] = True
        self.write("s.json", spec)
        self.analyze("s.json", "-o", "s.h5")
        with h5py.File(self.folder / "s.h5") as file:
            group = file["abstraction/x"]
            self.assertEqual(group["first"].shape, (11, 3))
            self.assertTrue(np.array_equal(group["first"][...], group["last"][...]))
            for (k, number), index in np.ndenumerate(group["first"][...]):
                value = between(points["x"], points["value"], -2.5 + 0.5 * k) + number - 1
                self.assertEqual(index, round((value + 2.5) / 0.5))
        self.assert_confirmed("s.h5")

    def test_arguments_outside_are_refused(self):
        table = {"x": [-2, 2], "value": [0, 1]}
        message = (
            "the equation of 'x', 'u - short(x)', is not defined everywhere near x = -2.5, u = -1: "
            "a table from -2 to 2 at a number in [-2.75, -2.25] (/dynamics/equations/x)"
        )
        for outside in (None, "refuse"):
            own = table if outside is None else {**table, "outside": outside}
            self.write("s.json", system({"x": "u - short(x)"}, {"short": own}, "discrete"))
            self.assert_fails(3, message, "validate", "s.json")
        self.write("s.json", system({"x": "u - short(x)"}, {"short": {**table, "outside": "clamp"}}, "discrete"))
        self.analyze("s.json")

    # CSV files.

    def write_csv(self, name, columns, rows):
        with open(self.folder / name, "w", newline="") as file:
            csv.writer(file).writerows([columns, *rows])

    def test_files_give_what_is_written_out(self):
        self.write_csv("drag.csv", ["x", "value"], zip(DRAG["x"], DRAG["value"]))
        points = [
            (x, y, MAP["value"][j][i]) for (i, x), (j, y) in itertools.product(enumerate(MAP["x"]), enumerate(MAP["y"]))
        ]
        self.write_csv("map.csv", ["note", "y", "x", "value"], [("", y, x, value) for x, y, value in points])
        equations = {"x": "u + w - drag(x) + 0.1*map(x, x)"}
        files = {"drag": {"file": "drag.csv", "outside": "clamp"}, "map": {"file": "map.csv"}}
        self.assert_same_results(
            system(equations, files, "discrete"),
            system(equations, {"drag": {**DRAG, "outside": "clamp"}, "map": MAP}, "discrete"),
        )
        # Results need them no more.
        with h5py.File(self.folder / "one.h5") as file:
            stored = json.loads(file["spec"][()])["tables"]
        self.assertEqual(stored, {"drag": {**DRAG, "outside": "clamp"}, "map": MAP})
        for file in ("drag.csv", "map.csv"):
            (self.folder / file).unlink()
        self.assert_confirmed("one.h5")
        for command in (["info", "one.h5"], ["query", "one.h5", "--at", "x=0"], ["simulate", "one.h5", "--from", "x=0", "--steps", "3"],
                        ["export", "one.h5", "--format", "c-header", "-o", "one.h"]):  # fmt: skip
            result = self.run_program(*command)
            self.assertEqual((result.returncode, without_warnings(result.stderr)), (0, b""), command)

    def test_a_file_stands_beside_the_spec(self):
        (self.folder / "there").mkdir()
        self.write_csv("there/drag.csv", ["x", "value"], zip(DRAG["x"], DRAG["value"]))
        self.write("there/s.json", system({"x": "u - drag(x)"}, {"drag": {"file": "drag.csv"}}, "discrete"))
        self.analyze("there/s.json")
        self.write_csv("other.csv", ["x", "value"], [(-3, 0), (3, 0)])
        self.analyze("there/s.json", "--set", "tables.drag.file=../other.csv")

    def test_no_output_takes_the_place_of_a_table(self):
        self.write_csv("drag.csv", ["x", "value"], zip(DRAG["x"], DRAG["value"]))
        self.write("s.json", system({"x": "u - drag(x)"}, {"drag": {"file": "drag.csv"}}))
        before = (self.folder / "drag.csv").read_bytes()
        for words, option in ((["-o", "drag.csv"], "--output"), (["--junit", "./drag.csv"], "--junit")):
            what = f"expected another file than a table of the spec, found '{words[1]}' ({option})"
            self.assert_fails(2, what, "analyze", "s.json", "--force", *words)
        self.assertEqual((self.folder / "drag.csv").read_bytes(), before)

    def test_errors_have_the_place_in_the_spec_as_written(self):
        self.write_csv("drag.csv", ["x", "value"], [(0, 0), (1, 1)])
        self.write("s.json", system({"x": "u - drag(x)"}, {"drag": {"file": "drag.csv"}}))
        lines = (self.folder / "s.json").read_text().splitlines()
        (place,) = [(i, line.index('"u - drag')) for i, line in enumerate(lines, 1) if '"u - drag' in line]
        self.shows_places = True
        result = self.run_program("validate", "s.json")
        self.assertIn(f"(/dynamics/equations/x; line {place[0]}, column {place[1] + 1})", result.stderr.decode())

    def test_quoted_numbers_and_names_are_read(self):
        self.write("drag.csv", '"x", "value"\r\n" -4 ","-4"\r\n"4",6\r\n')
        self.write("s.json", system({"x": "u - drag(x)"}, {"drag": {"file": "drag.csv"}}))
        self.analyze("s.json")
        self.write("drag.csv", 'x,value\n"1,2\n')
        self.assert_fails(3, "drag.csv: line 2, a quotation mark is not closed (/tables/drag/file)", "validate", "s.json")

    def test_settings_and_sweeps(self):
        self.write("s.json", system({"x": "u - drag(x)"}, {"drag": {"x": [-4, 4], "value": ["c", 0]}}, constants={"c": 0}))
        for name in ("tables.drag.value.1", "constants.c"):
            result = self.run_program("analyze", "s.json", "--sweep", f"{name}=0,12", "--json", "-o", ".")
            self.assertEqual(result.returncode, 0, result.stderr.decode())
            sizes = [run["summary"]["invariant"] for run in json.loads(result.stdout)["runs"]]
            self.assertNotEqual(sizes[0], sizes[1])

    def test_errors_in_files(self):
        self.write("s.json", system({"x": "u - drag(x)"}, {"drag": {"file": "drag.csv"}}))
        self.assert_fails(3, "drag.csv: no such file (/tables/drag/file)", "validate", "s.json")
        for text, what in {
            "": "expected a line with the columns 'x' and 'value', found nothing",
            "x;value\n1,5;2\n": "line 1, expected commas between columns and points in numbers, found semicolons",
            "x,y\n1,2\n": "line 1, expected a column 'value', found 'x' and 'y'",
            "# speed\nx,value\n1,2\n\n2,x\n": "line 5, expected a number, found 'x'",
            "x,value\n1,\n": "line 2, expected a number, found ''",
            "x,value\n1,2,3\n": "line 2, expected 2 values, found 3; numbers need a decimal point, not a comma",
            "x,value\n1,2\n1.0,3\n": "line 3, expected x > 1, found 1.0",
            "x,y,value\n1,2,3\n1,2.0,3\n": "the value at x = 1, y = 2.0 stands there twice",
            "x,y,value\n1,2,3\n2,2,3\n1,3,3\n": "no value at x = 2, y = 3",
            b"x,value\n\xff": "is no UTF-8 text, expected a table",
        }.items():
            with self.subTest(text=text):
                self.write("drag.csv", text)
                self.assert_fails(3, f"drag.csv: {what} (/tables/drag/file)", "validate", "s.json")
        self.write("drag.csv", "x,value\n1,2\n")
        self.assert_fails(3, "expected 2 to 100 numbers, found 1 (/tables/drag/x)", "validate", "s.json")
        self.write("s.json", system({"x": "u - drag(x)"}, {"drag": {"file": "drag.csv", "x": [1, 2]}}))
        self.assert_fails(3, "expected no 'x' beside 'file' (/tables/drag/x)", "validate", "s.json")

    def test_errors_in_tables(self):
        points = {"x": [0, 1, 2], "value": [0, 1, 2]}
        rows = {"x": [0, 1], "y": [0, 1], "value": [[0, 1], [1, 2]]}
        for table, what in (
            ({"x": [0, 2, 1], "value": [0, 1, 2]}, "expected a number > 2, found 1 (/tables/t/x/2)"),
            ({"x": [0], "value": [0]}, "expected 2 to 100 numbers, found 1 (/tables/t/x)"),
            ({**points, "value": [0, 1]}, "expected 3 numbers, one for each x, found 2 (/tables/t/value)"),
            ({"x": [0, 1]}, "expected 'x' and 'value', or 'file'; found no 'value' (/tables/t)"),
            ({**points, "value": [[0, 1, 2], 1, 2]},
             "expected a number, since there is no 'y', found a list (/tables/t/value/0)"),
            ({**rows, "value": [[0, 1]]}, "expected 2 lists, one for each y, found 1 (/tables/t/value)"),
            ({**rows, "value": [[0, 1], [1]]}, "expected 2 numbers, one for each x, found 1 (/tables/t/value/1)"),
            ({**rows, "value": [1, 2]},
             "expected a list of numbers, one for each x, found a number (/tables/t/value/0)"),
            ({**points, "x": [0, "x", 3]}, "expected constants only, found the state 'x' (/tables/t/x/1)"),
            ({**points, "x": [0, "t(1)", 3]}, "expected constants only, found the table 't' (/tables/t/x/1)"),
        ):  # fmt: skip
            with self.subTest(table=table):
                self.write("s.json", system({"x": "u"}, {"t": table}))
                self.assert_fails(3, what, "validate", "s.json")
        self.write("s.json", system({"x": "u"}, {"u": points}))
        self.assert_fails(3, "the name 'u' is taken, it stands at /inputs/0/name too (/tables/u)", "validate", "s.json")
        self.write("s.json", system({"x": "u"}, {"sin": points}))
        self.assert_fails(3, "'sin' is a function or keyword, expected another name (/tables/sin)", "validate", "s.json")
        for equation, what in (
            ("u + t(x, u)", "t takes 1 argument, found 2 (/dynamics/equations/x, column 5)"),
            ("u + t", "expected '(', found the end (/dynamics/equations/x, column 6)"),
        ):
            self.write("s.json", system({"x": equation}, {"t": points}))
            self.assert_fails(3, what, "validate", "s.json")
        self.write("s.json", system({"x": "u + drga(x)"}, {"drag": points}))
        self.assert_fails(3, "'drga' is not a function, did you mean 'drag'? (/dynamics/equations/x, column 5)", "validate", "s.json")
        self.write("s.json", system({"x": "u"}, {"t": points}, constants={"c": "t(1)"}))
        self.assert_fails(3, "expected constants only, found the table 't' (/constants/c)", "validate", "s.json")


if __name__ == "__main__":
    unittest.main()
