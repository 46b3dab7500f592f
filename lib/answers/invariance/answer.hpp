#pragma once

#include <string>
#include <vector>

#include "answers/answer.hpp"
#include "answers/invariance/invariance.hpp"
#include "choices/controller.hpp"

namespace coordreq {

/// The nonterminal cells of K, and C there: all of K but the cells of a goal that ends the
/// task, where agents choose nothing. Code that needs the choices of agents takes them in these cells.
struct NonterminalController {
  CellSet cells;  ///< K \ G; not used, and empty, where no goal ends the task
  Controller controller;
};

/// The guarantee of a result of this spec: "samples", "samples-center" or "continuous" (contract, "What is
/// guaranteed"). Safety at centres proves nothing about tubes, so that it is never "continuous".
[[nodiscard]] std::string guarantee_of(const ProblemSpec& spec);

extern const Answer invariance_answer;

// What its row takes from other files of this folder.
[[nodiscard]] Fields invariance_fields(const ProblemSpec& spec);
void fill_invariance_fields(const Answers& answers, ThreadTeam& team, FieldValues& values);

}  // namespace coordreq
