#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "answers/checking/claims.hpp"
#include "answers/step_codes.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// A number of steps in words.
[[nodiscard]] std::string step_text(std::int32_t value);
[[nodiscard]] std::int32_t one_more(std::int32_t steps);
/// Number of entries that are not 0.
[[nodiscard]] std::uint64_t count_members(const std::vector<std::uint8_t>& set);
/// The values by which a requirement judges cells: the field that its kind names. Without a partition the
/// delay is that of all agents together.
class ClaimedValues {
 public:
  /// @pre unchecked: `claims` outlives this object.
  ClaimedValues(const Claims& claims, const ProblemSpec& spec, const RequirementSpec& requirement);

  [[nodiscard]] std::int32_t operator()(std::size_t cell) const {
    if (values_ != nullptr) return (*values_)[cell];
    if (risks_ != nullptr) return std::bit_cast<std::int32_t>((*risks_)[cell]);
    if (safe_[cell] == 0) return kOutsideSafe;
    return invariant_[cell] == 0 ? kOutsideInvariant : kUnbounded;
  }

 private:
  const std::vector<std::uint8_t>& safe_;
  const std::vector<std::uint8_t>& invariant_;
  const std::vector<std::int32_t>* values_ = nullptr;  ///< null: the delay of all agents together, or a risk
  const std::vector<float>* risks_ = nullptr;          ///< where the network starts
};

/// How the bits of a cell differ from those expected.
struct BitDifference {
  std::int64_t extra = 0;  ///< bits that are set and must not be, as are all beyond the last expected one
  bool fewer = false;      ///< bits that must be set are missing
};
/// @param bytes [cell, ceil(m / 8)] for the m expected bits, each 0 or 1
[[nodiscard]] BitDifference compare_bits(const std::vector<std::uint8_t>& bytes, std::size_t cell,
                                         const std::vector<std::uint8_t>& expected);

}  // namespace coordreq
