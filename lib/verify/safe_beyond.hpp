#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "answers/checking/post_table.hpp"
#include "answers/checking/tally.hpp"
#include "base/thread_team.hpp"
#include "model/uniform_grid.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Where states saturate, tubes go on beyond the boundary cells until the sample sets them back, and there
/// has to be safe as well. Checks which cells of S are said to be safe that far out, as S itself is checked:
/// boundary cells are as much longer as any tube goes that is not blocked. A tube that goes farther than 32
/// bits tell leaves no such cell.
class SafeBeyond {
 public:
  /// @param tubes one table a state
  /// @pre unchecked: `spec` outlives this object.
  SafeBeyond(const ProblemSpec& spec, const UniformGrid& grid, const std::vector<PostTable>& tubes);

  /// @param safe S; @param beyond the part of it that is to be checked
  [[nodiscard]] Finding check(const std::vector<std::uint8_t>& safe, const std::vector<std::uint8_t>& beyond,
                              ThreadTeam& team) const;

 private:
  void extend(std::size_t state, const PostTable& tube, std::vector<GridDimension>& dimensions);
  [[nodiscard]] bool has(const std::vector<std::pair<std::size_t, std::int64_t>>& boundaries,
                         std::int64_t cell) const;

  const ProblemSpec& spec_;
  UniformGrid grid_;                                             ///< with boundary cells that are longer
  std::vector<std::pair<std::size_t, std::int64_t>> stretched_;  ///< state and index of these cells
  std::vector<std::pair<std::size_t, std::int64_t>> lost_;       ///< those without a known end
};

}  // namespace coordreq
