#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "results/result_content.hpp"

namespace coordreq::sample {

/// A made-up result in which every element is a formula of its place, so that a reader can compute what must
/// be there. Three states, two inputs, agents a, b, c; two partitions, one with a name as given, one
/// canonical; everything that is written on request.
struct Options {
  std::vector<std::uint64_t> points = {61, 51, 40};  ///< of x1, x2, heading
  ElementType steps = ElementType::int16;            ///< of collision times, delays and triggers
  bool truncated = false;
  bool with_extras = true;  ///< layers, actions, controller, abstraction
};

inline constexpr std::int64_t kConnectionDelay = 2;
inline constexpr char kSpecText[] = "{ \"coordreq\": 1, \"name\": \"sample \xC3\xA9\" }\n";

[[nodiscard]] std::int64_t maximum(ElementType steps);
[[nodiscard]] bool is_safe(std::uint64_t cell);
[[nodiscard]] bool is_invariant(std::uint64_t cell);
[[nodiscard]] std::int64_t collision_time(std::uint64_t cell, ElementType steps);
[[nodiscard]] std::int64_t delay(std::uint64_t partition, std::uint64_t cell, ElementType steps);
[[nodiscard]] std::int64_t trigger(std::uint64_t partition, std::uint64_t cell, ElementType steps);
/// Byte at linear index i of a packed array of actions.
[[nodiscard]] std::uint8_t action_byte(std::uint64_t i);

[[nodiscard]] std::uint64_t cell_count(const Options& options);
[[nodiscard]] ResultContent make_content(const Options& options = {});

}  // namespace coordreq::sample
