#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "expression/program.hpp"
#include "numeric/truth.hpp"

namespace coordreq {

/// An operator of a memory, which is kept in one discrete state (contract, section 6). Truths are kept as 0
/// no, 1 yes, or, where an argument can be undecided, as 0 no, 1 undecided, 2 yes; counts as they are.
struct PastOperator {
  enum class Kind : std::uint8_t { once, previous, since, within, for_last };
  Kind kind = Kind::once;
  std::int64_t samples = 1;   ///< of the counted ones, >= 2; `samples` values are kept
  bool three_valued = false;  ///< of the others
  bool possibly = false;      ///< counts samples at which the argument was not false, rather than true
  std::uint32_t slot = 0;     ///< of the state
  Program first;              ///< conditions over states and what earlier memories and inner operators keep
  Program second;             ///< of `since(first, second)`; else as `first`

  [[nodiscard]] bool is_counted() const { return kind == Kind::within || kind == Kind::for_last; }
  [[nodiscard]] std::int64_t values() const { return is_counted() ? samples : three_valued ? 3 : 2; }

  /// The value that is kept before the next sample, given the truths of the arguments at this one.
  [[nodiscard]] std::int64_t next(Truth one, Truth other, std::int64_t before) const {
    const auto level = [this](Truth truth) -> std::int64_t {
      if (truth == Truth::undecided) return 1;
      return truth == Truth::yes ? values() - 1 : 0;
    };
    const bool holds = one == Truth::yes || (possibly && one == Truth::undecided);
    switch (kind) {
      case Kind::once:
        return std::max(before, level(one));
      case Kind::previous:
        return level(one);
      case Kind::since:
        return std::max(level(other), std::min(level(one), before));
      case Kind::within:
        return holds ? samples - 1 : std::max<std::int64_t>(before - 1, 0);
      default:
        return holds ? std::min(before + 1, samples - 1) : 0;
    }
  }

  /// Slots of all that the next value depends on, ascending.
  [[nodiscard]] std::vector<std::uint32_t> variables() const;
};

}  // namespace coordreq
