#pragma once

#include <rapidcheck.h>

#include <array>
#include <string>

namespace coordreq::test {

inline int draw(int low, int high) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high + 1));
}

inline std::string random_number(int depth) {
  if (depth <= 0) return draw(0, 2) == 0 ? std::to_string(draw(0, 3)) : std::string(1, "xyz"[draw(0, 2)]);
  const auto next = [depth] { return random_number(depth - draw(1, 2)); };
  switch (draw(0, 9)) {
    case 0:
      return "(" + next() + " + " + next() + ")";
    case 1:
      return "(" + next() + " - " + next() + ")";
    case 2:
      return "(" + next() + " * " + next() + ")";
    case 3:
      return "(" + next() + " / " + next() + ")";  // may be undefined
    case 4:
      return "abs(" + next() + ")";
    case 5:
    case 6:
      return "min(" + next() + ", " + next() + ")";
    default:
      return "max(" + next() + ", " + next() + ")";
  }
}

/// A condition over x, y and z with operations that are exact at rational points.
inline std::string random_condition(int depth) {
  constexpr std::array<const char*, 6> kComparisons{" < ", " <= ", " > ", " >= ", " == ", " != "};
  const auto comparison = [&] { return kComparisons[static_cast<std::size_t>(draw(0, 5))]; };
  switch (depth > 0 ? draw(0, 6) : 6) {
    case 0:
    case 1:
      return "(" + random_condition(depth - 1) + " and " + random_condition(depth - 1) + ")";
    case 2:
    case 3:
      return "(" + random_condition(depth - 1) + " or " + random_condition(depth - 1) + ")";
    case 4:
      return "(not " + random_condition(depth - 1) + ")";
    case 5:
      return draw(0, 3) == 0
                 ? (draw(0, 1) == 0 ? "true" : "false")
                 : "(" + random_number(1) + " <= " + random_number(1) + " < " + random_number(1) + ")";
    default:
      return "(" + random_number(2) + comparison() + random_number(2) + ")";
  }
}

}  // namespace coordreq::test
