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
  void expect(std::string_view what, Number found, Number expected) {
    tally_.add_checked(1);
    if (found == expected) return;
    tally_.add_wrong(number_++, [&] { return fmt::format("{}: {}, expected {}", what, found, expected); });
  }
  [[nodiscard]] Finding finding() const { return tally_.finding(); }

 private:
  Tally tally_;
  std::int64_t number_ = 0;
};

}  // namespace coordreq
