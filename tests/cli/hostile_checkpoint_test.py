"""Checkpoints with right checksums and wrong contents, made from real ones: refused in one line, or harmless."""

import json
import os
import random
import subprocess
import unittest

import numpy as np
from checkpoint_pieces import list_of, numbers, put, take
from program import CONFIGS, PROGRAM, SANITIZED, Case, without_comments

MOST_BYTES = 300 << 20
NUMBERS = [0, 1, 2, 3, 8, 100, 255, 2**20, 2**31 - 1, 2**31, 2**32, 2**40, 2**62, 2**63, 2**64 - 1]
ODD = [None, True, -1, 0, 1.5, "", "layers", "two\nlines", "\u2028", [], {}, *NUMBERS]
LINE = ["--quiet", "--max-memory", "200M", "--threads", "2", "--checkpoint", "k"]


def lists_of(sections):
    """Where lists are: the list of lists, and the place in it."""
    return [(lists, i) for _, lists in sections for i in range(len(lists))]


def change_number(draw, sections, lists, i):
    values = numbers(lists[i])
    flat = values.reshape(-1)
    number = draw.choice(NUMBERS)
    if values.dtype.kind == "f":
        number = draw.choice([float("nan"), float("inf"), -1.0, 2.0, 1e308])
        number = values.dtype.type(min(number, 3e38) if number == number else number)
    else:
        size = 8 * values.dtype.itemsize
        number = number % 2**size
        if values.dtype.kind == "i" and number >= 2 ** (size - 1):
            number -= 2**size
    place = draw.randrange(len(flat))
    flat[place : place + draw.choice([1, 1, 7, len(flat)])] = number
    lists[i] = list_of(values)


def change_shape(draw, sections, lists, i):
    values = numbers(lists[i]).reshape(-1)
    values = draw.choice([values[1:], np.append(values, values), np.append(values, values[:1])])
    if len(values) > 0:
        lists[i] = list_of(values.reshape(1, -1) if draw.random() < 0.5 else values.reshape(-1, 1))


def change_type(draw, sections, lists, i):
    with np.errstate(all="ignore"):
        lists[i] = list_of(numbers(lists[i]).astype(draw.choice(["u1", "i8", "f4"])))


def change_head(draw, sections, lists, i):
    """What is said of a list, or of a section, and is not so."""
    head = draw.choice([lists[i]["head"], draw.choice(sections)[0]])
    head[draw.choice(list(head))] = draw.choice(ODD)


def change_blocks(draw, sections, lists, i):
    """What is no packed block."""
    blocks = lists[i]["blocks"]
    place = draw.randrange(len(blocks))
    block = bytearray(blocks[place])
    for _ in range(draw.choice([1, 3, 20])):
        block[draw.randrange(len(block))] ^= 1 << draw.randrange(8)
    blocks[place] = draw.choice([bytes(block), bytes(block[:-1]), b"", b"\0" * 300_000])


def take_away(draw, sections, lists, i):
    if draw.random() < 0.5 or len(sections) == 1:
        del lists[i]
    else:
        del sections[draw.randrange(len(sections))]


def exchange(draw, sections, lists, i):
    others, k = draw.choice(lists_of(sections))
    lists[i], others[k] = others[k], lists[i]


CHANGES = [change_number] * 6 + [change_shape, change_type, change_head, change_blocks, take_away, exchange]


class Cases(Case):
    def saved(self, *arguments, times):
        """Some checkpoints of one run, each as it was after a step."""
        process = subprocess.Popen([PROGRAM, "analyze", *arguments, *LINE, "--checkpoint-every", "0"], cwd=self.folder)
        self.addCleanup(process.kill)
        found = {}
        while process.poll() is None and len(found) < times:
            try:
                data = (self.folder / "k").read_bytes()
            except FileNotFoundError:
                continue
            if b'"rows"' in data:  # something was finished
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
            [PROGRAM, "analyze", spec, "-o", "o.h5", *LINE, "--checkpoint-every", "1000", "--resume"],
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
            header, sections = take(draw.choice(saved))
            what = []
            for _ in range(draw.choice([1, 1, 2, 5])):
                places = lists_of(sections)
                if not places:
                    break
                change = draw.choice(CHANGES)
                what.append(change.__name__)
                change(draw, sections, *draw.choice(places))
                if change in (change_head, change_blocks):  # then it has no numbers to be changed
                    break
            self.write("k", put(header, sections))
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

    def test_pieces_are_put_together_as_they_were(self):
        """So that what is refused above is refused for what was changed."""
        spec = self.config("circle")
        data = self.saved(spec, "-o", "first.h5", times=2)[-1]
        header, sections = take(data)
        self.assertEqual(put(header, sections), data)
        sections = [(head, [list_of(numbers(own)) for own in lists]) for head, lists in sections]
        self.write("k", put(header, sections))
        self.assertEqual(self.resume(spec, "as it was"), 0)


if __name__ == "__main__":
    unittest.main()
