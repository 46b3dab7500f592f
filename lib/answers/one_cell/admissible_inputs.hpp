#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "answers/checking/permitted_inputs.hpp"
#include "answers/one_cell/cell_members.hpp"
#include "answers/one_cell/cell_posts.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The controller C at single cells, computed on request: the analysis never stores C, and a run or a
/// question visits few cells. Straight from the definitions (contract, "Controller").
///
/// States and inputs fall into components that do not depend on one another (as the directions of a robot).
/// Inputs of a component with the same post are tried once: the gridworld's 14,641 joint inputs become at
/// most 625 boxes. One object a thread.
class AdmissibleInputs {
 public:
  struct Sets {
    CellMembers* invariant = nullptr;
    CellMembers* safe = nullptr;  ///< read only if there are tubes
    /// Gives TubeSets::beyond, called only if a tube passes a limit; empty: the set is S.
    std::function<CellMembers*()> safe_beyond;
    /// Whether `controller.file` lists a pair of a cell and a joint input; empty: there is no such file.
    std::function<bool(std::int64_t cell, std::int64_t u)> listed;
  };

  /// @pre unchecked: `posts` are of `spec`; they, `spec` and all sets outlive this object.
  AdmissibleInputs(const ProblemSpec& spec, CellPosts& posts, Sets sets);

  /// C(x) as joint inputs, ascending. `maximal`: {u allowed : empty != f(x,u) subset of K}; `given`: all
  /// allowed joint inputs. @pre unchecked: x is in K. Cost: a look at the sets for every different post, and
  /// |C(x)|.
  /// @throws SpecError if `allow` cannot be decided
  [[nodiscard]] const std::vector<std::int64_t>& of(std::int64_t x);
  /// Whether `allow` permits u at any cell x of the grid, and `controller.file` lists it.
  [[nodiscard]] bool allows(std::int64_t x, std::int64_t u);
  /// Whether `allow` does not permit u at x; a joint input that the file does not list is not forbidden.
  [[nodiscard]] bool forbids(std::int64_t x, std::int64_t u);

 private:
  using Box = std::vector<IndexRange>;  ///< of some states
  /// Where the states of a component can be next, and between the samples.
  struct Move {
    Box post;
    Box tube;  ///< empty if there are no tubes
    bool passes_a_limit = false;
    [[nodiscard]] auto operator<=>(const Move&) const = default;
  };
  struct Component {
    std::vector<std::size_t> states;
    std::vector<std::size_t> inputs;
    bool has_allow = false;  ///< `allow` depends on inputs, which are all in this component
    /// The moves from the last cell, with the contributions to the number of a joint input that lead to each.
    std::vector<std::pair<Move, std::vector<std::int64_t>>> groups;
  };

  void find_components();
  void find_moves(Component& component);
  [[nodiscard]] std::optional<Move> move(const Component& component, std::int64_t u) const;
  void cover(Box Move::*member, CellMembers& set) const;
  void prepare_sets();
  [[nodiscard]] bool is_safe(const std::vector<std::int64_t>& choice) const;
  [[nodiscard]] bool stays_in(const std::vector<std::int64_t>& choice, Box Move::*member,
                              const CellMembers& set) const;
  void collect(const std::vector<std::int64_t>& choice);
  void sort();

  const ProblemSpec* spec_;
  CellPosts* posts_;
  Sets sets_;
  CellMembers* safe_beyond_ =
      nullptr;  ///< of the last cell: the set in which tubes that pass a limit must stay
  std::vector<Component> components_;
  std::optional<PermittedInputs> allow_;  ///< nothing if all joint inputs are allowed
  bool allow_has_inputs_ = false;
  std::vector<std::int64_t> admissible_;
  std::vector<bool> marks_;
};

}  // namespace coordreq
