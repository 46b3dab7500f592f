#include "answers/layers/answer.hpp"

#include "answers/paths.hpp"

namespace coordreq {
namespace {

class DelayPolicy : public CellPolicy {
 public:
  bool holds(std::int64_t /*cell*/) override { return true; }
  const Numbers& together(std::int64_t /*cell*/, const Numbers& admissible) override { return admissible; }
};

}  // namespace

/// Agents who coordinate choose from C(x), silent agents from IND_C(x), for as many steps as the delay.
std::vector<AnswerPolicy> layer_policies(const ProblemSpec& /*spec*/) {
  return {{.kind = &kDelayKind,
           .label = "actions",
           .delay = paths::kDelay,
           .trigger = paths::kTrigger,
           .make = [](const PolicyContext& /*context*/) -> std::unique_ptr<CellPolicy> {
             return std::make_unique<DelayPolicy>();
           },
           .stored = paths::actions}};
}

}  // namespace coordreq
