#pragma once

#include <cstdint>
#include <vector>

#include "numeric/rational.hpp"
#include "support/plain_engine.hpp"

namespace coordreq {

/// [mode][cell] the probability to leave K.
using PlainRisks = std::vector<std::vector<Rational>>;

/// Risks (contract, section 10) done the plain way, in exact fractions: one cell, one joint input and one
/// order of the modes at a time.
class PlainRisk {
 public:
  /// REQUIRES: the spec has a network with numbers; all outlive this object.
  PlainRisk(const ProblemSpec& spec, const Abstraction& abstraction, const std::vector<bool>& safe,
            const std::vector<bool>& safe_beyond, const PlainAnalysis& plain);

  [[nodiscard]] PlainRisks first() const;
  /// One more step.
  [[nodiscard]] PlainRisks next(const PlainRisks& risks, bool is_safest) const;
  /// The risk at a cell before the mode that follows `mode` is drawn.
  [[nodiscard]] Rational expected(const PlainRisks& risks, std::size_t mode, std::int64_t cell) const;

 private:
  struct Post {
    bool is_blocked = false;
    std::vector<std::int64_t> cells;  ///< none: what has not been blocked has left for good
  };
  struct Successor {
    std::size_t mode;
    Rational low;
    Rational high;
  };

  const PlainAnalysis& plain_;
  std::vector<std::vector<Post>> posts_;                 ///< [cell][joint input]
  std::vector<std::vector<std::vector<bool>>> choices_;  ///< [mode][cell][joint input] IND_C
  std::vector<bool> is_one_;                             ///< [mode] all agents are together
  std::vector<std::vector<Successor>> successors_;       ///< [mode]
};

}  // namespace coordreq
