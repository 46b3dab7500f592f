"""`mpirun -n N coordreq-mpi analyze`: the bytes of one process, and one line where that cannot be."""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import time
import unittest

from program import CONFIGS, PROGRAM, SPEC, Case, spec_with

MPI_PROGRAM = os.environ.get("COORDREQ_MPI_PROGRAM", "")
MPIRUN = shutil.which("mpirun")

# As root and on few cores; what is not for the MPI at hand it does not look at.
ENVIRONMENT = dict(
    os.environ,
    OMPI_ALLOW_RUN_AS_ROOT="1",
    OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
    OMPI_MCA_rmaps_base_oversubscribe="1",
    OMPI_MCA_hwloc_base_binding_policy="none",
    PRTE_MCA_rmaps_default_mapping_policy=":oversubscribe",
)

# The others take long, and show no more.
MOST_CELLS = 300_000


def cells(path):
    summary = subprocess.run([PROGRAM, "validate", str(path), "--json"], capture_output=True, check=True)
    return json.loads(summary.stdout)["cells"]


@unittest.skipUnless(MPI_PROGRAM, "coordreq-mpi was not built: there is no MPI, or COORDREQ_MPI is OFF")
@unittest.skipUnless(MPIRUN, "there is no mpirun")
class Cases(Case):
    def command(self, ranks, *arguments):
        return [MPIRUN, "-n", str(ranks), MPI_PROGRAM, *arguments]

    def run_ranks(self, ranks, *arguments, **options):
        return subprocess.run(
            self.command(ranks, *arguments), capture_output=True, cwd=self.folder, timeout=280, env=ENVIRONMENT, **options
        )

    def errors(self, result):
        """Our lines; mpirun adds some of its own."""
        return [line for line in result.stderr.decode().splitlines() if line.startswith("coordreq: error: ")]

    def assert_same_bytes(self, path, counts, *arguments):
        one = self.run_program("analyze", str(path), "-o", "one.h5", "--json", *arguments)
        for ranks in counts:
            with self.subTest(example=path, ranks=ranks):
                many = self.run_ranks(ranks, "analyze", str(path), "-o", "many.h5", "--json", *arguments)
                self.assertEqual(many.returncode, one.returncode, many.stderr.decode())
                self.assertEqual((self.folder / "many.h5").read_bytes(), (self.folder / "one.h5").read_bytes())
                answers = [json.loads(result.stdout) for result in (one, many)]
                for answer in answers:
                    for key in ("output", "threads", "seconds", "work", "peak_memory_bytes"):
                        del answer[key]
                self.assertEqual(*answers)
                (self.folder / "many.h5").unlink()

    def test_examples_have_the_bytes_of_one_process(self):
        examples = sorted([*CONFIGS.glob("*.json"), *CONFIGS.glob("tutorial/*.json")])
        for path in examples:
            if cells(path) <= MOST_CELLS:
                self.assert_same_bytes(path, [3])

    def test_any_number_of_ranks_and_threads(self):
        for example in ("circle.json", "swap.json", "platoon_coalition.json"):
            self.assert_same_bytes(CONFIGS / example, [1, 2, 5, 8])
        self.assert_same_bytes(CONFIGS / "circle.json", [2], "--threads", "2")
        self.assert_same_bytes(CONFIGS / "aircraft_coarse.json", [4], "--set", "output.actions=true")

    def test_more_ranks_than_rows(self):
        self.write("small.json", SPEC)
        self.assert_same_bytes(pathlib.Path("small.json"), [8])

    def assert_refused(self, code, line, *arguments):
        before = self.files()
        result = self.run_ranks(3, *arguments)
        self.assertEqual(self.errors(result), ["coordreq: error: " + line])
        self.assertEqual((result.returncode, result.stdout), (code, b""))
        self.assertEqual(self.files(), before)

    def test_what_is_wrong_is_said_once(self):
        self.write("bad.json", spec_with(safe="x + z <= 6"))
        self.assert_refused(3, "'z' is not defined (/safe, column 5)", "analyze", "bad.json")
        self.assert_refused(5, "no such file (none.json)", "analyze", "none.json")
        self.assert_refused(2, "no command, expected analyze")

    def test_what_cannot_be_divided_is_refused_by_name(self):
        self.write("lists.json", spec_with(output={"layers": True}))
        message = "'layers' cannot be divided between ranks yet, expected one rank (/output/layers)"
        self.assert_refused(2, message, "analyze", "lists.json")

    def test_an_error_that_shows_late_is_said_once(self):
        spec = spec_with(controller={"allow": "sqrt(x - 1) >= 0"})
        self.write("late.json", spec)
        one = self.run_program("analyze", "late.json")
        self.assertNotEqual(one.returncode, 0)
        result = self.run_ranks(3, "analyze", "late.json")
        self.assertEqual(self.errors(result), one.stderr.decode().splitlines())
        self.assertEqual(result.returncode, one.returncode)

    def start_long_run(self):
        """With several ranks that are at work for some seconds."""
        spec = str(CONFIGS / "intersection_network.json")
        process = subprocess.Popen(
            self.command(3, "analyze", spec, "-o", "long.h5", "--refine", "2", "--progress", "none"),
            cwd=self.folder,
            env=ENVIRONMENT,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
        self.addCleanup(process.kill)
        ranks = []
        for _ in range(300):
            time.sleep(0.1)
            ranks = self.ranks_of(process.pid)
            if len(ranks) == 3:
                break
        self.assertEqual(len(ranks), 3)
        time.sleep(1)
        return process, ranks

    @staticmethod
    def ranks_of(launcher):
        """The processes below mpirun that run our program."""
        found, open_list = [], [launcher]
        while open_list:
            parent = open_list.pop()
            try:
                for task in os.listdir(f"/proc/{parent}/task"):
                    children = pathlib.Path(f"/proc/{parent}/task/{task}/children").read_text().split()
                    open_list += [int(child) for child in children]
                if os.readlink(f"/proc/{parent}/exe") == os.path.realpath(MPI_PROGRAM):
                    found.append(parent)
            except OSError:
                continue
        return sorted(found)

    def assert_nothing_is_left(self, process):
        process.communicate(timeout=60)
        self.assertNotEqual(process.returncode, 0)
        self.assertEqual(self.files(), [])

    def test_a_rank_that_is_killed_ends_all(self):
        for which in (0, -1):
            with self.subTest(which=which):
                process, ranks = self.start_long_run()
                os.kill(ranks[which], signal.SIGKILL)
                self.assert_nothing_is_left(process)

    def test_an_interrupt_ends_all(self):
        process, _ = self.start_long_run()
        process.send_signal(signal.SIGTERM)
        self.assert_nothing_is_left(process)


if __name__ == "__main__":
    unittest.main()
