#pragma once

#include <memory>
#include <vector>

#include "answers/answers.hpp"
#include "answers/field.hpp"
#include "answers/field_source.hpp"
#include "answers/memory_need.hpp"
#include "answers/one_cell/explain_context.hpp"
#include "answers/one_cell/policy.hpp"
#include "answers/stage.hpp"
#include "answers/warning.hpp"
#include "base/json.hpp"

namespace coordreq {

class AnswerCheck;
struct CheckContext;

/// One answer of an analysis, in a folder of its own: how it is found, shown and checked. Each folder defines
/// one, in answer.cpp; code that works on answers goes over all_answers() and knows none by name.
struct Answer {
  /// Stages that can refuse the spec before any work is done; null: none.
  std::vector<Stage> (*checks)(const ProblemSpec& spec) = nullptr;
  /// Its stages, in order; none if the spec does not ask for the answer. They need the answers before it in
  /// the plan.
  std::vector<Stage> (*stages)(const ProblemSpec& spec) = nullptr;
  /// The memory that stages and writing take with `threads` threads; 0 if the spec does not ask for the
  /// answer.
  MemoryNeed (*memory)(const EngineSizes& sizes, int threads) = nullptr;
  /// Its datasets in the results file of a spec; none if the spec does not ask for the answer.
  Fields (*fields)(const ProblemSpec& spec) = nullptr;
  /// Fills in the values of its datasets.
  void (*fill)(const Answers& answers, ThreadTeam& team, FieldValues& values) = nullptr;
  /// Adds its keys to the JSON summary (contract, section 3), and the work of its fixed points to `work`, by
  /// stage. Called whether or not the spec asks for the answer.
  void (*summarise)(const Answers& answers, Json& summary, Json& work) = nullptr;
  /// Fails if small fields of a file do not fit together; null: they always do.
  void (*examine)(const ProblemSpec& spec, const FieldSource& source) = nullptr;
  /// Adds its keys to the JSON of `info`: those of the summary, as far as the file has them. Called whether
  /// or not the spec asks for the answer; null: none.
  void (*describe)(const ProblemSpec& spec, const FieldSource& source, Json& info) = nullptr;
  /// Its warnings; null: none. Called whether or not the spec asks for the answer.
  Warnings (*advise)(const Answers& answers) = nullptr;
  /// Its policies: the choices that it leaves to agents at a cell and a countdown; null: none.
  std::vector<AnswerPolicy> (*policies)(const ProblemSpec& spec) = nullptr;
  /// Its addition to the explanation of a delay, whether or not the spec asks for the answer; null: none.
  Explained (*explain)(const ExplainContext& context) = nullptr;
  /// The check of its fields in a file, by its definition; null, or a null result: there is none.
  std::unique_ptr<AnswerCheck> (*check)(const CheckContext& context) = nullptr;
  /// Bytes for each cell that the check keeps beside the values of the file; null: none.
  double (*check_memory)(const ProblemSpec& spec) = nullptr;
};

}  // namespace coordreq
