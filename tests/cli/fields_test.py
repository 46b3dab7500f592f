"""docs/reference/fields.md is what the program declares."""

import pathlib
import subprocess
import unittest

from program import PROGRAM, ROOT, Case


class Cases(Case):
    def fields(self, root):
        return subprocess.run(
            ["/usr/bin/python3", str(root / "scripts/fields"), "--check", PROGRAM], capture_output=True, text=True, timeout=300
        )

    def test_the_page_is_what_the_program_declares(self):
        result = self.fields(ROOT)
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))

    def test_another_page_is_found(self):
        copy = pathlib.Path(self.folder)
        for name in ("scripts/fields", "docs/reference/fields.md"):
            (copy / name).parent.mkdir(parents=True, exist_ok=True)
            (copy / name).write_text((ROOT / name).read_text().replace("number of cells in Z_k", "number of cells in A_k"))
        self.assertEqual(self.fields(copy).returncode, 1)
        page = copy / "docs/reference/fields.md"
        page.write_text((ROOT / "docs/reference/fields.md").read_text())
        self.assertEqual(self.fields(copy).returncode, 0)


if __name__ == "__main__":
    unittest.main()
