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

/// A joint input, its post, and the level of the worst cell in the post.
struct EscapeChoice {
  std::int64_t joint_input = 0;
  std::int64_t level = INT64_MAX;
  CellPost post;
  bool is_forbidden = false;
  bool has_more = false;  ///< there are later equal joint inputs that the system itself can follow, too
};

/// Finds the steps of an escape, one cell after the other.
class EscapeSteps {
 public:
  using IsWanted = std::function<bool(std::int64_t)>;  ///< of a joint input, of a cell
  /// Instead of a level to look for: the least level that occurs.
  static constexpr std::int64_t kLeast = -1;

  /// @pre unchecked: all outlive this object.
  EscapeSteps(const EscapeSets& sets, CellPosts& posts, AdmissibleInputs& inputs, RealRun& real)
      : sets_(sets), posts_(posts), inputs_(inputs), real_(real), tubes_(sets.context->tubes()) {}

  /// The level of a cell, INT64_MAX if it is never lost.
  [[nodiscard]] static std::int64_t level_of(const LevelMap& levels, std::int64_t cell);

  /// A candidate whose worst successor has the wanted level: of those with which the system itself reaches
  /// that level, too, number `number`; if there are none, the lowest-numbered candidate.
  [[nodiscard]] std::optional<EscapeChoice> find(std::int64_t cell, const LevelMap& levels,
                                                 std::int64_t target, const IsWanted& is_candidate,
                                                 std::int64_t number);
  /// A wanted cell of a post: the cell of the system itself after the step, else the lowest-numbered;
  /// negative: there is none.
  [[nodiscard]] std::int64_t next_cell(std::int64_t cell, const CellPost& post, std::int64_t u,
                                       const IsWanted& is_wanted);
  /// Whether a cell is in a post. (Where the system itself is followed in floating point it may miss its post
  /// by a rounding.)
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
