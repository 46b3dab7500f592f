"""Analyses that are killed and go on from their checkpoint."""

import hashlib
import json
import os
import random
import shutil
import signal
import subprocess
import time
import unittest

from program import CONFIGS, PROGRAM, SPEC, Case, spec_with, without_comments, without_warnings

CIRCLE = str(CONFIGS / "circle.json")
CHECKPOINT = ["--checkpoint", "run.ckpt"]
RESUME = [*CHECKPOINT, "--resume"]
OFTEN = ["--checkpoint-every", "0"]  # after every step
FREQUENTLY = ["--checkpoint-every", "0.05"]  # where there are many


def identity(path):
    """Changes with every new checkpoint, for that is another file under the same name."""
    try:
        status = path.stat()
    except FileNotFoundError:
        return None
    return status.st_ino, status.st_mtime_ns


class Cases(Case):
    def start(self, *arguments):
        process = subprocess.Popen(
            [PROGRAM, "analyze", *arguments], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def run_until_saved(self, times, number, *arguments):
        """Ends a run with a signal once so many checkpoints have been seen. False if it was done before."""
        process = self.start(*arguments)
        path = self.folder / "run.ckpt"
        seen = identity(path)
        while times > 0 and process.poll() is None:
            now = identity(path)
            if now is not None and now != seen:
                times -= 1
            seen = now
            time.sleep(0.0005)
        process.send_signal(number)
        code = process.wait(timeout=60)
        self.assertIn(code, (0, 1, 130, -signal.SIGKILL))
        return code not in (0, 1)

    def interrupted(self, spec, *arguments, when):
        """What is said last by a run that a signal ends as soon as `when(process)` holds."""
        process = subprocess.Popen(
            [PROGRAM, "analyze", spec, "-o", "out.h5", *CHECKPOINT, *arguments],
            cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        )  # fmt: skip
        with process:
            while not when(process) and process.poll() is None:
                time.sleep(0.001)
            process.send_signal(signal.SIGINT)
            output, errors = process.communicate(timeout=120)
        self.assertEqual((process.returncode, output), (130, b""))
        return errors.decode().splitlines()[-1]

    def test_an_interrupt_says_how_to_continue(self):
        is_saved = (self.folder / "run.ckpt").exists
        line = self.interrupted(CIRCLE, "--refine", "8", *OFTEN, "--json", when=lambda process: is_saved())
        self.assertEqual(line, "coordreq: error: interrupted; --resume continues from the checkpoint (run.ckpt)")

    def test_an_interrupt_says_that_nothing_is_saved(self):
        """In the first stage, which takes seconds of the processor here."""
        states = [{"name": name, "lower": -2, "upper": 2, "step": 0.002, "outside": "unsafe"} for name in "xy"]
        equations = {"x": "sin(x*y) + u", "y": "cos(x) - x*y + v"}
        dynamics = {"time": "continuous", "period": 0.5, "equations": equations}
        self.write("slow.json", spec_with(states=states, dynamics=dynamics, safe="true"))

        def is_at_work(process):
            used = open(f"/proc/{process.pid}/stat").read().rsplit(")", 1)[1].split()
            return int(used[11]) >= 0.5 * os.sysconf("SC_CLK_TCK")

        line = self.interrupted("slow.json", when=is_at_work)
        expected = "coordreq: error: interrupted; no checkpoint had been saved, see --checkpoint-every (run.ckpt)"
        self.assertEqual(line, expected)
        self.assertEqual(self.files(), ["slow.json"])

    def analyze_to(self, name, *arguments):
        return self.analyze_and_say(name, *arguments)[0]

    def analyze_and_say(self, name, *arguments):
        """The results file, and the JSON summary without what is that of one run."""
        result = self.run_program("analyze", *arguments, "-o", name, "--json")
        self.assertIn(result.returncode, (0, 1), result.stderr)
        said = json.loads(result.stdout)
        for own in ("output", "seconds", "work", "peak_memory_bytes"):
            del said[own]
        self.said_on_the_way = without_warnings(result.stderr).decode()
        return (self.folder / name).read_bytes(), said

    def kill_and_resume(self, spec, seed, number=signal.SIGKILL, saves=(1, 3, 10, 30), often=OFTEN):
        expected = self.analyze_and_say("expected.h5", spec)
        draw = random.Random(seed)
        killed = 0
        arguments = (spec, "-o", "out.h5", *RESUME, *often)
        for _ in range(4):
            if not self.run_until_saved(draw.choice(saves), number, *arguments):
                if killed > 0:
                    break
                # A machine that is busy has saved less often.
                (self.folder / "out.h5").unlink()
                if not self.run_until_saved(1, number, *arguments):
                    break
            killed += 1
            self.assertNotIn("out.h5", self.files())
        self.assertGreater(killed, 0)
        found = self.analyze_and_say("out.h5", spec, *RESUME)
        self.assertRegex(
            self.said_on_the_way,
            r"^coordreq: (continuing from the checkpoint|no checkpoint yet, starting anew) \(run.ckpt\)\n$",
        )
        self.assertEqual(found, expected)
        self.assertNotIn("run.ckpt", self.files())
        self.assertEqual([name for name in self.files() if name.endswith(".new")], [])

    def config(self, name, **changes):
        spec = json.loads(without_comments((CONFIGS / f"{name}.json").read_text()))
        for file in CONFIGS.glob("*.h5"):
            shutil.copy(file, self.folder)
        spec.update(changes)
        return self.write("spec.json", spec)

    def test_one_partition(self):
        self.kill_and_resume(self.config("circle"), 1)

    def test_several_partitions_and_a_coalition_map(self):
        self.kill_and_resume(self.config("platoon_coalition"), 2)

    def test_requirements_that_fail(self):
        self.kill_and_resume(self.config("intersection_requirements"), 3)

    def test_a_given_controller(self):
        controller = {"file": "first_come.h5", "synthesis": "given"}
        self.kill_and_resume(self.config("crossing_first_come", controller=controller), 4)

    def test_a_restricting_controller_and_all_outputs(self):
        output = {"controller": True, "actions": True, "layers": True, "abstraction": True}
        self.kill_and_resume(self.config("crossing_first_come", output=output), 5)

    def test_a_network(self):
        self.kill_and_resume(self.config("intersection_network"), 6, saves=(1, 3, 5), often=FREQUENTLY)

    def test_a_network_of_careful_agents(self):
        network = {"weakly_hard": {"misses": 1, "window": 3}, "resynthesise": True}
        self.kill_and_resume(self.config("platoon", network=network), 7, saves=(1, 3, 5), often=FREQUENTLY)

    def test_coupled_dynamics(self):
        self.kill_and_resume(self.config("aircraft_coarse"), 8)

    def test_sums_and_a_convention(self):
        spec = json.loads(without_comments((CONFIGS / "load.json").read_text()))
        spec["coordination"] = {"convention": True}
        self.kill_and_resume(self.write("spec.json", spec), 9)

    def test_between_samples(self):
        abstraction = {"cells": "half_open", "safe": "inner", "between_samples": True}
        self.kill_and_resume(self.config("circle", abstraction=abstraction), 10)

    def test_delays_of_more_than_eight_bits(self):
        spec = spec_with(
            states=[
                {"name": "x", "lower": 0, "upper": 600, "step": 1, "outside": "saturate"},
                {"name": "y", "lower": 0, "upper": 2, "step": 1, "outside": "saturate"},
            ],
            inputs=[{"name": "u", "values": [0, 1]}, {"name": "v", "values": [0, 1]}],
            dynamics={
                "time": "discrete",
                "period": 1,
                "equations": {"x": "x - if(u != v, 1, 0)", "y": "y + 0*u"},
            },
            safe="x >= 1",
        )
        self.kill_and_resume(self.write("spec.json", spec), 11)

    def test_after_a_signal_that_can_be_caught(self):
        self.kill_and_resume(self.config("circle"), 12, signal.SIGTERM)

    def test_a_killed_run_goes_on_and_does_not_start_anew(self):
        spec = self.config("intersection_network")
        process = subprocess.Popen(
            [PROGRAM, "analyze", spec, *CHECKPOINT, *FREQUENTLY, "--progress", "log", "--progress-every", "0"],
            cwd=self.folder,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
        )
        with process:
            sweeps = (line for line in process.stderr if line.startswith(b"coordreq: network: sweep"))
            next(sweeps)
            for _ in range(2):  # the first may have begun before
                saved = identity(self.folder / "run.ckpt")
                self.assertTrue(any(identity(self.folder / "run.ckpt") != saved for _ in sweeps))
            process.kill()
        result = self.run_program("analyze", spec, *RESUME, "--json", "--quiet")
        self.assertEqual(result.stderr, b"")
        work = json.loads(result.stdout)["work"]
        none = {"sweeps": 0, "rows_visited": 0, "rows_skipped": 0}
        self.assertEqual(work["invariance"], none)
        self.assertEqual(work["layers first|second"], none)
        self.assertGreater(work["network"]["sweeps"], 0)

    def test_killed_in_the_writing(self):
        output = {"controller": True, "actions": True, "layers": True}
        spec = self.config("crossing", coordination={"convention": True}, output=output)
        expected = self.analyze_and_say("expected.h5", spec)
        log = ["--progress", "log", "--progress-every", "0"]
        for _ in range(5):
            process = subprocess.Popen(
                [PROGRAM, "analyze", spec, "-o", "out.h5", *RESUME, *OFTEN, *log],
                cwd=self.folder,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
            )
            with process:
                self.assertIsNotNone(next((line for line in process.stderr if b"convention: done" in line), None))
                process.kill()
            if (self.folder / "run.ckpt").exists():  # else it was faster
                break
        self.assertNotIn("out.h5", self.files())
        found = self.analyze_and_say("out.h5", spec, *RESUME)
        self.assertEqual(self.said_on_the_way, "coordreq: continuing from the checkpoint (run.ckpt)\n")
        self.assertEqual(found, expected)

    def test_nothing_is_left_of_a_run_that_ends(self):
        self.analyze(CIRCLE, *CHECKPOINT, *OFTEN)
        self.assertEqual(self.files(), ["circle.h5"])
        self.assert_prints("", "analyze", CIRCLE, *CHECKPOINT, *OFTEN, "--resume", "--quiet")
        self.assertEqual(self.files(), ["circle.h5"])

    def test_a_link_to_the_checkpoint_stays(self):
        (self.folder / "disk").mkdir()
        (self.folder / "run.ckpt").symlink_to("disk/state")
        spec = self.config("circle")
        self.assertTrue(self.run_until_saved(3, signal.SIGKILL, spec, "-o", "out.h5", *RESUME, *OFTEN))
        self.assertTrue((self.folder / "disk/state").exists())
        self.analyze(spec, *RESUME, "--quiet")
        self.assertTrue((self.folder / "run.ckpt").is_symlink())
        self.assertEqual([path.name for path in (self.folder / "disk").iterdir() if path.name == "state"], [])

    def test_without_a_checkpoint_resume_starts_anew_and_says_so(self):
        result = self.run_program("analyze", CIRCLE, *RESUME)
        self.assertEqual(result.returncode, 0)
        self.assertEqual(
            result.stderr, b"coordreq: no checkpoint yet, starting anew (run.ckpt)\n"
        )

    def saved_checkpoint(self, spec="spec.json", content=SPEC):
        """The bytes of a checkpoint of a run that was killed."""
        self.write(spec, content)
        arguments = [spec, "-o", "out.h5", *CHECKPOINT, *OFTEN]
        for times in (2, 1, 1, 1):
            if self.run_until_saved(times, signal.SIGKILL, *arguments):
                break
            (self.folder / "out.h5").unlink()
        for path in self.folder.glob("*.new"):
            path.unlink()
        return (self.folder / "run.ckpt").read_bytes()

    def test_a_checkpoint_is_not_overwritten(self):
        before = self.saved_checkpoint()
        message = (
            "the checkpoint is there already, expected --resume to continue from it, or another file (run.ckpt)"
        )
        self.assert_fails(2, message, "analyze", "spec.json", *CHECKPOINT)
        self.assertEqual((self.folder / "run.ckpt").read_bytes(), before)

    def test_damage_anywhere_is_found(self):
        good = self.saved_checkpoint()
        draw = random.Random(20)
        places = [0, len(good) - 1, *draw.sample(range(len(good)), 40)]
        for place in places:
            bad = bytearray(good)
            bad[place] ^= 1 << draw.randrange(8)
            self.write("run.ckpt", bytes(bad))
            self.assert_damaged(f"byte {place}")
        for length in [0, 1, len(good) - 1, *draw.sample(range(len(good)), 10)]:
            self.write("run.ckpt", good[:length])
            self.assert_damaged(f"{length} bytes")
        self.write("run.ckpt", good + b"x")
        self.assert_damaged("a byte more")

    def assert_damaged(self, what):
        before = self.files()
        result = self.run_program("analyze", "spec.json", *RESUME)
        self.assertEqual(result.returncode, 3, what)
        self.assertRegex(
            result.stderr.decode(),
            r"^coordreq: error: this (checkpoint is damaged: [a-z ]+|is no checkpoint, or a part of one) \(run.ckpt\)\n$",
            what,
        )
        self.assertEqual(self.files(), before)

    def test_another_file_is_no_checkpoint(self):
        self.write("spec.json", SPEC)
        self.write("run.ckpt", "hello")
        self.assert_fails(3, "this is no checkpoint, or a part of one (run.ckpt)", "analyze", "spec.json", *RESUME)
        self.analyze("spec.json", "-o", "run.ckpt")
        message = "this is HDF5: a checkpoint of an earlier version of coordreq, or none (run.ckpt)"
        self.assert_fails(3, message, "analyze", "spec.json", *RESUME)

    def test_a_checkpoint_of_another_spec_is_refused(self):
        self.saved_checkpoint()
        digest = hashlib.sha256((self.folder / "spec.json").read_bytes()).hexdigest()
        self.write("other.json", spec_with(safe="x + y <= 5"))
        other = hashlib.sha256((self.folder / "other.json").read_bytes()).hexdigest()
        self.assert_fails(
            3,
            f"the checkpoint was made from another spec: found SHA-256 {digest}, expected {other} (run.ckpt)",
            "analyze",
            "other.json",
            *RESUME,
        )

    def test_a_checkpoint_with_another_controller_is_refused(self):
        self.analyze_to("first.h5", self.write("plain.json", spec_with(output={"controller": True})))
        first = (self.folder / "first.h5").read_bytes()
        self.analyze_to(
            "second.h5", self.write("strict.json", spec_with(output={"controller": True}, safe="x + y <= 5"))
        )
        second = (self.folder / "second.h5").read_bytes()
        self.write("c.h5", first)
        self.saved_checkpoint(content=spec_with(controller={"file": "c.h5"}))
        self.write("c.h5", second)
        self.assert_fails(
            3,
            f"the checkpoint was made with another controller: found SHA-256 {hashlib.sha256(first).hexdigest()}, "
            f"expected {hashlib.sha256(second).hexdigest()} (run.ckpt)",
            "analyze",
            "spec.json",
            *RESUME,
        )

    def test_a_second_run_waits_for_nobody(self):
        spec = self.config("intersection_network")
        process = self.start(spec, "-o", "first.h5", *CHECKPOINT, *OFTEN)
        while not (self.folder / "run.ckpt").exists() and process.poll() is None:
            time.sleep(0.001)
        result = self.run_program("analyze", spec, "-o", "second.h5", *RESUME)
        if process.poll() is None:
            self.assertEqual(result.returncode, 5)
            self.assertEqual(
                result.stderr.decode(),
                "coordreq: error: the checkpoint is in use, expected one run at a time to use it (run.ckpt)\n",
            )

    def test_other_files_are_left_alone(self):
        self.write("run.ckpt.new", "mine")
        self.write("run.ckpt.1-0.new.txt", "mine too")
        self.analyze(CIRCLE, *CHECKPOINT, *OFTEN)
        self.assertEqual(self.files(), ["circle.h5", "run.ckpt.1-0.new.txt", "run.ckpt.new"])
        self.assertEqual((self.folder / "run.ckpt.new").read_bytes(), b"mine")

    def test_where_it_cannot_be(self):
        self.write("spec.json", SPEC)
        (self.folder / "folder").mkdir()
        for path, message in (
            ("no/run.ckpt", "the folder does not exist (no)"),
            ("folder", "cannot write the checkpoint: this is a folder (folder)"),
        ):
            self.assert_fails(5, message, "analyze", "spec.json", "--checkpoint", path)
        self.assert_fails(
            2, "expected another file than the results, found './out.h5' (--checkpoint)",
            "analyze", "spec.json", "-o", "out.h5", "--checkpoint", "./out.h5",
        )  # fmt: skip

    def test_options_that_need_a_checkpoint(self):
        for message, *options in (
            ("resume from what? expected --checkpoint FILE (--resume)", "--resume"),
            ("save where? expected --checkpoint FILE (--checkpoint-every)", "--checkpoint-every", "5"),
            (
                "expected a number of seconds from 0, found '-1' (--checkpoint-every)",
                *CHECKPOINT,
                "--checkpoint-every",
                "-1",
            ),
            ("expected the name of a file, found '-' (--checkpoint)", "--checkpoint", "-"),
        ):
            self.assert_fails(2, message, "analyze", CIRCLE, *options)

    def test_work_goes_on_where_saving_fails(self):
        expected = self.analyze_to("expected.h5", CIRCLE)
        (self.folder / "disk").mkdir()
        path = self.folder / "disk/run.ckpt"
        process = subprocess.Popen(
            [PROGRAM, "analyze", CIRCLE, "-o", "out.h5", "--checkpoint", "disk/run.ckpt", *OFTEN],
            cwd=self.folder,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
        )
        with process:
            while process.poll() is None and not path.exists():
                time.sleep(0.001)
            shutil.rmtree(self.folder / "disk", ignore_errors=True)
            shutil.rmtree(self.folder / "disk", ignore_errors=True)
            errors = process.stderr.read().decode()
        self.assertEqual(process.returncode, 0)
        self.assertRegex(errors, r"^coordreq: warning: continuing without a new checkpoint: .*\n$")
        self.assertEqual((self.folder / "out.h5").read_bytes(), expected)


if __name__ == "__main__":
    unittest.main()
