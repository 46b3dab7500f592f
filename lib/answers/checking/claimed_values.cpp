#include "answers/checking/claimed_values.hpp"

#include <algorithm>

#include "answers/step_codes.hpp"
#include "spec/problem_spec.hpp"
#include "spec/requirement_kind.hpp"

namespace coordreq {

std::string step_text(std::int32_t value) {
  return value == kUnbounded ? "infinite" : std::to_string(value);
}

std::int32_t one_more(std::int32_t steps) {
  return steps == kUnbounded ? kUnbounded : steps + 1;
}

std::uint64_t count_members(const std::vector<std::uint8_t>& set) {
  return set.size() - static_cast<std::uint64_t>(std::count(set.begin(), set.end(), 0));
}

ClaimedValues::ClaimedValues(const Claims& claims, const ProblemSpec& spec,
                             const RequirementSpec& requirement)
    : safe_(claims.members("/safe")), invariant_(claims.members("/invariant")) {
  if (requirement.kind == RequirementKind::invariant) return;
  const RequirementDataset dataset = dataset_of(requirement.kind, spec);
  if (requirement.kind == RequirementKind::max_risk) {
    risks_ = &claims.at(dataset.path).reals[dataset.entry];
    return;
  }
  values_ = &claims.values(dataset.path, static_cast<std::size_t>(requirement.partition.value_or(0)));
}

BitDifference compare_bits(const std::vector<std::uint8_t>& bytes, std::size_t cell,
                           const std::vector<std::uint8_t>& expected) {
  BitDifference difference;
  const std::size_t length = (expected.size() + 7) / 8;
  for (std::size_t a = 0; a < length * 8; ++a) {
    const bool stored = (bytes[cell * length + a / 8] >> (a % 8) & 1U) != 0;
    const bool right = a < expected.size() && expected[a] != 0;
    if (stored && !right) ++difference.extra;
    if (!stored && right) difference.fewer = true;
  }
  return difference;
}

}  // namespace coordreq
