"""Opens a results file as its users do: xarray, h5netcdf, h5py, ncdump, h5dump.

usage: xarray_test.py SAMPLE   (the file that write_sample made)
"""

import subprocess
import sys
import unittest

import h5netcdf
import h5py
import numpy as np
import xarray as xr

SAMPLE = sys.argv.pop()
SHAPE = (61, 51, 40)
CELLS = np.arange(np.prod(SHAPE)).reshape(SHAPE)


def is_safe():
    return CELLS % 7 != 0


def is_invariant():
    return is_safe() & (CELLS % 3 != 0)


def action_bytes(length):
    return (np.arange(CELLS.size * length) * 37 % 251).reshape(SHAPE + (length,))


def tool_output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


class Xarray(unittest.TestCase):
    def setUp(self):
        self.data = xr.open_dataset(SAMPLE, engine="h5netcdf")
        self.addCleanup(self.data.close)

    def test_axes_are_named(self):
        self.assertEqual(self.data.safe.dims, ("x1", "x2", "heading"))
        self.assertEqual(self.data.delay.dims, ("partition", "x1", "x2", "heading"))
        self.assertEqual(self.data.layer_size.dims, ("partition", "layer"))
        self.assertEqual(self.data.fixed_point_index.dims, ("partition",))

    def test_axes_have_values_and_units(self):
        np.testing.assert_array_equal(self.data.x1, -1 + 0.125 * np.arange(61))
        np.testing.assert_array_equal(self.data.u2, [-1, 0, 3])
        units = {name: self.data[name].attrs["units"] for name in ("x1", "x2", "heading", "u1", "u2")}
        self.assertEqual(units, {"x1": "m", "x2": "s", "heading": "1", "u1": "m/s", "u2": "rad"})
        self.assertEqual(self.data.x1.attrs["step"], 0.125)
        self.assertNotIn("step", self.data.u2.attrs)

    def test_an_axis_of_times_and_steps_stay_numbers(self):
        self.assertEqual(self.data.x2.dtype, np.float64)
        for name in ("collision_time", "delay", "trigger"):
            self.assertEqual(self.data[name].dtype, np.int16)

    def test_values(self):
        np.testing.assert_array_equal(self.data.safe, is_safe())
        np.testing.assert_array_equal(self.data.invariant, is_invariant())
        self.assertEqual(self.data.safe.attrs["cells"], is_safe().sum())

    def test_cells_are_selected_by_coordinates_and_partitions_by_name(self):
        at = dict(x1=-0.75, x2=1.5, heading=4)
        cell = CELLS[2, 3, 4]
        self.assertTrue(is_invariant()[2, 3, 4] and cell % 11 != 0)
        self.assertEqual(self.data.delay.sel(partition="a|b+c", **at), (cell + 1) % 50)

    def test_flags_are_typed_like_the_data(self):
        for name in ("safe", "invariant", "collision_time", "delay", "trigger", "fixed_point_index"):
            attributes = self.data[name].attrs
            values = np.atleast_1d(attributes["flag_values"])
            self.assertEqual(values.dtype, self.data[name].dtype, name)
            self.assertEqual(len(attributes["flag_meanings"].split()), len(values), name)
        np.testing.assert_array_equal(self.data.trigger.attrs["flag_values"], [-3, -2, -1, 32767])

    def test_attributes_of_the_file(self):
        attributes = self.data.attrs
        self.assertEqual(attributes["filetype"], "coordreq-results")
        np.testing.assert_array_equal(attributes["version"], [1, 0])
        self.assertEqual(attributes["title"], "sample")
        self.assertEqual(attributes["Conventions"], "CF-1.10")
        self.assertEqual((attributes["period"], attributes["period_unit"]), (0.25, "s"))

    def test_the_spec_is_text(self):
        self.assertIn("sample \u00e9", self.data.spec.item())

    def test_groups(self):
        with xr.open_dataset(SAMPLE, engine="h5netcdf", group="/layers/a|b+c") as layers:
            start = layers.start.values
            self.assertEqual(layers.cell.dtype, np.uint32)
            np.testing.assert_array_equal(layers.cell[start[1] : start[2]], 2 * np.arange(start[1], start[2]))
        with xr.open_dataset(SAMPLE, engine="h5netcdf", group="/actions/a|b+c") as actions:
            self.assertEqual(actions["b+c"].dims, ("x1", "x2", "heading", "b+c:byte"))
        with xr.open_dataset(SAMPLE, engine="h5netcdf", group="/abstraction/x1") as table:
            self.assertEqual(table["first"].dims, ("x1", "u1"))
        with xr.open_dataset(SAMPLE, engine="h5netcdf", group="/abstraction/x2") as table:
            self.assertEqual(table["last"].item(), 9)


class H5netcdf(unittest.TestCase):
    def test_no_axis_is_phony(self):
        with h5netcdf.File(SAMPLE, "r") as file:  # would refuse axes without a scale
            pending = [file]
            while pending:
                group = pending.pop()
                pending += group.groups.values()
                for variable in group.variables.values():
                    self.assertEqual(len(variable.dimensions), variable.ndim)


class H5py(unittest.TestCase):
    def test_actions_unpack_to_booleans(self):
        with h5py.File(SAMPLE) as file:
            packed = file["/actions/a|b+c/b+c"]
            actions = packed.attrs["actions"]
            admissible = np.unpackbits(packed[...], axis=-1, bitorder="little")[..., :actions]
        self.assertEqual(admissible.shape, SHAPE + (15,))
        expected = action_bytes(2)
        for action in (0, 7, 8, 14):
            bit = expected[..., action // 8] >> (action % 8) & 1
            np.testing.assert_array_equal(admissible[..., action], bit)

    def test_strings_are_unicode(self):
        with h5py.File(SAMPLE) as file:
            self.assertEqual(list(file["partition"].asstr()), ["alone", "a|b+c"])
            self.assertEqual(h5py.check_string_dtype(file["spec"].dtype).encoding, "utf-8")
            self.assertEqual(file["safe"].dims[2][0].name, "/heading")


class Tools(unittest.TestCase):
    def test_ncdump_names_the_dimensions(self):
        text = tool_output("ncdump", "-h", SAMPLE)
        self.assertIn("short delay(partition, x1, x2, heading) ;", text)
        self.assertIn('string x1:units = "m" ;', text)
        self.assertIn("int first(x1, u1) ;", text)
        self.assertNotIn("phony_dim", text)

    def test_ncdump_reads_the_data(self):
        self.assertIn("heading = 0, 1, 2, 3,", tool_output("ncdump", "-v", "heading", SAMPLE))
        tool_output("ncdump", SAMPLE)

    def test_hdf5_tools(self):
        self.assertIn('DATASET "collision_time"', tool_output("h5dump", "-H", SAMPLE))
        self.assertIn("/actions/a|b+c/b+c", tool_output("h5ls", "-r", SAMPLE))


if __name__ == "__main__":
    unittest.main()
