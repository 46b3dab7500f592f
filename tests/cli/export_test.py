"""The formats of other tools."""

import csv
import io
import itertools
import json
import math
import resource
import subprocess
import unittest
from decimal import Decimal

import h5py
import numpy as np
from program import CONFIGS, SPEC, Case, spec_with, without_comments

# Every kind of side, cell and dimension.
MIXED = spec_with(
    name="mixed-1.0",
    states=[
        {"name": "h", "lower": "-pi", "upper": "pi", "count": 5, "outside": "periodic"},
        {"name": "y", "lower": -0.7, "upper": 0.7, "step": 0.1, "outside": {"above": "safe"}},
        {"name": "v", "lower": 0, "upper": 0.6, "step": 0.3, "outside": "saturate", "measurement_error": 0.2},
        {"name": "gear", "lower": 1, "upper": 2, "step": 1, "discrete": True, "outside": "saturate"},
    ],
    inputs=[{"name": "turn", "values": [-1, 0, 0.5]}, {"name": "shift", "values": [-1, 1]},
            {"name": "push", "values": [-0.1, 0.1]}],
    agents=[{"name": "a", "inputs": ["turn"]}, {"name": "b", "inputs": ["shift", "push"]}],
    dynamics={"time": "discrete", "period": 0.5, "unit": "s",
              "equations": {"h": "h + turn*pi/5", "y": "y + 0.1*gear*push", "v": "v + push", "gear": "gear + shift"}},
    coordination={"connection_delay": 1},
    safe="abs(y) <= 0.55 or v < 0.1",
)  # fmt: skip

C_PROGRAM = """
#include "exported.h"
#include <stdio.h>

int main(void) {
  double x[@STATES];
  int i;
  for (;;) {
    int32_t cell;
    uint32_t c, a;
    for (i = 0; i < @STATES; ++i) {
      if (scanf("%lf", &x[i]) != 1) return 0;
    }
    cell = $cell(x);
    printf("%d", (int)cell);
    if (cell < 0) {
      uint32_t actions = 0, allowed = 0;
      for (c = 0; c <= @CLASSES; ++c) {
        for (a = 0; a < $action_count(c); ++a) {
          ++actions;
          allowed += $allowed(cell, c, a) != 0;
        }
        allowed += $allowed(cell, c, a) != 0;
      }
      printf(",%d,%s", (int)$countdown(cell), allowed == 0 ? "none" : allowed == actions ? "all" : "some");
    } else {
      printf(",%d", (int)$countdown(cell));
      for (c = 0; c < @CLASSES; ++c) {
        printf(",");
        for (a = 0; a < $action_count(c); ++a) {
          if ($allowed(cell, c, a)) printf("%u:%g ", (unsigned)a, $input(c, a, 0));
        }
      }
    }
    printf("\\n");
  }
}
"""

# Cell, countdown and actions that the program prints of what is no cell.
C_OUTSIDE = "-1,0,none"
C_LEFT_SAFELY = f"-2,{2**31 - 1},all"


def setUpModule():
    """AddressSanitizer reserves far more addresses than it uses: a soft limit of them is not for these tests."""
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (hard, hard))


class Cases(Case):
    def analyzed(self, spec=SPEC):
        self.write("spec.json", spec)
        self.analyze("spec.json", "-o", "out.h5")

    def example(self, config, **changes):
        self.analyzed(dict(json.loads(without_comments((CONFIGS / config).read_text())), **changes))

    def run_quietly(self, *arguments, stdin=b""):
        result = self.run_program(*arguments, stdin=stdin)
        self.assertEqual(result.stderr.decode(), "")
        self.assertEqual(result.returncode, 0)
        return result.stdout.decode()

    def export(self, *arguments):
        return self.run_quietly("export", "out.h5", "--format", *arguments)

    def table(self, *arguments):
        """Column names and an array [row, column]."""
        rows = list(csv.reader(io.StringIO(self.export("csv", *arguments))))
        return rows[0], np.array(rows[1:], dtype=float)

    # csv

    def test_csv_of_a_small_grid(self):
        self.analyzed(spec_with(states=[dict(state, upper=1) for state in SPEC["states"]], safe="x + y <= 1"))
        self.assertEqual(
            self.export("csv"),
            "x,y,safe,invariant,collision_time,delay:a|b,countdown:a|b\n"
            "0,0,1,1,inf,0,0\n0,1,1,1,inf,0,0\n1,0,1,1,inf,0,0\n1,1,0,0,0,-2,-2\n",
        )

    def expected(self, file, name, p):
        values = file[name][...] if p is None else file[name][p]
        if values.dtype == np.uint8:
            return values.astype(float)
        return np.where(values == np.iinfo(values.dtype).max, math.inf, values.astype(float))

    def columns(self, file):
        columns = {name: self.expected(file, name, None) for name in ("safe", "invariant", "collision_time")}
        for p, name in enumerate(file["partition"].asstr()):
            columns[f"delay:{name}"] = self.expected(file, "delay", p)
            columns[f"countdown:{name}"] = self.expected(file, "trigger", p)
        return columns

    def test_csv_holds_the_file(self):
        partitions = [{"classes": []}, {"name": "both", "classes": [["first", "second"]]}]
        self.example("intersection_coarse.json", coordination={"partitions": partitions, "connection_delay": 1})
        with h5py.File(self.folder / "out.h5") as file:
            names = ["p1", "v1", "v2", "p2"]
            columns = self.columns(file)
            axes = [file[name][...] for name in names]
            # Slices.
            header, table = self.table("--slice", "v1=1.01, v2=0.5", "--slice", "p1=-0.24")
            self.assertEqual(header, [*names, *columns])
            index = (self.cell(axes[0], -0.24), self.cell(axes[1], 1.01), self.cell(axes[2], 0.5), slice(None))
            for c, values in enumerate(columns.values()):
                self.assertTrue(np.array_equal(table[:, 4 + c], values[index]), header[4 + c])
            self.assertTrue(np.array_equal(table[:, 3], axes[3]))
            self.assertTrue((table[:, 0] == axes[0][index[0]]).all())
            # One partition, all cells.
            header, table = self.table("--partition", "both")
            self.assertEqual(header[4:], ["safe", "invariant", "collision_time", "delay:both", "countdown:both"])
            self.assertTrue(np.array_equal(table[:, 7], columns["delay:both"].ravel()))
            self.assertTrue(np.array_equal(table[:, 0], np.repeat(axes[0], table.shape[0] // len(axes[0]))))
            # Projections of one kind and of two, in their order, after a slice.
            cut = self.cell(axes[2], 1)
            for projections, reduce in (
                (("p2:min",), lambda a: a[:, :, cut].min(-1)),
                (("p2:max,v1:max",), lambda a: a[:, :, cut].max((1, 2))),
                (("p2:min", "v1:max"), lambda a: a[:, :, cut].min(-1).max(-1)),
                (("v1:max", "p2:min", "p1:min"), lambda a: a[:, :, cut].max(1).min().reshape(1)),
            ):
                arguments = [text for one in projections for text in ("--project", one)]
                header, table = self.table("--slice", "v2=1", *arguments)
                kept = [name for name in names if name not in "".join(projections)]
                self.assertEqual(header, [*kept, *columns])
                for c, (name, values) in enumerate(columns.items()):
                    # A connection that must stand already is between being lost and a countdown of 0.
                    ranks = np.where(values == -3, -0.5, values) if name.startswith("countdown") else values
                    found = table[:, len(kept) + c]
                    found = np.where(found == -3, -0.5, found) if name.startswith("countdown") else found
                    self.assertTrue(np.array_equal(found, reduce(ranks).ravel()), (projections, name))

    @staticmethod
    def cell(axis, value):
        return int(np.abs(axis - value).argmin())

    def test_wrong_selections(self):
        self.analyzed()
        for arguments, message in (
            (("--slice", "z=1"), "'z' is no state, expected 'x' or 'y' (--slice)"),
            (("--slice", "x"), "expected STATE=VALUE, found 'x' (--slice)"),
            (("--slice", "x=4.5"), "x = 4.5 is outside of the domain (--slice)"),
            (("--slice", "x=a"), "'a' is not defined (--slice, x, column 1)"),
            (("--slice", "x=1", "--project", "x:min"), "'x' is sliced or projected twice (--project)"),
            (("--project", "x:mean"), "expected STATE:min or STATE:max, found 'x:mean' (--project)"),
            (("--project", "x"), "expected STATE:min or STATE:max, found 'x' (--project)"),
            (("--partition", "all"), "no partition 'all', expected 'a|b' (--partition)"),
        ):
            self.assert_fails(2, message, "export", "out.h5", "--format", "csv", *arguments)

    # scs

    def test_scs_of_a_small_system(self):
        self.analyzed(
            spec_with(
                states=[dict(state, lower=lower, upper=2) for state, lower in zip(SPEC["states"], (1, 0))],
                safe="x + y <= 3",
                inputs=[{"name": "u", "values": [-1, 0]}, {"name": "v", "values": [-1, 0, 1]}],
            )
        )
        text = """\
#SCOTS:v0.2
#TYPE:STATICCONTROLLER
#SCOTS:STATE_SPACE
#TYPE:UNIFORMGRID
#MEMBER:DIM
2
#VECTOR:ETA
#BEGIN:2
1
1
#END
#VECTOR:LOWER_LEFT
#BEGIN:2
1
0
#END
#VECTOR:UPPER_RIGHT
#BEGIN:2
2
2
#END
#SCOTS:INPUT_SPACE
#TYPE:UNIFORMGRID
#MEMBER:DIM
2
#VECTOR:ETA
#BEGIN:2
1
1
#END
#VECTOR:LOWER_LEFT
#BEGIN:2
-1
-1
#END
#VECTOR:UPPER_RIGHT
#BEGIN:2
0
1
#END
#TYPE:WINNINGDOMAIN
#SCOTS:i (state) j_0 ... j_n (valid inputs)
#MATRIX:DATA
#BEGIN:6 6
0 3 5 
1 2 3 4 5 
2 1 3 5 
3 0 1 2 3 4 
4 1 3 
#END
"""
        self.assertEqual(self.export("scs"), text)

    def test_scs_is_the_controller(self):
        self.example("circle.json", output={"controller": True})
        lines = self.export("scs").split("#BEGIN:40401 1681\n")[1].splitlines()
        self.assertEqual(lines.pop(), "#END")
        with h5py.File(self.folder / "out.h5") as file:
            invariant = file["invariant"][...]
            self.assertEqual([int(line.split()[0]) for line in lines], list(np.flatnonzero(invariant.T)))
            for line in lines[::97]:
                number, *inputs = map(int, line.split())
                self.assertTrue(line.endswith(" "))
                bits = np.unpackbits(file["controller"][number % 201, number // 201], bitorder="little")
                allowed = bits[:1681].reshape(41, 41)
                self.assertEqual(inputs, list(np.flatnonzero(allowed.T)))

    def test_scs_without_a_stored_controller_is_the_same(self):
        text = []
        for controller in (True, False):
            self.analyzed(spec_with(output={"controller": controller}))
            text.append(self.export("scs"))
        self.assertEqual(text[0], text[1])

    def test_scs_of_the_progress_controller(self):
        texts = []
        for controller in (True, False):
            self.analyzed(spec_with(goal="x + y <= 2", output={"controller": controller}))
            texts.append(self.export("scs", "--controller", "progress"))
            if not controller:
                continue
            with h5py.File(self.folder / "out.h5") as file:
                arrival, bits = file["arrival"][...], file["controller:goal"][...]
                inputs = self.export("scs").split("#MATRIX:DATA\n#BEGIN:")[1].split()[1]
        self.assertEqual(texts[0], texts[1])
        self.assertNotEqual(texts[0], self.export("scs"))
        self.assertEqual(texts[0].split("#MATRIX")[0], self.export("scs").split("#MATRIX")[0])
        lines = texts[0].split(f" {inputs}\n")[1].splitlines()[:-1]
        winning = (arrival >= 0) & (arrival < np.iinfo(arrival.dtype).max)
        self.assertEqual([int(line.split()[0]) for line in lines], list(np.flatnonzero(winning.T)))
        shape = [len(one["values"]) for one in SPEC["inputs"]]
        for line in lines:
            number, *found = map(int, line.split())
            cell = bits[number % arrival.shape[0], number // arrival.shape[0]]
            allowed = np.unpackbits(cell, bitorder="little")[: int(inputs)].reshape(shape)
            self.assertEqual(found, list(np.flatnonzero(allowed.T)))
        self.assertEqual(self.export("scs", "--controller", "safety"), self.export("scs"))

    def test_grids_that_scots_does_not_know(self):
        self.analyzed(spec_with(states=[dict(SPEC["states"][0], origin=0.5), SPEC["states"][1]]))
        self.assert_fails(
            3,
            "SCOTS knows no such grid as that of 'x': expected multiples of the step 1, found 0.5 (out.h5)",
            "export", "out.h5", "--format", "scs",
        )  # fmt: skip
        self.analyzed(spec_with(inputs=[{"name": "u", "values": [-1, 0, 2]}, SPEC["inputs"][1]]))
        self.assert_fails(
            3,
            "SCOTS knows no such list of values as that of 'u': expected evenly spaced and ascending ones (out.h5)",
            "export", "out.h5", "--format", "scs",
        )  # fmt: skip

    # c-header

    def compile(self, prefix, *arguments):
        self.run_quietly("export", "out.h5", "--format", "c-header", "-o", "exported.h", *arguments)
        program = C_PROGRAM.replace("$", prefix + "_").replace("@", prefix.upper() + "_")
        self.write("main.c", program)
        self.build_c()

    def build_c(self):
        flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-fsanitize=undefined,address"]
        flags += ["-fno-sanitize-recover=all"]
        subprocess.run(["gcc", *flags, "main.c", "-o", "main"], cwd=self.folder, check=True)

    def ask_c(self, states):
        text = "".join(" ".join(float(x).hex() for x in state) + "\n" for state in states)
        result = subprocess.run(
            [self.folder / "main"], input=text, capture_output=True, text=True, check=True
        )
        return result.stdout.splitlines()

    def ask_query(self, names, states):
        """The same answers from `query`, which is told the doubles exactly."""
        lines = "".join(
            json.dumps({name: str(Decimal(float(x))) for name, x in zip(names, state)}) + "\n" for state in states
        )
        answers = []
        for line in self.run_quietly("query", "out.h5", stdin=lines.encode()).splitlines():
            answer = json.loads(line)
            if not answer["inside"]:
                answers.append(C_LEFT_SAFELY if answer["safe"] else C_OUTSIDE)
                continue
            (partition,) = answer["partitions"]
            codes = {"not_safe": -2, "not_invariant": -1, "connection_must_stand_already": -3, "never": 2**31 - 1}
            countdown = codes.get(partition["countdown_status"], partition["countdown"])
            classes = [
                "".join(f"{a}:{values[0]:g} " for a, values in zip(one["actions"], one["values"]))
                for one in partition["classes"]
            ]
            answers.append(",".join([str(answer["cell"]["number"]), str(countdown), *classes]))
        return answers

    def axes(self):
        with h5py.File(self.folder / "out.h5") as file:
            names = [scales[0].name[1:] for scales in file["safe"].dims]
            return {name: (file[name][...], file[name].attrs["step"]) for name in names}

    def compare(self, *arguments, prefix):
        axes = self.axes()
        self.compile(prefix, *arguments)
        centres = list(itertools.product(*(points for points, _ in axes.values())))
        # Faces and the doubles next to them, and beyond the domain, in one dimension at a time.
        middle = [points[len(points) // 2] for points, _ in axes.values()]
        edges = []
        for i, (points, step) in enumerate(axes.values()):
            for face in [*(points - step / 2), points[-1] + step / 2, points[0] - 0.2, points[-1] + 0.2, -50.0, 50.0]:
                for value in (math.nextafter(face, -math.inf), face, math.nextafter(face, math.inf)):
                    if list(axes)[i] == "h" and not -math.pi <= value < math.pi:
                        continue
                    edges.append([value if i == j else x for j, x in enumerate(middle)])
        states = centres + edges
        found = self.ask_c(states)
        self.assertEqual(len(found), len(states))
        for state, one, other in zip(states, found, self.ask_query(list(axes), states)):
            self.assertEqual(one, other, state)
        return found

    def test_c_header_agrees_with_query_on_every_cell_of_a_mixed_system(self):
        self.analyzed(MIXED)
        found = self.compare(prefix="coordreq_mixed_1_0")
        self.assertIn(C_OUTSIDE, found)
        self.assertIn(C_LEFT_SAFELY, found)
        countdowns = {line.split(",")[1] for line in found if "," in line}
        self.assertGreaterEqual(len(countdowns), 3)

    def test_c_header_agrees_with_query_on_every_cell_of_the_lane_change(self):
        self.example("lane_change.json")
        self.compare(prefix="coordreq_lane_change")

    def test_c_header_agrees_with_query_on_every_cell_of_a_coarse_circle(self):
        spec = json.loads(without_comments((CONFIGS / "circle.json").read_text()))
        states = [dict(state, step=0.05) for state in spec["states"]]
        dynamics = dict(spec["dynamics"], period=0.05)
        self.analyzed(dict(spec, states=states, dynamics=dynamics))
        self.compare(prefix="coordreq_circle")

    def test_c_header_agrees_with_query_where_cells_were_divided(self):
        states = [
            {"name": "x", "lower": -1, "upper": 1, "step": 0.5, "outside": "saturate"},
            {"name": "y", "lower": -2, "upper": 2, "step": 0.5, "outside": "saturate"},
        ]
        inputs = [{"name": "u", "values": [-1, 1]}, {"name": "v", "values": [0, 1]}]
        agents = [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}]
        equations = {"x": "y", "y": "2*(1 - x^2)*y - x + u - v"}
        spec = {"coordreq": 1, "name": "bending", "states": states, "inputs": inputs, "agents": agents}
        spec["dynamics"] = {"time": "continuous", "period": 0.8, "equations": equations}
        spec.update(safe="abs(x) < 1 or abs(y) < 2", output={"abstraction": True})
        widths = []
        for effort in (0, 40):
            self.analyzed(dict(spec, abstraction={"effort": effort}))
            with h5py.File(self.folder / "out.h5") as file:
                widths.append(int((file["abstraction/y/last"][...] - file["abstraction/y/first"][...]).sum()))
        self.assertLess(widths[1], widths[0])
        self.compare(prefix="coordreq_bending")

    def test_c_header_of_one_of_several_partitions(self):
        partitions = [{"classes": []}, {"name": "both", "classes": [["a", "b"]]}]
        self.analyzed(spec_with(coordination={"partitions": partitions}))
        self.assert_fails(
            2,
            "which partition? expected --partition 'a|b' or 'both'",
            "export", "out.h5", "--format", "c-header",
        )  # fmt: skip
        self.compile("coordreq_small", "--partition", "both")
        (line,) = self.ask_c([(3.0, 3.0)])
        self.assertEqual(line.split(",")[:2], ["18", str(2**31 - 1)])

    def test_nothing_is_known_of_what_is_no_number(self):
        self.analyzed()
        self.compile("coordreq_small")
        self.assertEqual(self.ask_c([(math.nan, 1.0), (1.0, math.inf), (1.0, -math.inf)]), [C_OUTSIDE] * 3)

    def test_the_double_nearest_to_the_seam_is_in_its_cell(self):
        # -0.2 and 0.7 as doubles lie below -1/5 and 7/10, 0.1 above 1/10.
        for lower, upper in ((-0.2, 0.7), (0.1, 1.0), (0.7, 1.6)):
            state = {"name": "h", "lower": lower, "upper": upper, "count": 9, "outside": "periodic"}
            dynamics = dict(SPEC["dynamics"], equations={"h": "h + 0.1*u", "y": "y + v"})
            self.analyzed(spec_with(states=[state, SPEC["states"][1]], dynamics=dynamics, safe="y <= 2"))
            self.compile("coordreq_small")
            states = [(lower, 1.0), (math.nextafter(upper, 0), 1.0), (math.nextafter(lower, -1), 1.0)]
            found = self.ask_c(states)
            self.assertEqual(found[:2], self.ask_query(["h", "y"], states[:2]))
            self.assertNotIn(C_OUTSIDE, found[:2])
            self.assertEqual(found[2], C_OUTSIDE)

    def test_numbers_that_are_no_cell_can_be_asked_for(self):
        self.analyzed()
        self.compile("coordreq_small")
        checks = """
#include "exported.h"
int main(void) {
  const int32_t none[] = {$OUTSIDE, -3, INT32_MIN, $CELLS, INT32_MAX};
  uint32_t i;
  for (i = 0; i < 5; ++i) {
    if (@countdown(none[i]) != 0 || @allowed(none[i], 0, 0)) return 1;
  }
  if (@countdown($LEFT_SAFELY) != $NEVER || !@allowed($LEFT_SAFELY, 0, 0)) return 2;
  return @action_count($CLASSES) != 0 || @allowed(0, $CLASSES, 0) || @allowed(0, 0, UINT32_MAX);
}
"""
        self.write("main.c", checks.replace("@", "coordreq_small_").replace("$", "COORDREQ_SMALL_"))
        self.build_c()
        self.assertEqual(subprocess.run([self.folder / "main"], check=False).returncode, 0)

    # all formats

    def test_a_file_or_standard_output(self):
        self.analyzed()
        for name in ("csv", "scs", "c-header"):
            self.assertEqual(self.export(name, "-o", "exported"), "")
            self.assertEqual((self.folder / "exported").read_text(), self.export(name))
        self.assertEqual(self.files(), ["exported", "out.h5", "spec.json"])

    def test_a_failed_export_leaves_what_was_there(self):
        self.analyzed(spec_with(inputs=[{"name": "u", "values": [-1, 0, 2]}, SPEC["inputs"][1]]))
        self.write("exported", "old")
        result = self.run_program("export", "out.h5", "--format", "scs", "-o", "exported")
        self.assertEqual(result.returncode, 3)
        self.assertEqual((self.folder / "exported").read_text(), "old")
        self.assertEqual(self.files(), ["exported", "out.h5", "spec.json"])
        self.assert_fails(
            5,
            "the folder does not exist (none)",
            "export", "out.h5", "--format", "csv", "-o", "none/exported",
        )  # fmt: skip

    def test_wrong_usage(self):
        self.analyzed()
        for arguments, message in (
            ((), "no --format, expected csv, scs, c-header or vtk"),
            (("--format", "xml"), "expected csv, scs, c-header or vtk, found 'xml' (--format)"),
            (("--format", "scs", "--slice", "x=1"), "only csv and vtk can be cut, found it with scs (--slice)"),
            (("--format", "c-header", "--project", "x:min"), "only csv and vtk can be cut, found it with c-header (--project)"),
            (
                ("--format", "scs", "--partition", "a|b"),
                "scs holds the controller, which no partition changes (--partition)",
            ),
            (("--format", "csv", "--controller", "safety"), "only scs is of one controller (--controller)"),
            (
                ("--format", "scs", "--controller", "progress"),
                "the spec has no goal, expected safety, found progress (--controller)",
            ),
        ):
            self.assert_fails(2, message, "export", "out.h5", *arguments)


if __name__ == "__main__":
    unittest.main()
