"""coordreq(1): no warnings from groff, and everything that --help says."""

import os
import pathlib
import re
import subprocess
import unittest

import program_help
from program import ROOT, Case

PAGE = pathlib.Path(os.environ["COORDREQ_MAN_PAGE"])


class Cases(Case):
    def groff(self, *options):
        result = subprocess.run(["groff", "-man", *options, str(PAGE)], capture_output=True, timeout=60)
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        return result.stdout.decode()

    def sections(self):
        """{heading: its text, each paragraph on one line}, of lines that are long enough for everything."""
        text = self.groff("-Tutf8", "-P-cbou", "-rLL=2000n", "-rHY=0")
        sections, heading = {}, None
        for line in text.splitlines():
            if line.strip() and not line.startswith("    "):
                heading = line.strip()
                sections[heading] = ""
            elif heading:
                sections[heading] += " ".join(line.replace("\u2010", "-").split()) + "\n"
        return sections

    def assert_describes(self, section, options):
        for name, (value, description) in options.items():
            option = f"{name} {value}".strip()
            self.assertRegex(section, rf"(?m)^(-\w, )?{option.replace('|', '[|]')}\s{description_pattern(description)}$")

    def test_no_warnings(self):
        self.groff("-ww", "-z")

    def test_everything_in_the_help_is_in_the_page(self):
        general = self.run_program("--help").stdout.decode()
        sections = self.sections()
        self.assert_describes(sections["OPTIONS WITHOUT A COMMAND"], program_help.options(general))
        for command, description in program_help.commands(general).items():
            with self.subTest(command=command):
                text = self.run_program(command, "--help").stdout.decode()
                arguments = program_help.arguments(text)
                names = "".join(
                    f" {name}{'...' * many}" if required else f" [{name}]" for name, many, required, _ in arguments
                )
                section = sections[f"coordreq {command}{names}"]
                self.assertIn(description, section)
                for *_, described in arguments:
                    self.assertIn(described, section)
                self.assert_describes(section + sections["COMMON OPTIONS"], program_help.options(text))

    def test_name_that_whatis_finds(self):
        name = self.sections()["NAME"].strip()
        self.assertEqual(name, "coordreq - When must agents that share a safety task communicate?")

    def test_exit_codes_are_those_of_the_manual(self):
        codes = re.findall(r"(?m)^\| ([0-9]+) \|", (ROOT / "docs/reference/commands.md").read_text())
        self.assertEqual(re.findall(r"(?m)^([0-9]+) \S", self.sections()["EXIT STATUS"]), codes)


def description_pattern(text):
    """The description as a sentence."""
    escaped = "".join("\\" + c if c in r".^$*+?{}[]\|()" else c for c in text)
    return escaped + r"\.?"


if __name__ == "__main__":
    unittest.main()
