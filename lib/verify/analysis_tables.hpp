#pragma once

#include <cstdint>
#include <vector>

#include "answers/one_cell/cell_posts.hpp"
#include "base/thread_team.hpp"
#include "model/input_space.hpp"
#include "model/uniform_grid.hpp"
#include "spec/spec_types.hpp"
#include "verify/reference_posts.hpp"

namespace coordreq {

/// The posts and tubes of the analysis, computed once more where no file has them: of all cells, or of
/// some, and then no others are computed, unless these cost as much as all. Not thread-safe.
class AnalysisTables {
 public:
  /// @param cells ascending; all if empty
  /// @pre unchecked: all outlive this object.
  AnalysisTables(const SystemSpec& spec, const UniformGrid& grid, const InputSpace& inputs,
                 const std::vector<std::int64_t>& cells, ThreadTeam& team)
      : spec_(spec), grid_(grid), inputs_(inputs), cells_(cells), source_(spec, grid, inputs, team, {}) {}

  [[nodiscard]] const std::vector<std::int64_t>& cells() const { return cells_; }
  [[nodiscard]] PostTable posts(std::size_t state);
  /// @pre `spec` requires safety between the samples
  [[nodiscard]] PostTable tubes(std::size_t state);
  [[nodiscard]] PostTable whole_tubes(std::size_t state);
  [[nodiscard]] const Abstraction& whole() { return source_.whole(); }
  /// Number of entries of tables that have been computed.
  [[nodiscard]] std::int64_t entries_built() const { return source_.entries_built(); }

 private:
  void look_at_cells();
  [[nodiscard]] PostTable empty(std::size_t state, const std::vector<std::int64_t>& cells) const;

  const SystemSpec& spec_;
  const UniformGrid& grid_;
  const InputSpace& inputs_;
  const std::vector<std::int64_t>& cells_;
  CellPosts source_;
  std::vector<PostTable> posts_;  ///< of `cells_`, once they have been looked at
  std::vector<PostTable> tubes_;
};

}  // namespace coordreq
