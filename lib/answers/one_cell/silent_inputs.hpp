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

/// What agents do by rules of their own at single cells, each class of a partition by itself (contract,
/// section 9): A_c(x) of `actions`, or of `then` the sets whose product is C'(x). Scratch inside: one object
/// a thread.
class SilentInputs {
 public:
  using Numbers = std::vector<std::int64_t>;
  enum class Part : std::uint8_t { actions, then };

  /// @param classes by agents
  /// @pre unchecked: the spec has that part of `silence`; it and `posts` outlive this object.
  SilentInputs(const ProblemSpec& spec, Part part, const std::vector<std::vector<std::int32_t>>& classes,
               const CellPosts& posts);

  /// [class] the actions that its agents' rules permit at x and, if one of them has none, that are part of a
  /// joint input of C(x), ascending. @param admissible C(x)
  [[nodiscard]] std::vector<Numbers> of(std::int64_t x, const Numbers& admissible);
  /// Some class may do something only if C(x) permits it.
  [[nodiscard]] bool asks_controller() const;
  /// Their product: joint inputs, ascending.
  [[nodiscard]] Numbers joint(std::int64_t x, const Numbers& admissible);
  [[nodiscard]] const std::vector<InputClass>& classes() const { return classes_; }

 private:
  /// Each agent's own actions, and what they add to a joint input.
  struct Agent {
    InputClass inputs;
    Numbers parts;
    std::optional<PairTruth> rule;
    std::vector<bool> permitted;  ///< [action] at the cell at work
  };

  std::deque<Agent> agents_;
  std::vector<std::vector<std::int32_t>> members_;  ///< [class] agents
  std::vector<InputClass> classes_;
  std::vector<Numbers> parts_;  ///< [class][action]
};

}  // namespace coordreq
