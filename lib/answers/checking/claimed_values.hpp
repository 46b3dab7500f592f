#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "answers/checking/claims.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// A number of steps in words.
[[nodiscard]] std::string step_words(std::int32_t value);
[[nodiscard]] std::int32_t one_more(std::int32_t steps);
/// How many are not 0.
[[nodiscard]] std::uint64_t count_members(const std::vector<std::uint8_t>& set);
/// The delay of a cell; without a partition that of all agents together.
[[nodiscard]] std::int32_t claimed_delay(const Claims& claims, std::optional<std::size_t> partition,
                                         std::size_t cell);
/// What a requirement judges a cell by: its delay, arrival or approach delay.
[[nodiscard]] std::int32_t claimed_value(const Claims& claims, const RequirementSpec& asked,
                                         std::size_t cell);

/// How bits of a cell differ from those expected.
struct BitDifference {
  std::int64_t extra = 0;  ///< set, but they must not be; bits beyond the last expected one are such
  bool fewer = false;      ///< some are missing
};
/// @param bytes [cell, ceil(m / 8)] for the m expected bits, each 0 or 1
[[nodiscard]] BitDifference compare_bits(const std::vector<std::uint8_t>& bytes, std::size_t cell,
                                         const std::vector<std::uint8_t>& expected);

}  // namespace coordreq
