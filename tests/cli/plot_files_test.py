"""What scripts/plot reads and writes: formats, whole files, errors; and numbers and comments as specs have them."""

import contextlib
import io
import json
import math
import os
import pathlib
import runpy
import stat
import subprocess
import unittest
from fractions import Fraction
from unittest import mock

import h5py
import numpy as np
from matplotlib.image import imread
from plot_case import PlotCase, main, parse
from program import ROOT, SPEC

MAGIC = {"png": b"\x89PNG\r\n", "svg": b"<?xml", "pdf": b"%PDF"}


class Cases(PlotCase):
    def setUp(self):
        super().setUp()
        self.analyzed(SPEC)

    def plot(self, *words):
        with contextlib.chdir(self.folder):
            self.assertEqual(main(list(words)), 0)

    # pictures

    def test_the_program_writes_the_format_of_the_extension(self):
        # From outside, as a user does; and the same file again.
        for extension, magic in MAGIC.items():
            name = f"a.{extension}"
            command = [str(ROOT / "scripts/plot"), "layers", "out.h5", "-o", name]
            result = subprocess.run(command, cwd=self.folder, capture_output=True, timeout=100)
            self.assertEqual((result.returncode, result.stdout, result.stderr), (0, b"", b""))
            first = (self.folder / name).read_bytes()
            self.assertTrue(first.startswith(magic))
            self.plot("layers", "out.h5", "-o", name)
            self.assertEqual((self.folder / name).read_bytes(), first, extension)
        self.assertEqual(self.files(), ["a.pdf", "a.png", "a.svg", "out.h5", "spec.json"])

    def test_size_and_resolution(self):
        self.plot("layers", "out.h5", "-o", "a.png", "--size", "3x2.5", "--dpi", "40")
        head = (self.folder / "a.png").read_bytes()[16:24]
        self.assertEqual((int.from_bytes(head[:4], "big"), int.from_bytes(head[4:], "big")), (120, 100))

    def test_a_picture_replaces_another_whole_or_not_at_all(self):
        picture = self.folder / "real.png"
        picture.write_text("old")
        picture.chmod(0o640)
        (self.folder / "a.png").symlink_to("real.png")
        with mock.patch("matplotlib.figure.Figure.savefig", side_effect=OSError(28, "No space left on device")):
            message = "cannot write the picture: No space left on device (a.png)"
            self.assert_plot_fails(5, message, "layers", "out.h5", "-o", "a.png")
        self.assertEqual(picture.read_text(), "old")
        self.plot("layers", "out.h5", "-o", "a.png")
        self.assertTrue((self.folder / "a.png").is_symlink())
        self.assertTrue(picture.read_bytes().startswith(MAGIC["png"]))
        self.assertEqual(stat.S_IMODE(picture.stat().st_mode), 0o640)
        self.assertEqual(self.files(), ["a.png", "out.h5", "real.png", "spec.json"])

    def test_an_interrupt_leaves_nothing_behind(self):
        with mock.patch("matplotlib.figure.Figure.savefig", side_effect=KeyboardInterrupt):
            self.assert_plot_fails(130, "interrupted", "layers", "out.h5", "-o", "a.png")

    def test_places_that_cannot_be_written(self):
        os.mkdir(self.folder / "folder.png")
        self.assert_plot_fails(5, "it is a folder (folder.png)", "layers", "out.h5", "-o", "folder.png")
        self.assert_plot_fails(5, "the folder does not exist (none)", "layers", "out.h5", "-o", "none/a.png")
        expected = "expected a name that ends in .png, .svg or .pdf, found 'a.gif' (-o)"
        self.assert_plot_fails(2, expected, "layers", "out.h5", "-o", "a.gif")

    # files

    def test_files_that_are_none_of_ours(self):
        self.write("other.h5", b"no HDF5")
        with h5py.File(self.folder / "plain.h5", "w") as file:
            file["safe"] = [1]
        for name, code, message in (
            ("none.h5", 5, "cannot read the file: No such file or directory (none.h5)"),
            ("other.h5", 3, "not a coordreq file: it is not HDF5, or cut short (other.h5)"),
            ("plain.h5", 3, "not a file that analyze wrote (plain.h5)"),
        ):
            self.assert_plot_fails(code, message, "layers", name, "-o", "a.png")
        message = "not a file that simulate wrote, it is one of analyze (out.h5)"
        self.assert_plot_fails(3, message, "run", "out.h5", "-o", "a.png")

    def test_files_that_lack_something(self):
        with h5py.File(self.folder / "out.h5", "r+") as file:
            del file["delay"]
        self.assert_plot_fails(3, "no /delay in the file (out.h5)", "layers", "out.h5", "-o", "a.png")
        with h5py.File(self.folder / "out.h5", "r+") as file:
            del file["spec"]
            file["spec"] = '{"states": '
        message = "the spec in the file is no JSON: Expecting value: line 1 column 12 (char 11) (out.h5)"
        self.assert_plot_fails(3, message, "layers", "out.h5", "-o", "a.png")
        with h5py.File(self.folder / "out.h5", "r+") as file:
            file.attrs["version"] = [2, 0]
        self.assert_plot_fails(3, "version 2 of the format, expected 1 (out.h5)", "layers", "out.h5", "-o", "a.png")

    # words

    def test_wrong_usage(self):
        layers = ("layers", "out.h5", "-o", "a.png")
        for words, message in (
            ((), "no FIGURE, see coordreq-plot --help"),
            (("layers",), "no FILE, see coordreq-plot layers --help"),
            (("layers", "out.h5"), "no --output, see coordreq-plot layers --help"),
            (("layers", "out.h5", "-o"), "expected a value, found none (--output)"),
            ((*layers, "more"), "unknown argument 'more', see coordreq-plot layers --help"),
            (("--more", *layers), "unknown argument '--more', see coordreq-plot --help"),
            ((*layers, "--size", "3"), "expected WIDTHxHEIGHT in inches, found '3' (--size)"),
            ((*layers, "--dpi", "5"), "expected a whole number from 10 to 2400, found '5' (--dpi)"),
            ((*layers, "--snapshots", "1,-2"), "expected whole numbers such as 1,14,29, found '1,-2' (--snapshots)"),
            ((*layers, "--partition", "a"), "no partition 'a', expected 'a|b' (--partition)"),
            (
                ("xyz", "out.h5", "-o", "a.png"),
                "unknown figure 'xyz', expected 'actions', 'layers', 'unsafe3d', 'run', 'requirements', 'coalition', 'goal', 'risk', 'sweep', 'blind', 'silence' or 'require'",
            ),
            (("layer", "out.h5", "-o", "a.png"), "unknown figure 'layer', did you mean 'layers'?"),
            (("Runs", "out.h5", "-o", "a.png"), "unknown figure 'Runs', did you mean 'run'?"),
        ):
            self.assert_plot_fails(2, message, *words)

    def test_the_first_python_that_has_the_packages_draws(self):
        """A virtual environment without them gives way to Debian's Python."""
        (self.folder / "bin").mkdir()
        (self.folder / "bin/python3").symlink_to("/usr/bin/python3")
        self.write("pyvenv.cfg", "home = /usr/bin\ninclude-system-site-packages = false\n")
        environment = {**os.environ, "PATH": f"{self.folder}/bin:{os.environ['PATH']}"}
        options = {"cwd": self.folder, "env": environment, "capture_output": True, "text": True, "timeout": 100}
        bare = subprocess.run(["/usr/bin/env", "python3", "-c", "import h5py"], **options)
        self.assertIn("No module named 'h5py'", bare.stderr)
        result = subprocess.run([ROOT / "scripts/plot", "layers"], **options)
        self.assertEqual((result.returncode, result.stderr), (2, "plot: error: no FILE, see plot layers --help\n"))

    def test_says_the_name_that_it_was_called_by(self):
        (self.folder / "coordreq-plot").symlink_to(ROOT / "scripts/plot")
        for command, name in ((ROOT / "scripts/plot", "plot"), ("./coordreq-plot", "coordreq-plot")):
            result = subprocess.run([command, "layers"], cwd=self.folder, capture_output=True, text=True, timeout=100)
            message = f"{name}: error: no FILE, see {name} layers --help\n"
            self.assertEqual((result.returncode, result.stderr), (2, message))

    def help(self, *words):
        text = io.StringIO()
        with contextlib.redirect_stdout(text), self.assertRaises(SystemExit) as end:
            main([*words, "--help"])
        self.assertEqual(end.exception.code, 0)
        return text.getvalue()

    def test_help_names_the_figures_and_theirs_the_options(self):
        text = self.help()
        for figure in ("actions", "layers", "unsafe3d", "run", "requirements", "coalition"):
            self.assertIn(f"    {figure}", text)
            self.assertIn("--output", self.help(figure))
        self.assertIn("'coordreq-plot FIGURE --help' shows the options of a figure.", text)

    def test_numbers_are_exact(self):
        from plotting.values import evaluate

        for text, value in (
            ("0.1", Fraction(1, 10)),
            ("-7/9", Fraction(-7, 9)),
            ("1e-3 + 2^3^2", Fraction(512001, 1000)),
            ("-2^2", Fraction(-4)),
            ("R/4", Fraction(1, 5)),
            ("2*pi", 2 * Fraction(math.pi)),
            ("sqrt(2)", Fraction(math.sqrt(2))),
            ("max(abs(-3), 1/3)", Fraction(3)),
        ):
            self.assertEqual(evaluate(text, {"R": Fraction(4, 5)}), value, text)
        calls = "f(1)", "__import__('os')", "sqrt(0-1)"
        for text in ("", "1 +", "x", "1/0", "'a'", "1 < 2", "9^9^9", "(-8)^(1/3)", *calls):
            with self.assertRaises(ValueError, msg=text):
                evaluate(text)

    def test_comments_are_taken_out_but_not_of_strings(self):
        from plotting.spec import without_comments

        text = '// one\n{"a": "http://x /* y */ \\" // z", /* two\n */ "b": [1, // three\n 2]} // four'
        self.assertEqual(json.loads(without_comments(text)), {"a": 'http://x /* y */ " // z', "b": [1, 2]})

    # the page

    def test_the_pictures_of_the_pages_are_made_by_one_script(self):
        made, pictures = self.folder / "pictures", ROOT / "docs/pictures"
        made.mkdir()
        command = [ROOT / "scripts/pictures", "--quick", made]
        result = subprocess.run(command, capture_output=True, text=True, timeout=600)
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))
        names = {path.name for path in made.iterdir()}
        self.assertEqual({path.name for path in pictures.iterdir()} - names, {"intersection_unsafe.png", "intersection_layers.png"})
        for name in names:
            self.assertLess((pictures / name).stat().st_size, 250_000)
            found, expected = (imread(folder / name) for folder in (made, pictures))
            self.assertEqual(found.shape, expected.shape, name)
            # Fonts and compression may change with the libraries, not what is drawn.
            self.assertLess(np.abs(found - expected).mean(), 0.01, name)

    def test_every_picture_is_on_a_page_with_the_lines_that_make_it(self):
        script = runpy.run_path(str(ROOT / "scripts/pictures"))
        pages = script["pages"]()
        shown = set().union(*map(script["shown"], pages))
        self.assertEqual(shown, {path.name for path in (ROOT / "docs/pictures").iterdir()})
        lines = [line.split() for page in pages for line in script["lines_of"](page)]
        for line in lines:
            if line[0] == "scripts/plot":
                parse(line[1:])
        # The notebook makes one, and a browser that of the report.
        made = {line[-1] for line in lines if line[0] == "scripts/plot"}
        self.assertEqual(shown - made, {"silence.png", "report_intersection.png"})

    def test_its_files_are_short(self):
        for path in [*pathlib.Path(ROOT / "scripts/plotting").glob("*.py"), ROOT / "scripts/plot"]:
            self.assertLess(len(path.read_text().splitlines()), 300, path.name)


if __name__ == "__main__":
    unittest.main()
