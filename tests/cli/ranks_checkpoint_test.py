"""`coordreq-mpi --checkpoint FOLDER`: after kills any number of ranks goes on to the same bytes."""

import os
import random
import shutil
import signal
import subprocess
import time
import unittest

from checkpoint_pieces import take
from program import CONFIGS, SPEC, spec_with
from ranks_case import RanksCase

EXAMPLES = ("circle.json", "intersection_network.json", "swap_deadline.json", "platoon_coalition.json", "lane_change.json")
GOAL = spec_with(goal="x >= 2 and y >= 2", coordination={"convention": True, "partitions": "all"})
# Tables with entries for every cell, of which each rank saves its own.
COUPLED = spec_with(dynamics={"time": "discrete", "period": 1, "equations": {"x": "x - 0.1*x*y + u", "y": "y - 0.1*x*x + v"}})
EVERY = ("--checkpoint", "saved", "--checkpoint-every", "0", "--progress", "none")


class Cases(RanksCase):
    def changes_of_manifest(self):
        try:
            return os.stat(self.folder / "saved/coordreq-manifest").st_mtime_ns
        except FileNotFoundError:
            return None

    def kill_after(self, changes, ranks, *arguments):
        """Kills one rank as soon as the checkpoint has been saved so often. @returns whether it was at work"""
        process, found = self.start(ranks, "analyze", *arguments)
        last = self.changes_of_manifest()
        while process.poll() is None and changes > 0:
            now = self.changes_of_manifest()
            changes -= 1 if now is not None and now != last else 0
            last = now
        for rank in found[-1:]:
            try:
                os.kill(rank, signal.SIGKILL)
            except ProcessLookupError:
                pass
        process.communicate(timeout=60)
        return process.returncode not in (0, 1)

    def assert_goes_on(self, spec, seed):
        draw = random.Random(seed)
        one = self.run_program("analyze", spec, "-o", "one.h5", "--quiet")
        self.assertIn(one.returncode, (0, 1))
        arguments = (spec, "-o", "many.h5", "--quiet", *EVERY, "--resume")
        kills = 0
        for _ in range(3):
            kills += self.kill_after(draw.randint(1, 12), draw.choice((1, 2, 3, 5)), *arguments)
        many = self.run_ranks(draw.choice((1, 2, 3, 4)), "analyze", *arguments)
        self.assertEqual(many.returncode, one.returncode, many.stderr.decode())
        self.assertEqual((self.folder / "many.h5").read_bytes(), (self.folder / "one.h5").read_bytes())
        self.assertNotIn("saved", self.files())
        return kills

    def test_any_number_of_ranks_goes_on(self):
        kills = 0
        for seed, example in enumerate(EXAMPLES):
            with self.subTest(example=example, seed=seed):
                kills += self.assert_goes_on(str(CONFIGS / example), seed)
        self.write("goal.json", GOAL)
        kills += self.assert_goes_on("goal.json", len(EXAMPLES))
        self.write("coupled.json", COUPLED)
        kills += self.assert_goes_on("coupled.json", len(EXAMPLES) + 1)
        self.assertGreater(kills, len(EXAMPLES))

    def save(self, ranks=3):
        """A checkpoint in which a fixed point is under way."""
        spec = str(CONFIGS / "intersection_network.json")
        self.assertTrue(self.kill_after(6, ranks, spec, "-o", "o.h5", *EVERY))
        return spec

    def parts(self):
        """Those that count, and that the manifest names."""
        _, sections = take((self.folder / "saved/coordreq-manifest").read_bytes())
        (head,) = [head for head, _ in sections if head["section"] == "parts"]
        return [self.folder / f"saved/coordreq-part-{head['set']}-{rank}" for rank in range(head["parts"])]

    def assert_not_resumed(self, code, line, spec, *arguments):
        for path in (self.folder / "saved").iterdir():  # what a rank has not finished goes in any case
            if path not in self.parts() and path.name != "coordreq-manifest":
                path.unlink()
        before = {path.name: path.read_bytes() for path in (self.folder / "saved").iterdir()}
        result = self.run_ranks(2, "analyze", spec, "-o", "o.h5", *EVERY, *arguments)
        self.assert_one_error(result, code, line)
        after = {path.name: path.read_bytes() for path in (self.folder / "saved").iterdir()}
        self.assertEqual(after, before)

    def test_what_does_not_fit_is_refused(self):
        spec = self.save()
        parts = self.parts()
        self.assertEqual(len(parts), 3)
        message = "the checkpoint is there already, expected --resume to continue from it, or another file (saved)"
        self.assert_not_resumed(2, message, spec)
        kept = parts[1].read_bytes()
        whole = f"saved/{parts[1].name}"
        parts[1].write_bytes(kept[:-100] + bytes([kept[-100] ^ 1]) + kept[-99:])
        self.assert_not_resumed(3, f"this checkpoint is damaged: its checksum is wrong ({whole})", spec, "--resume")
        parts[1].write_bytes(parts[2].read_bytes())
        message = "this part of a checkpoint does not belong to its manifest"
        self.assert_not_resumed(3, f"{message} ({whole})", spec, "--resume")
        parts[1].unlink()
        self.assert_not_resumed(3, f"a part of the checkpoint is missing ({whole})", spec, "--resume")
        self.write("other.json", SPEC)
        result = self.run_ranks(2, "analyze", "other.json", *EVERY, "--resume")
        self.assertRegex(self.errors(result)[0], "error: the checkpoint was made from another spec: found SHA-256 ")
        self.assertEqual(result.returncode, 3)

    def test_a_place_that_is_no_folder(self):
        self.write("saved", "mine")
        self.write("spec.json", SPEC)
        self.assert_refused(5, "not a folder (saved)", "analyze", "spec.json", "--checkpoint", "saved")
        self.assert_refused(5, "the folder does not exist (no/saved)", "analyze", "spec.json", "--checkpoint", "no/saved")

    def test_what_others_keep_in_the_folder_stays(self):
        (self.folder / "saved").mkdir()
        self.write("saved/mine", "mine")
        self.write("spec.json", SPEC)
        self.assertEqual(self.run_ranks(2, "analyze", "spec.json", "--quiet", *EVERY).returncode, 0)
        self.assertEqual(os.listdir(self.folder / "saved"), ["mine"])

    def test_two_runs_with_one_folder(self):
        spec = str(CONFIGS / "intersection_network.json")
        process, ranks = self.start(2, "analyze", spec, "-o", "a.h5", "--refine", "3", *EVERY)
        while process.poll() is None and self.changes_of_manifest() is None:
            time.sleep(0.01)
        for rank in ranks:  # so that it is at work for as long as the other one tries
            os.kill(rank, signal.SIGSTOP)
        result = self.run_ranks(2, "analyze", spec, "-o", "b.h5", "--refine", "3", *EVERY, "--resume")
        for rank in ranks:
            os.kill(rank, signal.SIGCONT)
        self.assert_one_error(result, 5, "the checkpoint is in use, expected one run at a time to use it (saved/coordreq-manifest)")

    def test_a_rank_that_cannot_save(self):
        """The work goes on without."""
        shutil.copy(CONFIGS / "circle.json", self.folder)
        run = self.limited(3, 1, "ulimit -f 1", "analyze", "circle.json", "-o", "o.h5", *EVERY)
        result = self.run_command(run)
        self.assertEqual(result.returncode, 0)
        (line,) = self.errors(result)
        self.assertRegex(line, "^coordreq: warning: continuing without a new checkpoint: another rank cannot write")
        self.assertEqual(self.files(), ["circle.json", "o.h5"])


if __name__ == "__main__":
    unittest.main()
