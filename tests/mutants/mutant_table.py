"""Reads the table of small faults, and writes sources that have all of them.

Each file tests/mutants/ROOM.toml lists some:

  [[mutant]]
  name = "outside.saturates"            # what it is about, in no other entry
  file = "lib/model/outside.cpp"
  place = 'raw.last = std::min(raw.last, «top»)'   # once in the file; the fault is between « and », or all of it
  fault = 'top + 1'                     # what stands there instead; '' leaves a statement out
  found_by = "model.Outside.Saturates"  # the test that fails with it
  unseen = "why no test can see it"     # instead of found_by

What ends with ';' is a statement, all else an expression.
"""

import dataclasses
import os
import pathlib
import re
import tomllib
import zlib

HEADER = "lib/base/mutant.hpp"
HEADER_TEXT = """#pragma once

#include <cstdint>
#include <cstdlib>

// The fault that is chosen for this run, if any.
namespace coordreq {

inline const std::uint32_t kChosenMutant = [] {
  const char* const chosen = std::getenv("COORDREQ_MUTANT");
  return chosen == nullptr ? 0U : static_cast<std::uint32_t>(std::strtoul(chosen, nullptr, 10));
}();
[[nodiscard]] inline bool is_mutant(std::uint32_t number) {
  return number == kChosenMutant;
}

}  // namespace coordreq
"""


@dataclasses.dataclass(frozen=True)
class Mutant:
    name: str
    file: str
    place: str
    fault: str
    test: str = ""
    unseen: str = ""

    @property
    def number(self):
        return zlib.crc32(self.name.encode())

    @property
    def text(self):
        """What stands at the place, without marks."""
        return self.place.replace("«", "").replace("»", "")

    def replaced(self):
        """The place, with a choice between what is written and the fault."""
        marked = self.place if "«" in self.place else f"«{self.place}»"
        before, old, after = re.fullmatch("(?s)(.*?)«(.*)»(.*)", marked).groups()
        asked = f"::coordreq::is_mutant({self.number}U)"
        if old.rstrip().endswith(";"):
            return f"{before}{{ if ({asked}) {{ {self.fault} }} else {{ {old} }} }}{after}"
        return f"{before}({asked} ? ({self.fault}) : ({old})){after}"


def read(root):
    mutants = []
    for path in sorted((pathlib.Path(root) / "tests/mutants").glob("*.toml")):
        for entry in tomllib.loads(path.read_text(encoding="utf-8"))["mutant"]:
            entry["test"] = entry.pop("found_by", "")
            mutants.append(Mutant(**entry))
    return mutants


def is_there(root, test):
    """A test by its name in CTest is written somewhere: FOLDER.Suite.Name or FOLDER.file.case."""
    folder, suite, name = test.split(".", 2) if test.count(".") >= 2 else (test, "", "")
    tests = pathlib.Path(root) / "tests" / folder
    script = tests / f"{suite}_test.py"
    if script.is_file():
        return f"def test_{name}(" in script.read_text(encoding="utf-8")
    written = re.compile(rf"^(TYPED_)?TEST(_F|_P)?\({suite.split('/')[-1]}, {name.split('/')[0]}\)", re.MULTILINE)
    sources = tests.rglob("*_test.cpp")
    return bool(suite) and any(written.search(path.read_text(encoding="utf-8")) for path in sources)


def problems(root, mutants):
    """What is wrong with the table, one line each."""
    found = []
    names = [one.name for one in mutants]
    for mutant in mutants:
        if names.count(mutant.name) > 1:
            found.append(f"{mutant.name}: named twice")
        if bool(mutant.test) == bool(mutant.unseen):
            found.append(f"{mutant.name}: expected either a test that finds it or why it is unseen")
        elif mutant.test and not is_there(root, mutant.test):
            found.append(f"{mutant.name}: there is no test {mutant.test}")
        path = pathlib.Path(root) / mutant.file
        if not path.is_file():
            found.append(f"{mutant.name}: there is no {mutant.file}")
            continue
        marked = mutant.place.partition("«")[2].partition("»")[0].strip()
        if re.fullmatch(r"[<>=!&|+*/%-]+|\{[^;]*\}", marked):
            found.append(f"{mutant.name}: expected an expression or a statement between the marks, found {marked}")
        times = path.read_text(encoding="utf-8").count(mutant.text)
        if times != 1:
            found.append(f"{mutant.name}: expected its text once in {mutant.file}, found it {times} times")
    return found or overlaps(root, mutants)


def overlaps(root, mutants):
    """REQUIRES: each text is there once."""
    found = []
    for path in sorted({one.file for one in mutants}):
        text = (pathlib.Path(root) / path).read_text(encoding="utf-8")
        end, before = 0, None
        for begin, one in sorted((text.find(one.text), one.name) for one in mutants if one.file == path):
            if begin < end:
                found.append(f"{one}: its text overlaps that of {before}")
            end, before = begin + len(next(m.text for m in mutants if m.name == one)), one
    return found


def mutated_sources(root, mutants):
    """{path: text} of all sources with a fault in them. REQUIRES: there are no problems()."""
    sources = {}
    for mutant in mutants:
        text = sources.get(mutant.file) or (pathlib.Path(root) / mutant.file).read_text(encoding="utf-8")
        sources[mutant.file] = text.replace(mutant.text, mutant.replaced())
    return {path: '#include "base/mutant.hpp"\n' + text for path, text in sources.items()}


def environment(mutant):
    """That of a run with this fault, or with none."""
    result = {name: value for name, value in os.environ.items() if name != "COORDREQ_MUTANT"}
    result["RC_PARAMS"] = "seed=20180410 verbose_progress=0 verbose_shrinking=0"
    if mutant:
        result["COORDREQ_MUTANT"] = str(mutant.number)
    return result
