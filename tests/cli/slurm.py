"""A Slurm of two nodes on this machine, for a test: no systemd, no root, no port or folder that another one has."""

import contextlib
import ctypes
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import time

DAEMONS = ("munged", "slurmctld", "slurmd")
PATH = os.pathsep.join((os.environ["PATH"], "/usr/sbin"))
CONFIGURATION = """\
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmUser={user}
SlurmdUser={user}
AuthInfo=socket={folder}/munge.socket,cred_expire=5
StateSaveLocation={folder}/controller
SlurmdSpoolDir={folder}/%n
TmpFS={folder}/%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/%n/slurmd.pid
MailProg=/bin/true
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
SchedulerParameters=sched_interval=1
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
KillWait=2
NodeName=node1 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[1]} CPUs=2
NodeName=node2 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[2]} CPUs=2
PartitionName=low Nodes=ALL Default=YES PriorityTier=1
PartitionName=high Nodes=ALL PriorityTier=2
"""
PR_SET_PDEATHSIG, PR_SET_CHILD_SUBREAPER = 1, 36
LIBC = ctypes.CDLL(None)


class NoSlurm(Exception):
    """Why there is none on this machine."""


def free_ports(number):
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(number)]
        for one in sockets:
            one.bind(("127.0.0.1", 0))
        return [one.getsockname()[1] for one in sockets]


def children(parent):
    """All below it: jobs, too, for this process is given those that have lost their parent."""
    with contextlib.suppress(OSError):
        for task in os.listdir(f"/proc/{parent}/task"):
            for child in pathlib.Path(f"/proc/{parent}/task/{task}/children").read_text().split():
                yield int(child)
                yield from children(child)


def poll(ready, seconds, what):
    """Waits until it is true. @raises AssertionError, which tells `what`"""
    end = time.monotonic() + seconds
    while not (answer := ready()):
        if time.monotonic() > end:
            raise AssertionError(f"not within {seconds} s: {what()}")
        time.sleep(0.02)
    return answer


class Slurm:
    """Runs in an empty folder from start() to stop(). @raises NoSlurm"""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.configuration = self.folder / "slurm.conf"
        self.daemons = []
        self.reason = ""
        self.environment = dict(os.environ, PATH=PATH, SLURM_CONF=str(self.configuration))

    def start(self):
        missing = [name for name in (*DAEMONS, "sbatch") if not shutil.which(name, path=PATH)]
        if missing:
            raise NoSlurm(f"there is no {missing[0]}: install slurm-wlm and munge")
        LIBC.prctl(PR_SET_CHILD_SUBREAPER, 1)
        for name in ("controller", "node1", "node2"):
            (self.folder / name).mkdir()
        key = self.folder / "munge.key"
        key.touch(0o600)
        key.write_bytes(os.urandom(64))
        for attempt in range(3):  # another process may take a port before we do
            ports = free_ports(3)
            text = CONFIGURATION.format(folder=self.folder, host=socket.gethostname(), user=os.geteuid(), ports=ports)
            self.configuration.write_text(text)
            if self.begins():
                return
            self.stop()
        raise NoSlurm(f"Slurm does not start here: {self.reason}")

    def begins(self):
        names = {"key-file": "munge.key", "socket": "munge.socket", "pid-file": "munge.pid", "log-file": "munge.log",
                 "seed-file": "munge.seed"}  # fmt: skip
        options = [f"--{option}={self.folder / name}" for option, name in names.items()]
        self.run_daemon("munged", "--foreground", "--force", *options)
        if not self.lives_until((self.folder / "munge.socket").exists):
            return False
        self.run_daemon("slurmctld", "-D", "-i")
        for node in ("node1", "node2"):
            self.run_daemon("slurmd", "-D", "-N", node)
        return self.lives_until(lambda: self.tool("sinfo", "-h", "-N", "-p", "low", "-o", "%T").split() == ["idle"] * 2)

    def run_daemon(self, name, *arguments):
        def end_with_parent():
            LIBC.prctl(PR_SET_PDEATHSIG, signal.SIGKILL)

        log = self.log_of(len(self.daemons))
        command = [shutil.which(name, path=PATH), *arguments]
        with open(log, "wb") as out:
            self.daemons.append(
                subprocess.Popen(command, env=self.environment, stdin=subprocess.DEVNULL, stdout=out, stderr=out,
                                 cwd=self.folder, preexec_fn=end_with_parent))  # fmt: skip

    def log_of(self, daemon):
        return self.folder / f"daemon{daemon}.log"

    def lives_until(self, ready):
        """False if a daemon ends before, or if it takes too long."""
        end = time.monotonic() + 30
        while time.monotonic() < end:
            for number, daemon in enumerate(self.daemons):
                if daemon.poll() is not None:
                    lines = self.log_of(number).read_text(errors="replace").strip().splitlines()
                    self.reason = f"{' '.join(daemon.args)}: {lines[-1] if lines else daemon.returncode}"
                    return False
            if ready():
                return True
            time.sleep(0.1)
        self.reason = "its nodes are not ready within 30 s"
        return False

    def tool(self, *command):
        """What a command of Slurm prints; nothing if it fails."""
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, timeout=60).stdout

    def stop(self):
        """Daemons, jobs, and all that they have started."""
        for daemon in reversed(self.daemons):
            daemon.terminate()
            with contextlib.suppress(subprocess.TimeoutExpired):
                daemon.wait(timeout=10)
        while left := list(children(os.getpid())):
            for process in left:
                with contextlib.suppress(ProcessLookupError):
                    os.kill(process, signal.SIGKILL)
            with contextlib.suppress(ChildProcessError):
                while os.waitpid(-1, os.WNOHANG)[0]:
                    pass
            time.sleep(0.02)
        self.daemons.clear()

    # Jobs

    def submit(self, *arguments, folder, **environment):
        """The number of a new job."""
        command = ["sbatch", "--parsable", *map(str, arguments)]
        result = subprocess.run(command, env={**self.environment, **environment}, cwd=folder, capture_output=True,
                                text=True, timeout=60)  # fmt: skip
        if result.returncode != 0:
            raise AssertionError(result.stderr)
        return result.stdout.strip()

    def job(self, number):
        """What Slurm says of it: JobState, ExitCode, Restarts, ..."""
        return dict(word.split("=", 1) for word in self.tool("scontrol", "show", "job", number).split() if "=" in word)

    def wait_for(self, number, *states):
        """The job, once it is in one of these states."""
        return poll(
            lambda: (job := self.job(number)).get("JobState") in states and job,
            600,
            lambda: f"{states}: {self.job(number)}",
        )
