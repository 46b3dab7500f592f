"""`mpirun -n N coordreq-mpi analyze`: the bytes of one process, and one line where that cannot be."""

import json
import pathlib
import re
import unittest

from program import CONFIGS, SANITIZED, SPEC, spec_with
from ranks_case import RanksCase, cells

FINE = spec_with(states=[{"name": name, "lower": 0, "upper": 1500, "step": 1, "outside": "unsafe"} for name in "xy"], safe="true")

# The others take long, and show no more.
MOST_CELLS = 300_000


def without_costs(table):
    """Lines of a table without the seconds and the memory that runs took, and without the width of columns."""
    return [" ".join(re.sub(r"\d+\.\d\d +\d+ .iB", "", line).split()) for line in table.decode().splitlines()]


class Cases(RanksCase):
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

    def test_what_is_wrong_is_said_once(self):
        self.write("bad.json", spec_with(safe="x + z <= 6"))
        self.assert_refused(3, "'z' is not defined (/safe, column 5)", "analyze", "bad.json")
        self.assert_refused(5, "no such file (none.json)", "analyze", "none.json")
        self.assert_refused(2, "no command, expected analyze")

    def test_words_are_read_as_one_process_reads_them(self):
        self.assert_refused(2, "unknown command 'analyse', did you mean 'analyze'?", "analyse", "spec.json")
        self.assert_refused(2, "no SPEC, expected the name of a file: coordreq-mpi analyze SPEC...", "analyze")
        self.assert_refused(2, "unknown option '--refien' of analyze, did you mean '--refine'?", "analyze", "a.json", "--refien")

    def test_an_error_that_shows_late_is_said_once(self):
        spec = spec_with(controller={"allow": "sqrt(x - 1) >= 0"})
        self.write("late.json", spec)
        one = self.run_program("analyze", "late.json")
        self.assertNotEqual(one.returncode, 0)
        result = self.run_ranks(3, "analyze", "late.json")
        self.assertEqual(self.errors(result), one.stderr.decode().splitlines())
        self.assertEqual(result.returncode, one.returncode)

    def told_of_ranks(self, ranks, *arguments):
        result = self.run_program("validate", *arguments, "--json", "--ranks", str(ranks), "--threads", "1")
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)["fullest_rank"]

    def test_rows_of_the_fullest_rank_are_told(self):
        """Posts of this grid go to the rows before and after."""
        self.write("fine.json", FINE)
        for ranks, own, halos in ((1, 1501, {0}), (2, 751, {1}), (3, 501, {1, 2})):
            told = self.told_of_ranks(ranks, "fine.json")
            self.assertAlmostEqual(told["rows"], own, delta=30)
            self.assertEqual(told["ranks"], ranks)
            self.assertIn(told["halo_rows"], halos)
        text = self.run_program("validate", "fine.json", "--ranks", "3").stdout.decode()
        self.assertRegex(text, r"fullest of 3 ranks +about \d+ MiB, \d+ rows of its own and [12] of others\n")

    def test_memory_of_the_fullest_rank_has_a_limit(self):
        """Far too much is refused at once: these tables would take minutes."""
        circle = (str(CONFIGS / "circle.json"), "--set", "/states/0/step=1e-7", "--set", "/states/1/step=1e-7")
        result = self.run_program("validate", *circle, "--ranks", "4", "--max-memory", "1G")
        need = "400,000,040,000,001 cells need about [0-9.]+ TiB of memory, on the fullest of 4 ranks at least, the limit is 1.0 GiB"
        self.assertRegex(result.stderr.decode(), rf"^coordreq: error: {need} \(--max-memory\)\n$")
        self.assertEqual((result.returncode, result.stdout), (4, b""))

        self.write("fine.json", FINE)
        told = self.told_of_ranks(2, "fine.json")["memory_bytes"]
        for most, code in ((told + 2**20, 0), (told - 2**20, 4)):
            result = self.run_program("validate", "fine.json", "--ranks", "2", "--threads", "1", "--max-memory", str(most))
            self.assertEqual(result.returncode, code, result.stderr)

    @unittest.skipIf(SANITIZED, "sanitisers take memory of their own")
    def test_memory_of_the_fullest_rank_is_kept(self):
        example = (str(CONFIGS / "intersection_network.json"), "--refine", "4")
        before = None
        for ranks in (1, 2, 4):
            told = self.told_of_ranks(ranks, *example)["memory_bytes"]
            result = self.run_ranks(ranks, "analyze", *example, "-o", "o.h5", "--json", "--max-memory", str(told + 2**22))
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertLess(json.loads(result.stdout)["peak_memory_bytes"], 1.1 * told)
            self.assertTrue(before is None or told < before)
            before = told

    def test_what_needs_more_memory_is_refused(self):
        spec = str(CONFIGS / "intersection_network.json")
        result = self.run_ranks(3, "analyze", spec, "--max-memory", "20M")
        (line,) = self.errors(result)
        need = "284,089 cells need about [0-9.]+ MiB of memory, on the fullest of 3 ranks, the limit is 20.0 MiB"
        self.assertRegex(line, rf"^coordreq: error: {need} \(--max-memory\)$")
        self.assertEqual((result.returncode, self.files()), (4, []))

    def test_what_ranks_have_exchanged_is_told(self):
        spec = str(CONFIGS / "circle.json")
        for ranks in (1, 3):
            result = self.run_ranks(ranks, "analyze", spec, "-o", "o.h5", "--json")
            works = json.loads(result.stdout)["work"]
            sent = [work.get("exchanged_bytes") for name, work in works.items() if name != "helpers"]
            self.assertEqual(sum(filter(None, sent)) > 0, ranks > 1)
            self.assertEqual(None in sent, ranks == 1)

    def report(self, name):
        return re.sub(r'time="[0-9.]*"', "", (self.folder / name).read_text())

    def test_several_analyses_one_by_one(self):
        """Whoever has done one gets the next; the table is that of one process."""
        fast, slow = str(CONFIGS / "circle.json"), str(CONFIGS / "swap.json")
        self.write("bad.json", spec_with(safe="x + z <= 6"))
        (self.folder / "one").mkdir()
        (self.folder / "many").mkdir()
        sweep = (fast, "bad.json", slow, "none.json", "--sweep", "coordination.max_delay=1,2,3", "--junit")
        one = self.run_program("analyze", *sweep, "one.xml", "-o", "one")
        for ranks in (1, 2, 5):
            many = self.run_ranks(ranks, "analyze", *sweep, "many.xml", "-o", "many")
            self.assertEqual(many.returncode, one.returncode)
            self.assertEqual(without_costs(many.stdout), [line.replace("files in one", "files in many") for line in without_costs(one.stdout)])
            self.assertEqual(self.errors(many), one.stderr.decode().splitlines())
            self.assertEqual(self.report("many.xml"), self.report("one.xml"))
            names = sorted(path.name for path in (self.folder / "one").iterdir())
            self.assertEqual(len(names), 6)
            for name in names:
                bytes_of = [(self.folder / folder / name).read_bytes() for folder in ("one", "many")]
                self.assertEqual(*bytes_of)
                (self.folder / "many" / name).unlink()
            self.assertEqual(list((self.folder / "many").iterdir()), [])
        self.assert_refused(2, "expected one analysis, found 3 (--checkpoint)", "analyze", *sweep[:1], *sweep[4:6], "--checkpoint", "c")

    def test_requirements_as_a_junit_report(self):
        self.write("spec.json", spec_with(requirements=[{"name": "two", "where": "true", "min_delay": 2}]))
        one = self.run_program("analyze", "spec.json", "--junit", "one.xml")
        many = self.run_ranks(3, "analyze", "spec.json", "--junit", "many.xml")
        self.assertEqual((one.returncode, many.returncode), (1, 1))
        self.assertEqual(self.report("many.xml"), self.report("one.xml"))
        message = "expected another file than the results, found 'x.xml' (--junit)"
        self.assert_refused(2, message, "analyze", "spec.json", "-o", "x.xml", "--junit", "x.xml")


if __name__ == "__main__":
    unittest.main()
