#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/sum_kernels.hpp"
#include "reach/abstraction.hpp"

namespace coordreq {

/// The ranges of one state along rows, added up when they are read, from a table that is a sum.
///
/// Why: where motion is coupled (a turn moves x by a multiple of y) a row would be cut into a dozen segments,
/// and hardly two rows are alike, so that there would be a slice for every row and every joint input. The
/// sums themselves are small tables: two aircraft on 101 x 101 x 72 cells with 441 joint inputs take 42 MiB
/// instead of 1.4 GiB. The switch is FastPaths::added_rows.
///
/// A row is one *profile* (the sum of the terms that vary along it) plus terms that are the same for all of
/// its cells. Rows are numbered as in RowSlices: row-major over the states in use without the last, then the
/// inputs in use.
class SumRows {
 public:
  /// Nothing if the table is no sum, if no term varies along the row, if its state is periodic, or if there
  /// are too many numbers to be small tables.
  [[nodiscard]] static std::optional<SumRows> make(const Abstraction& abstraction,
                                                   const TransitionTable& table, std::size_t state);

  /// Ends of the ranges of a row: cell c goes to [(lower + profile_lower[c]) >> kFractionBits, likewise
  /// upper].
  struct Row {
    std::int64_t lower = 0;
    std::int64_t upper = 0;
    std::size_t profile = 0;  ///< number of the profile
  };
  [[nodiscard]] SplitRow profile_lower(std::size_t profile) const {
    return lower_.row(profile * static_cast<std::size_t>(profile_stride_));
  }
  [[nodiscard]] SplitRow profile_upper(std::size_t profile) const {
    return upper_.row(profile * static_cast<std::size_t>(profile_stride_));
  }

  /// [number of a row read] Several rows.
  struct Rows {
    std::vector<std::int64_t> lower;
    std::vector<std::int64_t> upper;
    std::vector<std::size_t> profile;
    bool has_one_profile = true;
    [[nodiscard]] Row operator[](std::size_t k) const { return {lower[k], upper[k], profile[k]}; }
  };

  /// Adds up rows. One object a thread.
  class Reader {
   public:
    /// @pre unchecked: `rows` outlives this object.
    explicit Reader(const SumRows& rows);
    [[nodiscard]] Row row(std::uint32_t number);
    /// Reads rows that differ in their inputs alone. @param numbers every `step`-th of these, from the first
    /// on
    void read(std::span<const std::uint32_t> numbers, std::size_t step, Rows& rows);

   private:
    void go_to(std::uint32_t number);

    const SumRows* rows_;
    std::int64_t first_ =
        UINT32_MAX + std::int64_t{1};  ///< row of the choice of states that the bases below belong to
    std::vector<std::int64_t> base_;   ///< by term
    std::int64_t profile_base_ = 0;
    std::int64_t shift_ = 0;  ///< the index of the table's state, if the table is a shift
  };

  /// Number of all rows, a multiple of combinations().
  [[nodiscard]] std::int64_t size() const { return size_; }
  /// Joint inputs in use.
  [[nodiscard]] std::int64_t combinations() const { return combinations_; }
  /// No range has fewer cells than first + 1, none more than last + 1.
  [[nodiscard]] IndexRange widths() const { return widths_; }
  /// A range around those of all cells of a row: of indices; and of offsets from the cell's index.
  [[nodiscard]] IndexRange hull(const Row& row) const;
  [[nodiscard]] IndexRange offset_hull(const Row& row) const;
  /// Greatest profile_upper[c] - profile_lower[c].
  [[nodiscard]] std::int64_t widest(std::size_t profile) const { return bounds_[profile].widest; }
  /// Whether rows under different values of an input have different profiles.
  [[nodiscard]] bool tells_profiles_apart(std::int32_t input) const {
    return std::find(profile_inputs_.begin(), profile_inputs_.end(), input) != profile_inputs_.end();
  }
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  /// Numbers of 64 bits in halves, as SumKernels take them; each profile with room for whole blocks, and one
  /// block after the last.
  struct SplitProfiles {
    std::vector<std::int32_t> whole;
    std::vector<std::uint32_t> fraction;
    void add(std::int64_t number);
    [[nodiscard]] std::int64_t operator[](std::size_t i) const;
    [[nodiscard]] SplitRow row(std::size_t first) const {
      return {whole.data() + first, fraction.data() + first};
    }
  };
  struct Strides {
    std::vector<std::int64_t> state;  ///< by state in use but the last one
    std::vector<std::int64_t> input;  ///< by joint input in use: the offset
  };
  struct Term {
    const std::int64_t* lower;
    const std::int64_t* upper;
    Strides strides;
  };
  /// Least and greatest of what a profile adds.
  struct Bounds {
    std::int64_t least, greatest;                ///< of lower, of upper
    std::int64_t least_offset, greatest_offset;  ///< the same less the cell's own index
    std::int64_t widest;                         ///< greatest upper - lower of a cell
  };

  class Builder;

  void find_bounds();
  void find_widths(const TransitionTable& table);

  std::int64_t length_ = 0;
  std::int64_t profile_stride_ = 0;  ///< length_ rounded up to whole blocks
  SplitProfiles lower_, upper_;
  Strides profile_strides_;
  std::vector<std::int32_t> profile_inputs_;
  std::vector<Bounds> bounds_;            ///< by profile
  std::vector<Term> terms_;               ///< views of the table
  std::vector<std::int64_t> counts_;      ///< of the states in use but the last one
  std::size_t shifted_state_ = SIZE_MAX;  ///< index of the table's state in counts_, if the table is a shift
  std::int64_t combinations_ = 1;
  std::int64_t size_ = 1;
  IndexRange widths_;
};

}  // namespace coordreq
