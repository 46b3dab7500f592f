#include "answers/silence/answer.hpp"

#include <memory>

#include "answers/checking/class_choices.hpp"
#include "answers/paths.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

class SilencePolicy : public CellPolicy {
 public:
  SilencePolicy(const PolicyContext& context, ClassChoices::Rules rules)
      : choices_(*context.spec, context.posts->grid(), context.posts->inputs(), context.partition->classes,
                 rules) {}

  bool holds(std::int64_t /*cell*/) override { return true; }
  const Numbers& together(std::int64_t /*cell*/, const Numbers& admissible) override { return admissible; }
  std::vector<Numbers> alone(std::int64_t cell, std::int32_t /*countdown*/, const Numbers& together,
                             const std::vector<InputClass>& /*classes*/) override {
    choices_.go_to(cell, together);
    return choices_.numbers();
  }

 private:
  ClassChoices choices_;
};

template <ClassChoices::Rules rules>
std::unique_ptr<CellPolicy> make_policy(const PolicyContext& context) {
  return std::make_unique<SilencePolicy>(context, rules);
}

}  // namespace

/// Agents who act by rules while they are silent: each class chooses from its A_c(x), at every countdown
/// (contract, section 9). None if the spec does not say what silent agents do.
std::vector<AnswerPolicy> silence_policies(const ProblemSpec& spec) {
  if (!spec.silence) return {};
  return {{.name = kSilenceKind.name,
           .kind = &kSilenceKind,
           .label = "silent",
           .gain = "safe by the rule",
           .headline = "by the communication-loss rule",
           .delay = paths::kSilence,
           .is_anywhere = true,
           .make = make_policy<ClassChoices::Rules::actions>,
           .make_then = spec.silence->has_then() ? make_policy<ClassChoices::Rules::then> : nullptr,
           .header = {.where = "under the communication-loss rule",
                      .purpose = "Agents that follow the communication-loss rule during silence.",
                      .countdown = "Steps of silence that are safe, or one of the numbers above.",
                      .allowed = "Whether class c may take its joint action a during silence."}}};
}

}  // namespace coordreq
