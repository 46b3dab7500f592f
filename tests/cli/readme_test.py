"""What the README shows is what happens."""

import json
import os
import pathlib
import re
import subprocess
import unittest

import h5py
import numpy as np
from program import CONFIGS, PROGRAM, ROOT, Case, without_comments

README = (ROOT / "README.md").read_text()


def blocks(language):
    return re.findall(rf"(?ms)^```{language}\n(.*?)^```$", README)


class Cases(Case):
    def test_sessions(self):
        (self.folder / "configs").symlink_to(CONFIGS)
        environment = dict(os.environ, PATH=f"{pathlib.Path(PROGRAM).parent}:{os.environ['PATH']}")
        sessions = blocks("console")
        self.assertEqual(len(sessions), 14)
        for session in sessions:
            command, expected = re.fullmatch(r"(?s)\$ ([^\n]*)\n(.*)", session).groups()
            result = subprocess.run(
                command,
                shell=True,
                cwd=self.folder,
                env=environment,
                text=True,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
            )
            self.assertEqual(self.without_effort(result.stdout), self.without_effort(expected))

    @staticmethod
    def without_effort(text):
        text = re.sub(r"\([0-9.]+ s on [0-9]+ threads?(, [0-9.]+ MiB)?\)", "(effort)", text)
        return re.sub(r" +[0-9]+\.[0-9]{2} +[0-9.]+ MiB  ", " effort ", text)  # in a table

    def test_python(self):
        for example in ("circle", "platoon_coalition"):
            self.analyze(str(CONFIGS / f"{example}.json"))
        programs = blocks("python")
        self.assertEqual(len(programs), 4)
        printed = ("25\n2029\n", "lead+middle|tail\n2880\n", "", "(1, 201, 201) m\n")
        for program, expected in zip(programs, printed):
            result = subprocess.run(
                ["/usr/bin/python3", "-c", program],
                cwd=self.folder,
                capture_output=True,
                text=True,
                check=True,
            )
            self.assertEqual(result.stdout, expected)

        with h5py.File(self.folder / "first_come.h5") as written, h5py.File(CONFIGS / "first_come.h5") as example:
            self.assertTrue(np.array_equal(written["controller"][...], example["controller"][...]))

    def test_figures_of_the_crossing(self):
        rows = re.findall(r"(?m)^\| `(configs/crossing\w*\.json)` \|[^|]*\| (.*) \|$", README)
        self.assertEqual(len(rows), 4)
        for config, figures in rows:
            summary = self.analyze(str(ROOT / config))
            (partition,) = summary["partitions"]
            layers, never = partition["layers"], partition["fixed_point"]
            half = max(k for k, size in enumerate(layers) if 2 * size >= layers[0])
            bears = "for ever" if 2 * never >= layers[0] else f"{half} s"
            longest = f"{partition['F'] - 1} s" if partition["F"] > 0 else "-"
            self.assertEqual(figures.split(" | "), [f"{summary['invariant']:,}", bears, longest, f"{never:,}"])

    def test_networks(self):
        rows = re.findall(r"(?m)^\| `(\{.*\})`.* \| ([0-9,]+) \| ([0-9,]+) \|$", README)
        self.assertEqual(len(rows), 6)
        spec = json.loads(without_comments((CONFIGS / "intersection_network.json").read_text()))
        for row in rows:
            network = json.loads(row[0].replace("\\|", "|"))
            for resynthesise, expected in zip((False, True), row[1:]):
                with self.subTest(network=network, resynthesise=resynthesise):
                    self.write("spec.json", dict(spec, network=dict(network, resynthesise=resynthesise)))
                    found = self.analyze("spec.json")["network"]
                    self.assertEqual(f"{found['modes'][0]['cells']:,}", expected)

    def test_spec(self):
        (spec,) = blocks("jsonc")
        result = self.run_program("validate", "-", stdin=spec.encode())
        self.assertEqual((result.returncode, result.stderr), (0, b""))

    def test_files_that_it_names(self):
        for path in re.findall(r"`((?:configs|scripts|app|lib|tests)/[\w./]*)", README):
            self.assertTrue((ROOT / path).exists(), path)


if __name__ == "__main__":
    unittest.main()
