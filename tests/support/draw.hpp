#pragma once

#include <rapidcheck.h>

#include <cstddef>
#include <type_traits>
#include <vector>

// What the random cases of the tests are drawn with; inside a RapidCheck property.
namespace coordreq {

/// One of low, ..., high, at full size: RapidCheck would begin with the low end of every range.
template <class Low, class High>
[[nodiscard]] std::common_type_t<Low, High> draw(Low low, High high) {
  using Integer = std::common_type_t<Low, High>;
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange<Integer>(low, high + 1));
}

template <class T>
[[nodiscard]] T pick(const std::vector<T>& choices) {
  return choices[static_cast<std::size_t>(draw(0, static_cast<int>(choices.size()) - 1))];
}

}  // namespace coordreq
