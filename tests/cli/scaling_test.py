"""scripts/scaling --against: two programs beside each other."""

import json
import re
import shutil
import subprocess
import sys
import unittest

from program import PROGRAM, ROOT, Case


def against(*arguments):
    command = [sys.executable, "-B", ROOT / "scripts/scaling", "--against", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False)


class Cases(Case):
    def test_a_program_takes_what_it_takes(self):
        done = against(PROGRAM, "--only", "lane_change,swap", PROGRAM)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        rows = re.findall(r"(?m)^\| (\w+) \| ([0-9,.]+) \| ([0-9,.]+) \| ([0-9.]+) \|$", done.stdout)
        self.assertEqual([row[0] for row in rows], ["lane_change", "swap"])
        for _, then, now, ratio in rows:
            self.assertGreater(float(then.replace(",", "")), 1)
            self.assertAlmostEqual(float(now.replace(",", "")) / float(then.replace(",", "")), float(ratio), places=2)
            self.assertAlmostEqual(float(ratio), 1, delta=0.01)

    def test_a_commit_that_is_none_is_said(self):
        done = against("no-such-commit", PROGRAM)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"^scaling: git .* worktree add .*no-such-commit\n")

    def test_a_commit_is_built_and_what_it_refuses_has_no_ratio(self):
        """In a repository of its own, whose program counts to a number and knows one example."""
        tree = self.folder / "repository"
        (tree / "scripts").mkdir(parents=True)
        (tree / "app").mkdir()
        (tree / "configs").mkdir()
        shutil.copy(ROOT / "scripts/scaling", tree / "scripts")
        for name in ("known", "new"):
            (tree / f"configs/{name}.json").write_text(json.dumps({"name": name}), encoding="utf-8")
        release = {"name": "release", "binaryDir": "${sourceDir}/build/release", "cacheVariables": {"CMAKE_BUILD_TYPE": "Release"}}
        (tree / "CMakePresets.json").write_text(json.dumps({"version": 3, "configurePresets": [release]}), encoding="utf-8")
        (tree / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.20)\nproject(counter C)\nadd_subdirectory(app)\n", encoding="utf-8"
        )
        (tree / "app/CMakeLists.txt").write_text("add_executable(coordreq main.c)\n", encoding="utf-8")

        def commit(count, refused):
            (tree / "app/main.c").write_text(
                "#include <string.h>\n"
                "int main(int n, char** words) {\n"
                f"  for (volatile int k = 0; k < {count}; ++k) {{}}\n"
                f'  return n > 2 && strstr(words[2], "{refused}") != 0 ? 2 : 0;\n}}\n',
                encoding="utf-8",
            )
            subprocess.run([*git, "add", "."], check=True)
            subprocess.run([*git, "commit", "--quiet", "-m", f"Count to {count}"], check=True)

        git = ["git", "-C", tree, "-c", "user.name=a", "-c", "user.email=a@example.com"]
        subprocess.run([*git, "init", "--quiet"], check=True)
        commit(1_000_000, "new.json")
        commit(2_000_000, "nothing")
        for command in (["cmake", "--preset", "release"], ["cmake", "--build", "build/release"]):
            subprocess.run(command, cwd=tree, stdout=subprocess.DEVNULL, check=True)
        done = subprocess.run(
            [sys.executable, "-B", "scripts/scaling", "--against", "HEAD~1"], cwd=tree, capture_output=True, text=True, check=False
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        ratio = re.search(r"(?m)^\| known \| [0-9.]+ \| [0-9.]+ \| ([0-9.]+) \|$", done.stdout)
        self.assertAlmostEqual(float(ratio.group(1)), 2, delta=0.2)
        self.assertRegex(done.stdout, r"(?m)^\| new \| refused \| [0-9.]+ \| \|$")
        worktrees = subprocess.run([*git, "worktree", "list"], capture_output=True, text=True, check=True).stdout
        self.assertEqual(len(worktrees.splitlines()), 1)


if __name__ == "__main__":
    unittest.main()
