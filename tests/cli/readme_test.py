"""What the README shows is what happens."""

import re
import unittest

from pages import README, PageCase
from program import CONFIGS, ROOT


class Cases(PageCase):
    def test_sessions(self):
        self.assert_sessions_happen(README, 1)

    def test_python(self):
        self.analyze(str(CONFIGS / "circle.json"))
        self.assert_programs_print(README, "25\n2029\n")

    def test_it_is_short(self):
        self.assertLess(README.stat().st_size, 14_000)

    def test_its_two_commands(self):
        (shown,) = re.findall(r"(?s)```sh\n(.*?)```", README.read_text())
        commands = [line.split()[0] for line in shown.splitlines()]
        self.assertEqual(commands, ["scripts/quickstart", "scripts/test", "export"])
        self.assertIn("scripts/test", (ROOT / ".ci/run").read_text())

    def test_files_that_it_names(self):
        self.assert_files_exist(README)


if __name__ == "__main__":
    unittest.main()
