#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/thread_team.hpp"
#include "base/zeroed_array.hpp"
#include "expression/program.hpp"
#include "expression/sharp_condition.hpp"

namespace coordreq {

/// A condition as `and` and `or` of comparisons, each of which may depend on fewer variables than the whole:
/// `not` is moved into the comparisons, and max(a, b) >= c becomes a >= c or b >= c (and the like), where a
/// and b are defined everywhere. What the atoms prove by Kleene's logic is true of the condition.
struct ConditionAtoms {
  enum class Join : std::uint8_t { atom, both, either, always, never };
  struct Node {
    Join join;
    std::uint32_t a = 0;  ///< operands among `nodes`; of an atom its number
    std::uint32_t b = 0;
  };
  std::vector<Program> atoms;
  std::vector<Node> nodes;  ///< operands first, the result last
};

/// @param negated takes apart `not condition` instead
/// @returns nothing if the condition is a single atom, or needs more than a few dozen
[[nodiscard]] std::optional<ConditionAtoms> find_atoms(const Program& condition, bool negated);

/// The values of a variable, index by index.
struct ConditionAxis {
  using Ranges = std::vector<RationalInterval>;
  std::int64_t count = 0;
  /// Mostly one range; several (all of them can occur) for a cell that is cut by a seam. Called by many
  /// threads, and again for repeated queries: an axis can be too long to be kept.
  std::function<Ranges(std::int64_t index)> ranges;
  /// Another view of the variable in this slot: its index is that one's. Then the condition is asked
  /// comparison by comparison (CellTruth).
  std::optional<std::uint32_t> follows = std::nullopt;
};

/// The truth of a condition for every choice of an index for each of its variables; true where it holds on
/// all pieces of the ranges.
///
/// One row of bits along one variable for each choice of the others that the condition depends on: the
/// variables in the order of their slots, the last fastest. Bits beyond the end of a row are 0.
class TruthTable {
 public:
  using Word = std::uint64_t;
  /// @param treat_as_true called for a case left undecided, with the indices by slot; its result counts (a
  ///   callback may also throw)
  using Undecided = std::function<bool(const std::vector<std::int64_t>& indices)>;

  /// @param axes by slot; needed for the variables of the condition, and along the rows
  /// @param along slot of the variable that the rows run along, in use or not
  /// @param question `everywhere` saves work where `undecided` only ever answers false
  TruthTable(const Program& condition, std::span<const ConditionAxis> axes, std::uint32_t along,
             const Undecided& undecided, ThreadTeam& team, Question question = Question::truth);

  [[nodiscard]] std::int64_t rows() const { return rows_; }
  [[nodiscard]] std::int64_t row_length() const { return row_length_; }
  [[nodiscard]] std::span<const Word> row(std::int64_t position) const {
    return {bits_.data() + position * words_per_row(), static_cast<std::size_t>(words_per_row())};
  }
  /// By slot: the distance of rows whose variable there differs by one index; 0 if it is not in use.
  [[nodiscard]] const std::vector<std::int64_t>& strides() const { return strides_; }

 private:
  class Filler;

  [[nodiscard]] std::int64_t words_per_row() const { return (row_length_ + 63) / 64; }
  [[nodiscard]] std::span<Word> row(std::int64_t position) {
    return {bits_.data() + position * words_per_row(), static_cast<std::size_t>(words_per_row())};
  }
  [[nodiscard]] std::int64_t index_of(std::int64_t position, std::size_t slot) const {
    return position / strides_[slot] % counts_[slot];
  }
  void lay_out(const Program& condition, std::span<const ConditionAxis> axes, std::uint32_t along);
  [[nodiscard]] ZeroedArray<Word> proven_by_atoms(const Program& condition,
                                                  std::span<const ConditionAxis> axes, bool negated,
                                                  ThreadTeam& team) const;
  [[nodiscard]] bool is_settled(std::int64_t position, std::span<const Word> refuted) const;
  void fill_row(std::int64_t position, std::span<const Word> refuted, Filler& filler);

  std::uint32_t along_;
  bool along_in_use_ = false;
  std::int64_t rows_ = 1;
  std::int64_t row_length_;
  std::vector<std::int64_t> counts_;   ///< by slot
  std::vector<std::int64_t> strides_;  ///< in rows
  std::vector<std::size_t> across_;    ///< slots in use but for that along the rows
  ZeroedArray<Word> bits_;
};

}  // namespace coordreq
