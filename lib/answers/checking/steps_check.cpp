#include "answers/checking/steps_check.hpp"

#include <algorithm>

#include "answers/step_codes.hpp"

namespace coordreq {

std::int32_t steps_outside(const CheckedCell& cell) {
  return cell.is_safe() ? kOutsideInvariant : kOutsideSafe;
}

std::int32_t steps_by_definition(CheckedCell& cell, const ClassChoices& choices,
                                 const std::vector<std::int32_t>& steps,
                                 const std::optional<std::int32_t>& most, std::int32_t least) {
  const bool is_terminal = cell.is_terminal();
  bool any = is_terminal;
  std::int32_t worst = kUnbounded;
  for (std::int64_t u = 0; !is_terminal && u < choices.joint_inputs() && worst > least; ++u) {
    if (!choices.has(u)) continue;
    any = true;
    const std::int32_t value = cell.is_forbidden(u) ? least : cell.least(u, steps, least);
    worst = std::min(worst, std::max(value, least));
  }
  const std::int32_t result = any ? one_more(worst) : 0;
  return most ? std::min(result, *most) : result;
}

void compare_steps(const CheckContext& context, Tally& tally, const CheckedCell& cell, std::int32_t claimed,
                   std::int32_t expected, bool choices_differ) {
  tally.add_checked(1);
  if (claimed == expected) return;
  if (context.sound_only() && expected >= 0 && claimed >= 0 && (claimed < expected || choices_differ)) {
    tally.add_unproven();
  } else {
    add_wrong_steps(tally, cell, claimed, expected);
  }
}

void compare_trigger(const CheckContext& context, Tally& tally, const CheckedCell& cell, std::int32_t delay,
                     const std::vector<std::int32_t>& triggers) {
  tally.add_checked(1);
  const std::int32_t claimed = triggers[cell.at()];
  const std::int64_t needed = context.spec->coordination.connection_delay;
  std::int32_t expected = delay;
  if (delay >= 0 && delay != kUnbounded)
    expected = delay < needed ? kMustBeConnected : static_cast<std::int32_t>(delay - needed);
  if (claimed != expected) add_wrong_steps(tally, cell, claimed, expected);
}

void compare_actions(const CheckContext& context, Tally& tally, const CheckedCell& cell,
                     const PartitionClaims& claims, const ClassChoices& choices, const std::string& label) {
  BitDifference all;
  for (std::size_t c = 0; c < claims.actions.size(); ++c) {
    const BitDifference difference = compare_bits(*claims.actions[c], cell.at(), choices.actions()[c]);
    all = {.extra = all.extra + difference.extra, .fewer = all.fewer || difference.fewer};
  }
  add_choices(context, tally, cell, all, label);
}

}  // namespace coordreq
