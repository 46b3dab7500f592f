#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/cell_set.hpp"
#include "engine/packed_pairs.hpp"
#include "expression/evaluate.hpp"
#include "reach/abstraction.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// The controller C and its projections at single cells, computed when asked for: the analysis never stores
/// C, and a run visits few cells. Straight from the definitions (contract, "Controller").
///
/// States and inputs fall into components that have nothing to do with one another (as the directions of a
/// robot). Inputs of a component that move it alike are tried once: the gridworld's 14,641 joint inputs
/// become at most 625 boxes. Scratch inside: one object a thread.
class AdmissibleInputs {
 public:
  using IsMember = std::function<bool(std::int64_t cell)>;
  struct Sets {
    IsMember invariant;
    IsMember safe;                         ///< called only if the abstraction has tubes
    const CellSet* safe_beyond = nullptr;  ///< TubeSets::beyond
    const PackedPairs* listed = nullptr;   ///< what `controller.file` lists; null: it has none
  };

  /// REQUIRES: `spec`, `abstraction`, which is the spec's, and all sets outlive this object.
  AdmissibleInputs(const ProblemSpec& spec, const Abstraction& abstraction, Sets sets);

  /// C(x) as joint inputs, ascending. `maximal`: {u allowed : empty != f(x,u) subset of K}; `given`: all that
  /// are allowed. REQUIRES: x is in K. Cost: a look at every cell of every different post, and |C(x)|.
  [[nodiscard]] const std::vector<std::int64_t>& of(std::int64_t x);

 private:
  using Box = std::vector<IndexRange>;  ///< of some states
  /// Where a component's states can be next, and on the way there.
  struct Move {
    Box post;
    Box tube;  ///< empty if there are none
    bool passes_a_limit = false;
    [[nodiscard]] auto operator<=>(const Move&) const = default;
  };
  struct Component {
    std::vector<std::size_t> states;
    std::vector<std::size_t> inputs;
    bool has_allow = false;  ///< `allow` depends on inputs, all of them in here
    /// Of the cell at work: the parts of joint input numbers that lead to a move.
    std::vector<std::pair<Move, std::vector<std::int64_t>>> groups;
  };

  void find_components();
  void find_moves(Component& component, std::int64_t x);
  [[nodiscard]] std::optional<Move> move(const Component& component, std::int64_t x, std::int64_t u) const;
  [[nodiscard]] bool is_allowed(std::int64_t x, std::int64_t u);
  [[nodiscard]] bool is_safe(const std::vector<std::int64_t>& choice) const;
  [[nodiscard]] bool stays_in(const std::vector<std::int64_t>& choice, Box Move::*part,
                              const IsMember& set) const;
  void collect(const std::vector<std::int64_t>& choice);
  void sort();

  const ProblemSpec* spec_;
  const Abstraction* abstraction_;
  Sets sets_;
  IsMember safe_beyond_;
  std::vector<Component> components_;
  std::unique_ptr<Evaluator<RationalInterval>> allow_;  ///< none if everything is allowed
  bool allow_has_inputs_ = false;
  std::vector<RationalInterval> point_;
  std::vector<std::int64_t> admissible_;
  std::vector<bool> marks_;
};

}  // namespace coordreq
