#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "expression/condition.hpp"
#include "expression/domains.hpp"
#include "expression/evaluate.hpp"
#include "expression/program.hpp"

namespace coordreq::test {

/// A condition over x, y and z, slots 0, 1 and 2.
inline Program condition(std::string_view text) {
  const auto lookup = [](std::string_view name) -> Binding {
    constexpr std::array<std::string_view, 3> kNames{"x", "y", "z"};
    for (std::uint32_t slot = 0; slot < kNames.size(); ++slot) {
      if (name == kNames[slot]) return slot;
    }
    return NotDefined{};
  };
  return link(text, lookup, ExpectedType::condition, "test");
}

using Box = std::vector<RationalInterval>;

inline RationalInterval between(const Rational& lower, const Rational& upper) {
  return {.lower = lower, .upper = upper};
}

inline Truth decide(const Program& program, Box box, Question question = Question::truth) {
  box.resize(3);
  std::vector<Interval> fast;
  for (const RationalInterval& range : box) fast.push_back(enclose(range));
  return ConditionDecider(program, question).decide(fast, [&] {
    return std::span<const RationalInterval>(box);
  });
}

inline Truth decide(std::string_view text, Box box, Question question = Question::truth) {
  return decide(condition(text), std::move(box), question);
}

/// Natural evaluation in exact rationals, all that there was without sharpening.
inline Truth decide_naturally(const Program& program, Box box) {
  box.resize(3);
  return Evaluator<RationalInterval>(program).condition(box);
}

}  // namespace coordreq::test
