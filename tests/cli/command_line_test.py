"""Wrong usage is exit code 2 and one line; help and version go to standard output."""

import os
import pathlib
import re
import shutil
import subprocess
import unittest

from program import CONFIGS, PROGRAM, ROOT, SPEC, Case

COMMANDS = (
    *("init", "analyze", "validate", "info", "query", "require", "explain", "simulate", "judge", "verify", "compare", "export"),
    *("report", "schema", "completion", "help"),
)
LISTED = ", ".join(COMMANDS)


class Cases(Case):
    def test_no_command(self):
        self.assert_fails(2, f"no command, expected one of {LISTED}")

    def test_unknown_command(self):
        self.assert_fails(2, f"unknown command 'solve', expected one of {LISTED}", "solve")

    def test_pictures_are_drawn_by_another_program(self):
        self.assert_fails(2, "no command 'plot', expected coordreq-plot (scripts/plot) to draw pictures", "plot", "out.h5")

    def test_command_that_is_almost_one(self):
        self.assert_fails(2, "unknown command 'analyse', did you mean 'analyze'?", "analyse", "spec.json")
        self.assert_fails(2, "unknown command 'vaildate', did you mean 'validate'?", "help", "vaildate")

    def test_file_without_a_command(self):
        message = "no command before 'spec.json', did you mean 'coordreq analyze spec.json'?"
        self.assert_fails(2, message, "spec.json")
        self.assert_fails(2, "no command before 'a.h5', did you mean 'coordreq info a.h5'?", "a.h5", "b.h5")

    def test_option_that_is_almost_one(self):
        for typed in ("--thread", "--thread=2", "--treads"):
            message = f"unknown option '{typed}' of analyze, did you mean '--threads'?"
            self.assert_fails(2, message, "analyze", "spec.json", typed)

    def test_unknown_global_option(self):
        self.assert_fails(
            2,
            f"unknown option '--fast', expected a command ({LISTED}) or --help, --version",
            "--fast",
        )

    def test_unknown_option_of_a_command(self):
        self.assert_fails(
            2,
            "unknown option '--fast' of validate, expected one of --help, --set, --refine, --ranks, --posts, --verbose, --threads, --max-memory, --json, --quiet",
            "validate",
            "--fast",
            "spec.json",
        )

    def test_option_before_the_command(self):
        self.assert_fails(
            2,
            "'--threads' stands before the command analyze, expected it after",
            "--threads",
            "2",
            "analyze",
            "spec.json",
        )

    def test_no_spec(self):
        self.assert_fails(2, "no SPEC, expected the name of a file: coordreq analyze SPEC...", "analyze")

    def test_no_results(self):
        self.assert_fails(2, "no RESULTS, expected the name of a file: coordreq info RESULTS", "info")

    def test_two_specs(self):
        self.assert_fails(
            2, "unexpected argument 'b', validate takes one argument, SPEC", "validate", "a", "b"
        )

    def test_arguments_of_compare(self):
        usage = "expected the name of a file: coordreq compare A B"
        self.assert_fails(2, f"no A, {usage}", "compare")
        self.assert_fails(2, f"no B, {usage}", "compare", "a.h5")
        self.assert_fails(
            2, "unexpected argument 'c', compare takes two arguments, A and B", "compare", "a", "b", "c"
        )

    def test_argument_of_schema(self):
        self.assert_fails(2, "unexpected argument 'a', schema takes no argument", "schema", "a")

    def test_option_without_its_value(self):
        self.assert_fails(2, "expected a value, found none (--threads)", "analyze", "spec.json", "--threads")
        for line, option, found in (("-o --quiet", "--output", "--quiet"), ("--checkpoint --resume", "--checkpoint", "--resume"),
                                    ("--set -o", "--set", "-o")):  # fmt: skip
            self.assert_fails(2, f"expected a value, found the option '{found}' ({option})", "analyze", "spec.json", *line.split())

    def test_option_given_twice(self):
        self.assert_fails(
            2, "given more than once (--threads)", "analyze", "spec.json", "--threads", "1", "--threads", "2"
        )

    def test_flag_with_a_value(self):
        self.assert_fails(2, "expected no value, found one (--json)", "analyze", "spec.json", "--json=yes")

    def test_threads_out_of_range(self):
        for value in ("0", "-1", "1025", "99999999999999999999", "two", "2.5", ""):
            with self.subTest(value=value):
                message = f"expected a whole number from 1 to 1024, found '{value}' (--threads)"
                self.assert_fails(2, message, "analyze", "spec.json", "--threads", value)

    def test_most_threads_work(self):
        self.write("spec.json", SPEC)
        self.assertEqual(self.analyze("spec.json", "--threads", "1024")["threads"], 1024)

    def test_memory_size_that_is_none(self):
        for value in ("0", "-1", "M", "1Q", "1MiBs", "1e3", "0.5", ".", ""):
            with self.subTest(value=value):
                message = (
                    "expected a size such as 500M, 1.5GiB or a number of bytes, "
                    f"found '{value}' (--max-memory)"
                )
                self.assert_fails(2, message, "analyze", "spec.json", "--max-memory", value)

    def test_memory_sizes_that_are_enough(self):
        self.write("spec.json", SPEC)
        for value in ("1073741824", "1073741824B", "1048576k", "1024M", "1G", "1.5GiB", "1gb", "0.5T"):
            with self.subTest(value=value):
                self.analyze("spec.json", "--max-memory", value)

    def test_output_without_a_name(self):
        for value in ("", "-"):
            with self.subTest(value=value):
                message = f"expected the name of a file, found '{value}' (--output)"
                self.assert_fails(2, message, "analyze", "spec.json", "-o", value)

    def test_user_text_stays_on_one_line(self):
        self.assert_fails(
            2,
            r"unknown command 'a\nb\t\x1b[31m\x7f\xff é', expected one of " + LISTED,
            b"a\nb\t\x1b[31m\x7f\xff " + "é".encode(),
        )

    def test_help_lists_exactly_the_commands(self):
        result = self.run_program("--help")
        self.assertEqual(result.returncode, 0)
        self.assertEqual(result.stderr, b"")
        listed = result.stdout.decode().split("Subcommands:\n")[1].split("\n\n")[0]
        self.assertEqual(re.findall(r"^  (\S+)", listed, re.M), list(COMMANDS))

    def test_help_of_every_command(self):
        for command in COMMANDS:
            with self.subTest(command=command):
                result = self.run_program(command, "--help")
                self.assertEqual((result.returncode, result.stderr), (0, b""))
                self.assertIn(f"Usage: coordreq {command} [OPTIONS]", result.stdout.decode())
                # Only what the command has a use for.
                useless = {
                    "--threads N": {"init", "info", "compare", "require", "report", "schema", "completion", "help"},
                    "--max-memory SIZE": {"init", "schema", "completion", "help"},
                    "--json": {"export", "schema", "completion", "help"},
                    "--quiet": {"export", "schema", "completion", "help"},
                }
                for option, commands in useless.items():
                    self.assertEqual(option in result.stdout.decode(), command not in commands, option)
                self.assertEqual(self.run_program("help", command).stdout, result.stdout)

    def test_help_of_the_program(self):
        result = self.run_program("help")
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        self.assertEqual(result.stdout, self.run_program("--help").stdout)
        self.assert_fails(2, f"unknown command 'solve', expected one of {LISTED}", "help", "solve")
        self.assert_fails(2, "unexpected argument 'info', help takes at most one argument, COMMAND", "help", "analyze", "info")

    def test_examples_of_every_help_run(self):
        self.analyze(str(CONFIGS / "circle.json"))
        self.analyze(str(CONFIGS / "crossing.json"))
        (self.folder / "circle.json").symlink_to(CONFIGS / "circle.json")
        for copy in ("before.h5", "after.h5"):
            shutil.copy(self.folder / "circle.h5", self.folder / copy)
        self.write("states.csv", "x1,x2\n0.1,0\n")
        self.write("log.csv", "x1,x2,u1,u2\n0.1,0,0,0\n0.1,0,,\n")
        (self.folder / ".config/fish/completions").mkdir(parents=True)
        path = f"{pathlib.Path(PROGRAM).parent}:{os.environ['PATH']}"
        environment = dict(os.environ, PATH=path, HOME=str(self.folder))
        for command in ((), *((command,) for command in COMMANDS)):
            text = self.run_program(*command, "--help").stdout.decode()
            examples = re.findall(r"(?m)^  (.*)$", text.split("\nExamples:\n")[1].split("\n\n")[0])
            self.assertEqual(len(examples), 2)
            for example in examples:
                with self.subTest(example=example):
                    self.assertIn(" ".join(["coordreq", *command]), example)
                    result = subprocess.run(["bash", "-c", example], cwd=self.folder, env=environment, capture_output=True)
                    self.assertEqual((result.returncode, result.stderr), (0, b""))

    def test_help_names_the_pages(self):
        for command in ((), ("analyze",)):
            text = self.run_program(*command, "--help").stdout.decode()
            page = pathlib.Path(text.rstrip().rpartition("\nDocumentation: ")[2])
            self.assertTrue(page.samefile(ROOT / "docs/README.md"))

    def test_help_of_a_program_that_stands_alone(self):
        shutil.copy(PROGRAM, self.folder / "alone")
        result = subprocess.run([self.folder / "alone", "--help"], capture_output=True, text=True)
        self.assertTrue(result.stdout.endswith("\nDocumentation: man coordreq\n"))

    def test_version(self):
        result = self.run_program("--version")
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        self.assertRegex(result.stdout.decode(), r"^coordreq 0\.1\.0 \(([0-9a-f]{40}|unknown)\)\n$")


if __name__ == "__main__":
    unittest.main()
