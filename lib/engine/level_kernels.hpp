#pragma once

#include <cstddef>
#include <cstdint>

namespace coordreq {

/// The instruction sets that the row kernels are built for. All give the same bits.
enum class InstructionSet : std::uint8_t { portable, avx2, avx512 };

/// Lanes of a row: begin, ..., end - 1.
struct LaneRange {
  std::size_t begin = 0;
  std::size_t end = 0;
  [[nodiscard]] std::size_t size() const { return end - begin; }
};

/// Operations on rows of levels: small unsigned integers, one a cell, see LevelRows.
///
/// A row operation works on whole blocks of `kLevelBlock` bytes: @pre unchecked: every row handed in may be
/// read, and every target written, up to the next multiple of that many bytes after its `n` lanes. Levels in
/// lanes beyond n have no meaning. Rows need not be aligned; a target may be one of the sources.
template <class Level>
struct LevelKernels {
  /// out[j] = min over k < count of rows[k][j]. @pre count >= 1
  void (*minimum)(const Level* const* rows, std::size_t count, Level* out, std::size_t n);
  /// target[j] = max(target[j], source[j]).
  void (*raise)(const Level* source, Level* target, std::size_t n);
  /// target[j] = max(target[j], source[j]) where lanes[j] is all ones; `lanes` holds zeros and all ones.
  void (*raise_where)(const Level* source, const Level* lanes, Level* target, std::size_t n);
  /// target[j] = min(target[j], source[j]) where lanes[j] is all ones.
  void (*lower_where)(const Level* source, const Level* lanes, Level* target, std::size_t n);
  /// target[j] = min(target[j], source[j]) where labels[j] == label.
  void (*lower_at)(const Level* source, const Level* labels, Level label, Level* target, std::size_t n);
  /// True if row[j] + 1 >= bound[j] in every lane, counted without overflow.
  bool (*is_settled)(const Level* row, const Level* bound, std::size_t n);
  /// From the first to the last lane where lanes[j] is all ones and row[j] < bound[j].
  LaneRange (*below)(const Level* row, const Level* lanes, const Level* bound, std::size_t n);
  /// lanes[j] = all ones where bit j % 64 of bits[j / 64] is set, else 0.
  void (*spread)(const std::uint64_t* bits, Level* lanes, std::size_t n);
  /// Bit j % 64 of bits[j / 64] = whether row[j] is the greatest level, for j < n; further bits of the last
  /// word are 0.
  void (*top_bits)(const Level* row, std::uint64_t* bits, std::size_t n);
  /// Bit j % 64 of bits[j / 64] = whether row[j] is above bound[j], likewise.
  void (*above_bits)(const Level* row, const Level* bound, std::uint64_t* bits, std::size_t n);
  /// One step of L <- 1 + min ... : out[j] = 0 where old[j] = 0, else next[j] + 1, and the greatest level
  /// where that is above `limit`. @returns whether out differs from old.
  bool (*advance)(const Level* next, const Level* old, Level limit, Level* out, std::size_t n);
  /// One step of L <- max(L, -1 + max ...): out[j] = 0 where old[j] = 0, else the greater of old[j] and
  /// next[j] - 1. @returns whether out differs from old.
  bool (*rise)(const Level* next, const Level* old, Level* out, std::size_t n);
  /// The least of row[j] and other[j] over all lanes in which these differ; if there is none, the greatest
  /// level.
  Level (*lowest_change)(const Level* row, const Level* other, std::size_t n);
};

inline constexpr std::size_t kLevelBlock = 64;

/// The fastest set that this processor has.
[[nodiscard]] InstructionSet best_instruction_set();
/// The kernels for a set. @pre unchecked: the processor has it. Level: an unsigned integer of 8 to 64
/// bits.
template <class Level>
[[nodiscard]] const LevelKernels<Level>& level_kernels(InstructionSet set);
template <>
const LevelKernels<std::uint8_t>& level_kernels<std::uint8_t>(InstructionSet set);
template <>
const LevelKernels<std::uint16_t>& level_kernels<std::uint16_t>(InstructionSet set);
template <>
const LevelKernels<std::uint32_t>& level_kernels<std::uint32_t>(InstructionSet set);
template <>
const LevelKernels<std::uint64_t>& level_kernels<std::uint64_t>(InstructionSet set);

}  // namespace coordreq
