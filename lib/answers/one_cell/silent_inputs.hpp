#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "answers/one_cell/cell_posts.hpp"
#include "answers/one_cell/pair_truth.hpp"
#include "expression/program.hpp"
#include "model/input_class.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The actions of agents by rules of their own at single cells, each class of a partition by itself
/// (contract, section 9): A_c(x) for `actions`, or for `then` the sets whose product is C'(x). One object a
/// thread.
class SilentInputs {
 public:
  using Numbers = std::vector<std::int64_t>;
  enum class Part : std::uint8_t { actions, then };

  /// @param classes by agents
  /// @pre unchecked: the spec has this part of `silence`; spec and posts outlive this object.
  SilentInputs(const ProblemSpec& spec, Part part, const std::vector<std::vector<std::int32_t>>& classes,
               const CellPosts& posts);

  /// [class] The actions that the rules of its agents permit at x, ascending; if one of the agents has no
  /// rule, only those that occur in a joint input of C(x). @param admissible C(x)
  [[nodiscard]] std::vector<Numbers> of(std::int64_t x, const Numbers& admissible);
  /// Whether the actions of some class depend on C(x).
  [[nodiscard]] bool asks_controller() const;
  /// The product of the sets of all classes: joint inputs, ascending.
  [[nodiscard]] Numbers joint(std::int64_t x, const Numbers& admissible);
  [[nodiscard]] const std::vector<InputClass>& classes() const { return classes_; }

 private:
  /// The actions of an agent, and their contributions to the number of a joint input.
  struct Agent {
    InputClass inputs;
    Numbers parts;
    std::optional<PairTruth> rule;
    std::vector<bool> permitted;  ///< [action] at the last cell
  };

  std::deque<Agent> agents_;
  std::vector<std::vector<std::int32_t>> members_;  ///< [class] agents
  std::vector<InputClass> classes_;
  std::vector<Numbers> parts_;  ///< [class][action]
};

}  // namespace coordreq
