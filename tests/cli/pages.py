"""Pages that show what the program does: their blocks, and what happens when they are run."""

import os
import pathlib
import re
import subprocess

from program import CONFIGS, PROGRAM, ROOT, Case

README = ROOT / "README.md"
DOCS = ROOT / "docs"
PAGES = sorted([*DOCS.glob("**/*.md"), CONFIGS / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "tests/README.md"])


def blocks(page, language):
    return re.findall(rf"(?ms)^```{language}\n(.*?)^```$", page.read_text())


def without_effort(text):
    text = re.sub(r"\([0-9.]+ s on [0-9]+ threads?(, [0-9.]+ MiB)?\)", "(effort)", text)
    text = re.sub(r"(?<=memory of analyze  about )[0-9.]+(?= MiB)", "N", text)
    text = re.sub(r"(?<=time of analyze    )(about [0-9].*|less than a second)", "N", text)
    return re.sub(r" +[0-9]+\.[0-9]{2} +[0-9.]+ MiB  ", " effort ", text)  # in a table


class PageCase(Case):
    def assert_sessions_happen(self, page, count):
        """So many console blocks, run in their order as from the project's root, print what they show."""
        (self.folder / "configs").symlink_to(CONFIGS)
        environment = dict(os.environ, PATH=f"{pathlib.Path(PROGRAM).parent}:{os.environ['PATH']}")
        sessions = blocks(page, "console")
        self.assertEqual(len(sessions), count)
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
            self.assertEqual(without_effort(result.stdout), without_effort(expected))

    def assert_programs_print(self, page, *expected):
        """The Python programs of a page, run where results lie."""
        programs = blocks(page, "python")
        self.assertEqual(len(programs), len(expected))
        for program, text in zip(programs, expected):
            command = ["/usr/bin/python3", "-c", program]
            result = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=True)
            self.assertEqual(result.stdout, text)

    def assert_notebook_prints(self, page):
        """The Python blocks of a page, one after the other in one process, print the text blocks that follow them."""
        parts = re.findall(r"(?ms)^```python\n(.*?)^```$(?:\s+```text\n(.*?)^```$)?", page.read_text())
        self.assertGreater(len(parts), 1)
        mark = "== end of a block\n"
        program = "".join(f"{code}print({mark.strip()!r})\n" for code, _ in parts)
        result = subprocess.run(["/usr/bin/python3", "-c", program], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(result.stdout, "".join(text + mark for _, text in parts))

    def assert_files_exist(self, page):
        """Links lead somewhere, and so do paths in the project that are named."""
        text = page.read_text()
        for target, anchor in re.findall(r"\]\((?!https?:)([^)#]*)(#[^)]*)?\)", text):
            linked = page.parent / target if target else page
            self.assertTrue(linked.exists(), f"{page.name}: {target}")
            if anchor:
                headings = re.findall(r"(?m)^#+ (.*)$", linked.read_text())
                anchors = ["#" + re.sub(r"[^\w -]", "", heading).lower().replace(" ", "-") for heading in headings]
                self.assertIn(anchor, anchors, f"{page.name}: {target}")
        for path in re.findall(r"`((?:configs|scripts|app|lib|tests)/[\w./]*)", text):
            self.assertTrue((ROOT / path).exists(), path)
