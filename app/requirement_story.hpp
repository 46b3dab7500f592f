#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "answers/requirements/result_requirement.hpp"
#include "spec/problem_spec.hpp"

// A counterexample in words. `analyze` and `report` tell it alike.
namespace coordreq {

/// "3 steps (1.5 s)".
[[nodiscard]] std::string steps_text(std::int64_t steps, const ProblemSpec& spec);

/// The state that a counterexample starts in: "p1 = -9, v1 = 2".
[[nodiscard]] std::string start_text(const ResultPath& path, const ProblemSpec& spec);

/// "p1 above its grid".
[[nodiscard]] std::string side_text(const ResultSide& side, const ProblemSpec& spec);

/// "independent" or "evasive".
[[nodiscard]] const char* phase_word(EscapePhase phase);

/// One row a sample: where, what is left, and what each agent does next.
struct StoryTable {
  std::vector<std::string> heads;
  std::vector<std::vector<std::string>> rows;  ///< [sample][head]; the first cell is the number of the sample
  std::size_t numbers = 0;                     ///< so many of the first columns hold numbers
};
[[nodiscard]] StoryTable story_table(const ResultPath& path, const RequirementSpec& requirement,
                                     const ProblemSpec& spec);

/// The same in sentences.
[[nodiscard]] std::vector<std::string> story_sentences(const ResultPath& path,
                                                       const RequirementSpec& requirement,
                                                       const ProblemSpec& spec);

}  // namespace coordreq
