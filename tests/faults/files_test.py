"""Places that cannot be written, kills, two writers of one file, pipes and devices in place of files."""

import json
import os
import signal
import socket
import subprocess
import tempfile
import time
import unittest

from program import PROGRAM, SPEC, Case, spec_with

FINE = spec_with(states=[{"name": name, "lower": 0, "upper": 1500, "step": 1, "outside": "unsafe"} for name in "xy"], safe="true")


class Cases(Case):
    def setUp(self):
        super().setUp()
        self.write("s.json", SPEC)

    def start(self, *arguments, **options):
        process = subprocess.Popen([PROGRAM, *arguments], cwd=self.folder, stderr=subprocess.PIPE, **options)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def temporary(self):
        return [name for name in self.files() if name.startswith(".coordreq-")]

    def test_places_that_cannot_be_written(self):
        os.mkfifo(self.folder / "pipe")
        (self.folder / "folder").mkdir()
        with socket.socket(socket.AF_UNIX) as server:
            server.bind(str(self.folder / "socket"))
        os.symlink("loop", self.folder / "loop")
        special = "this is a device, a pipe or a socket, not a regular file"
        for path, message in (
            ("none/o.h5", "the folder does not exist (none)"),
            ("s.json/o.h5", "cannot use the folder: Not a directory (s.json/o.h5)"),
            ("folder", "cannot write the results: this is a folder (folder)"),
            ("pipe", f"cannot write the results: {special} (pipe)"),
            ("socket", f"cannot write the results: {special} (socket)"),
            ("/dev/null", f"cannot write the results: {special} (/dev/null)"),
            ("/dev/full", f"cannot write the results: {special} (/dev/full)"),
            ("loop", "cannot write the results: too many symbolic links (loop)"),
            ("/proc/o.h5", "cannot create a file in the folder: No such file or directory (/proc)"),
        ):
            with self.subTest(path=path):
                if path == "s.json/o.h5":
                    message = "not a folder (s.json)"
                self.assert_fails(5, message, "analyze", "s.json", "-o", path)

    def test_name_that_is_too_long(self):
        result = self.run_program("analyze", "s.json", "-o", "x" * 300)
        self.assertEqual(result.returncode, 5)
        self.assertIn("File name too long", result.stderr.decode())
        self.assertEqual(self.files(), ["s.json"])

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_no_permission(self):
        (self.folder / "folder").mkdir(mode=0o555)
        result = self.run_program("analyze", "s.json", "-o", "folder/o.h5")
        self.assertEqual(result.returncode, 5)
        self.assertIn("Permission denied", result.stderr.decode())

    def test_standard_output_by_its_name(self):
        """A pipe, nothing, a file, and one that has been deleted."""
        result = self.run_program("analyze", "s.json", "-o", "/dev/stdout")
        self.assertEqual(result.returncode, 5)
        self.assertIn(b"this is a device, a pipe or a socket", result.stderr)
        result = subprocess.run(
            ["sh", "-c", 'exec "$0" analyze s.json -o /dev/stdout >&-', PROGRAM],
            cwd=self.folder,
            stderr=subprocess.PIPE,
        )
        self.assertEqual(result.returncode, 5)
        self.assertIn(b"this is a device, a pipe or a socket", result.stderr)
        with tempfile.TemporaryFile(dir=self.folder) as deleted:
            process = self.start("analyze", "s.json", "-o", "/dev/stdout", stdout=deleted)
            errors = process.communicate()[1].decode()
        self.assertEqual(process.returncode, 5)
        self.assertEqual(
            errors, "coordreq: error: cannot write the results: this file has no name any more (/dev/stdout)\n"
        )
        self.assertEqual(self.files(), ["s.json"])

    def test_kill_while_writing(self):
        self.write("fine.json", FINE)
        self.write("o.h5", "before")
        process = self.start("analyze", "fine.json", "-o", "o.h5", "--quiet")
        while process.poll() is None and not any(
            (self.folder / name).stat().st_size > 0 for name in self.temporary() if (self.folder / name).exists()
        ):
            time.sleep(0.001)
        process.kill()
        if process.wait() == -signal.SIGKILL:
            self.assertEqual((self.folder / "o.h5").read_text(), "before")
        result = self.run_program("analyze", "fine.json", "-o", "o.h5", "--quiet")
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        self.assertEqual(self.run_program("info", "o.h5", "--quiet").returncode, 0)
        self.assertEqual(self.files(), ["fine.json", "o.h5", "s.json"])

    def test_temporary_files_of_others_stay(self):
        """Of another machine or another name space, of a process that lives, and what only looks so."""
        process = self.start("analyze", "/dev/stdin", "--quiet", stdin=subprocess.PIPE)
        self.addCleanup(process.stdin.close)
        space, host, dead = os.stat("/proc/self/ns/pid").st_ino, socket.gethostname(), 2**22 + 1
        stay = [
            f".coordreq-other-{host}-{space}-{dead}-0.tmp",
            f".coordreq-{host}-{space + 1}-{dead}-0.tmp",
            f".coordreq-{host}-{space}-{process.pid}-0.tmp",
            f".coordreq-{host}-{space}-{dead}-0-1.tmp",
            ".coordreq-abcdef.tmp",
        ]
        for name in [*stay, f".coordreq-{host}-{space}-{dead}-0.tmp"]:
            self.write(name, "")
        self.analyze("s.json", "-o", "o.h5")
        self.assertEqual(self.files(), sorted([*stay, "o.h5", "s.json"]))

    def test_two_writers_of_one_file(self):
        self.analyze("s.json", "-o", "expected.h5")
        processes = [self.start("analyze", "s.json", "-o", "o.h5", "--quiet") for _ in range(8)]
        for process in processes:
            self.assertEqual((process.communicate()[1], process.returncode), (b"", 0))
        self.assertEqual((self.folder / "o.h5").read_bytes(), (self.folder / "expected.h5").read_bytes())
        self.assertEqual(self.files(), ["expected.h5", "o.h5", "s.json"])

    def test_spec_from_a_pipe(self):
        os.mkfifo(self.folder / "pipe")
        process = self.start("validate", "pipe", "--quiet")
        time.sleep(0.2)  # the program waits for a writer
        with (self.folder / "pipe").open("w") as pipe:
            pipe.write(json.dumps(SPEC)[:50])
            pipe.flush()
            time.sleep(0.2)  # and for the rest
            pipe.write(json.dumps(SPEC)[50:])
        self.assertEqual((process.communicate(timeout=60)[1], process.returncode), (b"", 0))
        result = subprocess.run(
            ["bash", "-c", '"$0" validate <(cat s.json) --quiet', PROGRAM], cwd=self.folder, capture_output=True
        )
        self.assertEqual((result.returncode, result.stderr), (0, b""))

    def test_pipes_that_nobody_writes_to(self):
        os.mkfifo(self.folder / "pipe")
        process = self.start("validate", "pipe")  # which waits for a writer, as there is no saying when one comes
        process.send_signal(signal.SIGINT)
        self.assertIn(process.wait(timeout=60), (130, -signal.SIGINT))
        message = "is a device, a pipe or a socket, expected a file with a controller (pipe)"
        self.assert_fails(5, message, "validate", "s.json", "--set", 'controller.file="pipe"')
        self.assert_fails(5, message, "analyze", "s.json", "--set", 'controller.file="pipe"')

    def test_spec_without_an_end(self):
        self.assert_fails(5, "is a device, expected a spec file (/dev/zero)", "validate", "/dev/zero")
        with open("/dev/zero", "rb") as zeros:
            process = self.start("validate", "-", stdin=zeros)
            errors = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 4)
        self.assertEqual(errors, b"coordreq: error: longer than 64 MiB, expected a spec (standard input)\n")


if __name__ == "__main__":
    unittest.main()
