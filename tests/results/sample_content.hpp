#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "answers/field.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq::sample {

/// A made-up result in which every element is a formula of its place, so that a reader can compute what must
/// be there. Three states, three inputs, agents a, b, c; two partitions, one with a name as given, one
/// canonical.
struct Options {
  std::vector<std::uint64_t> points = {61, 51, 40};  ///< of x1, x2, heading
  ElementType steps = ElementType::int16;            ///< of collision times, delays and triggers
  bool truncated = false;
  bool with_extras = true;       ///< layers, actions, controller, abstraction
  bool with_everything = false;  ///< whatever a file can have
};
inline const std::vector<std::uint64_t> kFewPoints = {6, 5, 4};

struct Sample {
  ProblemSpec spec;
  FieldValues values;
};

inline constexpr std::int64_t kConnectionDelay = 2;

[[nodiscard]] std::int64_t maximum(ElementType steps);
[[nodiscard]] bool is_safe(std::uint64_t cell);
[[nodiscard]] bool is_invariant(std::uint64_t cell);
[[nodiscard]] std::int64_t collision_time(std::uint64_t cell, ElementType steps);
[[nodiscard]] std::int64_t delay(std::uint64_t partition, std::uint64_t cell, ElementType steps);
[[nodiscard]] std::int64_t trigger(std::uint64_t partition, std::uint64_t cell, ElementType steps);
/// Byte at linear index i of a packed array of actions.
[[nodiscard]] std::uint8_t action_byte(std::uint64_t i);

[[nodiscard]] std::uint64_t cell_count(const Options& options);
/// Cells of a set.
[[nodiscard]] std::uint64_t count_cells(const Options& options, bool (*is_member)(std::uint64_t cell));
[[nodiscard]] std::string spec_text(const Options& options);
[[nodiscard]] Sample make_sample(const Options& options = {});
/// Writes its results file; the same options once in this process, and then a copy of its bytes.
void write_sample(const std::string& path, const Options& options);

}  // namespace coordreq::sample
