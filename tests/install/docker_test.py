"""The image that Dockerfile describes, where docker runs: it is built from the tree, and analyses an example."""

import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(os.environ["COORDREQ_ROOT"])
IMAGE = "coordreq-under-test"


def docker(*words):
    return subprocess.run(["docker", *words], capture_output=True, text=True, check=False)


def is_running():
    try:
        return docker("info").returncode == 0
    except FileNotFoundError:
        return False


@unittest.skipUnless(is_running(), "docker does not run here")
class Cases(unittest.TestCase):
    def test_an_image_analyses_an_example(self):
        built = docker("build", "--tag", IMAGE, str(ROOT))
        self.assertEqual(built.returncode, 0, built.stderr)
        self.addCleanup(docker, "rmi", IMAGE)
        with tempfile.TemporaryDirectory() as folder:
            words = ("run", "--rm", "--user", f"{os.getuid()}:{os.getgid()}", "-v", f"{folder}:/data", "-v", f"{ROOT}/configs:/configs:ro")
            result = docker(*words, IMAGE, "analyze", "/configs/circle.json")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("F = 29", result.stdout)
            self.assertTrue(pathlib.Path(folder, "circle.h5").is_file())


if __name__ == "__main__":
    unittest.main()
