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

/// The parts of all rows that one of several processes holds, ghost rows among them, and that it owns.
struct RowFractions {
  double held = 1;
  double own = 1;
  std::vector<double> slices = {};  ///< [table] bytes of EngineSizes::slices(), once they are known
};

/// What the slices of posts of an engine take, and what tells equal ones while they are cut, by table.
[[nodiscard]] std::vector<double> bytes_of_slices(const RowEngine& engine);

/// What the types of the engine will take for a problem, in bytes, told before there is any of them; maybe
/// more than this machine has. Rows are those that the engine will make, as far as that is known before
/// tables are (join_rows()). Where it depends on what is found, on the high side of what is usual.
class EngineSizes {
 public:
  /// @param fractions of a process, of several that share the work; all: there is one. At least a row counts
  /// @pre unchecked: `model` outlives this object.
  explicit EngineSizes(const Model& model, RowFractions fractions = {});

  [[nodiscard]] const Model& model() const { return *model_; }
  [[nodiscard]] double cells() const { return static_cast<double>(grid_.points()); }
  /// Of the rows that are held, with the gaps in them.
  [[nodiscard]] double lanes() const { return fractions_.held * static_cast<double>(grid_.cells()); }
  [[nodiscard]] double rows() const { return fractions_.held * static_cast<double>(grid_.rows()); }
  [[nodiscard]] const UniformGrid& grid() const { return grid_; }

  [[nodiscard]] double set() const;     ///< CellSet
  [[nodiscard]] double levels() const;  ///< LevelRows of 8 bits
  /// RowSlices of the table of dimension t; and that table itself.
  [[nodiscard]] double slices(std::size_t t) const { return fractions_.slices[t]; }
  [[nodiscard]] double table(std::size_t t) const {
    return fraction_of_table(t) * model_->arranged_shapes()[t].bytes;
  }
  /// What a process of several keeps of tables in full before all of them are told of it.
  [[nodiscard]] double untold_entries() const;
  /// RowHull, and what else is kept of each row.
  [[nodiscard]] double hull() const;
  /// ConditionTable; and one of no other leading indices than the rows that are held have.
  [[nodiscard]] double condition(const Program& condition) const;
  [[nodiscard]] double condition_of_held(const Program& condition) const;
  /// PackedPairs of so many inputs or actions; PairTable of all joint inputs.
  [[nodiscard]] double packed_pairs(std::int64_t actions) const;
  [[nodiscard]] double pair_table() const;
  /// ActionGrouping
  [[nodiscard]] double groups(const std::vector<InputClass>& classes) const;
  /// PostReader of levels of so many bytes, one a thread.
  [[nodiscard]] double readers(int threads, double level_bytes = 1) const;
  /// run_wave() beside its levels.
  [[nodiscard]] double wave(int threads) const;
  /// And where its operator is a minimum.
  [[nodiscard]] double level_delta() const { return model_->keeps_sums() ? levels() + set() : 0; }

 private:
  [[nodiscard]] double sum_reader() const;
  /// Of slices, before they are known.
  [[nodiscard]] double usual_bytes(std::size_t t) const;
  [[nodiscard]] double groups_of_class(const InputClass& inputs) const;
  [[nodiscard]] RowMargins reach_of(std::size_t i) const;
  /// That the process has: of tables by cells the entries of its own rows.
  [[nodiscard]] double fraction_of_table(std::size_t t) const;

  const Model* model_;
  RowFractions fractions_;
  std::vector<IndexRange> offsets_;   ///< by state, usual_offsets()
  std::vector<std::int32_t> widths_;  ///< by state, usual_widths()
  UniformGrid grid_;
  RowShape shape_;  ///< of the rows of posts
};

}  // namespace coordreq
