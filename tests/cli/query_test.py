"""Everything that is known at a state."""

import csv
import io
import itertools
import json
import math
import subprocess
import unittest

import h5py
import numpy as np
from program import CONFIGS, PROGRAM, SPEC, Case, spec_with, without_comments

EVERYTHING = {"controller": True, "actions": True}

TEXT = """\
state                x = 0.6, y = 1
cell                 number 6, index (1, 1): x in [0.5, 1.5), y in [0.5, 1.5)
safe set             inside
invariance set       inside
leaves the safe set  never, with coordination
guarantee            samples-center: at the sampling instants, where the centre of a cell is safe

partition a|b
  delay         2 steps (1 s)
  connect in    2 steps (1 s)
  actions of a  all 3
  actions of b  all 3
  best state    3 steps (1.5 s) at x = 0, y = 0
"""


class Cases(Case):
    def analyzed(self, spec=SPEC, name="out.h5"):
        self.write("spec.json", spec)
        self.analyze("spec.json", "-o", name)
        return name

    def example(self, config, **changes):
        spec = json.loads(without_comments((CONFIGS / config).read_text()))
        return self.analyzed(dict(spec, **changes))

    def query(self, *arguments, stdin=b""):
        result = self.run_program("query", *arguments, stdin=stdin)
        self.assertEqual(result.stderr.decode(), "")
        self.assertEqual(result.returncode, 0)
        return result.stdout.decode()

    def at(self, state, name="out.h5"):
        return json.loads(self.query(name, "--at", state, "--json"))

    def test_text(self):
        self.assert_prints(TEXT, "query", self.analyzed(), "--at", "y=1,x=3/5")

    def test_sections_come_in_the_order_of_the_answers(self):
        answers = {"coordination": {"horizon": 1, "convention": True}, "network": {"delay": 1}}
        name = self.analyzed(spec_with(**answers))
        header = self.query(name, stdin=b"x,y\n0,0\n").splitlines()[0].split(",")
        sections = ("coalition", "critical_pairs", "safe_modes", "convention:a", "convention:b")
        self.assertEqual([column for column in header if column in sections], list(sections))
        keys = list(self.at("x=0,y=0", name))
        self.assertLess(keys.index("coalition"), keys.index("safe_modes"))

    def test_states_as_far_away_as_numbers_go(self):
        self.analyzed()
        for state in ("x=1e300,y=0", "x=0,y=-1e300", "x=9.3e18,y=9.3e18", "x=-9.3e18,y=1"):
            with self.subTest(state=state):
                answer = self.at(state)
                self.assertEqual((answer["inside"], answer["cell"]), (False, None))
                self.assertEqual(answer["outside"]["reason"], "beyond")

    def test_text_of_few_actions(self):
        self.analyzed()
        text = self.query("out.h5", "--at", "x=0,y=3")
        self.assertIn("  actions of a  2 of 3: u = 0, 1\n", text)
        self.analyzed(spec_with(coordination={"partitions": [{"classes": [["a", "b"]]}]}))
        few = "6 of 9: (u, v) = (-1, -1) (-1, 0) (-1, 1) (0, -1) (0, 0) (1, -1)"
        self.assertIn(f"  actions of a+b  {few}\n", self.query("out.h5", "--at", "x=3,y=3"))
        most = "8 of 9: (u, v) = (-1, -1) (-1, 0) (-1, 1) (0, -1) (0, 0) (0, 1) ..."
        self.assertIn(f"  actions of a+b  {most}\n", self.query("out.h5", "--at", "x=3,y=2"))

    def test_quiet(self):
        self.assert_prints("", "query", self.analyzed(), "--at", "x=1,y=1", "--quiet")

    def test_json(self):
        self.analyzed()
        answer = self.at("x=0,y=3")
        self.assertEqual(
            answer,
            {
                "state": {"x": 0, "y": 3},
                "guarantee": "samples-center",
                "inside": True,
                "outside": None,
                "cell": {
                    "number": 3,
                    "index": [0, 3],
                    "center": {"x": 0, "y": 3},
                    "lower": {"x": -0.5, "y": 2.5},
                    "upper": {"x": 0.5, "y": 3.5},
                },
                "safe": True,
                "invariant": True,
                "collision_time": None,
                "partitions": [
                    {
                        "name": "a|b",
                        "delay": 2,
                        "delay_time": 1,
                        "delay_status": "steps",
                        "countdown": 2,
                        "countdown_time": 1,
                        "countdown_status": "steps",
                        "classes": [
                            {"name": "a", "inputs": ["u"], "total": 3, "actions": [1, 2], "values": [[0], [1]]},
                            {
                                "name": "b",
                                "inputs": ["v"],
                                "total": 3,
                                "actions": [0, 1, 2],
                                "values": [[-1], [0], [1]],
                            },
                        ],
                    }
                ],
            },
        )

    def test_a_state_on_a_face_belongs_to_the_cell_above(self):
        for cells in ("closed", "half_open"):
            self.analyzed(spec_with(abstraction={"cells": cells, "safe": "center"}))
            self.assertEqual(self.at("x=0.5,y=1.5")["cell"]["index"], [1, 2])
            self.assertEqual(self.at("x=0.49999999999999999999999,y=1.5")["cell"]["index"], [0, 2])
            self.assertEqual(self.at("x=-0.5,y=4.499")["cell"]["index"], [0, 4])

    def test_outside_is_an_answer(self):
        states = [dict(SPEC["states"][0], outside={"above": "safe"}), dict(SPEC["states"][1], outside="saturate")]
        self.analyzed(spec_with(states=states))
        for state, outside, safe in (
            ("x=4.5,y=0", {"state": "x", "reason": "beyond", "side": "above", "rule": "safe"}, True),
            ("x=-0.6,y=0", {"state": "x", "reason": "beyond", "side": "below", "rule": "unsafe"}, None),
            ("x=9,y=5", {"state": "y", "reason": "beyond", "side": "above", "rule": "saturate"}, None),
        ):
            answer = self.at(state)
            self.assertEqual((answer["inside"], answer["cell"], answer["outside"]), (False, None, outside))
            self.assertEqual((answer["safe"], answer["invariant"], answer["partitions"]), (safe, safe, []))
        self.assert_prints(
            "state  x = 5, y = 0\n"
            "cell   outside: x = 5 has left above the domain, where the spec says that the system is safe indefinitely\n",
            "query", "out.h5", "--at", "x=5,y=0",
        )  # fmt: skip
        self.assert_prints(
            "state  x = -2, y = 0\n"
            "cell   outside: x = -2 lies below the domain, x in [-0.5, 4.5); the results do not cover it\n",
            "query", "out.h5", "--at", "x=-2,y=0",
        )  # fmt: skip

    def test_a_discrete_state_has_only_its_values(self):
        self.example("lane_change.json")
        answer = self.at("distance=1,left_lane=0.5,right_lane=0")
        self.assertEqual(answer["outside"], {"state": "left_lane", "reason": "off_grid"})
        self.assertEqual(self.at("distance=1,left_lane=1,right_lane=0")["cell"]["lower"]["left_lane"], 1)

    def test_a_periodic_state_wraps(self):
        self.example("aircraft_coarse.json", output={"abstraction": False})
        cells = {self.at(f"h={h},x=5,y=5")["cell"]["number"] for h in ("-pi", "pi", "3*pi", "-pi - 0.1")}
        self.assertEqual(len(cells), 1)

    def test_why_there_is_no_delay(self):
        self.example("intersection_coarse.json")
        with h5py.File(self.folder / "out.h5") as file:
            delay, time = file["delay"][0], file["collision_time"][...]
            axes = [file[name][...] for name in ("p1", "v1", "v2", "p2")]
            for value, status in ((-2, "not_safe"), (-1, "not_invariant"), (32767, "unbounded"), (3, "steps")):
                index = tuple(np.argwhere(delay == value)[0])
                state = ",".join(
                    f"{name}={axis[i]!r}" for name, axis, i in zip(("p1", "v1", "v2", "p2"), axes, index)
                )
                answer = self.at(state)
                (partition,) = answer["partitions"]
                self.assertEqual(answer["cell"]["index"], list(index))
                self.assertEqual(partition["delay_status"], status)
                self.assertEqual(partition["delay"], value if 0 <= value < 32767 else None)
                self.assertEqual(answer["collision_time"], None if time[index] == 32767 else time[index])
                none = [not one["actions"] for one in partition["classes"]]
                self.assertEqual(none, [value < 0, value < 0])

    def test_countdown_with_a_connection_delay(self):
        self.analyzed(spec_with(coordination={"connection_delay": 2, "max_delay": 3}))
        found = {}
        for x, y in itertools.product(range(5), range(5)):
            (partition,) = self.at(f"x={x},y={y}")["partitions"]
            if partition["delay"] is not None:
                delay, countdown = partition["delay"], partition["countdown"]
                self.assertEqual(countdown, delay - 2 if delay >= 2 else None)
                found[delay] = (partition["delay_status"], partition["countdown_status"])
        self.assertEqual(found.pop(0), ("steps", "connection_must_stand_already"))
        self.assertEqual(found.pop(3, ("at_least", "steps")), ("at_least", "steps"))

    def test_every_cell_with_actions_computed_as_the_analysis_stores_them(self):
        for config in ("lane_change.json", "load.json", "circle.json"):
            stored = self.example(config, output=EVERYTHING)
            with h5py.File(self.folder / stored) as file:
                names = [name for name in file if file[name].attrs.get("role") == "state"]
                axes = [file[name][...] for name in names]
                sample = list(itertools.product(*axes))[:: 1 if config == "lane_change.json" else 37]
            states = ",".join(names) + "\n"
            states += "".join(",".join(map(repr, map(float, state))) + "\n" for state in sample)
            expected = self.query(stored, stdin=states.encode())
            self.example(config)
            self.assertEqual(self.query("out.h5", stdin=states.encode()), expected)
            self.assertEqual(len(expected.splitlines()), len(sample) + 1)

    def test_csv_holds_what_the_file_holds(self):
        self.example("lane_change.json", output=EVERYTHING)
        states = list(itertools.product(range(7), range(2), range(2)))
        text = "right_lane,distance,left_lane\n" + "".join(f"{c},{a},{b}\n" for a, b, c in states)
        rows = list(csv.DictReader(io.StringIO(self.query("out.h5", stdin=text.encode()))))
        self.assertEqual(len(rows), len(states))
        with h5py.File(self.folder / "out.h5") as file:
            for state, row in zip(states, rows):
                self.assertEqual((row["inside"], int(row["cell"])), ("1", np.ravel_multi_index(state, (7, 2, 2))))
                self.assertEqual(float(row["distance"]), state[0])
                self.assertEqual((row["safe"], row["invariant"]), (str(file["safe"][state]),) * 2)
                for column, dataset in (("collision_time", file["collision_time"]), ("delay:left|right", file["delay"][0]),
                                        ("countdown:left|right", file["trigger"][0])):  # fmt: skip
                    value = dataset[state]
                    self.assertEqual(float(row[column]), math.inf if value == 32767 else value)
                bits = np.unpackbits(file["actions/left|right/left"][state], bitorder="little")
                self.assertEqual(row["actions:left|right:left"], " ".join(map(str, np.flatnonzero(bits))))

    def test_csv_of_a_state_with_the_name_of_a_column(self):
        self.analyzed(
            spec_with(
                states=[dict(SPEC["states"][0], name="cell"), SPEC["states"][1]],
                dynamics={"time": "discrete", "period": 0.5, "equations": {"cell": "cell + u", "y": "y + v"}},
                safe="cell + y <= 6",
            )
        )
        header = self.query("out.h5", stdin=b"cell,y\n0,0\n").splitlines()[0]
        self.assertTrue(header.startswith("cell,y,inside,answer:cell,safe,"), header)

    def test_csv_outside(self):
        self.analyzed()
        self.assert_prints(
            "x,y,inside,cell,safe,invariant,collision_time,delay:a|b,countdown:a|b,actions:a|b:a,actions:a|b:b\n"
            "7,0.25,0,,,,,,,,\n"
            "4,4,1,24,0,0,0,-2,-2,,\n",
            "query", "out.h5", stdin=b"y,x\n1/4,7\n4,4\n",
        )  # fmt: skip

    def test_json_lines(self):
        self.analyzed()
        lines = self.query("out.h5", stdin=b'{"x": 1, "y": "3/2"}\n{"y": 1, "x": 9}\n').splitlines()
        self.assertEqual(json.loads(lines[0]), self.at("x=1,y=1.5"))
        self.assertEqual(json.loads(lines[1]), self.at("x=9,y=1"))
        self.assertEqual(len(lines), 2)
        (line,) = self.query("out.h5", "--json", stdin=b"x,y\n1,1.5\n").splitlines()
        self.assertEqual(line, lines[0])

    def test_wrong_states(self):
        self.analyzed()
        for state, message in (
            ("x=1", "no value for the state 'y' (--at)"),
            ("x=1,y=1,u=0", "'u' is no state, expected 'x' or 'y' (--at)"),
            ("x=1,y=one", "'one' is not defined (--at, y, column 1)"),
            ("", "expected NAME=VALUE, found '' (--at)"),
        ):
            self.assert_fails(2, message, "query", "out.h5", "--at", state)
        self.assert_fails(
            2, "no column for the state 'y' (standard input, line 1)", "query", "out.h5", stdin=b"x\n1\n"
        )

    def test_a_wrong_line_comes_after_the_answers_before_it(self):
        self.analyzed()
        result = self.run_program("query", "out.h5", stdin=b"x,y\n1,1\n1,a\n")
        self.assertEqual(result.returncode, 2)
        self.assertEqual(len(result.stdout.splitlines()), 2)
        self.assertEqual(
            result.stderr.decode(), "coordreq: error: 'a' is not defined (standard input, line 3, y, column 1)\n"
        )

    LOG = b'time,y,notes,x,cell\n0.50,3/2,"calm, ""dry\"\"",1,a\n1,1,,9,\n'

    def test_columns_of_a_log_are_ignored_with_a_warning(self):
        self.analyzed()
        plain = self.query("out.h5", stdin=b"x,y\n1,1.5\n9,1\n")
        result = self.run_program("query", "out.h5", stdin=self.LOG)
        self.assertEqual((result.returncode, result.stdout.decode()), (0, plain))
        ignored = "no state is called 'time', 'notes', 'cell': ignored; --extra passes it through (standard input)"
        self.assertEqual(result.stderr.decode(), f"coordreq: warning: {ignored}\n")
        self.assertEqual(self.query("out.h5", "--quiet", stdin=self.LOG), plain)
        lines = b'{"x": 1, "y": 1, "t": 2}\n{"x": 1, "y": 1, "t": 2, "s": null}\n'
        result = self.run_program("query", "out.h5", stdin=lines)
        self.assertEqual(
            result.stderr, b"coordreq: warning: no state is called 't': ignored; --extra passes it through (standard input)\n"
        )
        first, second = result.stdout.splitlines()
        self.assertEqual(json.loads(first), self.at("x=1,y=1"))
        self.assertEqual(first, second)

    def test_columns_of_a_log_are_passed_through(self):
        self.analyzed()
        plain = self.query("out.h5", stdin=b"x,y\n1,1.5\n9,1\n").splitlines()
        told = self.query("out.h5", "--extra", stdin=self.LOG)
        extra = [",time,notes,extra:cell", ',0.50,"calm, ""dry""",a', ",1,,"]
        self.assertEqual(told.splitlines(), [line + more for line, more in zip(plain, extra)])
        lines = b'{"x": 1, "y": 1, "t": [2.50, "a"]}\n{"x": 9, "y": 1}\n'
        first, second = map(json.loads, self.query("out.h5", "--extra", stdin=lines).splitlines())
        self.assertEqual((first.pop("extra"), second.pop("extra")), ({"t": [2.5, "a"]}, {}))
        self.assertEqual((first, second), (self.at("x=1,y=1"), self.at("x=9,y=1")))
        first, second = map(json.loads, self.query("out.h5", "--extra", "--json", stdin=self.LOG).splitlines())
        self.assertEqual(first["extra"], {"time": "0.50", "notes": 'calm, "dry"', "cell": "a"})

    def test_a_slip_in_a_name_is_told(self):
        self.analyzed()
        message = "no column for the state 'y'; no state is 'Y', 'time' (standard input, line 1)"
        self.assert_fails(2, message, "query", "out.h5", stdin=b"x,Y,time\n1,1,1\n")

    def test_answers_come_line_by_line(self):
        self.analyzed()
        with subprocess.Popen(
            [PROGRAM, "query", "out.h5"],
            cwd=self.folder,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            bufsize=0,
        ) as child:
            child.stdin.write(b'{"x": 1, "y": 1}\n')
            self.assertEqual(json.loads(child.stdout.readline())["cell"]["number"], 6)
            child.stdin.write(b'{"x": 1, "y": 2}\n')
            self.assertEqual(json.loads(child.stdout.readline())["cell"]["number"], 7)
            child.stdin.close()
            self.assertEqual(child.wait(), 0)

    def test_files_that_are_no_results(self):
        self.write("spec.json", SPEC)
        self.assert_fails(
            3,
            "not a coordreq results file: it is not HDF5, or cut short (spec.json)",
            "query", "spec.json", "--at", "x=1,y=1",
        )  # fmt: skip
        self.assert_fails(
            5, "cannot read the results: No such file or directory (none.h5)", "query", "none.h5", "--at", "x=1,y=1"
        )

    def test_another_spec_than_the_one_analysed(self):
        self.analyzed()
        with h5py.File(self.folder / "out.h5", "r+") as file:
            file.attrs["spec_sha256"] = "00"
        result = self.run_program("query", "out.h5", "--at", "x=1,y=1")
        self.assertEqual(result.returncode, 3)
        self.assertIn("the attribute spec_sha256 says 00 (out.h5:/spec)", result.stderr.decode())


if __name__ == "__main__":
    unittest.main()
