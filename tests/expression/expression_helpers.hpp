#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "expression/evaluate.hpp"
#include "expression/program.hpp"

namespace coordreq {

inline constexpr std::array<std::string_view, 3> kVariables{"x", "y", "z"};

/// x, y and z are the variables 0, 1 and 2.
inline Binding look_up_xyz(std::string_view name) {
  for (std::uint32_t i = 0; i < kVariables.size(); ++i) {
    if (name == kVariables[i]) return i;
  }
  return NotDefined{};
}

inline Program link_xyz(std::string_view text, ExpectedType expected = ExpectedType::any) {
  return link(text, look_up_xyz, expected, "/safe");
}

inline RationalInterval exactly(const Rational& q) {
  return {q, q, true, true};
}

/// The exact value of a number at a point. REQUIRES: it is rational.
inline Rational value_at(std::string_view text, const Rational& x = 0, const Rational& y = 0,
                         const Rational& z = 0) {
  const Program program = link_xyz(text, ExpectedType::number);
  const std::array slots{exactly(x), exactly(y), exactly(z)};
  const RationalInterval value = Evaluator<RationalInterval>(program).number(slots);
  if (!value.is_point()) throw SpecError("not an exact value");
  return value.lower;
}

inline Truth truth_at(std::string_view text, const Rational& x = 0, const Rational& y = 0,
                      const Rational& z = 0) {
  const Program program = link_xyz(text, ExpectedType::condition);
  const std::array slots{exactly(x), exactly(y), exactly(z)};
  return Evaluator<RationalInterval>(program).condition(slots);
}

/// What the error says; empty if there is none.
template <class Action>
std::string error_of(Action&& action) {
  try {
    action();
  } catch (const SpecError& error) {
    return error.what();
  }
  return "";
}

}  // namespace coordreq
