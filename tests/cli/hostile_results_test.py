"""Results files that somebody has changed: refused with a reason, at little cost, and never waited for."""

import json
import os
import subprocess
import unittest

import h5py
import numpy as np
from program import PROGRAM, ROOT, SANITIZED, Case, spec_with

KIBI, MEBI = 1024, 1024 * 1024
# Of the processor: more than any refusal takes; what is damaged beyond all telling may take five seconds.
MOST_SECONDS = 60 if SANITIZED else 10
MOST_BYTES = 100 * MEBI


class Cases(Case):
    def setUp(self):
        super().setUp()
        self.write("spec.json", spec_with(output={"controller": True, "abstraction": True}))
        self.analyze("spec.json", "-o", "out.h5")

    def changed(self):
        return h5py.File(self.folder / "out.h5", "r+")

    def replace(self, path, **arguments):
        """The same dataset with other properties, attributes and axes kept."""
        with self.changed() as file:
            old = file[path]
            attributes = {name: old.attrs[name] for name in old.attrs if name not in ("DIMENSION_LIST", "REFERENCE_LIST")}
            arguments = {"shape": old.shape, "dtype": old.dtype} | arguments
            del file[path]
            dataset = file.create_dataset(path, **arguments)
            for name, value in attributes.items():
                dataset.attrs[name] = value

    def refused(self, *arguments, code=3):
        """The one error line; asserts that it took little memory and time of the processor."""
        with subprocess.Popen(
            [PROGRAM, *arguments], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE
        ) as process:
            output, error = process.stdout.read(), process.stderr.read()
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual((process.returncode, output), (code, b""), error)
        self.assertLess(usage.ru_utime + usage.ru_stime, MOST_SECONDS)
        if not SANITIZED:
            self.assertLess(usage.ru_maxrss * KIBI, MOST_BYTES)
        lines = error.decode().splitlines()
        self.assertEqual(len(lines), 1, lines)
        return lines[0]

    def assert_refused(self, message):
        """By all that reads the file."""
        for command in (("info",), ("query", "--at", "x=1,y=1"), ("verify",), ("export", "--format", "csv")):
            self.assertEqual(self.refused(command[0], "out.h5", *command[1:]), f"coordreq: error: {message}")

    def test_the_file_is_read_before_it_is_changed(self):
        result = self.run_program("verify", "out.h5")
        self.assertEqual((result.returncode, result.stderr), (0, b""))

    def test_lists_that_are_longer_than_the_spec_says(self):
        with self.changed() as file:
            del file["partition"]
            file.create_dataset("partition", (2**28,), dtype=h5py.string_dtype())
        self.assert_refused("wrong shape: found [268435456], expected [1] (out.h5:/partition)")

    def test_more_layers_than_there_are_cells(self):
        with self.changed() as file:
            del file["layer"]
            file.create_dataset("layer", (2**28,), dtype="i4")
        self.assert_refused("found 268435456 entries, expected 1 to 26 (out.h5:/layer)")

    def test_elements_that_are_not_stored(self):
        self.replace("safe")  # nothing is written, so that there is no place for it
        self.assert_refused("damaged: the file does not hold all of its elements (out.h5:/safe)")

    def test_chunks_that_are_not_stored(self):
        self.replace("safe", chunks=(1, 5))
        self.assert_refused("damaged: the file does not hold all of its elements (out.h5:/safe)")

    def test_a_shape_that_does_not_fit_the_spec(self):
        self.replace("invariant", shape=(5, 2**40), chunks=(5, 1024))
        self.assert_refused("wrong shape: found [5, 1099511627776], expected [5, 5] (out.h5:/invariant)")

    def test_one_huge_chunk(self):
        states = [
            {"name": "x", "lower": 0, "upper": 4095, "step": 1},
            {"name": "y", "lower": 0, "upper": 4095, "step": 1},
        ]
        spec = spec_with(states=states, safe="x >= 0")
        text = json.dumps(spec)
        self.write("out.h5", self.bytes_of_huge_chunk(text))
        error = self.refused("info", "out.h5", "--max-memory", "100M")
        self.assertEqual(error, "coordreq: error: stored in chunks of more than 4 MiB (out.h5:/safe)")

    def bytes_of_huge_chunk(self, text):
        """A file as it would be of this spec, with 16 MiB of zeros in one chunk."""
        import hashlib

        path = self.folder / "huge.h5"
        with h5py.File(path, "w") as file, h5py.File(self.folder / "out.h5") as old:
            for name in old.attrs:
                file.attrs[name] = old.attrs[name]
            file.attrs["spec_sha256"] = hashlib.sha256(text.encode()).hexdigest()
            file["spec"] = text
            for name in "xy":
                file[name] = np.arange(4096.0)
            for name in "uv":
                file[name] = np.array([-1.0, 0, 1])
            old.copy("partition", file)
            old.copy("layer", file)
            shape = (4096, 4096)
            file.create_dataset("safe", data=np.zeros(shape, "u1"), chunks=shape, compression="gzip")
        return path.read_bytes()

    def test_a_chunk_that_unpacks_to_more_than_it_is(self):
        import zlib

        self.replace("safe", chunks=(5, 5), compression="gzip")
        with self.changed() as file:
            file["safe"].id.write_direct_chunk((0, 0), zlib.compress(bytes(2**16)))
        error = self.refused("export", "out.h5", "--format", "csv")
        self.assertEqual(error, "coordreq: error: cannot read the numbers: damaged (out.h5:/safe)")
        with self.changed() as file:
            file["safe"].id.write_direct_chunk((0, 0), zlib.compress(bytes(2**25), 9))
        error = self.refused("export", "out.h5", "--format", "csv")
        self.assertEqual(error, "coordreq: error: cannot read the numbers: damaged (out.h5:/safe)")

    def test_files_that_other_tools_packed_anew_are_read(self):
        expected = self.run_program("export", "out.h5", "--format", "csv").stdout
        for arguments in ({"chunks": (2, 3), "compression": "gzip", "shuffle": True}, {"chunks": (5, 1)}, {}):
            with self.subTest(arguments):
                with h5py.File(self.folder / "out.h5") as file:
                    values = file["collision_time"][...]
                self.replace("collision_time", data=values, **arguments)
                self.assertEqual(self.run_program("export", "out.h5", "--format", "csv").stdout, expected)

    def test_other_filters(self):
        with h5py.File(self.folder / "out.h5") as file:
            values = file["safe"][...]
        for arguments in ({"fletcher32": True}, {"compression": "lzf"}, {"scaleoffset": 2}):
            with self.subTest(arguments):
                self.replace("safe", data=values, chunks=(5, 5), **arguments)
                self.assert_refused(
                    "packed in a way that results are not: expected the filters shuffle and deflate (out.h5:/safe)"
                )

    def test_links_to_elsewhere(self):
        os.mkfifo(self.folder / "fifo")
        links = {
            "external": h5py.ExternalLink("fifo", "/safe"),
            "soft": h5py.SoftLink("/invariant"),
        }
        for kind, link in links.items():
            with self.subTest(kind):
                with self.changed() as file:
                    del file["safe"]
                    file["safe"] = link
                self.assert_refused("a link to an object elsewhere, which results do not have (out.h5:/safe)")

    def test_a_link_that_is_no_field(self):
        os.mkfifo(self.folder / "fifo")
        with self.changed() as file:
            file["more"] = h5py.ExternalLink("fifo", "/safe")
        error = self.refused("info", "out.h5")
        self.assertEqual(
            error, "coordreq: error: a link to an object elsewhere, which results do not have (out.h5:/more)"
        )

    def test_elements_in_another_file(self):
        os.mkfifo(self.folder / "fifo")
        with self.changed() as file:
            del file["safe"]
            file.create_dataset("safe", (5, 5), "u1", external=[("fifo", 0, 25)])
        self.assert_refused("its elements are in another file, which results do not have (out.h5:/safe)")

    def test_a_virtual_dataset(self):
        os.mkfifo(self.folder / "fifo")
        layout = h5py.VirtualLayout((5, 5), "u1")
        layout[...] = h5py.VirtualSource("fifo", "safe", (5, 5))
        with self.changed() as file:
            del file["safe"]
            file.create_virtual_dataset("safe", layout)
        self.assert_refused("a virtual dataset, which results do not have (out.h5:/safe)")

    def test_what_the_spec_asks_for_must_be_there(self):
        for path in ("controller", "abstraction"):
            with self.subTest(path):
                self.setUp()
                with self.changed() as file:
                    del file[path]
                self.assertIn("missing or damaged (out.h5:/" + path, self.refused("verify", "out.h5"))

    def test_files_that_were_found_to_do_harm(self):
        os.mkfifo(self.folder / "fifo")
        files = set((ROOT / "tests/fuzz/corpus/results").glob("*.h5"))
        files = sorted(file for file in files if file.name != "small.h5")  # an honest one, to begin with
        self.assertGreater(len(files), 4)
        for file in files:
            with self.subTest(file.name):
                self.write("out.h5", file.read_bytes())
                self.refused("info", "out.h5")
                self.refused("query", "out.h5", "--at", "x1=0,x2=0", "--max-memory", "100M")

    def test_groups_that_hold_one_another(self):
        with self.changed() as file:
            group = file.create_group("more")
            for i in range(26):
                group[f"{i}"] = group
        self.refused("info", "out.h5")

    def test_pipes_devices_and_folders(self):
        os.mkfifo(self.folder / "fifo")
        os.mkdir(self.folder / "folder")
        other = "cannot read the results: this is a device, a pipe or a socket, not a regular file"
        for name, what in (("fifo", other), ("/dev/zero", other), ("folder", "cannot read the results: this is a folder")):
            self.assertEqual(self.refused("info", name, code=5), f"coordreq: error: {what} ({name})")

    def test_a_controller_file_that_is_none(self):
        os.mkfifo(self.folder / "fifo")
        os.mkdir(self.folder / "folder")
        for name, what in (
            ("fifo", "is a device, a pipe or a socket, expected a file with a controller"),
            ("/dev/zero", "is a device, a pipe or a socket, expected a file with a controller"),
            ("folder", "is a folder, expected a file with a controller"),
        ):
            self.write("other.json", spec_with(controller={"file": name}))
            error = self.refused("validate", "other.json", code=5)
            self.assertEqual(error, f"coordreq: error: {what} ({name})")

    def test_a_spec_from_a_device(self):
        error = self.refused("validate", "/dev/zero", code=5)
        self.assertEqual(error, "coordreq: error: is a device, expected a spec file (/dev/zero)")

    def test_a_spec_from_a_pipe_that_somebody_fills(self):
        command = f"{PROGRAM} validate <(sleep 0.2; cat spec.json) --json"
        result = subprocess.run(["bash", "-c", command], cwd=self.folder, capture_output=True, timeout=60)
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        self.assertEqual(json.loads(result.stdout)["name"], "small")


if __name__ == "__main__":
    unittest.main()
