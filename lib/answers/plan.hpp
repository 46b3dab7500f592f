#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "answers/answers.hpp"
#include "answers/field.hpp"
#include "answers/field_source.hpp"
#include "answers/memory_need.hpp"
#include "answers/one_cell/explain_ground.hpp"
#include "answers/one_cell/policy.hpp"
#include "answers/stage.hpp"
#include "answers/warning.hpp"
#include "base/json.hpp"

namespace coordreq {

class AnswerCheck;
struct CheckGround;

/// One thing that an analysis can answer, in a folder of its own: what it takes to find it, what to say of it
/// and how to check that. Whoever works on answers goes over all_answers() and knows none by name.
struct Answer {
  /// What can be refused before any work is done, for the spec alone; null: nothing.
  std::vector<Stage> (*checks)(const ProblemSpec& spec) = nullptr;
  /// In their order; none if the spec does not ask for it. They need the answers before.
  std::vector<Stage> (*stages)(const ProblemSpec& spec) = nullptr;
  /// What that takes with so many threads, and writing it; nothing if the spec does not ask for it.
  MemoryNeed (*memory)(const EngineSizes& sizes, int threads) = nullptr;
  /// Its datasets in the results file of a spec; none if the spec does not ask for it.
  Fields (*fields)(const ProblemSpec& spec) = nullptr;
  /// What was found for them.
  void (*fill)(const Answers& answers, ThreadTeam& team, FieldValues& values) = nullptr;
  /// Adds its keys to the JSON summary (contract, section 3), and what its fixed points took to `work`, by
  /// stage. Called whether or not it was asked for.
  void (*summarise)(const Answers& answers, Json& summary, Json& work) = nullptr;
  /// Fails where small fields of a file do not fit together; null: they always do.
  void (*examine)(const ProblemSpec& spec, const FieldSource& source) = nullptr;
  /// Adds to what `info` says of a file: the same keys, as far as the file tells them. Called whether or not
  /// it was asked for; null: nothing.
  void (*tell)(const ProblemSpec& spec, const FieldSource& source, Json& info) = nullptr;
  /// What of it is no error and can mislead; null: nothing. Called whether or not it was asked for.
  Warnings (*advise)(const Answers& answers) = nullptr;
  /// What it leaves to agents at a cell and a countdown; null: it says nothing of that.
  std::vector<AnswerPolicy> (*policies)(const ProblemSpec& spec) = nullptr;
  /// What it adds to the explanation of a delay, whether or not it was asked for; null: nothing.
  Explained (*explain)(const ExplainGround& ground) = nullptr;
  /// What it says in a file, to be checked by its definition; null, or a null result: nothing is.
  std::unique_ptr<AnswerCheck> (*check)(const CheckGround& ground) = nullptr;
  /// Bytes that this keeps of each cell beside what the file says; null: none.
  double (*check_memory)(const ProblemSpec& spec) = nullptr;
};

/// In the order of need; the first is the ground, on which all others stand.
[[nodiscard]] const std::vector<Answer>& all_answers();

/// The stages of all answers that the spec asks for, in order.
[[nodiscard]] std::vector<Stage> answer_stages(const ProblemSpec& spec);

/// The policies of all answers that the spec asks for, in order; the first is that of the delays.
[[nodiscard]] std::vector<AnswerPolicy> answer_policies(const ProblemSpec& spec);

/// Where the work is told of and kept.
struct PlanWatch {
  /// A stage begins; may be empty.
  std::function<void(const std::string& stage)> enter = {};
  /// Where this stage is kept, or null; may be empty.
  std::function<StageStore*(const std::string& stage)> store = {};
};

/// Works out one stage after the other. @param work its store is not looked at
void run_stages(const std::vector<Stage>& stages, Answers& answers, const StageWork& work,
                const PlanWatch& watch = {});

}  // namespace coordreq
