#include "analysis/analysis_stages.hpp"

#include <utility>

#include "answers/plan.hpp"
#include "results/controller_file.hpp"

namespace coordreq {
namespace {

void append(std::vector<Stage>& stages, std::vector<Stage> more) {
  for (Stage& stage : more) stages.push_back(std::move(stage));
}

/// A file that does not fit is an error that nobody should wait for.
void read_listed(Answers& answers, const StageWork& /*work*/) {
  answers.ground.listed = read_controller_file(answers.ground.spec);
}

}  // namespace

std::vector<Stage> analysis_stages(const ProblemSpec& spec) {
  std::vector<Stage> stages;
  for (const Answer& answer : all_answers()) {
    if (answer.checks != nullptr) append(stages, answer.checks(spec));
  }
  if (spec.controller.file) stages.push_back({"controller", read_listed});
  append(stages, answer_stages(spec));
  return stages;
}

}  // namespace coordreq
