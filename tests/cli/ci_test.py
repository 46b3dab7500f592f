"""The example of a CI job: a change to a spec that costs something fails, others pass. Its commands are run."""

import json
import os
import pathlib
import shutil
import subprocess
import unittest
import xml.etree.ElementTree

import yaml
from program import CONFIGS, PROGRAM, Case, spec_with

REGION = "x >= -0.1 and x <= 0.1 and y >= -0.1 and y <= 0.1"
MODEL = spec_with(requirements=[{"name": "near the corner", "where": REGION, "min_delay": 2}])
JOB = yaml.safe_load((CONFIGS / "ci/requirements.yml").read_text())["jobs"]["requirements"]


class Cases(Case):
    def setUp(self):
        super().setUp()
        self.git("init", "--quiet", "--initial-branch", "main")
        (self.folder / "specs").mkdir()
        (self.folder / "scripts").mkdir()
        shutil.copy(CONFIGS / "ci/check_specs", self.folder / "scripts")
        self.write("specs/one.json", MODEL)
        self.write("specs/two.json", spec_with(name="two"))
        self.commit()
        self.git("remote", "add", "origin", ".")
        self.git("fetch", "--quiet", "origin")
        self.git("checkout", "--quiet", "-b", "change")

    def environment(self, **more):
        path = f"{pathlib.Path(PROGRAM).parent}:{os.environ['PATH']}"
        identity = {
            f"GIT_{who}_{what}": f"somebody@{what}" for who in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")
        }
        return dict(os.environ, PATH=path, HOME=str(self.folder), **identity, **more)

    def git(self, *arguments):
        subprocess.run(["git", *arguments], cwd=self.folder, env=self.environment(), check=True)

    def commit(self):
        self.git("add", "specs", "scripts")
        self.git("commit", "--quiet", "--message", "A change")

    def job(self, code, **more):
        """Runs the step of the workflow that checks, as the runner does; its output."""
        (step,) = [step["run"] for step in JOB["steps"] if "check_specs" in step.get("run", "")]
        result = subprocess.run(
            ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", step],
            cwd=self.folder,
            env=self.environment(GITHUB_BASE_REF="main", GITHUB_WORKSPACE=str(self.folder), **more),
            capture_output=True,
            text=True,
            timeout=280,
        )
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        worktrees = subprocess.run(["git", "worktree", "list"], cwd=self.folder, capture_output=True, check=True)
        self.assertEqual(len(worktrees.stdout.splitlines()), 1)
        return result

    def test_nothing_changed(self):
        result = self.job(0)
        self.assertEqual(result.stdout.count("Not worse: no cell has lost delay."), 2)
        self.assertEqual(result.stderr, "")
        names = sorted(os.listdir(self.folder / "coordreq-results"))
        kinds = (".before.h5", ".h5", ".json", ".xml")
        self.assertEqual(names, [f"specs_{name}{kind}" for name in ("one", "two") for kind in kinds])

    def test_change_that_gains(self):
        self.write("specs/one.json", dict(MODEL, safe="x + y <= 7"))
        self.commit()
        self.assertIn("requirement near the corner: delay of a|b at least 2 steps (1 s)\n  holds", self.job(0).stdout)

    def test_change_that_breaks_a_requirement(self):
        self.write("specs/one.json", dict(MODEL, safe="x + y <= 2"))
        self.commit()
        self.assertIn("requirement near the corner: held, now FAILS\n", self.job(1).stdout)
        report = xml.etree.ElementTree.parse(self.folder / "coordreq-results/specs_one.xml").getroot()
        self.assertEqual(report.get("failures"), "1")

    def test_change_that_costs_delay(self):
        """Also where no requirement says anything."""
        self.write("specs/two.json", spec_with(name="two", safe="x + y <= 6 and 2*x + 2*y + 0.1*x < 12.2"))
        self.commit()
        self.assertIn("Worse: cells have lost delay.", self.job(1).stdout)
        document = json.loads((self.folder / "coordreq-results/specs_two.json").read_text())
        self.assertGreater(document["partitions"][0]["lost"], 0)

    def test_tolerance(self):
        equations = {"x": "x + u", "y": "y + v + if(y == 0 and v > 0, 1, 0)"}
        self.write("specs/two.json", spec_with(name="two", dynamics=dict(MODEL["dynamics"], equations=equations)))
        self.commit()
        self.job(1)
        self.job(0, TOLERANCE="3")

    def test_new_spec(self):
        self.write("specs/three.json", spec_with(name="three"))
        self.commit()
        self.assertIn("== specs/three.json\n", self.job(0).stdout)
        self.assertIn("new: nothing to compare it with\n", self.job(0).stdout)

    def test_broken_spec(self):
        self.write("specs/one.json", dict(MODEL, safe="x +"))
        self.commit()
        result = self.job(3)
        self.assertIn("coordreq: error: ", result.stderr)
        self.assertIn("== specs/two.json\n", result.stdout)

    def test_another_grid(self):
        x, y = MODEL["states"]
        self.write("specs/two.json", spec_with(name="two", states=[x, dict(y, upper=5)]))
        self.commit()
        self.assertIn("expected the grid of y as in ", self.job(3).stderr)

    def test_wrong_usage(self):
        def check(*arguments):
            command = ["sh", "scripts/check_specs", *arguments]
            return subprocess.run(command, cwd=self.folder, env=self.environment(), capture_output=True, text=True)

        result = check("main")
        self.assertEqual((result.returncode, result.stderr), (2, "check_specs: expected COMMIT SPEC...\n"))
        self.assertEqual(check("none", "specs/one.json").returncode, 2)


if __name__ == "__main__":
    unittest.main()
