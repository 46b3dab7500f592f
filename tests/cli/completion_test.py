"""Completion in bash, zsh and fish, asked of the shells. What it has to offer is read off --help."""

import pathlib
import tempfile
import unittest

import program_help
from program import Case
from shells import Zsh, bash_offers, fish_offers


def words_of(value):
    """The words of csv|scs|OTHER that stand for themselves."""
    return sorted(word for word in value.split("|") if word and word == word.lower())


class Cases(Case):
    def setUp(self):
        super().setUp()
        for name in ("a.json", "b.h5", "c.txt", "with space.h5", "sub/d.json", "sub/e.h5"):
            (self.folder / name).parent.mkdir(exist_ok=True)
            self.write(name, "")

    def help_of(self, *command):
        return self.run_program(*command, "--help").stdout.decode()

    def script(self, shell):
        result = self.run_program("completion", shell)
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = pathlib.Path(folder.name, "script")
        path.write_bytes(result.stdout)
        return path

    def check_shell(self, offers):
        """`offers(words)`: what a shell offers for the last of the words, without the option of --option=word."""
        commands = program_help.commands(self.help_of())
        self.assertEqual(offers([""]), sorted(commands))
        self.assertEqual(offers(["ana"]), ["analyze"])
        self.assertEqual(offers(["--"]), sorted(program_help.options(self.help_of())))
        for command in commands:
            with self.subTest(command=command):
                self.check_options(offers, command)
                self.check_arguments(offers, command)
        self.check_line(offers)

    def check_options(self, offers, command):
        options = program_help.options(self.help_of(command))
        self.assertEqual(offers([command, "--"]), sorted(options))
        for option, (value, _) in options.items():
            if words_of(value):
                self.assertEqual(offers([command, option, ""]), words_of(value))
            elif value and value != "FILE":
                self.assertEqual(offers([command, option, ""]), [])

    def check_arguments(self, offers, command):
        specs, results = ["a.json", "sub"], ["b.h5", "sub", "with space.h5"]
        kinds = {"SPEC": specs, "RESULTS": results, "A": results, "B": results, "SHELL": ["bash", "fish", "zsh"]}
        kinds["FILE"] = kinds["LOG"] = ["a.json", "b.h5", "c.txt", "sub", "with space.h5"]
        kinds["COMMAND"] = sorted(program_help.commands(self.help_of()))
        arguments = program_help.arguments(self.help_of(command))
        words = [command]
        for name, many, *_ in arguments:
            for _ in range(3 if many else 1):
                self.assertEqual(offers([*words, ""]), kinds[name])
                words.append(kinds[name][0])
        if not (arguments and arguments[-1][1]):
            self.assertEqual(offers([*words, ""]), [])

    def check_line(self, offers):
        """Further on in a line, as far as --help does not say it."""
        self.assertEqual(offers(["analyze", "-o", ""]), ["a.json", "b.h5", "c.txt", "sub", "with space.h5"])
        self.assertEqual(offers(["analyze", "sub/"]), ["sub/d.json"])
        self.assertEqual(offers(["query", r"with\ s"]), ["with space.h5"])
        self.assertEqual(offers(["validate", "--threads", "2", ""]), ["a.json", "sub"])
        self.assertEqual(offers(["query", "b.h5", ""]), [])
        self.assertEqual(offers(["export", "b.h5", "--format", "c"]), ["c-header", "csv"])

    def check_repeats(self, offers):
        """What is given is not offered again, unless it may be repeated. (fish offers everything.)"""
        self.assertNotIn("--quiet", offers(["query", "b.h5", "--quiet", "--"]))
        self.assertNotIn("--output", offers(["export", "b.h5", "-o", "c.csv", "--"]))
        self.assertIn("--slice", offers(["export", "b.h5", "--slice", "x=1", "--"]))

    def test_bash(self):
        script = self.script("bash")

        def offers(words):
            return bash_offers(script, ["coordreq", *words], self.folder)

        self.check_shell(offers)
        self.check_repeats(offers)
        words = ["coordreq", "export", "--format", "=", "c"]
        self.assertEqual(bash_offers(script, words, self.folder), ["c-header", "csv"])
        words = ["coordreq", "export", "--format", "="]
        self.assertEqual(bash_offers(script, words, self.folder), ["c-header", "csv", "scs", "vtk"])

    def test_fish(self):
        script = self.script("fish")

        def offers(words):
            found = fish_offers(script, " ".join(["coordreq", *words]), self.folder)
            return sorted(name.rstrip("/") for name in found)

        self.check_shell(offers)
        self.assertEqual(offers(["export", "--format=c"]), ["--format=c-header", "--format=csv"])

    def test_zsh(self):
        shell = Zsh(self.script("zsh"), self.folder)
        self.addCleanup(shell.close)

        def offers(words):
            found = [name.replace("\\", "") for name in shell.offers(" ".join(["coordreq", *words]))]
            if not words[-1]:  # where nothing else may come zsh offers the options
                found = [name for name in found if not name.startswith("-")]
            # A path is completed piece by piece, and names are told without their folder.
            return sorted(words[-1].rpartition("/")[0] + "/" * ("/" in words[-1]) + name for name in found)

        self.check_shell(offers)
        self.check_repeats(offers)
        self.assertEqual(offers(["export", "--format=c"]), ["c-header", "csv"])

    def test_zsh_finds_the_function_by_its_name(self):
        script = self.script("zsh")
        (self.folder / "functions").mkdir()
        script.rename(self.folder / "functions/_coordreq")
        self.write(".load", "fpath=($PWD/functions $fpath)\ncompinit -D -u\n")
        shell = Zsh(self.folder / ".load", self.folder)
        self.addCleanup(shell.close)
        self.assertEqual(shell.offers("coordreq ana"), ["analyze"])
        self.assertEqual(shell.offers("coordreq analyze a"), ["a.json"])

    def test_unknown_shell(self):
        self.assert_fails(2, "no completion for 'ksh', expected bash, zsh or fish", "completion", "ksh")
        self.assert_fails(
            2, "no SHELL, expected one of bash|zsh|fish: coordreq completion SHELL", "completion"
        )


if __name__ == "__main__":
    unittest.main()
