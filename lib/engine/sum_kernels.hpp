#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/level_kernels.hpp"

namespace coordreq {

/// A row of fixed-point numbers of 64 bits, whose upper half is an index, with the halves in rows of their
/// own: so sums are taken in 32-bit lanes.
struct SplitRow {
  const std::int32_t* whole = nullptr;
  const std::uint32_t* fraction = nullptr;

  /// The row from a lane on.
  [[nodiscard]] SplitRow from(std::size_t lane) const { return {whole + lane, fraction + lane}; }
};

/// One dimension of the boxes of a row of cells: first = (lower + lower_profile[c]) >> 32,
/// last = (upper + upper_profile[c]) >> 32. @pre unchecked: no sum overflows
struct BoxSides {
  SplitRow lower_profile;
  SplitRow upper_profile;
  std::int64_t lower = 0;
  std::int64_t upper = 0;
  std::int32_t count = 0;         ///< of indices in the domain: 0, ..., count - 1
  std::int32_t stride = 0;        ///< offset from one index to the next
  std::int32_t width_stride = 0;  ///< offset from boxes of one width to boxes one wider
};

/// Operations on rows of boxes. As with LevelKernels rows are read and written in whole blocks of kLevelBlock
/// bytes.
struct SumKernels {
  /// offset[c] = origin + sum over the sides of at(first, last) * stride + (last - first) * width_stride,
  /// where at = first, but at least first - last - 1 and at most count: a box beyond the domain is moved to
  /// where it just touches it, and meets the same there. @pre size >= 1
  void (*find_offsets)(const BoxSides* sides, std::size_t size, std::int32_t origin, std::int32_t* offset,
                       std::size_t n);
};

[[nodiscard]] const SumKernels& sum_kernels(InstructionSet set);

}  // namespace coordreq
