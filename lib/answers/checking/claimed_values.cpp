#include "answers/checking/claimed_values.hpp"

#include <algorithm>

#include "spec/problem_spec.hpp"

namespace coordreq {

std::string step_words(std::int32_t value) {
  return value == kForever ? "infinite" : std::to_string(value);
}

std::int32_t one_more(std::int32_t steps) {
  return steps == kForever ? kForever : steps + 1;
}

std::uint64_t count_members(const std::vector<std::uint8_t>& set) {
  return set.size() - static_cast<std::uint64_t>(std::count(set.begin(), set.end(), 0));
}

std::int32_t claimed_delay(const Claims& claims, std::optional<std::size_t> partition, std::size_t cell) {
  if (partition) return claims.partitions[*partition].delay[cell];
  if (claims.safe[cell] == 0) return kOutsideSafe;
  return claims.invariant[cell] == 0 ? kOutsideInvariant : kForever;
}

std::int32_t claimed_value(const Claims& claims, const RequirementSpec& asked, std::size_t cell) {
  if (asked.kind == RequirementKind::max_arrival) return claims.numbers.at("/arrival")[cell];
  std::optional<std::size_t> partition;
  if (asked.partition) partition = static_cast<std::size_t>(*asked.partition);
  if (asked.kind == RequirementKind::min_approach_delay)
    return claims.partition_numbers.at("/approach_delay")[*partition][cell];
  return claimed_delay(claims, partition, cell);
}

BitDifference compare_bits(const std::vector<std::uint8_t>& bytes, std::size_t cell,
                           const std::vector<std::uint8_t>& expected) {
  BitDifference found;
  const std::size_t length = (expected.size() + 7) / 8;
  for (std::size_t a = 0; a < length * 8; ++a) {
    const bool stored = (bytes[cell * length + a / 8] >> (a % 8) & 1U) != 0;
    const bool right = a < expected.size() && expected[a] != 0;
    if (stored && !right) ++found.extra;
    if (!stored && right) found.fewer = true;
  }
  return found;
}

}  // namespace coordreq
