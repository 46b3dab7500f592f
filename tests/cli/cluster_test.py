"""The job scripts of configs/cluster under a real Slurm."""

import contextlib
import os
import pathlib
import shutil
import signal
import unittest

from program import CONFIGS, PROGRAM, Case
from slurm import PATH, NoSlurm, Slurm, children, poll

MPI_PROGRAM = os.environ.get("COORDREQ_MPI_PROGRAM", "")
SCRIPTS = CONFIGS / "cluster"
# Two nodes that are one machine cannot share memory as Open MPI thinks they can.
SEPARATE = {"OMPI_MCA_btl": "self,tcp", "OMPI_MCA_pml": "ob1", "OMPI_MCA_btl_tcp_if_include": "lo"}
# With more ranks on a node PMIx 4.2 at times lets one of them start, and send, before another can receive.
NODES = ("--nodes=2", "--ntasks-per-node=1")
LONG = str(CONFIGS / "intersection_network.json")


def why_no_ranks():
    if not MPI_PROGRAM:
        return "coordreq-mpi was not built: there is no MPI, or COORDREQ_MPI is OFF"
    if not shutil.which("srun", path=PATH):
        return "there is no srun: install slurm-wlm"
    return ""


def processes_of(program):
    """Those of jobs that run it."""
    for process in children(os.getpid()):
        with contextlib.suppress(OSError):
            if os.readlink(f"/proc/{process}/exe") == os.path.realpath(program):
                yield process


class Cases(Case):
    def setUp(self):
        super().setUp()
        (self.folder / "slurm").mkdir()
        (self.folder / "programs").mkdir()
        for program in filter(None, (PROGRAM, MPI_PROGRAM)):
            (self.folder / "programs" / pathlib.Path(program).name).symlink_to(program)
        self.slurm = Slurm(self.folder / "slurm")
        self.addCleanup(self.slurm.stop)
        try:
            self.slurm.start()
        except NoSlurm as reason:
            self.skipTest(str(reason))
        self.slurm.environment["PATH"] = f"{self.folder / 'programs'}{os.pathsep}{PATH}"

    def submit(self, script, *arguments, options=(), **environment):
        options = ["--output=job.log", "--cpus-per-task=1", *options]
        return self.slurm.submit(*options, SCRIPTS / script, *arguments, folder=self.folder, **environment)

    def log(self):
        log = self.folder / "job.log"
        return log.read_text() if log.exists() else ""

    def expected(self, spec):
        self.assertEqual(self.run_program("analyze", spec, "-o", "expected.h5", "--quiet").returncode, 0)
        return (self.folder / "expected.h5").read_bytes()

    def assert_completed(self, job):
        self.assertEqual(self.slurm.wait_for(job, "COMPLETED", "FAILED", "CANCELLED")["ExitCode"], "0:0", self.log())

    def start_long_analysis(self, *options, script="analyze.sbatch", program=PROGRAM, **environment):
        """The number of a job that has saved a checkpoint, and then stands still."""
        job = self.submit(script, LONG, "out.h5", "--checkpoint-every", "0.05", options=options, **environment)
        poll(lambda: "checkpoint yet" in self.log() and (self.folder / "out.h5.ckpt").exists(), 300, self.log)
        os.kill(max(processes_of(program)), signal.SIGSTOP)
        return job

    def assert_goes_on(self, job):
        expected = self.expected(LONG)
        poll(lambda: self.slurm.job(job).get("Restarts") == "1", 300, lambda: self.slurm.job(job))
        self.assert_completed(job)
        self.assertEqual((self.folder / "out.h5").read_bytes(), expected)
        lines = [line for line in self.log().splitlines() if "interrupted" not in line]
        started = [line for line in lines if "checkpoint (" in line or "checkpoint yet" in line]
        self.assertEqual(
            started,
            [
                "coordreq: no checkpoint yet, starting anew (out.h5.ckpt)",
                "coordreq: continuing from the checkpoint (out.h5.ckpt)",
            ],
        )
        self.assertFalse((self.folder / "out.h5.ckpt").exists())

    def test_a_job_near_its_time_limit_goes_on_in_another_run(self):
        job = self.start_long_analysis()
        # What --signal=B:USR1 does, without waiting for it.
        self.slurm.tool("scancel", "--batch", "--signal=USR1", job)
        self.assert_goes_on(job)

    def test_a_preempted_job_goes_on_in_another_run(self):
        job = self.start_long_analysis("--nodelist=node1")
        urgent = ("--partition=high", "--nodelist=node1", "--exclusive", "--output=urgent.log", "--wrap=true")
        self.slurm.wait_for(self.slurm.submit(*urgent, folder=self.folder), "COMPLETED")
        self.assert_goes_on(job)

    def test_what_is_wrong_ends_a_job(self):
        job = self.submit("analyze.sbatch", "none.json", "out.h5")
        state = self.slurm.wait_for(job, "COMPLETED", "FAILED")
        self.assertEqual((state["ExitCode"], state["Restarts"]), ("5:0", "0"))
        self.assertEqual(self.log(), "coordreq: error: no such file (none.json)\n")

    @unittest.skipIf(why_no_ranks(), why_no_ranks())
    def test_ranks_on_several_nodes(self):
        spec = str(CONFIGS / "circle.json")
        job = self.submit("analyze_ranks.sbatch", spec, "out.h5", options=NODES, **SEPARATE)
        expected = self.expected(spec)
        self.assert_completed(job)
        self.assertEqual((self.folder / "out.h5").read_bytes(), expected)

        (self.folder / "job.log").unlink()
        job = self.submit("analyze_ranks.sbatch", "none.json", "out.h5", options=NODES, **SEPARATE)
        self.assertEqual(self.slurm.wait_for(job, "COMPLETED", "FAILED")["ExitCode"], "5:0")
        self.assertIn("coordreq: error: no such file (none.json)\n", self.log())

    @unittest.skipIf(why_no_ranks(), why_no_ranks())
    def test_ranks_near_their_time_limit_go_on_in_another_run(self):
        job = self.start_long_analysis(*NODES, script="analyze_ranks.sbatch", program=MPI_PROGRAM, **SEPARATE)
        self.slurm.tool("scancel", "--batch", "--signal=USR1", job)
        self.assert_goes_on(job)

    @unittest.skipIf(why_no_ranks(), why_no_ranks())
    def test_a_rank_that_is_killed_ends_the_job(self):
        job = self.submit("analyze_ranks.sbatch", LONG, "out.h5", options=NODES, **SEPARATE)
        poll(lambda: "layers first|second: done" in self.log(), 300, self.log)
        os.kill(max(processes_of(MPI_PROGRAM)), signal.SIGKILL)
        self.assertNotEqual(self.slurm.wait_for(job, "COMPLETED", "FAILED")["ExitCode"], "0:0")
        self.assertFalse((self.folder / "out.h5").exists())

    @unittest.skipIf(why_no_ranks(), why_no_ranks())
    def test_a_table_of_numbers_of_ranks(self):
        before = self.files()
        job = self.submit("sweep_ranks.sbatch", str(CONFIGS / "swap.json"), options=NODES, **SEPARATE)
        self.assert_completed(job)
        head, *rows = self.log().splitlines()
        self.assertEqual(head.split(), "ranks nodes seconds MiB of a rank".split())
        self.assertEqual([row.split()[:2] for row in rows], [["1", "1"], ["2", "2"]])
        for row in rows:
            self.assertRegex(row, r"^ +\d+ +\d+ +\d+\.\d +[1-9]\d*$")
        self.assertEqual(self.files(), sorted([*before, "job.log"]))


if __name__ == "__main__":
    unittest.main(verbosity=2)
