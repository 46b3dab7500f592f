"""Logs are judged: is the model true to them, are agents reckless, do they coordinate, are they silent for too long."""

import csv
import io
import json
import unittest

import h5py
import numpy as np
from program import CONFIGS, SPEC, Case, spec_with, without_comments

LOG = """\
t,x,y,u,v,connected
0,1,1,1,1,0
0.5,2,2,1,0,0
1,3,2,1,1,1
1.5,4,3,0,0,0
2,3,3,-1,-1,
"""

TEXT = """\
small, partition a|b: 5 rows
outside the domain  in none of 5 rows
not safe            in 1 of 5 rows, first in row 4 (t = 1.5): x = 4, y = 3
not invariant       in none of 4 rows
off the model       in 1 of 4 steps, first in row 4 (t = 1.5): from x = 4, y = 3 with u = 0, v = 0 the model leads to \
x between 3.5 and 4.5, found 3
reckless            in none of 4 steps
not coordinated     in 1 of 1 step, first in row 3 (t = 1): at x = 3, y = 2 with u = 1, v = 1
countdown broken    in none of 3 rows
"""

ROWS = """\
row,t,x,y,cell,delay,countdown,outside,unsafe,not_invariant,off_model,reckless:a,reckless:b,not_coordinated,breach
1,0,1,1,6,2,2,0,0,0,0,0,0,,0
2,0.5,2,2,12,1,1,0,0,0,0,0,0,,0
3,1,3,2,17,0,0,0,0,0,0,0,0,1,0
4,1.5,4,3,23,-2,,0,1,,1,,,,
5,2,3,3,18,0,0,0,0,0,,0,0,,
"""


class Cases(Case):
    def results(self, spec=SPEC):
        self.write("spec.json", spec)
        self.analyze("spec.json", "-o", "out.h5")

    def example(self, config, **changes):
        self.results({**json.loads(without_comments((CONFIGS / config).read_text())), **changes})

    def judge(self, log, *arguments, code=0, warning=""):
        result = self.run_program("judge", "out.h5", *arguments, stdin=log.encode())
        self.assertEqual((result.stderr.decode(), result.returncode), (warning, code))
        return result.stdout.decode()

    def findings(self, log, *arguments, code=0):
        found = json.loads(self.judge(log, "--json", *arguments, code=code))["findings"]
        return {name: own["count"] for name, own in found.items()}

    def test_text(self):
        self.results()
        self.assertEqual(self.judge(LOG, code=1), TEXT)
        self.assertEqual(self.judge(LOG, "--quiet", code=1), "")

    def test_rows_as_csv(self):
        self.results()
        self.assertEqual(self.judge(LOG, "--csv", code=1), ROWS)

    def test_json(self):
        self.results()
        found = json.loads(self.judge(LOG, "--json", code=1))
        findings = found.pop("findings")
        self.assertEqual(
            found,
            {
                "name": "small",
                "results": "out.h5",
                "guarantee": "samples-center",
                "partition": "a|b",
                "connection_delay": 0,
                "period": 0.5,
                "period_unit": "s",
                "rows": 5,
                "gaps": 0,
                "holds": False,
            },
        )
        self.assertEqual(findings["reckless"], {"judged": 4, "count": 0, "classes": {"a": 0, "b": 0}, "first": None})
        self.assertEqual(
            findings["off_model"],
            {
                "judged": 4,
                "count": 1,
                "first": {
                    "row": 4,
                    "t": 1.5,
                    "state": {"x": 4, "y": 3},
                    "inputs": {"u": 0, "v": 0},
                    "cell": 23,
                    "delay": None,
                    "delay_status": "not_safe",
                    "countdown": None,
                    "countdown_status": "none",
                    "next": {"state": "x", "found": 3, "lower": 3.5, "upper": 4.5},
                },
            },
        )
        lines = "".join(json.dumps(row) + "\n" for row in csv.DictReader(io.StringIO(LOG)))
        self.assertEqual(json.loads(self.judge(lines.replace('"connected": ""', '"connected": null'), "--json", code=1)),
                         {**found, "findings": findings})  # fmt: skip

    def test_what_is_wrong_is_said_in_words(self):
        self.results()
        late = self.judge("x,y,u,v,connected\n2,2,0,0,0\n2,2,0,0,0\n", code=1)
        self.assertIn(
            "countdown broken    in 1 of 2 rows, first in row 2: at x = 2, y = 2 the agents go on without contact\n", late
        )
        less = self.judge("x,y,u,v,connected\n0,0,1,1,0\n3,2,0,0,1\n", code=1)
        self.assertIn("first in row 2: x = 3, y = 2 tolerates 0 steps (0 s), less than the countdown promised\n", less)
        reckless = self.judge("x,y,u,v,connected\n0,3,-1,1,1\n2,2,57,0,1\n", code=1)
        self.assertIn("reckless            in 2 of 2 steps, first in row 1: a at x = 0, y = 3 with u = -1, v = 1\n", reckless)
        unit = self.judge("x,y,u,v,connected\n2,2,57,0,1\n")
        self.assertIn("a at x = 2, y = 2 with u = 57, v = 0, which is no value of u in the spec\n", unit)
        states = self.judge("x,y\n2,2\n9,2\n")
        self.assertIn("outside the domain  in 1 of 2 rows, first in row 2: x = 9, y = 2\n", states)
        self.assertIn("off the model       not judged\n", states)
        gap = self.judge("t,x,y\n0,2,2\n2,2,2\n")
        self.assertEqual(gap.splitlines()[0], "small, partition a|b: 2 rows, 1 after missing samples")

    def test_exit_code_is_1_if_the_model_or_a_countdown_is_broken(self):
        self.results()
        for log, code in (
            ("2,2,0,0,0\n2,2,,,", 0),
            ("2,2,0,0,0\n3,2,,,1", 1),  # off the model
            ("2,2,0,0,0\n2,2,0,0,0", 1),  # breach
            ("3,2,1,1,1", 0),  # not coordinated
            ("0,0,-1,0,0", 0),  # reckless
            ("4,4,,,", 0),  # not safe
        ):
            with self.subTest(log=log):
                self.judge(f"x,y,u,v,connected\n{log}\n", code=code)

    def test_mistakes_of_users(self):
        self.results(spec_with(coordination={"partitions": "all"}))
        for log, message in (
            ("x,y,connected\n1,1,yes\n", "expected 0 or 1, found 'yes' (standard input, line 2, connected)"),
            ("x,u\n1,0\n", "no column for the state 'y'; no state is 'u' (standard input, line 1)"),
            ("t,x,y\n0,1,1\n10,1,1\n10.1,1,1\n",
             "found 10.1 after 10, expected one period more, 0.5 s, or several (standard input, line 4, t)"),
            ("x,y,u,u\n1,1,0,0\n", "'u' is given twice (standard input, line 1)"),
            ("x,y\n", "no samples, expected a line of column names and a line for each (standard input)"),
        ):  # fmt: skip
            with self.subTest(log=log):
                self.assert_fails(2, message, "judge", "out.h5", "--partition", "a|b", stdin=log.encode())
        several = "several partitions, expected the name of one of a+b, a|b (--partition)"
        self.assert_fails(2, several, "judge", "out.h5", stdin=LOG.encode())
        both = "expected --csv or --json, found both (--csv)"
        self.assert_fails(2, both, "judge", "out.h5", "--csv", "--json", stdin=LOG.encode())
        missing = "cannot read the results: No such file or directory (none.h5)"
        self.assert_fails(5, missing, "judge", "none.h5", stdin=LOG.encode())

    def test_columns_that_mean_nothing_are_told_once(self):
        self.results()
        warning = "coordreq: warning: no state or input is called 'speed', 'note': ignored (standard input)\n"
        self.judge("speed,x,y,note\n1,2,2,a\n1,2,2,b\n", warning=warning)
        self.judge("speed,x,y,note\n1,2,2,a\n", "--quiet")

    def test_states_with_names_of_columns(self):
        states = [dict(SPEC["states"][0], name="t"), dict(SPEC["states"][1], name="cell")]
        equations = {"t": "t + u", "cell": "cell + v"}
        self.results(spec_with(states=states, dynamics={**SPEC["dynamics"], "equations": equations}, safe="t + cell <= 6"))
        header, row = self.judge("cell,t\n2,1\n", "--csv").splitlines()
        self.assertTrue(header.startswith("row,answer:t,t,cell,answer:cell,delay,"), header)
        self.assertTrue(row.startswith("1,,1,2,7,"), row)

    def run_as_log(self, *arguments, contact=True):
        """The first run of simulate as a log."""
        result = self.run_program("simulate", "out.h5", "-o", "runs.h5", *arguments)
        self.assertEqual((result.stderr.decode(), result.returncode), ("", 0))
        with h5py.File(self.folder / "runs.h5") as file:
            states = file["measured" if "measured" in file else "state"][0]
            inputs, coordinated, time = file["input"][0], file["coordinated"][0], file["time"][...]
            names = [*file["state_name"].asstr(), *file["input_name"].asstr()]
        (self.folder / "runs.h5").unlink()
        rows = [",".join(["t", *names, *(["connected"] if contact else [])])]
        for t, state, action, contacted in zip(time, states, inputs, coordinated):
            if np.isnan(state).any():
                break
            is_last = np.isnan(action).any()
            row = [repr(float(t)), *(repr(float(x)) for x in state), *("" if is_last else repr(float(u)) for u in action)]
            rows.append(",".join([*row, *(["" if is_last else str(contacted)] if contact else [])]))
        return "\n".join(rows) + "\n"

    def test_runs_of_examples_are_judged_without_a_finding(self):
        for config, arguments in (
            ("circle.json", ()),
            ("swap.json", ()),
            ("swap_deadline.json", ()),
            ("patrol_lock.json", ()),
            ("lane_change.json", ()),
            ("tutorial/corridor_4.json", ("--disturbance", "extremes")),
            ("blind_crossing.json", ("--blind",)),
        ):
            self.example(config)
            for contact in (True, False):
                with self.subTest(config=config, contact=contact):
                    log = self.run_as_log("--start", "random", "--steps", "60", *arguments, contact=contact)
                    self.assertEqual(set(self.findings(log).values()), {0})

    def test_changed_runs_are_found(self):
        self.example("circle.json")
        log = self.run_as_log("--from", "x1=0.1,x2=0", "--steps", "60")
        rows = [row.split(",") for row in log.splitlines()]
        for column, found in ((1, "off_model"), (3, "off_model")):
            changed = [list(row) for row in rows]
            value = float(changed[20][column])
            changed[20][column] = repr(value + 0.05 if column == 1 else (-1.0 if value > 0 else 1.0))
            with self.subTest(column=column):
                counts = self.findings("\n".join(",".join(row) for row in changed) + "\n", code=1)
                self.assertGreater(counts[found], 0)


if __name__ == "__main__":
    unittest.main()
