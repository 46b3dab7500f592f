"""Limits of the system: file size, disk, descriptors, address space. One line, the right code, nothing left behind."""

import os
import resource
import subprocess
import unittest

from program import PROGRAM, SANITIZED, SPEC, Case

KIB = 1024
# Every output is larger than 32 KiB, the limit of files here.
LARGE = dict(
    SPEC,
    states=[{"name": name, "lower": 0, "upper": 300, "step": 1, "outside": "unsafe"} for name in "xy"],
    safe="x + y <= 500",
    requirements=[{"name": "near " * 20_000, "where": "3 <= x <= 5 and 3 <= y <= 5", "invariant": True}],
)


class Cases(Case):
    def setUp(self):
        super().setUp()
        self.write("s.json", LARGE)

    def limited(self, limit, value, *arguments):
        return self.run_program(*arguments, preexec_fn=lambda: resource.setrlimit(limit, (value, value)))

    def assert_one_line(self, result, code, words):
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertIn(words, result.stderr.decode())

    def outputs(self):
        """Command lines that write files, and the files."""
        run = ("--start", "random", "--steps", "2000", "--runs", "20")
        yield ("analyze", "s.json", "-o", "o.h5"), "o.h5"
        yield ("analyze", "s.json", "--sweep", "name=a", "--junit", "o.xml"), "o.xml"
        yield ("export", "R.h5", "--format", "csv", "-o", "o.csv"), "o.csv"
        yield ("export", "R.h5", "--format", "c-header", "-o", "o.h"), "o.h"
        yield ("export", "R.h5", "--format", "scs", "-o", "o.scs"), "o.scs"
        yield ("export", "R.h5", "--format", "vtk", "-o", "o.vti"), "o.vti"
        yield ("report", "R.h5", "-o", "o.html"), "o.html"
        yield ("simulate", "R.h5", *run, "-o", "o.h5"), "o.h5"

    def test_file_size(self):
        self.analyze("s.json", "-o", "R.h5")
        for arguments, output in self.outputs():
            with self.subTest(command=arguments):
                self.write(output, "before")
                before = self.files()
                result = self.limited(resource.RLIMIT_FSIZE, 4 * KIB, *arguments)
                self.assert_one_line(result, 5, "File too large")
                self.assertEqual(self.files(), before)
                self.assertEqual((self.folder / output).read_text(), "before")

    def test_file_size_of_a_checkpoint(self):
        result = self.limited(
            resource.RLIMIT_FSIZE,
            64,
            *("analyze", "s.json", "--sweep", "name=a", "--quiet"),
        )
        self.assertEqual((result.returncode, result.stderr), (0, b""))  # writes nothing
        result = self.limited(
            resource.RLIMIT_FSIZE,
            64,
            *("analyze", "s.json", "--checkpoint", "c", "--checkpoint-every", "0"),
        )
        lines = result.stderr.decode().splitlines()
        self.assertIn("warning: continuing without a new checkpoint: cannot write: File too large (c)", lines[0])
        self.assertRegex(lines[-1], r"^coordreq: error: cannot write the results: .*File too large \(small\.h5\)$")
        self.assertEqual((result.returncode, self.files()), (5, ["s.json"]))

    def test_file_size_of_standard_output(self):
        self.analyze("s.json", "-o", "R.h5")
        with (self.folder / "table.csv").open("wb") as table:
            result = subprocess.run(
                [PROGRAM, "export", "R.h5", "--format", "csv"],
                cwd=self.folder,
                stdout=table,
                stderr=subprocess.PIPE,
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4 * KIB, 4 * KIB)),
            )
        self.assert_one_line(result, 5, "cannot write the result: File too large (standard output)")

    def test_full_disk(self):
        """A small file system of our own, where the system lets us mount one."""
        self.analyze("s.json", "-o", "R.h5")
        (self.folder / "disk").mkdir()
        mount = 'mount -t tmpfs -o size=8k,mode=777 none disk && (echo before > disk/"$1"; "$0" $2; code=$?; ls -A disk; cat disk/"$1"; exit $code)'
        if subprocess.run(["unshare", "-rm", "mount", "-t", "tmpfs", "none", str(self.folder / "disk")]).returncode != 0:
            self.skipTest("nothing may be mounted here")
        for arguments, output in self.outputs():
            with self.subTest(command=arguments):
                there = [argument.replace(output, "disk/" + output) for argument in arguments]
                if arguments[0] != "export":  # which prints nothing
                    there.append("--quiet")
                result = subprocess.run(
                    ["unshare", "-rm", "sh", "-c", mount, PROGRAM, output, " ".join(there)],
                    cwd=self.folder,
                    capture_output=True,
                )
                self.assert_one_line(result, 5, "No space left on device")
                self.assertEqual(result.stdout.decode(), f"{output}\nbefore\n")

    @unittest.skipIf(SANITIZED, "the undefined-behaviour sanitiser opens files itself")
    def test_descriptors(self):
        self.write("small.json", SPEC)
        self.analyze("small.json", "-o", "R.h5")
        commands = (
            ("analyze", "small.json", "-o", "o.h5", "--quiet"),
            ("info", "R.h5", "--quiet"),
            ("query", "R.h5", "--at", "x=1,y=1", "--quiet"),
            ("export", "R.h5", "--format", "csv", "-o", "o.csv"),
        )
        for command in commands:
            for most in range(3, 9):
                with self.subTest(command=command[0], descriptors=most):
                    result = self.limited(resource.RLIMIT_NOFILE, most, *command)
                    for output in ("o.h5", "o.csv"):
                        if result.returncode == 0 and output in command:
                            (self.folder / output).unlink()
                    self.assertEqual(self.files(), ["R.h5", "s.json", "small.json"])
                    if result.returncode == 127:  # too few for the program to be loaded
                        continue
                    if result.returncode != 0:
                        self.assert_one_line(result, 5, "Too many open files")

    def test_number_of_processes(self):
        """A results file is tried in a process of its own, or not read at all."""
        self.write("small.json", SPEC)
        self.analyze("small.json", "-o", "R.h5")
        self.folder.chmod(0o755)
        self.write("c.json", dict(SPEC, controller={"file": "R.h5"}))

        def without_processes():
            if os.geteuid() == 0:  # whom no limit binds
                os.setgroups([])
                os.setgid(65534)
                os.setuid(65534)
            resource.setrlimit(resource.RLIMIT_NPROC, (0, 0))

        for command in (("info", "R.h5"), ("query", "R.h5", "--at", "x=1,y=1"), ("validate", "c.json")):
            try:
                result = self.run_program(*command, preexec_fn=without_processes)
            except PermissionError:
                self.skipTest("nobody else may run the program here")
            self.assert_one_line(result, 5, "cannot be tried in a process of its own, as a damaged file must be: ")

    @unittest.skipIf(SANITIZED, "shadow memory takes terabytes of address space")
    def test_address_space(self):
        """From where the program cannot be loaded to where it has all it wants."""
        self.write("small.json", SPEC)
        self.analyze("small.json", "-o", "R.h5")
        for command in (
            ("analyze", "s.json", "-o", "o.h5", "--quiet", "--threads", "2"),
            ("info", "R.h5", "--quiet"),
            ("validate", "s.json", "--quiet"),
        ):
            codes = set()
            for space in [*range(20, 100, 4), *range(100, 300, 20), 1000]:
                with self.subTest(command=command[0], space=space):
                    result = self.limited(resource.RLIMIT_AS, space * KIB * KIB, *command)
                    if result.returncode == 0:
                        (self.folder / "o.h5").unlink(missing_ok=True)
                    elif result.returncode != 127:
                        self.assert_one_line(result, 4, "the system gave no more memory")
                    self.assertEqual(self.files(), ["R.h5", "s.json", "small.json"])
                    codes.add(result.returncode)
            self.assertIn(0, codes)

    def test_time_of_the_processor(self):
        fine = [{"name": name, "lower": 0, "upper": 6000, "step": 1} for name in "xy"]
        self.write("s.json", dict(SPEC, states=fine, safe="x + y <= 6000"))
        result = self.run_program(
            *("analyze", "s.json", "-o", "o.h5"),
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (1, 100)),
        )
        self.assertEqual((result.returncode, result.stderr), (130, b"coordreq: error: interrupted\n"))
        self.assertEqual(self.files(), ["s.json"])


if __name__ == "__main__":
    unittest.main()
