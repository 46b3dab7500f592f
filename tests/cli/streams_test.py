"""Streams that fail, signals, and the progress line."""

import json
import os
import pty
import signal
import subprocess
import time
import unittest

from program import CONFIGS, PROGRAM, Case, without_comments, without_warnings

CIRCLE = str(CONFIGS / "circle.json")


def fine_circle(step):
    """The circle on a grid fine enough to keep the program busy."""
    spec = json.loads(without_comments((CONFIGS / "circle.json").read_text()))
    for state in spec["states"]:
        state["step"] = step
    return spec


class Cases(Case):
    def start(self, *arguments, **options):
        process = subprocess.Popen([PROGRAM, *arguments], cwd=self.folder, **options)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def start_on_terminal(self, *arguments, **variables):
        """The process, and the end of a pseudo-terminal that shows its standard error."""
        reader, writer = pty.openpty()
        self.addCleanup(os.close, reader)
        environment = dict(os.environ, TERM="xterm", **variables)
        process = self.start(*arguments, stdout=subprocess.PIPE, stderr=writer, env=environment)
        self.addCleanup(process.stdout.close)
        os.close(writer)
        return process, reader

    @staticmethod
    def read_all(reader):
        text = b""
        while True:
            try:
                part = os.read(reader, 4096)
            except OSError:  # how a pseudo-terminal says that the other end is closed
                return text
            if not part:
                return text
            text += part

    def writes_temporary_file(self):
        try:
            return any(path.stat().st_size > 0 for path in self.folder.glob(".coordreq-*"))
        except FileNotFoundError:  # the empty one, with which the program tries whether it can write
            return False

    def interrupt(self, number):
        self.write("spec.json", fine_circle(0.0005))
        process, reader = self.start_on_terminal("analyze", "spec.json", "-o", "out.h5")
        os.read(reader, 1)  # the first sign of progress
        process.send_signal(number)
        self.assertEqual(process.wait(timeout=120), 130)
        # The line of progress, and the ^C that a terminal shows behind it, are gone.
        self.assertRegex(self.read_all(reader), rb"\r +\rcoordreq: error: interrupted\r\n$")
        self.assertEqual(process.stdout.read(), b"")
        self.assertEqual(self.files(), ["spec.json"])

    def test_ctrl_c_leaves_nothing_behind(self):
        self.interrupt(signal.SIGINT)

    def test_termination_leaves_nothing_behind(self):
        self.interrupt(signal.SIGTERM)

    def test_termination_while_writing_leaves_no_temporary_file(self):
        spec = fine_circle(0.001)
        spec["safe"] = "true"  # quick to analyse, long to write
        self.write("spec.json", spec)
        process = self.start(
            "analyze", "spec.json", "-o", "out.h5", stdout=subprocess.PIPE, stderr=subprocess.PIPE
        )
        self.addCleanup(process.stdout.close)
        while process.poll() is None and not self.writes_temporary_file():
            time.sleep(0.001)
        process.terminate()
        errors = process.communicate(timeout=120)[1].decode()
        self.assertEqual(process.returncode, 130)
        if "out.h5" in self.files():  # too late to stop
            self.assertEqual(errors, "coordreq: error: interrupted when the results were complete (out.h5)\n")
            self.assertEqual(self.run_program("info", "out.h5").returncode, 0)
        else:
            self.assertEqual(errors, "coordreq: error: interrupted\n")
        self.assertEqual([name for name in self.files() if name.startswith(".")], [])

    def test_ctrl_c_while_waiting_for_standard_input(self):
        process = self.start(
            "analyze", "-", stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE
        )
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        output, errors = process.communicate(timeout=60)
        self.assertEqual((process.returncode, output, errors), (130, b"", b"coordreq: error: interrupted\n"))

    def test_progress_on_a_terminal_is_one_line_that_goes_away(self):
        self.write("spec.json", fine_circle(0.001))  # the layers take several tenths of a second
        process, reader = self.start_on_terminal("analyze", "spec.json", NO_COLOR="1")
        shown = self.read_all(reader).decode()
        self.assertEqual(process.wait(), 0)
        lines = shown.split("\r")
        self.assertNotIn("\n", shown)
        self.assertNotIn("\x1b", shown)
        self.assertRegex(
            shown, r"layers horizontal\|vertical \[#*-*\] sweep [0-9,]+, (layer [0-9,]+, )?[0-9,]+ cells? left"
        )
        self.assertEqual((lines[0], lines[-2].strip(), lines[-1]), ("", "", ""))
        self.assertGreaterEqual(len(lines[-2]), len(lines[-3].rstrip()))
        self.assertLessEqual(max(len(line) for line in lines), 80)

    def test_no_progress_when_quiet(self):
        self.write("spec.json", fine_circle(0.0025))
        process, reader = self.start_on_terminal("analyze", "spec.json", "--quiet")
        self.assertEqual(self.read_all(reader), b"")
        self.assertEqual((process.wait(), process.stdout.read()), (0, b""))

    def test_no_progress_without_a_terminal(self):
        self.write("spec.json", fine_circle(0.0025))
        result = self.run_program("analyze", "spec.json")
        self.assertEqual((result.returncode, without_warnings(result.stderr)), (0, b""))

    def test_full_standard_output(self):
        with open("/dev/full", "wb") as full:
            process = self.start("validate", CIRCLE, stdout=full, stderr=subprocess.PIPE)
            errors = process.communicate()[1]
        self.assertEqual(process.returncode, 5)
        self.assertEqual(
            errors, b"coordreq: error: cannot write the result: No space left on device (standard output)\n"
        )

    def test_closed_standard_output(self):
        result = subprocess.run(
            ["sh", "-c", 'exec "$0" analyze "$1" >&-', PROGRAM, CIRCLE],
            cwd=self.folder,
            stderr=subprocess.PIPE,
        )
        self.assertEqual(result.returncode, 5)
        self.assertEqual(
            result.stderr,
            b"coordreq: error: cannot write the result: Bad file descriptor (standard output)\n",
        )
        # The results were complete before the summary failed.
        self.assertEqual(self.run_program("info", "circle.h5").returncode, 0)

    def test_closed_standard_error(self):
        self.analyze(CIRCLE, "-o", "expected.h5")
        script = 'exec "$0" analyze "$1" -o out.h5 --quiet 2>&-'
        result = subprocess.run(["sh", "-c", script, PROGRAM, CIRCLE], cwd=self.folder)
        self.assertEqual(result.returncode, 0)
        self.assertEqual((self.folder / "out.h5").read_bytes(), (self.folder / "expected.h5").read_bytes())
        result = subprocess.run(["sh", "-c", 'exec "$0" analyze no.json 2>&-', PROGRAM], cwd=self.folder)
        self.assertEqual(result.returncode, 5)


if __name__ == "__main__":
    unittest.main()
