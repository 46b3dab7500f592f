"""Pipes that are closed, terminals that hang up, standard input that is no file."""

import os
import signal
import subprocess
import unittest

from program import PROGRAM, SPEC, Case, spec_with

FINE = spec_with(
    states=[{"name": name, "lower": 0, "upper": 1500, "step": 1, "outside": "unsafe"} for name in "xy"], safe="x + y <= 1500"
)


class Cases(Case):
    def setUp(self):
        super().setUp()
        self.write("s.json", SPEC)

    def into_closed_pipe(self, *arguments, **options):
        reader, writer = os.pipe()
        os.close(reader)
        process = subprocess.Popen(
            [PROGRAM, *arguments], cwd=self.folder, stdout=writer, stderr=subprocess.PIPE, **options
        )
        os.close(writer)
        return process.communicate(timeout=60)[1], process.returncode

    def test_closed_pipe_ends_the_program_silently(self):
        self.analyze("s.json", "-o", "R.h5")
        for arguments in (
            ("schema",),
            ("validate", "s.json"),
            ("info", "R.h5", "--json"),
            ("export", "R.h5", "--format", "csv"),
            ("analyze", "s.json", "s.json", "--sweep", "states.x.upper=4,5"),
        ):
            with self.subTest(command=arguments[0]):
                self.assertEqual(self.into_closed_pipe(*arguments), (b"", -signal.SIGPIPE))
                self.assertEqual(self.files(), ["R.h5", "s.json"])

    def test_results_are_complete_before_the_summary(self):
        self.assertEqual(self.into_closed_pipe("analyze", "s.json"), (b"", -signal.SIGPIPE))
        self.assertEqual(self.run_program("info", "small.h5", "--quiet").returncode, 0)

    def test_head(self):
        self.analyze("s.json", "--set", "states.x.upper=3000", "-o", "R.h5")
        script = '"$0" export R.h5 --format csv | head -n 1; echo "${PIPESTATUS[0]}"'
        result = subprocess.run(["bash", "-c", script, PROGRAM], cwd=self.folder, capture_output=True)
        self.assertEqual(result.stderr, b"")
        self.assertEqual(result.stdout.decode().splitlines()[1], str(128 + signal.SIGPIPE))

    def test_caller_that_ignores_the_signal(self):
        errors, code = self.into_closed_pipe(
            "schema", restore_signals=False, preexec_fn=lambda: signal.signal(signal.SIGPIPE, signal.SIG_IGN)
        )
        self.assertEqual(errors, b"coordreq: error: cannot write the result: Broken pipe (standard output)\n")
        self.assertEqual(code, 5)

    def hang_up(self, **options):
        """In the middle of an analysis."""
        self.write("fine.json", FINE)
        process = subprocess.Popen(
            [PROGRAM, "analyze", "fine.json", "-o", "o.h5", "--progress", "log"],
            cwd=self.folder,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            **options,
        )
        process.stderr.readline()  # the first stage is done
        process.send_signal(signal.SIGHUP)
        return process.communicate(timeout=120)[1], process.returncode

    def test_terminal_that_hangs_up(self):
        errors, code = self.hang_up()
        self.assertEqual(code, 130)
        self.assertTrue(errors.endswith(b"coordreq: error: interrupted\n"), errors)
        self.assertEqual(self.files(), ["fine.json", "s.json"])

    def test_nohup(self):
        errors, code = self.hang_up(preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        self.assertEqual(code, 0)
        self.assertNotIn(b"interrupted", errors)
        self.assertIn("o.h5", self.files())

    def test_folder_as_standard_input(self):
        self.analyze("s.json", "-o", "R.h5")
        for arguments in (("query", "R.h5"), ("validate", "-"), ("analyze", "-")):
            with self.subTest(command=arguments[0]):
                folder = os.open(self.folder, os.O_RDONLY)
                result = subprocess.run(
                    [PROGRAM, *arguments], stdin=folder, cwd=self.folder, capture_output=True, timeout=60
                )
                os.close(folder)
                self.assertEqual(result.stderr, b"coordreq: error: cannot be read (standard input)\n")
                self.assertEqual((result.stdout, result.returncode), (b"", 5))


if __name__ == "__main__":
    unittest.main()
