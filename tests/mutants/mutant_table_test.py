"""What mutant_table.py finds wrong with a table, and how it writes a fault."""

import pathlib
import tempfile
import unittest

import mutant_table

SOURCE = """int f(int a) {
  if (a > 3) return 1;
  g(a);
  return a;
}
"""
ENTRY = """[[mutant]]
name = "f.{name}"
file = "lib/a.cpp"
place = '{place}'
fault = '{fault}'
{rest}
"""


class MutantTable(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.write("lib/a.cpp", SOURCE)
        self.write("tests/base/a_test.cpp", "TEST(F, IsOneAboveThree) {\n")
        self.write("tests/cli/f_test.py", "    def test_f(self):\n")

    def write(self, path, text):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")

    def entry(self, place, fault, name="a", rest='found_by = "base.F.IsOneAboveThree"'):
        return ENTRY.format(place=place, fault=fault, name=name, rest=rest)

    def read(self, *entries):
        self.write("tests/mutants/base.toml", "\n".join(entries))
        return mutant_table.read(self.root)

    def problems(self, *entries):
        return mutant_table.problems(self.root, self.read(*entries))

    def written(self, *entries):
        return mutant_table.mutated_sources(self.root, self.read(*entries))["lib/a.cpp"]

    def test_nothing_is_wrong(self):
        self.assertEqual(self.problems(self.entry("if («a > 3»)", "a >= 3")), [])
        self.assertEqual(self.problems(self.entry("g(a);", "", rest='found_by = "cli.f.f"')), [])
        self.assertEqual(self.problems(self.entry("g(a);", "", rest='unseen = "g does nothing"')), [])

    def test_a_mark_around_less_than_an_expression(self):
        """The choice at run time would not compile."""
        self.assertEqual(
            self.problems(self.entry("if (a «>» 3)", ">=")),
            ["f.a: expected an expression or a statement between the marks, found >"],
        )

    def test_a_place_that_is_gone(self):
        self.assertEqual(
            self.problems(self.entry("if («a > 4»)", "a")),
            ["f.a: expected its text once in lib/a.cpp, found it 0 times"],
        )

    def test_a_place_that_is_not_the_only_one(self):
        self.assertEqual(
            self.problems(self.entry("return", "")), ["f.a: expected its text once in lib/a.cpp, found it 2 times"]
        )

    def test_places_that_overlap(self):
        entries = self.entry("(«a > 3») return", "a"), self.entry("return «1»;", "2", "b")
        self.assertEqual(self.problems(*entries), ["f.b: its text overlaps that of f.a"])

    def test_names_are_different(self):
        entries = self.entry("«a > 3»", "a"), self.entry("g(a);", "")
        self.assertEqual(self.problems(*entries), ["f.a: named twice"] * 2)

    def test_a_test_that_is_not_there(self):
        for test in ("base.F.IsTwoAboveThree", "cli.f.g", "base.F"):
            self.assertEqual(
                self.problems(self.entry("«a > 3»", "a", rest=f'found_by = "{test}"')),
                [f"f.a: there is no test {test}"],
            )

    def test_a_test_or_a_reason(self):
        for rest in ("", 'found_by = "cli.f.f"\nunseen = "why"'):
            self.assertEqual(
                self.problems(self.entry("g(a);", "", rest=rest)),
                ["f.a: expected either a test that finds it or why it is unseen"],
            )

    def test_an_expression_becomes_a_choice(self):
        asked = f"::coordreq::is_mutant({mutant_table.Mutant('f.a', '', '', '').number}U)"
        text = self.written(self.entry("if («a > 3»)", "a >= 3"))
        self.assertEqual(
            text, '#include "base/mutant.hpp"\n' + SOURCE.replace("a > 3", f"({asked} ? (a >= 3) : (a > 3))")
        )

    def test_a_statement_becomes_a_branch(self):
        asked = f"::coordreq::is_mutant({mutant_table.Mutant('f.a', '', '', '').number}U)"
        text = self.written(self.entry("g(a);", ""))
        self.assertIn(f"  {{ if ({asked}) {{  }} else {{ g(a); }} }}\n", text)


if __name__ == "__main__":
    unittest.main()
