"""What the README shows is what happens."""

import unittest

from pages import README, PageCase
from program import CONFIGS


class Cases(PageCase):
    def test_sessions(self):
        self.assert_sessions_happen(README, 1)

    def test_python(self):
        self.analyze(str(CONFIGS / "circle.json"))
        self.assert_programs_print(README, "25\n2029\n")

    def test_it_is_short(self):
        self.assertLess(README.stat().st_size, 14_000)

    def test_files_that_it_names(self):
        self.assert_files_exist(README)


if __name__ == "__main__":
    unittest.main()
