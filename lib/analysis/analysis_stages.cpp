#include "analysis/analysis_stages.hpp"

#include <span>
#include <utility>

#include "answers/plan.hpp"
#include "results/controller_file.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

void append(std::vector<Stage>& stages, std::vector<Stage> more) {
  for (Stage& stage : more) stages.push_back(std::move(stage));
}

/// Sends all processes the controller that the first one has read.
void share_listed(Ranks& ranks, ListedController& listed) {
  const auto text = std::as_bytes(std::span(listed.sha256));
  const Bytes sum = ranks.from_first({text.begin(), text.end()});
  listed.sha256.assign(reinterpret_cast<const char*>(sum.data()), sum.size());
  const auto pair_bytes = std::as_bytes(std::span(listed.pairs.bytes));
  Bytes message(pair_bytes.begin(), pair_bytes.end());
  put_numbers<std::int64_t>(message, {&listed.pairs.inputs, 1});
  const Bytes pairs = ranks.from_first(std::move(message));
  MessageReader reader(pairs);
  const auto bytes = reader.take(pairs.size() - sizeof(std::int64_t));
  listed.pairs.bytes.assign(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                            reinterpret_cast<const std::uint8_t*>(bytes.data()) + bytes.size());
  listed.pairs.inputs = reader.number();
}

/// A file that does not fit is an error that should be reported at once.
void read_listed(Answers& answers, const StageWork& /*work*/) {
  AnalysisContext& context = answers.context;
  if (context.ranks == nullptr || context.ranks->rank() == 0) {
    context.listed = read_controller_file(context.spec);
  } else {
    context.listed.emplace();
  }
  if (context.ranks != nullptr) share_listed(*context.ranks, *context.listed);
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
