"""Rules about the source tree that no compiler checks. Each rule is a function tree -> list of findings.

Usage: style_checks.py RULE ROOT
"""

import pathlib
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
PRINTING = re.compile(
    r"\bstd::(cout|cerr|clog|print|println)\b|\b(f?printf|puts|fputs|putchar|perror)\s*\(|\bfmt::print\b"
    r"|#\s*include\s*<(iostream|fmt/ostream\.h)>"
)
CLOCK = re.compile(
    r"\b(std::chrono|std::clock|std::time|clock_gettime|gettimeofday|alarm|setitimer|timer_create|timerfd_create|usleep|nanosleep"
    r"|sleep_for|sleep_until|wait_for|wait_until)\b|#\s*include\s*<(chrono|ctime|time\.h|sys/time\.h)>"
)
# Where one is read, and what for: never for what is found.
CLOCKS = {
    "lib/base/timer": "seconds that are reported",
    "app/commands/verify": "seconds that are reported",
    "lib/analysis/estimate_seconds": "seconds that are shown",
    "lib/analysis/stage_reporter": "how often progress is told",
    "app/progress_display": "how often progress is told",
    "lib/analysis/checkpoint": "how often work is saved",
    "app/mpi/mpi_ranks": "which rank tells of an error",
    "app/mpi/batch_on_ranks": "how often rank 0 looks for answers",
}
# Views and subranges of the standard library of g++ 12, which clang 14 cannot compile: sanitisers and fuzzers are built with it.
SUBRANGES = re.compile(
    r"\bstd::(ranges::)?views\b|#\s*include\s*<ranges>"
    r"|\bstd::ranges::(subrange|unique|remove|remove_if|partition|stable_partition|rotate|search|search_n|find_end|equal_range)\b"
)
MAX_LINES = 400
# Headers of several sources, which check: kernels in those named _impl, advice in advise_on_answers and the like, blocks of a
# results file in stored_array.
CHECKED_ELSEWHERE = ["level_kernels", "sum_kernels", "advice", "results_file"]


def sources(root, *folders):
    """C++ files below the folders, as (path from root, lines)."""
    for folder in folders:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in (".cpp", ".hpp"):
                yield path.relative_to(root), path.read_text(encoding="utf-8").splitlines()


def includes(root, *folders):
    """Every include as (path, line number, name)."""
    for path, lines in sources(root, *folders):
        for number, line in enumerate(lines, 1):
            match = INCLUDE.match(line)
            if match:
                yield path, number, match.group(2)


def without_comments(lines):
    """The lines with comments and string literals blanked; enough for code that is formatted."""
    for line in lines:
        yield re.sub(r'"(\\.|[^"\\])*"', '""', line).split("//")[0]


def module_order(root):
    """The modules in the order in which lib/CMakeLists.txt adds them."""
    text = (root / "lib/CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"foreach\(module([^)]*)\)", text).group(1).split()


def includes_point_left(root):
    order = module_order(root)
    findings = []
    for path, number, name in includes(root, "lib"):
        module, target = path.parts[1], name.split("/")[0]
        if module not in order:
            findings.append(f"{path}: module {module} is not in lib/CMakeLists.txt")
        elif target == "app" or (target in order and order.index(target) > order.index(module)):
            findings.append(f"{path}:{number}: {module} may not include {name}")
    return findings


# What a check may know of answers and of the engine: what is claimed, not how it is found.
CLAIMED = (
    "engine/packed_pairs.hpp",
    "answers/countdown/kinds.hpp",
    "answers/field_source.hpp",
    "answers/step_codes.hpp",
    "answers/layers/stored_partition.hpp",
    "answers/counterexample/result_path.hpp",
    "answers/requirements/result_requirement.hpp",
)
ROOMS_OF_CHECKS = ("base", "numeric", "expression", "spec", "model")


def is_check(name):
    return re.match(r"answers/(checking/|[^/]+/check)", name) is not None


def checks_stand_alone(root):
    """Checks by definition include nothing that computes an answer, nor what includes that."""
    return [
        f"{path}:{number}: a check may not include {name}"
        for path, number, name in includes(root, "lib")
        if is_check("/".join(path.parts[1:])) or "/".join(path.parts[1:]) in CLAIMED
        if name.split("/")[0] in module_order(root)
        if not (name.split("/")[0] in ROOMS_OF_CHECKS or is_check(name) or name in CLAIMED)
    ]


def only_results_uses_hdf5(root):
    return [
        f"{path}:{number}: only lib/results may include {name}"
        for path, number, name in includes(root, "lib", "app")
        if re.match(r"(hdf5/|hdf5|H5)", name) and path.parts[:2] != ("lib", "results")
    ]


def library_never_prints(root):
    return [
        f"{path}:{number}: lib/ must not print: {line.strip()}"
        for path, lines in sources(root, "lib")
        for number, line in enumerate(without_comments(lines), 1)
        if PRINTING.search(line)
    ]


def no_clock_decides(root):
    return [
        f"{path}:{number}: a clock may decide nothing; see CLOCKS in style_checks.py: {line.strip()}"
        for path, lines in sources(root, "lib", "app")
        if str(path.with_suffix("")) not in CLOCKS
        for number, line in enumerate(without_comments(lines), 1)
        if CLOCK.search(line)
    ]


def clang_knows_ranges(root):
    return [
        f"{path}:{number}: clang 14 does not compile views and subranges, expected iterators: {line.strip()}"
        for path, lines in sources(root, "lib", "app", "tests")
        for number, line in enumerate(without_comments(lines), 1)
        if SUBRANGES.search(line)
    ]


def files_are_short(root):
    return [
        f"{path}: {len(lines)} lines, at most {MAX_LINES} are allowed"
        for path, lines in sources(root, "lib", "app", "tests")
        if len(lines) > MAX_LINES
    ]


TYPE = re.compile(r"^(?:struct|class|enum class|union) (?:\[\[\w+\]\] )?(\w+)\b(?! *<| *;|::)")
NAMESPACE = re.compile(r"^(?:inline )?namespace ?([\w:]*) ?\{")


def header_of(path, lines):
    """The header of a source, without its suffix: the one that it includes first, if that is in its folder."""
    match = INCLUDE.match(lines[0]) if lines and path.suffix == ".cpp" else None
    own = match and pathlib.Path("" if path.parts[0] == "app" else path.parts[0], match.group(2)).with_suffix("")
    return own if own and own.parent == path.parent else path.with_suffix("")


def needs_are_checked(root):
    """In docstrings `@pre` is for what REQUIRES() checks, here or in the header's sources, and `@pre unchecked:` for the rest."""
    findings, stated, checked = [], {}, {}
    for path, lines in sources(root, "lib", "app"):
        name = header_of(path, lines)
        for number, line in enumerate(lines, 1):
            code, _, comment = line.partition("//")
            if "REQUIRES" in comment:
                findings.append(f"{path}:{number}: REQUIRES is for checks; say '@pre', or '@pre unchecked:'")
            stated[name] = stated.get(name, 0) + len(re.findall(r"@pre (?!unchecked:)", comment))
            checked[name] = checked.get(name, 0) + code.count("REQUIRES(")
    return findings + [
        f"{name}: '@pre' {count} times, and REQUIRES() {checked[name]} times"
        for name, count in stated.items() if count > checked[name] and name.name not in CHECKED_ELSEWHERE
    ]


def types_by_name(root):
    """Where each type of a namespace with a name is defined: places by full name. What is indented is a member."""
    places = {}
    for path, lines in sources(root, "lib", "app"):
        namespaces = []
        for number, line in enumerate(without_comments(lines), 1):
            if match := NAMESPACE.match(line):
                namespaces.append(match.group(1))
            elif line.startswith("}") and not line.rstrip().endswith(";") and namespaces:
                if "// namespace" in lines[number - 1]:
                    namespaces.pop()
            elif (match := TYPE.match(line)) and not line.rstrip().endswith(";") and "" not in namespaces:
                places.setdefault("::".join([*namespaces, match.group(1)]), []).append(f"{path}:{number}")
    return places


def types_have_names_of_their_own(root):
    """Two types of one name are undefined behaviour, although compiler and linker take them."""
    return [
        f"{places[-1]}: {name} is defined in {places[0]} too"
        for name, places in types_by_name(root).items()
        if len(places) > 1
    ]


RULES = {
    rule.__name__: rule
    for rule in (
        includes_point_left,
        checks_stand_alone,
        only_results_uses_hdf5,
        library_never_prints,
        no_clock_decides,
        clang_knows_ranges,
        files_are_short,
        needs_are_checked,
        types_have_names_of_their_own,
    )
}


def main():
    rule, root = RULES[sys.argv[1]], pathlib.Path(sys.argv[2])
    findings = rule(root)
    for finding in findings:
        print(finding)
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
