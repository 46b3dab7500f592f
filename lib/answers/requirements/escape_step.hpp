#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "answers/one_cell/admissible_inputs.hpp"
#include "answers/one_cell/cell_posts.hpp"
#include "answers/requirements/escape_path.hpp"
#include "answers/requirements/real_run.hpp"
#include "engine/level_map.hpp"
#include "engine/tube_sets.hpp"

namespace coordreq {

/// A joint input, where it leads to, and the level of the worst cell there.
struct EscapeChoice {
  std::int64_t joint_input = 0;
  std::int64_t level = INT64_MAX;
  CellPost post;
  bool is_forbidden = false;
  bool has_more = false;  ///< there are equal ones behind it that the system itself can follow, too
};

/// Finds the steps of an escape, one cell after the other.
class EscapeSteps {
 public:
  using IsWanted = std::function<bool(std::int64_t)>;  ///< of a joint input, of a cell
  /// Instead of a level to look for: the least there is.
  static constexpr std::int64_t kLeast = -1;

  /// @pre unchecked: all outlive this object.
  EscapeSteps(const EscapeSets& sets, CellPosts& posts, AdmissibleInputs& inputs, RealRun& real)
      : sets_(sets), posts_(posts), inputs_(inputs), real_(real), tubes_(sets.ground->tubes()) {}

  /// The level of a cell, INT64_MAX if it is never lost.
  [[nodiscard]] static std::int64_t level_of(const LevelMap& levels, std::int64_t cell);

  /// A joint input of the candidates whose worst successor has the level that is looked for: of those with
  /// which the system itself comes to that level, too, the one of this number; if there is none the lowest.
  [[nodiscard]] std::optional<EscapeChoice> find(std::int64_t cell, const LevelMap& levels,
                                                 std::int64_t target, const IsWanted& is_candidate,
                                                 std::int64_t number);
  /// The cell of a post that is wanted: the one in which the system itself is then, else the lowest-numbered;
  /// negative: there is none.
  [[nodiscard]] std::int64_t next_cell(std::int64_t cell, const CellPost& post, std::int64_t u,
                                       const IsWanted& is_wanted);
  /// Whether a cell is in a post. (The system itself may miss it by a rounding, where floating point follows
  /// it.)
  [[nodiscard]] static bool holds(const UniformGrid& grid, const CellPost& post, std::int64_t cell);
  /// The number of a cell in the grid of the spec.
  [[nodiscard]] std::int64_t number_of(std::int64_t cell) const;

 private:
  using Known = std::map<std::vector<IndexRange>, std::int64_t>;

  [[nodiscard]] std::int64_t worst_level(const CellPost& post, const LevelMap& levels, Known& known) const;
  [[nodiscard]] bool follows(std::int64_t cell, const EscapeChoice& choice, const LevelMap& levels);
  [[nodiscard]] std::int64_t real_cell(std::int64_t cell, const CellPost& post, std::int64_t u);

  const EscapeSets& sets_;
  CellPosts& posts_;
  AdmissibleInputs& inputs_;
  RealRun& real_;
  TubeSets tubes_;
};

}  // namespace coordreq
