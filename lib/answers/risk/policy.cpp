#include "answers/risk/policy.hpp"

#include <algorithm>

#include "answers/one_cell/cell_members.hpp"
#include "answers/one_cell/kept_inputs.hpp"

namespace coordreq {
namespace {

class SafestPolicy : public CellPolicy {
 public:
  explicit SafestPolicy(const PolicyContext& context)
      : posts_(*context.posts),
        after_(context.values(paths::kRiskAfter)),
        most_(context.values(paths::kRiskMost)) {}

  bool holds(std::int64_t /*cell*/) override { return true; }
  const Numbers& together(std::int64_t cell, const Numbers& admissible) override {
    const Numbers* const known = safest_.find(cell);
    return known != nullptr ? *known : safest_.keep(cell, safest(cell, admissible));
  }

 private:
  [[nodiscard]] Numbers safest(std::int64_t cell, const Numbers& admissible) {
    posts_.move_to(cell);
    risks_.clear();
    for (const std::int64_t u : admissible) risks_.push_back(worst(u));
    if (risks_.empty()) return {};
    const std::int32_t most = std::max(most_(cell), *std::ranges::min_element(risks_));
    Numbers chosen;
    for (std::size_t i = 0; i < admissible.size(); ++i) {
      if (risks_[i] <= most) chosen.push_back(admissible[i]);
    }
    return chosen;
  }

  /// The greatest risk in f(x,u), as bits. No post of C(x) is blocked.
  [[nodiscard]] std::int32_t worst(std::int64_t u) {
    std::vector<IndexRange> box;
    for (std::size_t i = 0; i < posts_.grid().size(); ++i) {
      const ResolvedRange range = posts_.resolved(i, u);
      if (range.all_left()) return 0;
      box.push_back(range.inside);
    }
    std::int32_t worst = 0;
    for_each_cell(posts_.grid(), box, [&](std::int64_t y) {
      worst = std::max(worst, after_(y));
      return true;
    });
    return worst;
  }

  CellPosts& posts_;
  CellValue after_, most_;
  std::vector<std::int32_t> risks_;  ///< [position in C(x)]
  KeptInputs safest_;
};

}  // namespace

AnswerPolicy safest_policy(const std::string& delay) {
  return {.label = "safest actions",
          .delay = delay,
          .make = [](const PolicyContext& context) -> std::unique_ptr<CellPolicy> {
            return std::make_unique<SafestPolicy>(context);
          }};
}

}  // namespace coordreq
