#pragma once

#include <cstdint>

namespace coordreq {

/// Kleene's three truth values. A condition over a box is `yes` if it holds at every point, `no` if at
/// none, else `undecided`; so is one that is not defined somewhere in the box.
enum class Truth : std::uint8_t { no, yes, undecided };

[[nodiscard]] constexpr Truth operator!(Truth a) {
  return a == Truth::undecided ? a : a == Truth::yes ? Truth::no : Truth::yes;
}
[[nodiscard]] constexpr Truth truth_and(Truth a, Truth b) {
  if (a == Truth::no || b == Truth::no) return Truth::no;
  return a == Truth::yes && b == Truth::yes ? Truth::yes : Truth::undecided;
}
[[nodiscard]] constexpr Truth truth_or(Truth a, Truth b) {
  if (a == Truth::yes || b == Truth::yes) return Truth::yes;
  return a == Truth::no && b == Truth::no ? Truth::no : Truth::undecided;
}
[[nodiscard]] constexpr Truth to_truth(bool value) {
  return value ? Truth::yes : Truth::no;
}

}  // namespace coordreq
