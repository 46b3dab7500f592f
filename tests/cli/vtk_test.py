"""Images that `export --format vtk` writes, opened with VTK."""

import json
import math
import unittest

import h5py
import numpy as np
from program import CONFIGS, SPEC, Case, spec_with, without_comments
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLImageDataReader

CROSSING = json.loads(without_comments((CONFIGS / "intersection_coarse.json").read_text()))


class Cases(Case):
    def analyzed(self, spec):
        self.write("spec.json", spec)
        self.analyze("spec.json", "-o", "out.h5")

    def exported(self, name, *arguments):
        self.assert_prints("", "export", "out.h5", "--format", "vtk", "-o", name, *arguments)
        return str(self.folder / name)

    def image(self, *arguments):
        """The VTK image of a .vti file."""
        reader = vtkXMLImageDataReader()
        reader.SetFileName(self.exported("image.vti", *arguments))
        reader.Update()
        self.assertEqual(reader.GetErrorCode(), 0)
        return reader.GetOutput()

    @staticmethod
    def arrays(image, cells):
        """Arrays at cells by name, [x, y, z]."""
        data = image.GetCellData()
        found = {}
        for i in range(data.GetNumberOfArrays()):
            array = data.GetArray(i)
            found[array.GetName()] = vtk_to_numpy(array).reshape(cells[::-1]).transpose()
        return found

    @staticmethod
    def field(image, name):
        array = image.GetFieldData().GetAbstractArray(name)
        return [array.GetValue(i) for i in range(array.GetNumberOfValues())]

    def expected(self, partitions=None):
        """The same arrays from the results file, over all states."""
        with h5py.File(self.folder / "out.h5") as file:
            found = {name: self.numbers(file[name][...]) for name in ("safe", "invariant", "collision_time")}
            for p, name in enumerate(file["partition"].asstr()):
                if partitions is None or name in partitions:
                    found[f"delay:{name}"] = self.numbers(file["delay"][p])
                    found[f"countdown:{name}"] = self.numbers(file["trigger"][p])
            return found

    @staticmethod
    def numbers(values):
        if values.dtype == np.uint8:
            return values.astype(float)
        return np.where(values == np.iinfo(values.dtype).max, math.inf, values.astype(float))

    def assert_holds(self, found, expected):
        self.assertEqual(list(found), list(expected))
        for name, values in expected.items():
            np.testing.assert_array_equal(found[name], values, name)

    def crossing(self):
        partitions = [{"classes": []}, {"name": "both", "classes": [["first", "second"]]}]
        self.analyzed(dict(CROSSING, coordination={"partitions": partitions, "connection_delay": 1}))
        with h5py.File(self.folder / "out.h5") as file:
            return int(np.abs(file["v2"][...] - 2).argmin())

    # .vti

    def test_three_states_and_a_slice_of_the_fourth(self):
        v2 = self.crossing()
        image = self.image("--slice", "v2=2")
        with h5py.File(self.folder / "out.h5") as file:
            axes = [file[name][...] for name in ("p1", "v1", "p2")]
            steps = [file[name].attrs["step"] for name in ("p1", "v1", "p2")]
        cells = [len(axis) for axis in axes]
        self.assertEqual(image.GetDimensions(), tuple(n + 1 for n in cells))
        np.testing.assert_allclose(image.GetSpacing(), steps, rtol=1e-15)
        # Values belong to cells, whose centres are the grid points.
        for i, j, k in ((0, 0, 0), (3, 1, 2), tuple(n - 1 for n in cells)):
            bounds = image.GetCell(i + cells[0] * (j + cells[1] * k)).GetBounds()
            centre = [(low + high) / 2 for low, high in zip(bounds[::2], bounds[1::2])]
            np.testing.assert_allclose(centre, [axis[n] for axis, n in zip(axes, (i, j, k))], atol=1e-12)
        found = self.arrays(image, cells)
        self.assert_holds(found, {name: values[:, :, v2, :] for name, values in self.expected().items()})
        self.assertIn(-3, found["countdown:first|second"])
        self.assertEqual(self.field(image, "title"), ["intersection_coarse"])
        self.assertEqual(self.field(image, "axes"), ["p1 [m]", "v1 [m/s]", "p2 [m]"])
        self.assertEqual(self.field(image, "cut"), ["v2 = 2 m/s"])
        # What a colour scale shows.
        delay = found["delay:first|second"]
        self.assertTrue(np.isinf(delay).any())
        finite = delay[np.isfinite(delay)]
        array = image.GetCellData().GetArray("delay:first|second")
        self.assertEqual(array.GetFiniteRange(), (finite.min(), finite.max()))

    def test_one_of_several_partitions_and_a_projection(self):
        self.crossing()
        image = self.image("--project", "v2:min", "--partition", "both")
        found = self.arrays(image, [n - 1 for n in image.GetDimensions()])
        expected = self.expected(["both"])
        for name in ("safe", "invariant", "collision_time", "delay:both"):
            np.testing.assert_array_equal(found[name], expected[name].min(axis=2), name)
        self.assertEqual(list(found), list(expected))
        self.assertEqual(self.field(image, "cut"), ["v2: min"])

    def test_fewer_states_are_one_cell_thick(self):
        self.analyzed(spec_with(states=[dict(SPEC["states"][0], upper=6), SPEC["states"][1]]))
        image = self.image()
        self.assertEqual((image.GetDimensions(), image.GetBounds()), ((8, 6, 2), (-0.5, 6.5, -0.5, 4.5, 0, 1)))
        found = self.arrays(image, (7, 5, 1))
        self.assert_holds(found, {name: values[:, :, None] for name, values in self.expected().items()})
        self.assertEqual((self.field(image, "axes"), self.field(image, "cut")), (["x [m]", "y [m]", ""], [""]))
        image = self.image("--slice", "x=1", "--slice", "y=2")
        self.assertEqual(image.GetDimensions(), (2, 2, 2))
        self.assertEqual(self.field(image, "cut"), ["x = 1 m, y = 2 m"])

    def test_more_cells_than_fit_a_block(self):
        names = "xyz"
        self.analyzed(
            spec_with(
                states=[{"name": n, "lower": 0, "upper": 57, "step": 1} for n in names],
                dynamics=dict(SPEC["dynamics"], equations={"x": "x + u", "y": "y + v", "z": "z"}),
                safe="x + 2*y + 3*z <= 200",
            )
        )
        self.assert_holds(self.arrays(self.image(), (58, 58, 58)), self.expected())

    def test_names_that_xml_would_misread(self):
        partitions = [{"classes": [["a", "b"]]}]
        states = [dict(SPEC["states"][0], unit='<"&'), SPEC["states"][1]]
        self.analyzed(spec_with(states=states, coordination={"partitions": partitions}))
        image = self.image("--partition", "a+b")
        self.assertEqual(self.field(image, "axes"), ['x [<"&]', "y [m]", ""])
        self.assertIn("delay:a+b", self.arrays(image, (5, 5, 1)))

    def test_equal_results_give_equal_images(self):
        self.crossing()
        contents = set()
        for threads in ("1", "2"):
            self.exported("image.vti", "--slice", "v1=1", "--threads", threads)
            contents.add((self.folder / "image.vti").read_bytes())
        self.assertEqual(len(contents), 1)
        self.assertEqual(self.files(), ["image.vti", "out.h5", "spec.json"])

    def test_what_is_wrong(self):
        self.crossing()
        export = ("export", "out.h5", "--format", "vtk")
        states = "'p1', 'v1', 'v2' or 'p2'"
        extension = "expected a name that ends in .vti, found"
        axes = f"an image has 3 axes, expected --slice or --project for 1 of {states}"
        partition = "no partition 'all', expected 'first|second' or 'both' (--partition)"
        for arguments, message in (
            ((), f"{extension} none (-o)"),
            (("-o", "a.vtk"), f"{extension} 'a.vtk' (-o)"),
            (("-o", "a.vti"), axes),
            (("-o", "a.vtkhdf"), f"{extension} 'a.vtkhdf' (-o)"),
            (("-o", "a.vti", "--slice", "q=1"), f"'q' is no state, expected {states} (--slice)"),
            (("-o", "a.vti", "--partition", "all"), partition),
        ):
            self.assert_fails(2, message, *export, *arguments)
        message = "the folder does not exist (none)"
        self.assert_fails(5, message, *export, "--slice", "v1=1", "-o", "none/a.vti")


if __name__ == "__main__":
    unittest.main()
