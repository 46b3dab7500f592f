"""What the README shows is what happens."""

import unittest

from pages import README, PageCase, blocks
from program import CONFIGS


class Cases(PageCase):
    def test_sessions(self):
        self.assert_sessions_happen(README, 9)

    def test_python(self):
        self.analyze(str(CONFIGS / "circle.json"))
        self.assert_programs_print(README, "25\n2029\n", "(1, 201, 201) m\n")

    def test_spec(self):
        (spec,) = blocks(README, "jsonc")
        result = self.run_program("validate", "-", stdin=spec.encode())
        self.assertEqual((result.returncode, result.stderr), (0, b""))

    def test_files_that_it_names(self):
        self.assert_files_exist(README)


if __name__ == "__main__":
    unittest.main()
