"""Writes results where it goes wrong, and where memory is full of rubbish.

usage: write_sample_test.py WRITE_SAMPLE   (the program)
"""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

WRITE_SAMPLE = sys.argv.pop()


def write(path, *arguments, **environment):
    return subprocess.run([WRITE_SAMPLE, path, *map(str, arguments)], env=os.environ | environment,
                          capture_output=True, text=True)


class FullDisk(unittest.TestCase):
    def test_leaves_the_old_file_and_nothing_else(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "results.h5"
            self.assertEqual(write(path).returncode, 0)
            size = path.stat().st_size
            path.write_text("old")
            # In the first header, among the chunks, and in what is written last, when the file is closed.
            for limit in (1, 1000, size // 2, size - 10000, size - 1000, size - 1):
                with self.subTest(limit=limit):
                    done = write(path, 2, limit)
                    self.assertEqual(done.returncode, 5, done)
                    self.assertEqual(done.stderr, f"cannot write the results: File too large ({path})\n")
                    self.assertEqual(path.read_text(), "old")
                    self.assertEqual(os.listdir(folder), ["results.h5"])


class Reproducible(unittest.TestCase):
    def test_no_uninitialised_memory_gets_into_the_file(self):
        with tempfile.TemporaryDirectory() as folder:
            contents = set()
            for threads, rubbish in ((1, "0"), (2, "85"), (3, "170")):
                path = Path(folder) / f"{threads}.h5"
                self.assertEqual(write(path, threads, MALLOC_PERTURB_=rubbish).returncode, 0)
                contents.add(path.read_bytes())
            self.assertEqual(len(contents), 1)


if __name__ == "__main__":
    unittest.main()
