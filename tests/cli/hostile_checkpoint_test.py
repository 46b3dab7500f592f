"""Checkpoints with right checksums and wrong contents, made from real ones: refused in one line, or harmless."""

import hashlib
import json
import os
import random
import subprocess
import unittest

import h5py
import numpy as np
from program import CONFIGS, PROGRAM, SANITIZED, Case, without_comments

DIGEST = 64
MOST_BYTES = 300 << 20
NUMBERS = [0, 1, 2, 3, 8, 100, 255, 2**20, 2**31 - 1, 2**31, 2**32, 2**40, 2**62, 2**63, 2**64 - 1]
LINE = ["--checkpoint-every", "0", "--quiet", "--max-memory", "200M", "--threads", "2"]


def sealed(data):
    """With the digest that a reader wants."""
    return data + hashlib.sha256(data).hexdigest().encode()


def lists_of(file):
    names = []
    file.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) else None)
    return names


def change_number(draw, file, name):
    values = file[name][()]
    flat = values.reshape(-1)
    number = draw.choice(NUMBERS)
    if values.dtype.kind == "f":
        number = draw.choice([float("nan"), float("inf"), -1.0, 2.0, 1e308])
    else:
        size = 8 * values.dtype.itemsize
        number = number % 2**size
        if values.dtype.kind == "i" and number >= 2 ** (size - 1):
            number -= 2**size
    place = draw.randrange(len(flat))
    flat[place : place + draw.choice([1, 1, 7, len(flat)])] = number
    file[name][...] = values


def change_shape(draw, file, name):
    values = file[name][()].reshape(-1)
    values = draw.choice([values[:-1], np.append(values, values), np.append(values, values[:1])])
    del file[name]
    file.create_dataset(name, data=values.reshape(1, -1) if draw.random() < 0.5 else values)


def change_type(draw, file, name):
    values = file[name][()].astype(draw.choice(["u1", "i8", "f4"]))
    del file[name]
    file[name] = values


def change_storage(draw, file, name):
    shape, kind = file[name].shape, file[name].dtype
    del file[name]
    draw.choice(
        [
            lambda: file.create_dataset(name, shape, kind, chunks=(1,) * len(shape)),
            lambda: file.create_dataset(name, (2**20, 2**30), kind, chunks=(2**10, 2**10), compression="gzip"),
            lambda: file.create_dataset(name, shape, kind, external=[("/dev/zero", 0, h5py.h5f.UNLIMITED)]),
            lambda: file.__setitem__(name, h5py.ExternalLink("/etc/passwd", "/x")),
            lambda: file.__setitem__(name, h5py.SoftLink("/" + name)),
        ]
    )()


def take_away(draw, file, name):
    del file[name if draw.random() < 0.5 else name.split("/")[0]]


def exchange(draw, file, name):
    other = draw.choice(lists_of(file))
    if other == name:
        return
    file.move(other, "kept")
    file.move(name, other)
    file.move("kept", name)


CHANGES = [change_number] * 6 + [change_shape, change_type, change_storage, take_away, exchange]


class Cases(Case):
    def saved(self, *arguments, times):
        """Some checkpoints of one run, each as it was after a step."""
        process = subprocess.Popen([PROGRAM, "analyze", *arguments, *LINE, "--checkpoint", "k"], cwd=self.folder)
        self.addCleanup(process.kill)
        found = {}
        while process.poll() is None and len(found) < times:
            try:
                data = (self.folder / "k").read_bytes()
            except FileNotFoundError:
                continue
            if b"stage" in data:  # something was finished
                found[len(data)] = data
        process.kill()
        process.wait()
        for name in self.folder.glob("k*"):  # with what the killed run had begun to write
            name.unlink()
        self.assertTrue(found)
        return list(found.values())

    def resume(self, spec, what):
        """Ends well, or with one line; never by a signal, and not with more memory than it may have."""
        before = self.files()
        process = subprocess.Popen(
            [PROGRAM, "analyze", spec, "-o", "o.h5", *LINE, "--checkpoint", "k", "--resume"],
            cwd=self.folder,
            stderr=subprocess.PIPE,
        )
        text = process.stderr.read().decode("utf-8", "replace")
        process.stderr.close()
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        self.assertIn(process.returncode, (0, 3, 4), f"{what}: {text}")
        if process.returncode != 0:
            self.assertRegex(text, r"\Acoordreq: error: .*\(k\)\n\Z", what)
            self.assertEqual(self.files(), before, what)
        if not SANITIZED:
            self.assertLess(used.ru_maxrss * 1024, MOST_BYTES, what)
        for name in ("k", "o.h5"):
            (self.folder / name).unlink(missing_ok=True)
        return process.returncode

    def attack(self, spec, seed, runs):
        draw = random.Random(seed)
        saved = self.saved(spec, "-o", "first.h5", times=8)
        codes = []
        for run in range(runs):
            self.write("k", draw.choice(saved)[:-DIGEST])
            what = []
            with h5py.File(self.folder / "k", "r+") as file:
                for _ in range(draw.choice([1, 1, 2, 5])):
                    change = draw.choice(CHANGES)
                    name = draw.choice(lists_of(file))
                    what.append(f"{change.__name__} {name}")
                    change(draw, file, name)
            self.write("k", sealed((self.folder / "k").read_bytes()))
            codes.append(self.resume(spec, f"run {run}: {what}"))
        self.assertGreater(codes.count(3), runs // 4)

    def config(self, name, **changes):
        spec = json.loads(without_comments((CONFIGS / f"{name}.json").read_text()))
        spec.update(changes)
        return self.write("spec.json", spec)

    def test_levels_and_tables(self):
        self.attack(self.config("platoon_coalition"), 1, 20)

    def test_sets_of_a_network(self):
        self.attack(self.config("platoon", network={"weakly_hard": {"misses": 1, "window": 3}}), 2, 15)

    def test_sums_and_a_convention(self):
        self.attack(self.config("load", coordination={"convention": True}), 3, 15)

    def test_the_library_s_own_parts(self):
        spec = self.config("circle")
        draw = random.Random(4)
        saved = self.saved(spec, "-o", "first.h5", times=4)
        for run in range(60):
            data = bytearray(draw.choice(saved)[:-DIGEST])
            places = [draw.randrange(len(data)) for _ in range(draw.choice([1, 3, 20]))]
            for place in places:
                data[place] = draw.choice([0, 1, 255, data[place] ^ 1 << draw.randrange(8)])
            self.write("k", sealed(bytes(data)))
            self.resume(spec, f"run {run}: bytes {places}")


if __name__ == "__main__":
    unittest.main()
