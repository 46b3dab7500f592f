"""The Debian packages that cpack makes: installed below another root, the program runs from there."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

BUILD = pathlib.Path(os.environ["COORDREQ_BUILD"])
CPACK = os.environ["CPACK_COMMAND"]
CMAKE = os.environ["CMAKE_COMMAND"]
MODULE = pathlib.Path(os.environ["COORDREQ_ROOT"]) / "scripts/cmake/coordreq_maintainer.cmake"
MAINTAINER = "Ada Example <ada@example.org>"


def run(*command, **options):
    options = {"cwd": "/", "timeout": 280, **options}
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True, **options)
    if result.returncode != 0:
        raise AssertionError(f"{command}: {result.returncode}\n{result.stdout}\n{result.stderr}")
    return result.stdout


class Cases(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        run(CPACK, "--config", BUILD / "CPackConfig.cmake", "-B", cls.folder, "-D",
            "CPACK_DEBIAN_COMPRESSION_TYPE=gzip", "-D", f"CPACK_PACKAGE_CONTACT={MAINTAINER}")
        (cls.package,) = cls.folder.glob("coordreq_*.deb")
        (cls.development,) = cls.folder.glob("libcoordreq-dev_*.deb")

    def field(self, package, name):
        return run("dpkg-deb", "--field", package, name).strip()

    def test_fields(self):
        self.assertEqual(self.field(self.package, "Package"), "coordreq")
        self.assertEqual(self.field(self.package, "Maintainer"), MAINTAINER)
        self.assertRegex(self.field(self.package, "Version"), r"^\d+\.\d+\.\d+-1$")
        depends = self.field(self.package, "Depends")
        for library in ("libc6", "libgmp10", "libmpfr6", "libdeflate0", "libnettle8"):
            self.assertIn(library, depends)
        self.assertNotIn("-dev", depends)
        self.assertIn("libmpfr-dev", self.field(self.development, "Depends"))

    def maintainer(self, debian, git, **variables):
        """Who is found to be the maintainer, given pairs of a name and an address."""
        script = self.folder / "maintainer.cmake"
        script.write_text(f'include("{MODULE}")\ncoordreq_find_maintainer(found)\nmessage(STATUS "[${{found}}]")\n')
        environment = dict(os.environ, DEBFULLNAME=debian[0], DEBEMAIL=debian[1], GIT_CONFIG_COUNT="2",
                           GIT_CONFIG_KEY_0="user.name", GIT_CONFIG_VALUE_0=git[0],
                           GIT_CONFIG_KEY_1="user.email", GIT_CONFIG_VALUE_1=git[1])  # fmt: skip
        definitions = [f"-D{name}={value}" for name, value in variables.items()]
        return run(CMAKE, *definitions, "-P", script, env=environment).strip().removeprefix("-- ")

    def test_maintainer(self):
        debian, git, none = ("Deb", "deb@example.org"), ("Git", "git@example.org"), ("", "")
        self.assertEqual(self.maintainer(debian, git, COORDREQ_MAINTAINER=MAINTAINER), f"[{MAINTAINER}]")
        self.assertEqual(self.maintainer(debian, git), "[Deb <deb@example.org>]")
        self.assertEqual(self.maintainer(("Deb", ""), git), "[Git <git@example.org>]")
        self.assertEqual(self.maintainer(none, ("", "git@example.org")), "[]")

    def test_contents(self):
        listed = run("dpkg-deb", "--contents", self.package)
        for name in (
            "./usr/bin/coordreq",
            "./usr/share/man/man1/coordreq.1.gz",
            "./usr/share/zsh/vendor-completions/_coordreq",
            "./usr/share/doc/coordreq/copyright",
            "./usr/share/doc/coordreq/changelog.gz",
        ):
            self.assertRegex(listed, rf"(?m) {name}$")
        self.assertNotRegex(listed, r"\.(hpp|a)\n")
        self.assertNotRegex(listed, r"(?m)^[-d].{4}w|^[-d].{7}w")

    def test_installs_and_runs_below_another_root(self):
        root = self.folder / "root"
        for name in ("updates", "info"):
            (root / "var/lib/dpkg" / name).mkdir(parents=True)
        for name in ("status", "available"):
            (root / "var/lib/dpkg" / name).touch()
        # Its libraries are those of this machine; that the package asks for them is seen in its fields.
        run("dpkg", f"--root={root}", "--force-not-root", "--force-depends", "--install", self.package)
        program = root / "usr/bin/coordreq"
        self.assertRegex(run(program, "--version"), r"^coordreq \d+\.\d+\.\d+ ")
        spec = root / "usr/share/coordreq/configs/circle.json"
        text = run(program, "analyze", spec, cwd=self.folder)
        self.assertIn("invariance set  20,077 cells", text)
        self.assertIn("holds", run(program, "verify", "circle.h5", cwd=self.folder))
        shutil.rmtree(root)


if __name__ == "__main__":
    unittest.main()
