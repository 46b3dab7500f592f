"""What is told of work that takes long, and how it is stopped in any stage."""

import json
import os
import pty
import re
import signal
import subprocess
import time
import unittest

from program import CONFIGS, PROGRAM, Case, without_comments, without_warnings

CIRCLE = str(CONFIGS / "circle.json")
EVERYTHING = ["--progress", "log", "--progress-every", "0"]

SPAN = r"(\d\.\d s|\d+ s|\d+ min \d+ s)"
CELLS = r"[\d,]+ cells? left"
SWEEP = rf"sweep [\d,]+, (layer [\d,]+, )?{CELLS}(, {SPAN} left)?"
PASS = rf"\d+ %(, {SPAN} left)?"
LINE = re.compile(rf"coordreq: (?P<stage>[^:]+): (({SWEEP}, |{PASS}, )?{SPAN} so far|(?P<done>done) in {SPAN})\n")


class Cases(Case):
    def fine_circle(self, step=0.0025, **changes):
        """The circle on a grid fine enough to keep the program busy."""
        spec = json.loads(without_comments((CONFIGS / "circle.json").read_text()))
        for state in spec["states"]:
            state["step"] = step
        spec.update(changes)
        return self.write("spec.json", spec)

    def log(self, *arguments):
        """The lines of a log, each as it must be, and the stages that they say are done."""
        result = self.run_program(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        lines = without_warnings(result.stderr).decode().splitlines(keepends=True)
        for line in lines:
            self.assertRegex(line, LINE)
        return lines, [match["stage"] for match in map(LINE.fullmatch, lines) if match["done"]]

    def test_log_of_an_analysis(self):
        spec = self.fine_circle(0.001, output={"actions": True})
        lines, done = self.log("analyze", spec, *EVERYTHING)
        self.assertEqual(
            done, ["abstraction", "safe set", "invariance", "layers horizontal|vertical", "writing"]
        )
        self.assertTrue(any("layers horizontal|vertical, projections: " in line for line in lines))
        self.assertTrue(any(re.search(r"layers horizontal\|vertical: sweep \d+, layer \d+, ", line) for line in lines))
        self.assertTrue(any(re.search(r"writing: \d+ %", line) for line in lines))

    def test_log_of_a_quick_analysis_has_its_stages_only(self):
        lines, done = self.log("analyze", CIRCLE, "--progress", "log")
        self.assertEqual(len(lines), len(done))

    def test_where_there_is_no_terminal_a_line_now_and_then(self):
        """Here after no time at all, else every minute; ends of stages are not told."""
        spec = self.fine_circle(0.001)
        lines, done = self.log("analyze", spec, "--progress-every", "0")
        self.assertTrue(any("layers horizontal|vertical: sweep" in line for line in lines))
        self.assertEqual(done, [])
        self.assertEqual(self.log("analyze", CIRCLE), ([], []))
        result = self.run_program("analyze", CIRCLE, "--quiet", "--progress-every", "0")
        self.assertEqual((result.returncode, result.stderr), (0, b""))

    def test_log_also_with_quiet(self):
        result = self.run_program("analyze", CIRCLE, "--quiet", "--progress", "log")
        self.assertEqual(result.stdout, b"")
        self.assertRegex(result.stderr.decode(), r"(?m)^coordreq: invariance: done in ")

    def test_interval_of_the_log(self):
        spec = self.fine_circle(0.001)
        begin = time.monotonic()
        lines, done = self.log("analyze", spec, "--progress", "log", "--progress-every", "0.3")
        seconds = time.monotonic() - begin
        self.assertLessEqual(len(lines) - len(done), seconds / 0.3)
        self.assertGreater(len(lines) - len(done), 0)

    def test_layers_that_are_final_never_get_fewer(self):
        lines, _ = self.log("analyze", self.fine_circle(), *EVERYTHING)
        layers = [int(found[1].replace(",", "")) for found in map(re.compile(r"layers .*, layer ([\d,]+)").search, lines) if found]
        self.assertEqual(layers, sorted(layers))

    def test_log_of_verify_and_simulate(self):
        self.analyze(CIRCLE)
        lines, done = self.log("verify", "circle.h5", *EVERYTHING)
        self.assertIn("checking cells", done)
        self.assertTrue(any(re.search(r"checking cells: \d+ %", line) for line in lines))
        options = ["--start", "random", "--steps", "20", "--runs", "300"]
        lines, done = self.log("simulate", "circle.h5", *options, *EVERYTHING)
        self.assertIn("running", done)
        self.assertTrue(any(re.search(r"running: \d+ %", line) for line in lines))

    def test_bar_on_a_terminal_only(self):
        spec = self.fine_circle(0.001)
        result = self.run_program("analyze", spec, "--progress", "auto")
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        for options in ([], ["--progress", "auto"]):
            shown = self.on_terminal("analyze", spec, *options)
            self.assertIn("layers horizontal|vertical", shown)
            self.assertRegex(shown, r"\r +\r$")
        for options in (["--progress", "none"], ["--quiet"], ["--quiet", "--progress", "auto"]):
            self.assertEqual(self.on_terminal("analyze", spec, *options), "")

    def on_terminal(self, *arguments):
        """All that standard error shows if it is a terminal."""
        reader, writer = pty.openpty()
        self.addCleanup(os.close, reader)
        process = subprocess.Popen(
            [PROGRAM, *arguments],
            cwd=self.folder,
            stdout=subprocess.DEVNULL,
            stderr=writer,
            env=dict(os.environ, TERM="xterm"),
        )
        os.close(writer)
        shown = b""
        with process:
            while True:
                try:
                    part = os.read(reader, 4096)
                except OSError:  # how a pseudo-terminal says that the other end is closed
                    break
                shown += part
        self.assertEqual(process.returncode, 0)
        return shown.decode()

    def test_options(self):
        for message, *options in (
            ("expected auto, log or none, found 'no' (--progress)", "--progress", "no"),
            (
                "no lines are printed, expected --progress log (--progress-every)",
                "--progress",
                "none",
                "--progress-every",
                "5",
            ),
            (
                "expected a number of seconds from 0, found 'soon' (--progress-every)",
                "--progress",
                "log",
                "--progress-every",
                "soon",
            ),
        ):
            self.assert_fails(2, message, "analyze", CIRCLE, *options)

    def stop_in(self, stage, number, *options):
        """Stops an analysis when it tells of a stage; everything is then as it was before."""
        changes = {"output": {"actions": True, "layers": True}}
        if stage == "network":
            changes["network"] = {"weakly_hard": {"misses": 2, "window": 5}}
        self.write("out.h5", "old results")
        spec = self.fine_circle(0.0015, **changes)
        process = subprocess.Popen(
            [PROGRAM, "analyze", spec, "-o", "out.h5", *EVERYTHING, *options],
            cwd=self.folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
        with process:
            line = next((line for line in process.stderr if re.match(f"coordreq: {stage}".encode(), line)), None)
            self.assertIsNotNone(line)
            begin = time.monotonic()
            process.send_signal(number)
            output, errors = process.communicate(timeout=60)
            seconds = time.monotonic() - begin
        self.assertEqual(process.returncode, 130, stage)
        self.assertEqual(output, b"")
        last = errors.splitlines()[-1]
        if "--checkpoint" in options:
            self.assertIn(b"coordreq: error: interrupted; ", last)
        else:
            self.assertEqual(last, b"coordreq: error: interrupted")
        # Some milliseconds, were there no other work on the machine.
        self.assertLess(seconds, 2, stage)
        self.assertEqual((self.folder / "out.h5").read_bytes(), b"old results")
        self.assertEqual([name for name in self.files() if name != "run.ckpt"], ["out.h5", "spec.json"])

    def test_a_signal_stops_every_stage(self):
        stages = ["abstraction", "safe set", "invariance", r"layers [^:]*, projections", "layers [^:]*: sweep", "network"]
        stages += ["writing, lists", r"writing: [1-6]?\d %"]
        for i, stage in enumerate(stages):
            self.stop_in(stage, signal.SIGTERM if i % 2 else signal.SIGINT)

    def test_a_signal_stops_the_saving_of_a_checkpoint(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            self.stop_in("layers [^:]*: sweep", number, "--checkpoint", "run.ckpt", "--checkpoint-every", "0")
            (self.folder / "run.ckpt").unlink()


if __name__ == "__main__":
    unittest.main()
