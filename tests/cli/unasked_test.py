"""Nothing is overwritten unasked: files under names that nobody has typed."""

import json
import os
import pathlib
import unittest

from program import SPEC, Case, spec_with

OTHER = "the file holds the results of another spec, expected --force to replace it, or another name by --output"
NO_RESULTS = "the file is there already and no results file, expected --force to replace it, or another name by --output"
NO_REPORT = "the file is there already and no report on these results, expected --force to replace it, or another name by --output"
CHANGED = {"safe": "x + y <= 5"}


class Cases(Case):
    replaces_unasked = False

    def setUp(self):
        super().setUp()
        self.write("spec.json", SPEC)
        self.write("copy.json", spec_with(**CHANGED))

    def succeed(self, *arguments):
        result = self.run_program(*arguments)
        self.assertEqual((result.returncode, result.stderr), (0, b""))

    def assert_refused(self, message, name, *arguments):
        before = (self.folder / name).read_bytes()
        self.assert_fails(2, f"{message} ({name})", *arguments)
        self.assertEqual((self.folder / name).read_bytes(), before)

    def test_results_of_another_spec_stay(self):
        self.succeed("analyze", "spec.json")
        self.assert_refused(OTHER, "small.h5", "analyze", "copy.json")
        self.assert_refused(OTHER, "small.h5", "analyze", "spec.json", "--set", "safe=x <= 3")
        self.assert_refused(OTHER, "small.h5", "analyze", "copy.json", "--json")

    def test_it_is_refused_before_any_work(self):
        self.succeed("analyze", "spec.json")
        result = self.run_program("analyze", "copy.json", "--progress", "log")
        self.assertEqual((result.returncode, result.stderr.decode()), (2, f"coordreq: error: {OTHER} (small.h5)\n"))

    def test_results_of_the_same_spec_are_replaced(self):
        self.succeed("analyze", "spec.json")
        before = os.stat(self.folder / "small.h5").st_ino
        self.succeed("analyze", "spec.json")
        self.assertNotEqual(os.stat(self.folder / "small.h5").st_ino, before)

    def test_force_replaces(self):
        self.succeed("analyze", "spec.json")
        self.succeed("analyze", "copy.json", "--force")
        info = json.loads(self.run_program("info", "small.h5", "--json").stdout)
        self.assertEqual(info["safe"], sum(x + y <= 5 for x in range(5) for y in range(5)))

    def test_a_name_that_was_typed_is_replaced(self):
        self.succeed("analyze", "spec.json", "-o", "out.h5")
        self.succeed("analyze", "copy.json", "-o", "out.h5")
        self.write("out.h5", "mine")
        self.succeed("analyze", "copy.json", "-o", "out.h5")
        self.succeed("info", "out.h5")

    def test_other_files_stay(self):
        for content in (b"", b"mine", b"\x89HDF\r\n\x1a\nmine"):
            with self.subTest(content=content):
                self.write("small.h5", content)
                self.assert_refused(NO_RESULTS, "small.h5", "analyze", "spec.json")
        self.succeed("analyze", "spec.json", "--force")

    def test_runs_are_not_results(self):
        self.succeed("analyze", "spec.json", "-o", "out.h5")
        self.succeed("simulate", "out.h5", "--from", "x=1,y=1", "--steps", "3", "-o", "small.h5")
        self.assert_refused(NO_RESULTS, "small.h5", "analyze", "spec.json")

    def test_a_link_is_what_it_leads_to(self):
        self.succeed("analyze", "copy.json", "-o", "kept.h5")
        os.symlink("kept.h5", self.folder / "small.h5")
        self.assert_refused(OTHER, "small.h5", "analyze", "spec.json")

    def test_several_specs(self):
        self.write("second.json", spec_with(name="second"))
        self.succeed("analyze", "spec.json")
        self.assert_refused(OTHER, "small.h5", "analyze", "second.json", "copy.json")
        self.assertNotIn("second.h5", self.files())
        self.succeed("analyze", "second.json", "spec.json")
        self.succeed("analyze", "second.json", "copy.json", "--force")

    def test_sweeps_in_a_folder(self):
        pathlib.Path(self.folder, "all").mkdir()
        sweep = ("--sweep", "states.x.upper=4,3", "-o", "all")
        self.succeed("analyze", "spec.json", *sweep)
        self.succeed("analyze", "spec.json", *sweep)
        name = "all/small_states.x.upper=4.h5"
        self.assert_refused(OTHER, name, "analyze", "copy.json", *sweep)
        self.succeed("analyze", "copy.json", *sweep, "--force")

    def test_reports(self):
        self.succeed("analyze", "spec.json", "-o", "a.h5")
        self.succeed("analyze", "copy.json", "-o", "b.h5")
        self.succeed("report", "a.h5")
        self.succeed("report", "a.h5")
        self.assert_refused(NO_REPORT, "small.html", "report", "b.h5")
        self.succeed("report", "b.h5", "--force")
        self.assert_refused(NO_REPORT, "small.html", "report", "a.h5")
        self.succeed("report", "a.h5", "-o", "small.html")
        self.write("small.html", "<p>mine</p>")
        self.assert_refused(NO_REPORT, "small.html", "report", "a.h5")


if __name__ == "__main__":
    unittest.main()
