#include "answers/layers/policy.hpp"

#include "answers/layers/fields.hpp"

namespace coordreq {
namespace {

class DelayPolicy : public CellPolicy {
 public:
  bool holds(std::int64_t /*cell*/) override { return true; }
  const Numbers& together(std::int64_t /*cell*/, const Numbers& admissible) override { return admissible; }
};

}  // namespace

std::vector<AnswerPolicy> layer_policies(const ProblemSpec& /*spec*/) {
  return {{.words = "actions",
           .delay = paths::kDelay,
           .trigger = paths::kTrigger,
           .make = [](const PolicyContext& /*context*/) -> std::unique_ptr<CellPolicy> {
             return std::make_unique<DelayPolicy>();
           },
           .stored = paths::actions}};
}

}  // namespace coordreq
