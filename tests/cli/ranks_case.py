"""What tests of coordreq-mpi share: how ranks are started, looked at, and compared with one process."""

import json
import os
import pathlib
import shutil
import subprocess
import time
import unittest

from program import PROGRAM, Case, without_places

MPI_PROGRAM = os.environ.get("COORDREQ_MPI_PROGRAM", "")
MPIRUN = shutil.which(os.environ.get("COORDREQ_MPIRUN", "mpirun"))

# As root and on few cores; what is not for the MPI at hand it does not look at.
ENVIRONMENT = dict(
    os.environ,
    OMPI_ALLOW_RUN_AS_ROOT="1",
    OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
    OMPI_MCA_rmaps_base_oversubscribe="1",
    OMPI_MCA_hwloc_base_binding_policy="none",
    PRTE_MCA_rmaps_default_mapping_policy=":oversubscribe",
)

# The number of a rank in a shell, whichever MPI has started it.
RANK = "${OMPI_COMM_WORLD_RANK:-$PMI_RANK}"


def cells(path):
    summary = subprocess.run([PROGRAM, "validate", str(path), "--json"], capture_output=True, check=True)
    return json.loads(summary.stdout)["cells"]


@unittest.skipUnless(MPI_PROGRAM, "coordreq-mpi was not built: there is no MPI, or COORDREQ_MPI is OFF")
@unittest.skipUnless(MPIRUN, "there is no mpirun")
class RanksCase(Case):
    def command(self, ranks, *arguments):
        return [MPIRUN, "-n", str(ranks), MPI_PROGRAM, *arguments]

    def limited(self, ranks, limited, limit, *arguments):
        """With a limit of the shell in one of the ranks."""
        script = f'[ "{RANK}" != {limited} ] || {limit}; exec "$0" "$@"'
        return [MPIRUN, "-n", str(ranks), "sh", "-c", script, MPI_PROGRAM, *arguments]

    def run_command(self, command):
        return subprocess.run(command, capture_output=True, cwd=self.folder, timeout=280, env=ENVIRONMENT)

    def run_ranks(self, ranks, *arguments):
        return self.run_command(self.command(ranks, *arguments))

    def errors(self, result):
        """Our lines; mpirun adds some of its own."""
        return [line for line in without_places(result.stderr).decode().splitlines() if line.startswith("coordreq: ")]

    def assert_one_error(self, result, code, line):
        self.assertEqual(self.errors(result), ["coordreq: error: " + line])
        self.assertEqual((result.returncode, result.stdout), (code, b""))

    def assert_refused(self, code, line, *arguments):
        before = self.files()
        self.assert_one_error(self.run_ranks(3, *arguments), code, line)
        self.assertEqual(self.files(), before)

    def assert_same_bytes(self, path, counts, *arguments):
        one = self.run_program("analyze", str(path), "-o", "one.h5", "--json", *arguments)
        for ranks in counts:
            with self.subTest(example=path, ranks=ranks):
                many = self.run_ranks(ranks, "analyze", str(path), "-o", "many.h5", "--json", *arguments)
                self.assertEqual(many.returncode, one.returncode, many.stderr.decode())
                self.assertEqual((self.folder / "many.h5").read_bytes(), (self.folder / "one.h5").read_bytes())
                answers = [json.loads(result.stdout) for result in (one, many)]
                for answer in answers:
                    for key in ("output", "threads", "seconds", "work", "peak_memory_bytes", "warnings"):
                        del answer[key]
                self.assertEqual(*answers)
                (self.folder / "many.h5").unlink()

    def start(self, ranks, *arguments):
        """@returns mpirun and the ranks, which have begun"""
        process = subprocess.Popen(
            self.command(ranks, *arguments),
            cwd=self.folder,
            env=ENVIRONMENT,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        found = []
        for _ in range(3000):
            time.sleep(0.01)
            found = self.ranks_of(process.pid)
            if len(found) == ranks or process.poll() is not None:
                break
        return process, found

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
