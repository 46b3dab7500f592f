"""No file takes the place of another that the same command reads or writes."""

import json
import os
import subprocess
import unittest

from program import PROGRAM, SPEC, Case, spec_with


class Cases(Case):
    def setUp(self):
        super().setUp()
        self.write("s.json", SPEC)

    def assert_refused(self, what, found, option, *arguments, **options):
        """The message, and every file as it was."""
        before = {name: (self.folder / name).read_bytes() for name in self.files()}
        self.assert_fails(2, f"expected another file than {what}, found '{found}' (--{option})", *arguments, **options)
        self.assertEqual({name: (self.folder / name).read_bytes() for name in self.files()}, before)

    def results(self, **changes):
        self.write("made.json", spec_with(**changes))
        self.analyze("made.json", "-o", "R.h5")
        return "R.h5"

    def test_spec_and_results(self):
        os.symlink("s.json", self.folder / "link.json")
        os.link(self.folder / "s.json", self.folder / "hard.json")
        for output in ("s.json", "./s.json", "link.json", "hard.json", str(self.folder / "s.json")):
            with self.subTest(output=output):
                self.assert_refused("the spec", output, "output", "analyze", "s.json", "-o", output)
        self.assert_refused("the spec", "s.json", "output", "analyze", "link.json", "-o", "s.json")

    def test_default_output(self):
        self.write("small.h5", SPEC)
        self.assert_refused("the spec", "small.h5", "output", "analyze", "small.h5")

    def test_spec_and_junit_report(self):
        self.assert_refused("the spec", "s.json", "junit", "analyze", "s.json", "--junit", "s.json")
        self.assert_refused("the results", "o.h5", "junit", "analyze", "s.json", "-o", "o.h5", "--junit", "o.h5")

    def test_link_to_nothing_yet(self):
        os.symlink("o.h5", self.folder / "link")
        before = {name: os.lstat(self.folder / name) for name in self.files()}
        message = "expected another file than the results, found 'link' (--junit)"
        result = self.run_program("analyze", "s.json", "-o", "o.h5", "--junit", "link")
        self.assertEqual((result.returncode, result.stderr.decode()), (2, f"coordreq: error: {message}\n"))
        self.assertEqual(self.files(), sorted(before))

    def test_standard_input_from_the_file(self):
        with (self.folder / "s.json").open("rb") as spec:
            result = subprocess.run(
                [PROGRAM, "analyze", "-", "-o", "s.json"], stdin=spec, cwd=self.folder, capture_output=True, timeout=60
            )
        self.assertEqual(result.returncode, 2)
        self.assertEqual(
            result.stderr.decode(), "coordreq: error: expected another file than the spec, found 's.json' (--output)\n"
        )
        self.assertEqual(json.loads((self.folder / "s.json").read_text()), SPEC)

    def test_results_that_are_read(self):
        results = self.results(output={"controller": True})
        for arguments in (
            ("export", results, "--format", "csv"),
            ("export", results, "--format", "c-header"),
            ("report", results),
            ("simulate", results, "--from", "x=1,y=1", "--steps", "3"),
        ):
            with self.subTest(command=arguments[0]):
                self.assert_refused("the results", results, "output", *arguments, "-o", results)
        os.symlink(results, self.folder / "R.vti")
        os.symlink(results, self.folder / "R.vtkhdf")
        for name in ("R.vti", "R.vtkhdf"):
            self.assert_refused("the results", name, "output", "export", results, "--format", "vtk", "-o", name)

    def test_controller(self):
        results = self.results(output={"controller": True})
        self.write("s.json", spec_with(controller={"file": results}))
        self.assert_refused("the controller", results, "output", "analyze", "s.json", "-o", results)
        self.assert_refused("the controller", results, "junit", "analyze", "s.json", "--junit", results)
        self.assert_refused(
            "the controller", results, "checkpoint", "analyze", "s.json", "--checkpoint", results, "--resume"
        )

    def test_checkpoint(self):
        self.assert_refused("the results", "z", "checkpoint", "analyze", "s.json", "-o", "z", "--checkpoint", "z")
        for also in ((), ("--resume",)):
            self.assert_refused("the spec", "s.json", "checkpoint", "analyze", "s.json", "--checkpoint", "s.json", *also)
        self.assert_refused(
            "the JUnit report", "z", "checkpoint", "analyze", "s.json", "--junit", "z", "--checkpoint", "z"
        )

    def test_foreign_file_beside_the_checkpoint(self):
        self.write("z.new", "years of work")
        self.analyze("s.json", "--checkpoint", "z", "--checkpoint-every", "0")
        self.assertEqual((self.folder / "z.new").read_text(), "years of work")
        self.assertEqual(self.files(), ["s.json", "small.h5", "z.new"])

    def test_batches(self):
        (self.folder / "out").mkdir()
        os.symlink("../s.json", self.folder / "out" / "small.h5")
        self.write("other.json", spec_with(name="other"))
        specs = ("s.json", "other.json")
        message = "expected another file than the spec, found '{}' (--{})"
        self.assert_fails(2, message.format("out/small.h5", "output"), "analyze", *specs, "-o", "out")
        self.assert_fails(2, message.format("other.json", "junit"), "analyze", *specs, "--junit", "other.json")
        sweep = ("--sweep", "states.x.upper=4,5")
        self.assert_fails(2, message.format("s.json", "junit"), "analyze", "s.json", *sweep, "--junit", "s.json")
        self.assertEqual(json.loads((self.folder / "s.json").read_text()), SPEC)

    def test_results_that_are_the_spec_of_another(self):
        self.write("small.h5", spec_with(name="other"))
        self.assert_refused("the spec", "small.h5", "output", "analyze", "s.json", "small.h5")

    def test_reading_one_file_twice(self):
        results = self.results()
        self.assertEqual(self.run_program("compare", results, results).returncode, 0)


if __name__ == "__main__":
    unittest.main()
