"""The installed tree: moved elsewhere it still works, as a program and as a library."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

BUILD = pathlib.Path(os.environ["COORDREQ_BUILD"])
ROOT = pathlib.Path(os.environ["COORDREQ_ROOT"])
CMAKE = os.environ["CMAKE_COMMAND"]


def run(*command, **options):
    options = {"cwd": "/", "timeout": 280, **options}
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True, **options)
    if result.returncode != 0:
        raise AssertionError(f"{command}: {result.returncode}\n{result.stdout}\n{result.stderr}")
    return result.stdout


class Cases(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        run(CMAKE, "--install", BUILD, "--prefix", cls.folder / "first")
        (cls.folder / "first").rename(cls.folder / "second")
        cls.prefix = cls.folder / "second"
        cls.program = cls.prefix / "bin/coordreq"

    def test_files(self):
        installed = {str(path.relative_to(self.prefix)) for path in self.prefix.rglob("*") if not path.is_dir()}
        for name in (
            "bin/coordreq",
            "bin/coordreq-plot",
            "share/man/man1/coordreq.1",
            "share/bash-completion/completions/coordreq",
            "share/fish/vendor_completions.d/coordreq.fish",
            "share/zsh/site-functions/_coordreq",
            "share/coordreq/schema.json",
            "share/doc/coordreq/README.md",
            "share/doc/coordreq/CHANGELOG.md",
            "share/doc/coordreq/LICENSE",
            "share/coordreq/examples/library/CMakeLists.txt",
            "include/coordreq/analysis/analyze.hpp",
        ):
            self.assertIn(name, installed)
        configs = {path.name for path in (ROOT / "configs").iterdir()}
        self.assertEqual({path.name for path in (self.prefix / "share/coordreq/configs").iterdir()}, configs)
        self.assertFalse([name for name in installed if "debian" in name or "__pycache__" in name])

    def test_pages_link_to_each_other(self):
        for page in ("share/doc/coordreq/README.md", "share/doc/coordreq/docs/README.md", "share/doc/coordreq/docs/tutorial/README.md"):
            path = self.prefix / page
            links = re.findall(r"\]\(((?:configs/|\.\.)[^)#]*)", path.read_text(encoding="utf-8"))
            self.assertTrue(links, page)
            for link in links:
                self.assertTrue((path.parent / link).exists(), f"{page}: {link}")

    def test_pages_have_their_pictures(self):
        documents = self.prefix / "share/doc/coordreq"
        pictures = [
            (page, picture)
            for page in documents.glob("**/*.md")
            for picture in re.findall(r"!\[[^]]*\]\(([^)]*)\)", page.read_text(encoding="utf-8"))
        ]
        self.assertGreater(len(pictures), 5)
        for page, picture in pictures:
            self.assertTrue((page.parent / picture).is_file(), f"{page}: {picture}")

    def test_help_names_the_installed_pages(self):
        page = run(self.program, "--help").rstrip().rpartition("\nDocumentation: ")[2]
        self.assertTrue((self.prefix / "share/doc/coordreq/docs/README.md").samefile(page))

    def test_new_specs_name_the_installed_schema(self):
        run(self.program, "init", self.folder / "first.json")
        (schema,) = re.findall(r'"\$schema": "file://([^"]*)"', (self.folder / "first.json").read_text(encoding="utf-8"))
        self.assertTrue((self.prefix / "share/coordreq/schema.json").samefile(schema))

    def test_nothing_names_the_prefix_or_the_sources(self):
        names = [str(self.folder / "first").encode(), str(ROOT).encode()]
        for path in self.prefix.rglob("*"):
            # Debug information, which packages are without, names the sources.
            if path.is_file() and not path.is_symlink() and path != self.program and path.suffix != ".a":
                content = path.read_bytes()
                self.assertFalse([name for name in names if name in content], path)

    def test_program(self):
        self.assertRegex(run(self.program, "--version"), r"^coordreq \d+\.\d+\.\d+ ")
        spec = self.prefix / "share/coordreq/configs/circle.json"
        text = run(self.program, "analyze", spec, "-o", self.folder / "circle.h5")
        self.assertIn("invariance set  20,077 cells", text)
        picture = self.folder / "layers.svg"
        run(self.prefix / "bin/coordreq-plot", "layers", self.folder / "circle.h5", "-o", picture)
        self.assertIn("<svg", picture.read_text(encoding="utf-8"))

    def test_library(self):
        source = self.folder / "consumer"
        shutil.copytree(self.prefix / "share/coordreq/examples/library", source)
        build = source / "build"
        run(CMAKE, "-G", "Ninja", "-S", source, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}",
            "-DCMAKE_CXX_FLAGS=" + os.environ["COORDREQ_CXX_FLAGS"],
            "-DCMAKE_CXX_COMPILER=" + os.environ["COORDREQ_CXX_COMPILER"])
        run(CMAKE, "--build", build)
        spec = self.prefix / "share/coordreq/configs/circle.json"
        text = run(build / "analyze_and_ask", spec, self.folder / "library.h5", "x1=0.1,x2=0")
        self.assertEqual(
            text,
            "invariance set: 20077 of 40401 cells\nx1=0.1,x2=0, horizontal|vertical: 25 steps of silence\n",
        )

    def test_headers_of_the_interface_are_complete(self):
        listed = (ROOT / "scripts/cmake/coordreq_interface.cmake").read_text(encoding="utf-8")
        headers = re.findall(r"\S+\.hpp", listed)
        self.assertIn("analysis/analyze.hpp", headers)
        includes = "".join(f"#include <coordreq/{header}>\n" for header in headers)
        (self.folder / "all.cpp").write_text(includes, encoding="utf-8")
        include = self.prefix / "include"
        run("c++", "-std=c++20", "-fsyntax-only", f"-I{include}", f"-I{include}/coordreq", self.folder / "all.cpp")



if __name__ == "__main__":
    unittest.main()
