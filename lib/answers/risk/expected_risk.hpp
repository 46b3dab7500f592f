#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "numeric/rational.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// E_q v = the greatest sum over q' of p(q, q') v(q') with admissible p: each within its range, all together
/// 1. The rest of probability, when all have their least, goes to the modes of greatest v, as much as each
///    may have (R. Givan, S. Leach, T. Dean: Bounded-parameter Markov decision processes, Artificial
///    Intelligence 122(1-2), 2000, doi:10.1016/S0004-3702(00)00047-3).
///
/// Computed in double, every operation rounded up, so that the result is nowhere below the exact number;
/// exact if all operations are, 0 only if the exact number is 0, and never above the greatest v(q').
class ExpectedRisk {
 public:
  /// A mode that can follow, and the range of its probability, as in NetworkSpec.
  struct Successor {
    std::size_t mode;
    Rational low;
    Rational high;
  };
  explicit ExpectedRisk(const std::vector<Successor>& successors);

  /// The modes q' that can follow, in the order of the spec's transitions.
  [[nodiscard]] const std::vector<std::size_t>& successors() const { return successors_; }

  /// out = for each lane E_q of the risks whose levels are in `rows`, as a level; with 32 bits rounded up to
  /// float once. @param rows [successor] n lanes, none below kCertain Level: std::uint32_t, std::uint64_t.
  template <class Level>
  void find(std::span<const std::uint32_t* const> rows, std::size_t n, Level* out) const;

 private:
  std::vector<std::size_t> successors_;
  std::vector<double> least_;  ///< [successor] its least probability
  std::vector<double> more_;   ///< [successor] probability that it may have beyond its least; empty: none may
  double rest_ = 0;            ///< 1 less the sum of least_
};

extern template void ExpectedRisk::find(std::span<const std::uint32_t* const>, std::size_t,
                                        std::uint32_t*) const;
extern template void ExpectedRisk::find(std::span<const std::uint32_t* const>, std::size_t,
                                        std::uint64_t*) const;

/// The different E_q of a network, and which mode has which: modes with the same outgoing numbers share one.
struct ExpectedRisks {
  explicit ExpectedRisks(const NetworkSpec& network);

  std::vector<ExpectedRisk> different;
  std::vector<std::size_t> of_mode;  ///< [mode] index into `different`
};

}  // namespace coordreq
