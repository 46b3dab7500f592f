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

/// The actions of one class: the joint values of its inputs, numbered row-major, the last input fastest.
class ActionClass {
 public:
  /// @param inputs indices of the class's inputs, ascending
  ActionClass(const InputSpace& space, std::vector<std::int32_t> inputs);

  [[nodiscard]] const std::vector<std::int32_t>& inputs() const { return inputs_; }
  [[nodiscard]] std::int64_t count() const { return count_; }
  /// The part of joint input u that belongs to this class.
  [[nodiscard]] std::int64_t action(std::int64_t u) const {
    return actions_.empty() ? compute_action(u) : actions_[static_cast<std::size_t>(u)];
  }
  /// What action `a` adds to the number of a joint input.
  [[nodiscard]] std::int64_t part(std::int64_t a) const;
  /// The projection of a set of joint inputs onto the class, ascending.
  [[nodiscard]] std::vector<std::int64_t> project(const std::vector<std::int64_t>& joint_inputs) const;

 private:
  [[nodiscard]] std::int64_t compute_action(std::int64_t u) const;

  const InputSpace* space_;
  std::vector<std::int32_t> inputs_;
  std::int64_t count_ = 1;
  std::vector<std::int32_t> actions_;  ///< by joint input, where those are few enough for a table
};

/// The classes of a partition, in its order. REQUIRES: `space` outlives the result.
[[nodiscard]] std::vector<ActionClass> action_classes(const ProblemSpec& spec, const PartitionSpec& partition,
                                                      const InputSpace& space);

}  // namespace coordreq
