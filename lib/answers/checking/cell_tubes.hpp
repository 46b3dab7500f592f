#pragma once

#include <cstdint>
#include <vector>

#include "answers/checking/posts.hpp"

namespace coordreq {

/// The tubes of every pair: cells that have to be safe between the samples. Immutable.
struct Tubes {
  Posts covering;  ///< of tubes instead of posts
  std::vector<std::vector<std::uint8_t>>
      passes;  ///< [state][entry] whether the tube passes a limit at which the state saturates
  std::vector<std::int32_t> inside;  ///< [cell]: 1 in S, else 0
  std::vector<std::int32_t> beyond;  ///< [cell] likewise, for tubes that pass a limit
};
/// @pre unchecked: `grid` and `tables` outlive the result.
[[nodiscard]] Tubes make_tubes(const UniformGrid& grid, const InputSpace& inputs,
                               const std::vector<PostTable>& tables, const std::vector<std::uint8_t>& safe,
                               const std::vector<std::uint8_t>& beyond);

/// True if a tube with this raw range passes a limit to which the state is set back at the sample alone.
[[nodiscard]] bool passes_saturation(const GridDimension& dimension, IndexRange raw);

/// The tubes of one cell at a time. One object a thread.
class CellTubes {
 public:
  /// @pre unchecked: `tubes` outlives this object.
  explicit CellTubes(const Tubes& tubes) : tubes_(&tubes), covering_(tubes.covering) {}

  void go_to(std::int64_t cell);
  /// Whether the tube under joint input u is safe.
  [[nodiscard]] bool is_safe(std::int64_t u);

 private:
  [[nodiscard]] bool passes(std::int64_t u) const;

  const Tubes* tubes_;
  PostMinima covering_;
  std::vector<std::int64_t> first_;  ///< [state] first entry of the cell
  bool may_pass_ = false;            ///< whether a tube passes a limit under some input
  std::vector<std::int32_t> inside_memory_;
  std::vector<std::int32_t> beyond_memory_;
};

}  // namespace coordreq
