#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "answers/blind/silent_table.hpp"
#include "base/requires.hpp"
#include "engine/row_operations.hpp"

namespace coordreq {

/// A_c(x) of the cells of one row after another: for each action the cells that have it. One object a thread.
class ClassRows {
 public:
  explicit ClassRows(const SilentSources& sources) : sources_(sources) {}

  /// @pre K has cells in the row. @pre unchecked: this process owns it
  void enter(const RowPosition& position) {
    REQUIRES(any_set(sources_.invariant.row(position.row)));
    row_ = position.row;
    is_full_ = sources_.projections.is_full(row_);
    if (!is_full_) sources_.projections.grouping().group(position, groups_);
  }
  /// All cells of K in the row have all actions.
  [[nodiscard]] bool is_full() const { return is_full_; }
  /// {x in K in the row : a in A_c(x)}
  [[nodiscard]] ConstRow cells(std::size_t c, std::uint32_t a) const {
    if (is_full_) return sources_.invariant.row(row_);
    return sources_.projections.mask(row_, groups_, c, groups_.classes[c]->group_of[a]);
  }

 private:
  SilentSources sources_;
  std::int64_t row_ = 0;
  bool is_full_ = false;
  RowGroups groups_;
};

}  // namespace coordreq
