#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "answers/checking/tally.hpp"

namespace coordreq {

/// Compares one number after the other.
class Comparison {
 public:
  explicit Comparison(std::string check) : tally_(std::move(check)) {}

  template <class Number>
  void expect(std::string_view what, Number value, Number expected) {
    tally_.add_checked(1);
    if (value == expected) return;
    tally_.add_wrong(number_++, [&] { return fmt::format("{}: {}, expected {}", what, value, expected); });
  }
  [[nodiscard]] Finding finding() const { return tally_.finding(); }

 private:
  Tally tally_;
  std::int64_t number_ = 0;
};

}  // namespace coordreq
