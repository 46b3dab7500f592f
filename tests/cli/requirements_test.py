"""Requirements from outside: verdicts and their stories, exit codes, the JUnit report, the results file."""

import json
import unittest
import xml.etree.ElementTree as ElementTree

import h5py
import xarray
from program import CONFIGS, Case, spec_with, without_warnings

EXAMPLE = str(CONFIGS / "intersection_requirements.json")
RESULTS = "intersection_requirements.h5"
ALL = "0 <= x <= 4 and 0 <= y <= 4"
# SPEC is x + y <= 6 on a grid of 5 by 5 points; leaving the domain is not safe.
HOLDS = {"name": "corner", "where": "-0.4 < x < 0.4 and -0.4 < y < 0.4", "min_delay": 1}
STORY = """requirement 1.5 s of silence, fast: delay of first|second at least 3 steps (1.5 s)
  FAILS: 1 of 81 cells fails, the worst at p1 = -9, v1 = 2, v2 = 2, p2 = -9: it has a delay of 2 steps (1 s).
  With p1 up to -9.25 m and the other states unchanged, the delay is long enough.

  step  p1 [m]  v1 [m/s]  v2 [m/s]  p2 [m]  delay  collision time  action       first     second
     0      -9         2         2      -9      2           never  independent  u1 = 0.5  u2 = 0.5
     1    -7.5         2         2    -7.5      1           never  independent  u1 = 0.5  u2 = 0.5
     2      -6         2         2      -6      0           never  independent  u1 = 0.5  u2 = 0.5
     3    -4.5      1.75      1.75    -4.5      -               4  evasive      u1 = -1   u2 = -1
     4    -3.5      1.25      1.25    -3.5      -               3  evasive      u1 = -1   u2 = -1
     5    -2.5      0.75      0.75    -2.5      -               2  evasive      u1 = -1   u2 = -1
     6      -2      0.25      0.25      -2      -               1  evasive      u1 = -1   u2 = -1
     7    -1.5         0         0    -1.5      -               0

  Each agent independently takes permitted actions, and after 3 steps (1.5 s) it is too late.
  Even if all agents then coordinate, after 4 steps (2 s) the state is no longer safe.
  Proven: 2 steps (1 s). A nominal simulation from the first state left the invariance set after 5 steps (2.5 s).
"""


def asking(*requirements, **changes):
    return spec_with(requirements=list(requirements), **changes)


class Cases(Case):
    def run_spec(self, spec, *arguments):
        self.write("spec.json", spec)
        return self.run_program("analyze", "spec.json", *arguments)

    def requirements(self, spec, code):
        """The requirements of the JSON summary; they decide about the exit code."""
        result = self.run_spec(spec, "--json")
        self.assertEqual((result.returncode, without_warnings(result.stderr)), (code, b""))
        return json.loads(result.stdout)["requirements"]

    def test_story_of_the_two_vehicles(self):
        result = self.run_program("analyze", EXAMPLE)
        self.assertEqual((result.returncode, without_warnings(result.stderr)), (1, b""))
        text = result.stdout.decode()
        self.assertIn(
            "requirement coordination keeps them apart: in the invariance set\n"
            "  holds: for all 81 cells that may meet the region\n",
            text,
        )
        self.assertIn("\n" + STORY + "\nresults in ", text)
        self.assertEqual(self.files(), [RESULTS])

    def test_json(self):
        result = self.run_program("analyze", EXAMPLE, "--json", "--quiet")
        self.assertEqual((result.returncode, result.stderr), (1, b""))
        first, second, third = json.loads(result.stdout)["requirements"]
        self.assertEqual(
            first,
            {
                "name": "coordination keeps them apart",
                "holds": True,
                "kind": "invariant",
                "partition": None,
                "min_delay": None,
                "cells": 81,
                "failing": 0,
                "least_delay": None,
                "least_delay_status": "unbounded",
                "reaches_outside": None,
                "counterexample": None,
            },
        )
        self.assertEqual((second["holds"], second["least_delay"], second["min_delay"]), (True, 3, 3))
        self.assertEqual((third["holds"], third["least_delay"], third["partition"]), (False, 2, "first|second"))
        path = third["counterexample"]
        self.assertEqual(path["state"], {"p1": -9, "v1": 2, "v2": 2, "p2": -9})
        self.assertEqual([s["action"] for s in path["steps"]], ["independent"] * 3 + ["evasive"] * 4)
        self.assertEqual([s["delay"] for s in path["steps"]], [2, 1, 0] + [None] * 4)
        self.assertEqual([s["collision_time"] for s in path["steps"]], [None] * 3 + [4, 3, 2, 1])
        self.assertEqual(path["steps"][3]["delay_status"], "not_invariant")
        self.assertEqual(path["steps"][0]["inputs"], {"first": {"u1": 0.5}, "second": {"u2": 0.5}})
        self.assertEqual(path["end"], "outside_safe_set")
        self.assertEqual(path["end_sample"]["state"], {"p1": -1.5, "v1": 0, "v2": 0, "p2": -1.5})
        self.assertEqual((path["end_sample"]["delay_status"], path["left_side"]), ("not_safe", None))

    def test_results_file(self):
        self.run_program("analyze", EXAMPLE, "--quiet")
        group = "counterexample"
        path = str(self.folder / RESULTS)
        verdicts = xarray.open_dataset(path, engine="h5netcdf", group=group)
        self.assertEqual(verdicts.holds.values.tolist(), [1, 1, 0])
        self.assertEqual(verdicts.least_delay.values.tolist(), [2**31 - 1, 3, 2])
        self.assertEqual(verdicts.requirement.values[2], "1.5 s of silence, fast")
        self.assertEqual(verdicts.end.attrs["flag_meanings"].split()[verdicts.end.values[2]], "outside_safe_set")
        story = xarray.open_dataset(path, engine="h5netcdf", group=group + "/2")
        self.assertEqual(story.state.dims, ("sample", "state_name"))
        self.assertEqual(story.state.values[0].tolist(), [-9, 2, 2, -9])
        self.assertEqual(story.input.values.tolist(), [[0.5, 0.5]] * 3 + [[-1, -1]] * 4)
        self.assertEqual(story.phase.values.tolist(), [0, 0, 0, 1, 1, 1, 1])
        self.assertEqual(story.delay.values.tolist(), [2, 1, 0, -1, -1, -1, -1, -2])
        with h5py.File(path) as file:
            shape = file["safe"].shape
            collision_time = file["collision_time"][...].reshape(-1)
            cells = file[group + "/2/cell"][...]
            self.assertEqual(collision_time[cells].tolist()[3:], [4, 3, 2, 1, 0])
            self.assertEqual(shape, (41, 13, 13, 41))
            self.assertNotIn("0", file[group])

    def test_info(self):
        self.run_program("analyze", EXAMPLE, "--quiet")
        text = self.run_program("info", RESULTS).stdout.decode()
        self.assertIn(
            """
requirement                    verdict  cells  failing  least delay       counterexample
coordination keeps them apart  holds       81        0  unbounded                      -
1.5 s of silence, slowly       holds       25        0  3 steps (1.5 s)                -
1.5 s of silence, fast         FAILS       81        1  2 steps (1 s)    7 steps (3.5 s)

datasets
""",
            text,
        )
        third = json.loads(self.run_program("info", RESULTS, "--json").stdout)["requirements"][2]
        self.assertEqual(
            third,
            {
                "name": "1.5 s of silence, fast",
                "holds": False,
                "cells": 81,
                "failing": 1,
                "least_delay": 2,
                "least_delay_status": "steps",
                "counterexample_steps": 7,
            },
        )

    def test_verify(self):
        spec = asking(HOLDS, {"name": "edge", "where": ALL, "min_delay": 1})
        self.assertEqual(self.run_spec(spec, "--quiet").returncode, 1)
        result = self.run_program("verify", "small.h5")
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        self.assertIn("\nrequirement corner        1  holds\n", result.stdout.decode())
        for path, place, value in (
            ("holds", 1, 1),
            ("cells", 1, 24),
            ("failing", 0, 1),
            ("least_delay", 0, 0),
            ("reached_side", 1, 1),
            ("end", 1, 2),
            ("1/cell", 0, 3),
            ("1/delay", 0, 0),
            ("1/collision_time", 0, 1),
        ):
            with self.subTest(path=path):
                self.run_spec(spec, "--quiet")
                with h5py.File(self.folder / "small.h5", "r+") as file:
                    file["counterexample/" + path][place] = value
                result = self.run_program("verify", "small.h5", "--quiet")
                self.assertEqual((result.returncode, result.stderr), (1, b""))

    def test_a_failing_requirement_without_text(self):
        result = self.run_spec(asking({"name": "edge", "where": ALL, "invariant": True}), "--quiet")
        self.assertEqual((result.returncode, result.stdout, result.stderr), (1, b"", b""))
        self.assertEqual(self.files(), ["small.h5", "spec.json"])

    def test_where_it_is_not_safe_to_begin_with(self):
        (edge,) = self.requirements(asking({"name": "edge", "where": ALL, "invariant": True}), 1)
        self.assertEqual((edge["cells"], edge["failing"]), (25, 3))
        self.assertEqual((edge["least_delay"], edge["least_delay_status"]), (None, "not_safe"))
        path = edge["counterexample"]
        self.assertEqual((path["state"], path["steps"]), ({"x": 3, "y": 4}, []))
        self.assertEqual(path["end"], "outside_safe_set")
        text = self.run_spec(asking({"name": "edge", "where": ALL, "invariant": True})).stdout.decode()
        self.assertIn("the worst at x = 3, y = 4: it is not safe.\n", text)
        self.assertIn("  The first state is not safe.\n", text)

    def test_leaving_the_domain(self):
        # A rule that lets the first one only move up: at the upper end that leads out of the domain.
        spec = asking(
            {"name": "top", "where": "3.6 < x < 4.4 and -0.4 < y < 0.4", "invariant": True},
            controller={"allow": "u == 1"},
        )
        (top,) = self.requirements(spec, 1)
        path = top["counterexample"]
        self.assertEqual([step["action"] for step in path["steps"]], ["evasive"])
        self.assertEqual((path["end"], path["end_sample"]), ("left_domain", None))
        self.assertEqual(path["left_side"], {"state": "x", "side": "above"})
        self.assertIn(
            "  Even if all agents then coordinate, after 1 step (0.5 s) the state leaves the domain, x above "
            "its grid.\n",
            self.run_spec(spec).stdout.decode(),
        )
        self.assertEqual(self.run_program("verify", "small.h5", "--quiet").returncode, 0)

    def test_regions_end_exactly_at_faces(self):
        """y in three points from -1.7 to 0.3: cells end at -2.2, -1.2, -0.2 and 0.8, of which none is a double."""
        regions = {
            "-2.2 < y < 0.8": (15, None),
            "-1.2 < y < 0.8": (10, None),
            "-1.2 <= y < -0.2": (10, None),
            "-1.2 < y and not y >= -0.2": (5, None),
            "-1.2 < y <= 0.8": (10, {"state": "y", "side": "above"}),
        }
        spec = asking(
            *({"name": where, "where": f"x < 9 and {where}", "invariant": True} for where in regions),
            states=[
                {"name": "x", "lower": 0, "upper": 4, "step": 1, "outside": "saturate"},
                {"name": "y", "lower": -1.7, "upper": 0.3, "count": 3, "outside": "unsafe"},
            ],
            dynamics={"time": "discrete", "period": 0.5, "unit": "s", "equations": {"x": "x + u", "y": "y"}},
            safe="true",
        )
        for own in self.requirements(spec, 1):
            cells, outside = regions[own["name"]]
            self.assertEqual((own["cells"], own["reaches_outside"], own["holds"]), (cells, outside, outside is None))
        self.assertEqual(self.run_program("verify", "small.h5", "--strict", "--quiet").returncode, 0)

    def test_nothing_is_allowed(self):
        spec = asking(
            {"name": "top", "where": "3.6 < x < 4.4 and -0.4 < y < 0.4", "invariant": True},
            controller={"allow": "x != 4"},
        )
        (top,) = self.requirements(spec, 1)
        path = top["counterexample"]
        self.assertEqual((path["steps"], path["end"]), ([], "no_allowed_action"))
        self.assertEqual(path["end_sample"]["collision_time"], 1)
        self.assertIn("  Then no joint input is allowed.\n", self.run_spec(spec).stdout.decode())
        self.assertEqual(self.run_program("verify", "small.h5", "--quiet").returncode, 0)

    def test_a_way_that_is_not_safe(self):
        spec = asking(
            {"name": "left", "where": "-0.4 < x < 0.4", "invariant": True},
            states=[{"name": "x", "lower": 0, "upper": 6, "step": 1, "outside": "saturate"}],
            inputs=[{"name": "u", "values": [2]}],
            agents=[{"name": "a", "inputs": ["u"]}],
            dynamics={"time": "continuous", "period": 1, "equations": {"x": "u"}},
            safe="x <= 0.6 or x >= 1.4",
            abstraction={"cells": "half_open", "between_samples": True},
        )
        (left,) = self.requirements(spec, 1)
        path = left["counterexample"]
        self.assertEqual([step["state"] for step in path["steps"]], [{"x": 0}])
        self.assertEqual((path["end"], path["end_sample"]), ("unsafe_between_samples", None))
        self.assertIn("after 1 step the motion to the next sample is not safe.\n", self.run_spec(spec).stdout.decode())
        self.assertEqual(self.run_program("verify", "small.h5", "--quiet").returncode, 0)

    def test_what_a_given_controller_may_choose(self):
        spec = asking(
            {"name": "middle", "where": "1.6 < x < 2.4 and 1.6 < y < 2.4", "invariant": True},
            controller={"synthesis": "given"},
        )
        (middle,) = self.requirements(spec, 1)
        path = middle["counterexample"]
        self.assertEqual([step["collision_time"] for step in path["steps"]], [2, 1])
        self.assertEqual(path["end_sample"]["delay_status"], "not_safe")
        self.assertIn(
            "  With inputs that the controller may then choose, after 2 steps (1 s) the state is no longer safe.\n",
            self.run_spec(spec).stdout.decode(),
        )
        self.assertEqual(self.run_program("verify", "small.h5", "--quiet").returncode, 0)

    def test_the_nearest_values_of_a_state_with_which_it_would_hold(self):
        x = {"name": "x", "lower": 0, "upper": 9, "step": 1, "unit": "m", "outside": "saturate"}
        dynamics = {"time": "discrete", "period": 0.5, "unit": "s", "equations": {"x": "x + u + v", "y": "y"}}
        asked = {"name": "near", "where": "x == 2 and y == 1", "min_delay": 3}
        y = dict(x, name="y", upper=4)
        spec = asking(asked, states=[x, y], dynamics=dynamics, safe="x >= 1")
        result = self.run_spec(spec, "--json")
        (own,) = json.loads(result.stdout)["requirements"]
        self.assertEqual(own["nearest"], {"state": "x", "best": "large", "value": 6.5})
        text = self.run_spec(spec).stdout.decode()
        self.assertIn("\n  With x from 6.5 m on and the other states unchanged, the delay is long enough.\n", text)
        asked["min_delay"] = 100
        (own,) = json.loads(self.run_spec(spec, "--json").stdout)["requirements"]
        self.assertIsNone(own["nearest"])

    def test_region_that_reaches_outside(self):
        asked = {"name": "wide", "where": "x <= 1 and -0.4 < y < 0.4", "invariant": True}
        (wide,) = self.requirements(asking(asked), 1)
        self.assertEqual(wide["reaches_outside"], {"state": "x", "side": "below"})
        self.assertEqual((wide["failing"], wide["holds"]), (0, False))
        self.assertEqual(
            wide["counterexample"],
            {
                "state": None,
                "steps": [],
                "end": "outside_domain",
                "end_sample": None,
                "left_side": {"state": "x", "side": "below"},
                "proven": None,
                "seen": None,
            },
        )
        text = self.run_spec(asking(asked)).stdout.decode()
        self.assertIn("  FAILS: the region may reach outside the domain, x below its grid; add \"and x >= 0\" to its \"where\".\n", text)
        self.assertEqual(self.run_program("verify", "small.h5", "--quiet").returncode, 0)
        spec = asking(asked)
        spec["states"][0]["outside"] = {"below": "saturate"}
        self.assertTrue(self.requirements(spec, 0)[0]["holds"])

    def test_region_that_meets_no_cell(self):
        spec = asking(HOLDS, {"name": "gap", "where": "x > 7", "invariant": True})
        for command in ("analyze", "validate"):
            self.assert_fails(
                3,
                "expected a region that meets the grid, found one that meets no cell (/requirements/1/where)",
                command,
                self.write("spec.json", spec),
            )

    def test_delay_that_the_analysis_does_not_reach(self):
        spec = asking(dict(HOLDS, min_delay=3), coordination={"max_delay": 2})
        self.assert_fails(
            3,
            "expected at most 'max_delay', 2 steps, where the analysis stops, found 3 steps "
            "(/requirements/0/min_delay)",
            "analyze",
            self.write("spec.json", spec),
        )
        (kept,) = self.requirements(asking(dict(HOLDS, min_delay=2), coordination={"max_delay": 2}), 0)
        self.assertTrue(kept["holds"])

    def test_layout_and_threads_do_not_matter(self):
        asked = {"name": "edge", "where": "0 <= x <= 4 and 0 <= y <= 3", "min_delay": 4}
        plain = self.requirements(asking(asked), 1)
        self.assertEqual(self.requirements(asking(asked, output={"actions": True}), 1), plain)
        self.run_spec(asking(asked), "--threads", "1", "-o", "one.h5")
        self.run_spec(asking(asked), "--threads", "3", "-o", "three.h5")
        self.assertEqual(*((self.folder / name).read_bytes() for name in ("one.h5", "three.h5")))

    def test_junit(self):
        result = self.run_program("analyze", EXAMPLE, "--junit", "report.xml", "--quiet")
        self.assertEqual((result.returncode, result.stdout, result.stderr), (1, b"", b""))
        root = ElementTree.parse(self.folder / "report.xml").getroot()
        self.assertEqual((root.tag, root.get("tests"), root.get("failures")), ("testsuites", "3", "1"))
        (suite,) = root
        self.assertEqual((suite.get("name"), suite.get("errors")), ("intersection_requirements", "0"))
        self.assertEqual([case.find("failure") is None for case in suite], [True, True, False])
        self.assertEqual(suite[2].get("name"), "1.5 s of silence, fast")
        failure = suite[2].find("failure")
        self.assertEqual(
            failure.get("message"),
            "1 of 81 cells fails, the worst at p1 = -9, v1 = 2, v2 = 2, p2 = -9: it has a delay of 2 steps (1 s)",
        )
        self.assertEqual(failure.text, STORY.split(": ", 1)[1])

    def test_junit_of_names_that_xml_minds(self):
        name = "a < b & \"c\" ]]> 'd' \x01\n\ud83d\ude97 \ufffe"
        spec = asking(dict(HOLDS, name=name), {"name": "<&>", "where": ALL, "invariant": True})
        self.assertEqual(self.run_spec(spec, "--junit", "report.xml", "--quiet").returncode, 1)
        cases = ElementTree.parse(self.folder / "report.xml").getroot()[0]
        self.assertEqual(cases[0].get("name"), "a < b & \"c\" ]]> 'd' \\x01\\n\U0001f697 \ufffd")
        self.assertEqual(cases[1].get("name"), "<&>")
        with h5py.File(self.folder / "small.h5") as file:
            found = file["counterexample/requirement"].asstr()[0]
            self.assertEqual(found, "a < b & \"c\" ]]> 'd' \x01\n\U0001f697 \ufffe")

    def test_junit_of_units_that_xml_minds(self):
        spec = spec_with(requirements=[dict(HOLDS, min_delay=100)])
        spec["dynamics"]["unit"] = "\uffff\ufffe"
        self.assertEqual(self.run_spec(spec, "--junit", "report.xml", "--quiet").returncode, 1)
        (case,) = ElementTree.parse(self.folder / "report.xml").getroot().iter("testcase")
        self.assertIn("\ufffd\ufffd", case[0].text)

    def test_junit_without_requirements(self):
        self.write("spec.json", spec_with())
        self.analyze("spec.json", "--junit", "report.xml")
        root = ElementTree.parse(self.folder / "report.xml").getroot()
        self.assertEqual((root.get("tests"), root.get("failures"), list(root[0])), ("0", "0", []))

    def test_junit_that_cannot_be_written(self):
        path = self.write("spec.json", asking(HOLDS))
        self.assert_fails(
            5,
            "the folder does not exist (missing)",
            "analyze",
            path,
            "--junit",
            "missing/report.xml",
        )
        self.assert_fails(
            2,
            "expected another file than the results, found './small.h5' (--junit)",
            "analyze",
            path,
            "--junit",
            "./small.h5",
        )
        self.assert_fails(2, "expected the name of a file, found '-' (--junit)", "analyze", path, "--junit", "-")


if __name__ == "__main__":
    unittest.main()
