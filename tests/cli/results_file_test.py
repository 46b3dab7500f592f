"""The results file as users open it, and what info tells about it."""

import json
import subprocess
import unittest

from program import CONFIGS, SPEC, Case, spec_with, without_comments

CIRCLE = str(CONFIGS / "circle.json")


class Cases(Case):
    def test_info_text(self):
        self.analyze(CIRCLE)
        result = self.run_program("info", "circle.h5")
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        self.assertRegex(
            result.stdout.decode(),
            r"""^name              circle
written by        coordreq 0\.1\.0 \(([0-9a-f]{40}|unknown)\)
spec SHA-256      [0-9a-f]{64}
period            0\.01 s
connection delay  0 steps \(0 s\)
guarantee         samples-center: at the sampling instants, where the centre of a cell is safe
cells             40,401
safe set          20,081
invariance set    20,077

horizontal\|vertical
  From the best state \(x1 = -0\.01, x2 = 0\), 28 steps \(0\.28 s\) without coordination are safe\.

axis  kind   points  first  last  unit  outside
x1    state     201     -1     1  m     unsafe
x2    state     201     -1     1  m     unsafe
u1    input      41     -1     1  m/s
u2    input      41     -1     1  m/s

partition             F  layers
horizontal\|vertical  29  20,077 19,421 17,869 16,717 15,533 14,317 \.\.\. 61 5 0

datasets
(  /[a-zA-Z0-9_/|+]+\n)+$""",
        )

    def test_info_json(self):
        summary = self.analyze(CIRCLE)
        result = self.run_program("info", "circle.h5", "--json")
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        info = json.loads(result.stdout)
        self.assertEqual(
            list(info),
            [
                "file",
                "name",
                "coordreq_version",
                "git_sha1",
                "spec_sha256",
                "guarantee",
                "period",
                "period_unit",
                "connection_delay",
                "states",
                "inputs",
                "cells",
                "safe",
                "invariant",
                "partitions",
                "coalition",
                "requirements",
                "datasets",
                "spec",
            ],
        )
        self.assertEqual((info["cells"], info["safe"], info["invariant"]), (40401, 20081, 20077))
        self.assertEqual(
            info["states"][0],
            {
                "name": "x1",
                "unit": "m",
                "points": 201,
                "first": -1.0,
                "last": 1.0,
                "outside": {"below": "unsafe", "above": "unsafe"},
            },
        )
        self.assertEqual([axis["name"] for axis in info["inputs"]], ["u1", "u2"])
        self.assertEqual(info["partitions"][0]["layers"], summary["partitions"][0]["layers"])
        self.assertEqual(info["partitions"][0]["F"], 29)
        for dataset in (
            "/safe",
            "/invariant",
            "/collision_time",
            "/delay",
            "/trigger",
            "/spec",
            "/x1",
            "/u2",
        ):
            self.assertIn(dataset, info["datasets"])
        # The configuration has comments, as has the text in the file.
        self.assertIn("//", (CONFIGS / "circle.json").read_text())
        self.assertEqual(info["spec"], json.loads(without_comments((CONFIGS / "circle.json").read_text())))

    def test_info_of_a_truncated_result(self):
        self.write("spec.json", spec_with(coordination={"max_delay": 1, "connection_delay": 2}))
        self.analyze("spec.json")
        info = json.loads(self.run_program("info", "small.h5", "--json").stdout)
        self.assertEqual((info["partitions"][0]["F"], info["partitions"][0]["truncated"]), (None, True))
        self.assertEqual(len(info["partitions"][0]["layers"]), 2)
        self.assertEqual(info["connection_delay"], 2)
        self.assertIn("not reached", self.run_program("info", "small.h5").stdout.decode())

    def test_info_quiet(self):
        self.analyze(CIRCLE)
        self.assert_prints("", "info", "circle.h5", "--quiet")

    def test_info_of_nothing(self):
        self.assert_fails(5, "cannot read the results: No such file or directory (no.h5)", "info", "no.h5")

    def test_info_of_a_folder(self):
        self.assert_fails(5, "cannot read the results: this is a folder (.)", "info", ".")

    def test_info_of_another_file(self):
        self.write("text.h5", "no HDF5")
        self.assert_fails(
            3, "not a coordreq results file: it is not HDF5, or cut short (text.h5)", "info", "text.h5"
        )

    def test_info_of_a_file_cut_short(self):
        self.analyze(CIRCLE)
        self.write("cut.h5", (self.folder / "circle.h5").read_bytes()[:20000])
        self.assert_fails(
            3, "not a coordreq results file: it is not HDF5, or cut short (cut.h5)", "info", "cut.h5"
        )

    def test_xarray_shows_named_axes(self):
        import xarray

        self.analyze(CIRCLE)
        with xarray.open_dataset(self.folder / "circle.h5", engine="h5netcdf") as data:
            self.assertEqual(data.delay.dims, ("partition", "x1", "x2"))
            self.assertEqual(data.x1.attrs["units"], "m")
            self.assertEqual(data.attrs["guarantee"], "samples-center")
            alone = data.delay.sel(partition="horizontal|vertical")
            self.assertEqual(int(alone.sel(x1=0, x2=0, method="nearest")), 28)
            self.assertEqual(int(alone.sel(x1=1, x2=1, method="nearest")), -2)
            self.assertEqual(int((alone == -1).sum()), 20081 - 20077)
            self.assertEqual(int((alone >= 1).sum()), 19421)
            self.assertEqual(int(data.safe.sum()), 20081)
            self.assertEqual(int(data.invariant.sum()), 20077)

    def test_h5py_reads_the_spec(self):
        import h5py

        self.analyze(CIRCLE)
        with h5py.File(self.folder / "circle.h5") as file:
            self.assertEqual(file.attrs["filetype"], "coordreq-results")
            self.assertEqual(list(file.attrs["version"]), [1, 0])
            self.assertEqual(file["spec"].asstr()[()], (CONFIGS / "circle.json").read_text())

    def test_ncdump_reads_the_header(self):
        self.analyze(CIRCLE)
        result = subprocess.run(
            ["ncdump", "-h", "circle.h5"], capture_output=True, cwd=self.folder, text=True, check=True
        )
        self.assertRegex(result.stdout, r"(short|int) delay\(partition, x1, x2\) ;")
        self.assertNotIn("phony_dim", result.stdout)


if __name__ == "__main__":
    unittest.main()
