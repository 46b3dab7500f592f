#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/row_engine.hpp"
#include "engine/row_shape.hpp"
#include "expression/program.hpp"
#include "model/input_class.hpp"
#include "model/model.hpp"

namespace coordreq {

/// The fractions of all rows that one of several processes holds, ghost rows included, and that it owns.
struct RowFractions {
  double held = 1;
  double local = 1;
  std::vector<double> slices = {};  ///< [table] bytes of EngineSizes::slices(), once tables are known
};

/// [table] Bytes of the slices of posts of an engine, with the memory that finds equal slices while they are
/// cut.
[[nodiscard]] std::vector<double> bytes_of_slices(const RowEngine& engine);

/// Estimates of the memory, in bytes, that the types of the engine will take for a problem, before there is
/// any of them; may be more than this machine has. Rows are those that the engine will make, as far as that
/// is known before there are tables (join_rows()). Memory that depends on results is estimated on the high
/// side of the usual.
class EngineSizes {
 public:
  /// @param fractions of a process of several; 1: there is one process. At least one row counts
  /// @pre unchecked: `model` outlives this object.
  explicit EngineSizes(const Model& model, RowFractions fractions = {});

  [[nodiscard]] const Model& model() const { return *model_; }
  [[nodiscard]] double cells() const { return static_cast<double>(grid_.points()); }
  /// Lanes, gaps included, and number of the rows held.
  [[nodiscard]] double lanes() const { return fractions_.held * static_cast<double>(grid_.cells()); }
  [[nodiscard]] double rows() const { return fractions_.held * static_cast<double>(grid_.rows()); }
  [[nodiscard]] const UniformGrid& grid() const { return grid_; }

  [[nodiscard]] double set() const;     ///< CellSet
  [[nodiscard]] double levels() const;  ///< LevelRows of 8 bits
  /// RowSlices of the table of dimension t; and the table itself.
  [[nodiscard]] double slices(std::size_t t) const { return fractions_.slices[t]; }
  [[nodiscard]] double table(std::size_t t) const {
    return fraction_of_table(t) * model_->arranged_shapes()[t].bytes;
  }
  /// Entries of full tables that a process of several has found and not yet sent to the others.
  [[nodiscard]] double unsent_entries() const;
  /// RowHull, and the other lists over rows.
  [[nodiscard]] double hull() const;
  /// ConditionTable; and one for the leading indices of the rows held alone.
  [[nodiscard]] double condition(const Program& condition) const;
  [[nodiscard]] double condition_of_held(const Program& condition) const;
  /// PackedPairs of so many joint inputs or actions; PairTable of all joint inputs.
  [[nodiscard]] double packed_pairs(std::int64_t actions) const;
  [[nodiscard]] double pair_table() const;
  /// ActionGrouping
  [[nodiscard]] double groups(const std::vector<InputClass>& classes) const;
  /// PostReader, one a thread and what they share, of levels of `level_bytes` bytes.
  [[nodiscard]] double readers(int threads, double level_bytes = 1) const;
  /// run_wave(), without its levels.
  [[nodiscard]] double wave(int threads) const;
  /// LevelDelta, where the operator of a wave is a minimum.
  [[nodiscard]] double level_delta() const { return model_->keeps_sums() ? levels() + set() : 0; }

 private:
  [[nodiscard]] double patches() const;
  /// Bytes of the slices of table t before there are tables.
  [[nodiscard]] double usual_bytes(std::size_t t) const;
  [[nodiscard]] double groups_of_class(const InputClass& inputs) const;
  [[nodiscard]] RowMargins reach_of(std::size_t i) const;
  /// The fraction of table t that the process has: of tables by cells the entries of its local rows, else
  /// all.
  [[nodiscard]] double fraction_of_table(std::size_t t) const;

  const Model* model_;
  RowFractions fractions_;
  std::vector<IndexRange> offsets_;   ///< by state, usual_offsets()
  std::vector<std::int32_t> widths_;  ///< by state, usual_widths()
  UniformGrid grid_;
  RowShape shape_;  ///< of the rows of posts
};

}  // namespace coordreq
