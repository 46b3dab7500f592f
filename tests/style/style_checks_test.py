"""Each rule of style_checks.py finds what it forbids and passes what it allows."""

import pathlib
import tempfile
import unittest

import style_checks


class StyleChecks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.write(
            "lib/CMakeLists.txt", "foreach(module base numeric results\n        analysis)\nendforeach()\n"
        )

    def write(self, path, text):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")

    def test_include_to_the_left_passes(self):
        self.write(
            "lib/numeric/a.cpp", '#include "base/error.hpp"\n#include "numeric/b.hpp"\n#include <vector>\n'
        )
        self.assertEqual(style_checks.includes_point_left(self.root), [])

    def test_include_to_the_right_is_found(self):
        self.write("lib/base/a.hpp", '#pragma once\n#include "numeric/b.hpp"\n')
        self.assertEqual(
            style_checks.includes_point_left(self.root),
            ["lib/base/a.hpp:2: base may not include numeric/b.hpp"],
        )

    def test_include_of_the_app_is_found(self):
        self.write("lib/analysis/a.cpp", '#include "app/text.hpp"\n')
        self.assertEqual(
            style_checks.includes_point_left(self.root),
            ["lib/analysis/a.cpp:1: analysis may not include app/text.hpp"],
        )

    def test_unlisted_module_is_found(self):
        self.write("lib/extra/a.cpp", "#include <vector>\n")
        self.assertEqual(
            style_checks.includes_point_left(self.root),
            ["lib/extra/a.cpp: module extra is not in lib/CMakeLists.txt"],
        )

    def write_rooms_of_answers(self):
        self.write("lib/CMakeLists.txt", "foreach(module base model reach engine answers)\nendforeach()\n")

    def test_check_on_what_is_claimed_passes(self):
        self.write_rooms_of_answers()
        self.write(
            "lib/answers/layers/check.cpp",
            '#include "answers/layers/check.hpp"\n#include <vector>\n#include "model/uniform_grid.hpp"\n'
            '#include "answers/checking/tally.hpp"\n#include "answers/invariance/check_safe.hpp"\n',
        )
        self.write(
            "lib/answers/checking/claims.hpp",
            '#include "answers/requirements/result_requirement.hpp"\n#include "engine/packed_pairs.hpp"\n',
        )
        self.write("lib/answers/layers/answer.cpp", '#include "answers/countdown/delay_layers.hpp"\n')
        self.assertEqual(style_checks.checks_stand_alone(self.root), [])

    def test_check_that_includes_what_computes_is_found(self):
        self.write_rooms_of_answers()
        self.write(
            "lib/answers/layers/check.cpp",
            '#include "answers/countdown/delay_layers.hpp"\n#include "engine/wave.hpp"\n',
        )
        self.write("lib/answers/checking/posts.hpp", '#include "reach/abstraction.hpp"\n')
        self.write("lib/engine/packed_pairs.hpp", '#include "engine/row_engine.hpp"\n')
        self.assertEqual(
            style_checks.checks_stand_alone(self.root),
            [
                "lib/answers/checking/posts.hpp:1: a check may not include reach/abstraction.hpp",
                "lib/answers/layers/check.cpp:1: a check may not include answers/countdown/delay_layers.hpp",
                "lib/answers/layers/check.cpp:2: a check may not include engine/wave.hpp",
                "lib/engine/packed_pairs.hpp:1: a check may not include engine/row_engine.hpp",
            ],
        )

    def test_hdf5_outside_results_is_found(self):
        self.write("lib/results/a.cpp", "#include <hdf5.h>\n")
        self.write("lib/analysis/a.cpp", "#include <hdf5.h>\n#include <H5Cpp.h>\n")
        self.assertEqual(
            style_checks.only_results_uses_hdf5(self.root),
            [
                "lib/analysis/a.cpp:1: only lib/results may include hdf5.h",
                "lib/analysis/a.cpp:2: only lib/results may include H5Cpp.h",
            ],
        )

    def test_printing_is_found_but_not_in_text_or_comments(self):
        self.write("lib/base/a.cpp", '// std::cout\nauto text = "printf(";\nstd::snprintf(buffer, 3, "");\n')
        self.assertEqual(style_checks.library_never_prints(self.root), [])
        self.write("lib/base/b.cpp", 'std::cerr << 1;\n  printf("x");\n')
        self.assertEqual(
            style_checks.library_never_prints(self.root),
            [
                "lib/base/b.cpp:1: lib/ must not print: std::cerr << 1;",
                'lib/base/b.cpp:2: lib/ must not print: printf("");',
            ],
        )

    def test_a_clock_is_found_but_not_where_it_reports(self):
        self.write("lib/base/timer.cpp", "#include <chrono>\nstd::chrono::steady_clock::now();\n")
        self.write("lib/base/a.cpp", "// std::chrono\nwait_for_helpers();\nresult.clock = 1;\n")
        self.assertEqual(style_checks.no_clock_decides(self.root), [])
        self.write("lib/base/b.cpp", "#include <ctime>\nif (std::clock() > end) return;\n")
        self.assertEqual(
            [finding.split(": ")[0] for finding in style_checks.no_clock_decides(self.root)],
            ["lib/base/b.cpp:1", "lib/base/b.cpp:2"],
        )

    def test_a_range_that_clang_does_not_compile_is_found(self):
        self.write("lib/base/a.cpp", "std::ranges::sort(list);\n// std::views\nstd::unique(list.begin(), list.end());\n")
        self.assertEqual(style_checks.clang_knows_ranges(self.root), [])
        self.write("lib/base/b.cpp", "#include <ranges>\nstd::ranges::unique(list);\nfor (int i : std::views::iota(0, 3))\n")
        self.assertEqual(
            [finding.split(": ")[0] for finding in style_checks.clang_knows_ranges(self.root)],
            ["lib/base/b.cpp:1", "lib/base/b.cpp:2", "lib/base/b.cpp:3"],
        )

    def test_long_file_is_found(self):
        self.write("app/a.cpp", "\n" * 400)
        self.write("app/b.cpp", "\n" * 401)
        self.assertEqual(
            style_checks.files_are_short(self.root), ["app/b.cpp: 401 lines, at most 400 are allowed"]
        )

    def test_a_need_that_only_a_comment_states_is_found(self):
        self.write("lib/engine/a.hpp", "/// @pre k > 0. @pre unchecked: `b` outlives it\nint f(int k) {\n  REQUIRES(k > 0);\n}\n")
        self.write("lib/engine/b.hpp", "/// @pre k > 0\nint g(int k);\n")
        self.write("lib/engine/b.cpp", "int g(int k) {\n  REQUIRES(k > 0);\n}\n")
        self.write("lib/engine/two.hpp", "/// @pre k > 0\nint first(int k);\n/// @pre k > 0\nint second(int k);\n")
        self.write("lib/engine/first.cpp", '#include "engine/two.hpp"\nint first(int k) {\n  REQUIRES(k > 0);\n}\n')
        self.write("lib/engine/second.cpp", '#include "engine/two.hpp"\nint second(int k) {\n  REQUIRES(k > 0);\n}\n')
        self.assertEqual(style_checks.needs_are_checked(self.root), [])
        self.write("lib/engine/c.hpp", "/// REQUIRES: k > 0\nint h(int k);\n/// @pre k > 0\nint i(int k);\n")
        self.assertEqual(
            style_checks.needs_are_checked(self.root),
            ["lib/engine/c.hpp:1: REQUIRES is for checks; say '@pre', or '@pre unchecked:'",
             "lib/engine/c: '@pre' 1 times, and REQUIRES() 0 times"],
        )

    def test_types_of_one_name_are_found(self):
        self.write("lib/base/a.hpp", "namespace coordreq {\n\nstruct Form {\n  int a;\n};\n\n}  // namespace coordreq\n")
        own = "namespace coordreq {\nnamespace {\n\nclass Form {\n};\n\n}  // namespace\n\nclass Base;\n\n}  // namespace coordreq\n"
        self.write("lib/numeric/own.cpp", own)
        self.write("app/other.hpp", "namespace coordreq::other {\nclass Form {\n};\n}  // namespace coordreq::other\n")
        self.assertEqual(style_checks.types_have_names_of_their_own(self.root), [])
        self.write("lib/results/a.hpp", "namespace coordreq {\n\nclass Form final\n    : public Base {\n};\n\n}  // namespace coordreq\n")
        self.assertEqual(
            style_checks.types_have_names_of_their_own(self.root),
            ["lib/results/a.hpp:3: coordreq::Form is defined in lib/base/a.hpp:3 too"],
        )


if __name__ == "__main__":
    unittest.main()
