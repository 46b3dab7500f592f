"""From which values on so much silence is tolerated: the answer of require, against the table of all cells."""

import csv
import io
import itertools
import json
import unittest

from program import CONFIGS, Case


class Cases(Case):
    def setUp(self):
        super().setUp()
        self.analyze(str(CONFIGS / "crossing.json"))

    def require(self, *arguments):
        result = self.run_program("require", "crossing.h5", *arguments)
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        return result.stdout.decode()

    def delays(self):
        """Of each cell, by (p1, v1, v2, p2)."""
        text = self.run_program("export", "crossing.h5", "--format", "csv").stdout.decode()
        rows = csv.DictReader(io.StringIO(text))
        return {tuple(float(row[name]) for name in ("p1", "v1", "v2", "p2")): float(row["delay:first|second"]) for row in rows}

    def test_in_words(self):
        self.assertEqual(
            self.require("--delay", "2s", "--over", "p1", "--given", "v1=1,v2=1,p2=-8"),
            "crossing, partition first|second: a delay of at least 2 steps (2 s)\n"
            "given the cell of  v1 = 1, v2 = 1, p2 = -8\n"
            "guarantee          samples-center: at the sampling instants, where the centre of a cell is safe\n"
            "tolerated          p1 up to -9.5 m\n"
            "tolerated          p1 from 2.5 m on\n",
        )
        text = self.require("--delay", "2", "--over", "p1,p2", "--given", "v1=1,v2=1", "--best", "small,large")
        self.assertIn("\ntolerated          p1 up to 10.5 m, p2 from 2.5 m on\n", text)
        text = self.require("--delay", "1", "--over", "p2", "--given", "p1=10", "--best", "small")
        self.assertIn("\nwhatever           v1, v2\n", text)
        text = self.require("--delay", "900", "--over", "v1", "--given", "p1=-4,p2=-4,v2=1", "--best", "large")
        self.assertTrue(text.endswith("\ntolerated          not even at the best end, v1 = 3.25 m/s\n"), text)

    def test_a_time_is_rounded_up_to_periods(self):
        for text, steps in (("2", 2), ("2s", 2), ("2 s", 2), ("1.5s", 2), ("0.1s", 1), ("1500ms", 2), ("0.1 min", 6)):
            found = json.loads(self.require("--delay", text, "--over", "p1", "--json"))
            self.assertEqual(found["delay"], steps, text)

    def test_one_state_against_all_cells(self):
        delays = self.delays()
        values = sorted({cell[0] for cell in delays})
        seen = set()
        for steps, best, given in itertools.product((1, 2, 4), ("large", "small"), ({1: 1, 2: 1, 3: -8}, {1: 3, 2: 0, 3: -1}, {3: -9}, {1: 2})):
            names = ("p1", "v1", "v2", "p2")
            text = ",".join(f"{names[i]}={value}" for i, value in given.items())
            found = json.loads(self.require("--delay", str(steps), "--over", "p1", "--given", text, "--best", best, "--json"))
            holds = {
                value: all(
                    delay >= steps
                    for cell, delay in delays.items()
                    if cell[0] == value and all(cell[i] == given[i] for i in given)
                )
                for value in values
            }
            order = values[::-1] if best == "large" else values
            run = list(itertools.takewhile(lambda value: holds[value], order))
            expected = [[run[-1] + (-0.5 if best == "large" else 0.5)]] if run else []
            self.assertEqual(found["corners"], expected, (steps, best, given))
            seen.add(len(run))
        self.assertGreater(len(seen), 3)

    def test_intervals_against_all_cells(self):
        """Without --best all values of one state that are tolerated, not only those at one end."""
        delays = self.delays()
        values = sorted({cell[0] for cell in delays})
        shapes = set()
        for steps, given in itertools.product((1, 2, 4, 900), ({1: 1, 2: 1, 3: -8}, {1: 3, 2: 0, 3: -1}, {1: 2, 2: 2, 3: 0}, {3: -9})):
            names = ("p1", "v1", "v2", "p2")
            arguments = ("--delay", str(steps), "--over", "p1", "--given", ",".join(f"{names[i]}={value}" for i, value in given.items()))
            found = json.loads(self.require(*arguments, "--json"))
            holds = [
                all(delay >= steps for cell, delay in delays.items() if cell[0] == value and all(cell[i] == given[i] for i in given))
                for value in values
            ]
            expected = []
            for is_kept, run in itertools.groupby(zip(holds, values), key=lambda own: own[0]):
                run = [value for _, value in run]
                if is_kept:
                    expected.append([run[0] - 0.5, run[-1] + 0.5])
            self.assertEqual(found["intervals"], expected, (steps, given))
            lines = self.require(*arguments, "--csv").splitlines()
            self.assertEqual([lines[0], *([float(value) for value in line.split(",")] for line in lines[1:])], ["p1_from,p1_to", *expected])
            text = self.require(*arguments)
            self.assertEqual(text.count("\ntolerated"), max(1, len(expected)), text)
            shapes.add((len(expected), bool(expected) and expected[0][0] > values[0] - 0.5))
        self.assertGreater(len(shapes), 2, shapes)

    def test_a_band(self):
        """A level of which neither end is good."""
        spec = {
            "coordreq": 1, "name": "band",
            "states": [{"name": "T", "lower": 0, "upper": 9, "step": 1, "unit": "degC", "discrete": True, "outside": "unsafe"}],
            "inputs": [{"name": "u", "values": [-1, 0, 1]}], "agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
            "dynamics": {"time": "discrete", "period": 1, "unit": "min", "equations": {"T": "T + u + v"}}, "safe": "2 <= T and T <= 7",
        }  # fmt: skip
        spec["inputs"].append({"name": "v", "values": [-1, 0, 1]})
        self.write("band.json", spec)
        self.analyze("band.json")
        ask = ("require", "band.h5", "--delay", "1", "--over", "T")
        text = self.run_program(*ask).stdout.decode()
        self.assertTrue(text.endswith("\ntolerated  T from 4 to 5 degC\n"), text)
        text = self.run_program(*ask, "--best", "large").stdout.decode()
        self.assertTrue(text.endswith("\ntolerated  not even at the best end, T = 9 degC; but T from 4 to 5 degC\n"), text)
        text = self.run_program("require", "band.h5", "--delay", "9", "--over", "T").stdout.decode()
        self.assertTrue(text.endswith("\ntolerated  nowhere\n"), text)

    def test_other_limits_against_all_cells(self):
        """Silence by rule, with own observations, towards a goal; arrival; risk."""
        for config, option, limit, column, keeps in (
            ("brake_on_silence", "--silence", "3", "silence:first|second", lambda value: value >= 3),
            ("blind_crossing", "--blind", "2", "blind_delay:first|second", lambda value: value >= 2),
            ("swap", "--approach", "1", "approach_delay:left|right", lambda value: value >= 1),
            ("swap", "--arrival", "4", "arrival", lambda value: 0 <= value <= 4),
            ("crossing_risk", "--risk", "0.01", "risk:up", lambda value: value <= 0.01),
        ):
            with self.subTest(option=option):
                self.run_program("analyze", str(CONFIGS / f"{config}.json"), "-o", "other.h5", "--quiet")
                rows = list(csv.DictReader(io.StringIO(self.run_program("export", "other.h5", "--format", "csv").stdout.decode())))
                states = [own["name"] for own in json.loads(self.run_program("info", "other.h5", "--json").stdout)["states"]]
                result = self.run_program("require", "other.h5", option, limit, "--over", states[0], "--given", f"{states[1]}={rows[0][states[1]]}", "--json")
                self.assertEqual(result.returncode, 0, result.stderr)
                found = json.loads(result.stdout)
                some = [row for row in rows if row[states[1]] == rows[0][states[1]]]
                values = sorted({float(row[states[0]]) for row in some})
                kept = [value for value in values if all(keeps(float(row[column])) for row in some if float(row[states[0]]) == value)]
                inside = [value for value in values if any(low <= value <= high for low, high in found["intervals"])]
                self.assertEqual(inside, kept)
                self.assertEqual(found[column.split(":")[0]], float(limit))
        self.assert_fails(2, "the results have no /silence, expected those of a spec with the key 'silence' (--silence)",
                          "require", "crossing.h5", "--silence", "3", "--over", "p1")  # fmt: skip
        self.assert_fails(2, "expected one limit, found --delay too (--silence)",
                          "require", "crossing.h5", "--silence", "3", "--delay", "2", "--over", "p1")  # fmt: skip
        self.run_program("analyze", str(CONFIGS / "crossing_risk.json"), "-o", "other.h5", "--quiet")
        self.assert_fails(2, "expected a probability from 0 to 1, found '2' (--risk)",
                          "require", "other.h5", "--risk", "2", "--over", "p1")  # fmt: skip

    def test_two_states_against_all_cells(self):
        delays = self.delays()
        values = sorted({cell[0] for cell in delays})
        for best in (("large", "large"), ("small", "large"), ("small", "small")):
            found = json.loads(
                self.require("--delay", "2", "--over", "p1,p2", "--given", "v1=2,v2=1", "--best", ",".join(best), "--json")
            )
            order = [values[::-1] if word == "large" else values for word in best]
            half = [-0.5 if word == "large" else 0.5 for word in best]
            reach, corners = len(values), []
            for p1 in order[0]:
                row = [delays[p1, 2, 1, p2] >= 2 for p2 in order[1]]
                reach = min(reach, row.index(False) if False in row else len(row))
                if reach == 0:
                    break
                if corners and corners[-1][1] == order[1][reach - 1] + half[1]:
                    corners.pop()
                corners.append([p1 + half[0], order[1][reach - 1] + half[1]])
            self.assertEqual(found["corners"], corners[::-1], best)
            lines = self.require("--delay", "2", "--over", "p1,p2", "--given", "v1=2,v2=1", "--best", ",".join(best), "--csv")
            rows = [[float(value) for value in line.split(",")] for line in lines.splitlines()[1:]]
            self.assertEqual((lines.splitlines()[0], rows), ("p1,p2", found["corners"]))

    def test_what_cannot_be_asked(self):
        for arguments, message in (
            ((), "missing --delay N, the silence to be tolerated, or one of --silence, --blind, --approach, --arrival and --risk"),
            (("--delay", "2"), "missing --over STATE, the state over which to search"),
            (("--delay", "2x", "--over", "p1"), "expected a number of steps from 1 on, or a time, e.g. 2s, found '2x' (--delay)"),
            (("--delay", "0", "--over", "p1"), "expected a number of steps from 1 on, or a time, e.g. 2s, found '0' (--delay)"),
            (("--delay", "1.5", "--over", "p1"), "expected a number of steps from 1 on, or a time, e.g. 2s, found '1.5' (--delay)"),
            (("--delay", "2", "--over", "p1,p1"), "'p1' is given twice (--over)"),
            (("--delay", "2", "--over", "q"), "'q' is no state, expected 'p1', 'v1', 'v2' or 'p2' (--over)"),
            (("--delay", "2", "--over", "p1,v1,p2"), "expected one state or two, found 3 (--over)"),
            (("--delay", "2", "--over", "p1", "--given", "p1=2"), "'p1' is sought, expected no value (--given)"),
            (("--delay", "2", "--over", "p1", "--given", "p2=50"), "p2 = 50 is outside of the domain (--given)"),
            (("--delay", "2", "--over", "p1", "--best", "x"), "expected large or small, found 'x' (--best)"),
            (("--delay", "2", "--over", "p1,p2", "--best", "large,small,large"), "expected one word for each state of --over (--best)"),
            (("--delay", "2", "--over", "p1", "--csv", "--json"), "expected --csv or --json, found both (--csv)"),
        ):
            with self.subTest(arguments=arguments):
                self.assert_fails(2, message, "require", "crossing.h5", *arguments)


if __name__ == "__main__":
    unittest.main()
