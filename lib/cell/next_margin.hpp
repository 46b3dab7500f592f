#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "cell/margin.hpp"
#include "cell/next_states.hpp"
#include "model/input_class.hpp"

namespace coordreq {

/// The margin of `safe` at the next states of one point under many joint inputs. Each comparison in it is
/// computed once for all joint inputs that lead to the same values there. Scratch inside: one object a
/// thread.
class NextMargin {
 public:
  using Numbers = std::vector<std::int64_t>;

  /// @param dynamics that of the next states @pre unchecked: `spec` outlives this object
  NextMargin(const ProblemSpec& spec, const InputSpace& space, const PointDynamics& dynamics);

  /// The joint input of the smallest margin, of several the smallest number. A next state that is not known
  /// has the margin -infinity. @pre `candidates` is not empty
  [[nodiscard]] std::int64_t smallest(NextStates& next, const Numbers& candidates);

 private:
  struct Comparison {
    std::vector<std::size_t> states;                            ///< on which it depends
    InputClass inputs;                                          ///< on which these depend
    std::unordered_map<std::int64_t, double> approximate = {};  ///< differences, by actions of `inputs`
    std::unordered_map<std::int64_t, double> exact = {};
  };

  [[nodiscard]] Numbers distinct(NextStates& next, const Numbers& candidates) const;
  [[nodiscard]] double approximate(NextStates& next, std::int64_t u);
  [[nodiscard]] double exact(NextStates& next, std::int64_t u);

  const ProblemSpec* spec_;
  Margin margin_;
  InputClass inputs_;  ///< on which the margin depends
  bool is_of_all_inputs_ = false;
  std::vector<Comparison> comparisons_;
  std::vector<double> differences_;  ///< [comparison] under the joint input at work
  std::vector<Rational> slots_;
  std::vector<double> doubles_;
};

}  // namespace coordreq
