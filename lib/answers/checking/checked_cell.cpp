#include "answers/checking/checked_cell.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "answers/checking/cell_location.hpp"
#include "answers/step_codes.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

CheckedCell::CheckedCell(const CheckContext& context)
    : context_(context),
      safe_(context.claims->members("/safe")),
      invariant_(context.claims->members("/invariant")),
      delay_(context.claims->values("/delay")),
      arrival_(context.spec->ends_at_goal() ? &context.claims->values("/arrival") : nullptr),
      posts_(*context.posts),
      listed_(context.claims->listed),
      admitted_(static_cast<std::size_t>(context.inputs->count())) {
  if (context.tubes != nullptr) tubes_.emplace(*context.tubes);
  if (const auto& allow = context.spec->controller.allow)
    allow_.emplace(*context.spec, *allow, *context.grid, *context.inputs, "'allow'", "/controller/allow");
}

void CheckedCell::go_to(std::int64_t cell) {
  cell_ = cell;
  remembered_ = nullptr;
  std::fill(admitted_.begin(), admitted_.end(), 0);
  if (!is_safe()) return;
  posts_.go_to(cell);
  if (tubes_) tubes_->go_to(cell);
  if (allow_) allow_->go_to(cell);
  if (is_invariant()) find_admitted();
}

/// Finds C(x) by the delays of the first partition, which are negative exactly outside K: so their minima are
/// at hand for the check of delays.
void CheckedCell::find_admitted() {
  const bool given = context_.spec->controller.synthesis == Synthesis::given;
  all_stay_ = true;
  for (std::size_t u = 0; u < admitted_.size(); ++u) {
    const auto input = static_cast<std::int64_t>(u);
    if (!is_allowed(input)) continue;
    const bool stays = least(input, delay_, kOutsideInvariant) > kOutsideInvariant;
    all_stay_ = all_stay_ && stays;
    admitted_[u] = given || stays ? 1 : 0;
  }
}

std::string CheckedCell::location() const {
  return location_of(*context_.grid, cell_);
}

void add_wrong(Tally& tally, const CheckedCell& cell, const char* what) {
  tally.add_wrong(cell.number(), [&] { return fmt::format("{}: {}", cell.location(), what); });
}

void add_wrong_steps(Tally& tally, const CheckedCell& cell, std::int32_t claimed, std::int32_t expected) {
  tally.add_wrong(cell.number(), [&] {
    return fmt::format("{}: {}, expected {}", cell.location(), step_text(claimed), step_text(expected));
  });
}

void add_choices(const CheckContext& context, Tally& tally, const CheckedCell& cell,
                 const BitDifference& difference, const std::string& label) {
  tally.add_checked(1);
  if (difference.extra > 0) {
    tally.add_wrong(cell.number(), [&] {
      return fmt::format("{}: {}{} too many", cell.location(), difference.extra,
                         label.empty() ? "" : " " + label);
    });
  } else if (difference.fewer && context.sound_only()) {
    tally.add_unproven();
  } else if (difference.fewer) {
    tally.add_wrong(cell.number(), [&] {
      return fmt::format("{}: {} are missing", cell.location(), label.empty() ? "some" : label);
    });
  }
}

}  // namespace coordreq
