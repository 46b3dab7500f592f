#pragma once

#include <cstdint>
#include <vector>

#include "answers/checking/posts.hpp"

namespace coordreq {

/// The cells that have to be safe between the samples, for every pair. Immutable.
struct Tubes {
  Posts covering;                                 ///< of the tubes instead of the posts
  std::vector<std::vector<std::uint8_t>> passes;  ///< [state][entry]: goes on where the state saturates
  std::vector<std::int32_t> inside;               ///< [cell]: 1 in S, else 0
  std::vector<std::int32_t> beyond;               ///< the same; for tubes that pass a limit
};
/// @pre unchecked: `grid` and `tables` outlive the result.
[[nodiscard]] Tubes make_tubes(const UniformGrid& grid, const InputSpace& inputs,
                               const std::vector<PostTable>& tables, const std::vector<std::uint8_t>& safe,
                               const std::vector<std::uint8_t>& beyond);

/// True if a state with this raw range goes on beyond a limit where it is set back only at the sample.
[[nodiscard]] bool passes_saturation(const GridDimension& dimension, IndexRange raw);

/// The tubes of one cell at a time. One object a thread.
class CellTubes {
 public:
  /// @pre unchecked: `tubes` outlives this object.
  explicit CellTubes(const Tubes& tubes) : tubes_(&tubes), covering_(tubes.covering) {}

  void go_to(std::int64_t cell);
  /// Whether all is safe on the way under joint input u.
  [[nodiscard]] bool is_safe(std::int64_t u);

 private:
  [[nodiscard]] bool passes(std::int64_t u) const;

  const Tubes* tubes_;
  PostMinima covering_;
  std::vector<std::int64_t> first_;  ///< [state]: entry of the cell
  bool may_pass_ = false;            ///< under some input
  std::vector<std::int32_t> inside_memory_;
  std::vector<std::int32_t> beyond_memory_;
};

}  // namespace coordreq
