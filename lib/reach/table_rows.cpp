#include "reach/table_rows.hpp"

#include <algorithm>

namespace coordreq {
namespace {

/// Position of the row's first cell in a part of a table.
template <class Strides>
std::size_t row_position(const Strides& strides, std::size_t along, std::span<const std::int64_t> states,
                         std::span<const std::int64_t> inputs) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (i != along) sum += states[i] * strides.state_stride[i];
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) sum += inputs[i] * strides.input_stride[i];
  return static_cast<std::size_t>(sum);
}

/// A row of a sum: the parts that vary along it, each a run of numbers with a stride, and the sum of the
/// others.
class RowSum {
 public:
  void add(const std::int64_t* lower, const std::int64_t* upper, std::int64_t stride) {
    if (stride == 0) {
      add(*lower, *upper);
    } else {
      runs_[count_++] = {lower, upper, stride};
    }
  }
  void add(std::int64_t lower, std::int64_t upper) {
    lower_ += lower;
    upper_ += upper;
  }

  /// @param step what a cell adds to the one before
  void write(std::int64_t step, std::span<IndexRange> out) const {
    if (count_ == 1 && runs_[0].stride == 1 && step == 0) {
      for (std::size_t c = 0; c < out.size(); ++c) {
        out[c] = TransitionTable::sum_range(lower_ + runs_[0].lower[c], upper_ + runs_[0].upper[c]);
      }
      return;
    }
    for (std::size_t c = 0; c < out.size(); ++c) {
      const auto cell = static_cast<std::int64_t>(c);
      std::int64_t low = lower_ + cell * step;
      std::int64_t high = upper_ + cell * step;
      for (std::size_t r = 0; r < count_; ++r) {
        low += runs_[r].lower[cell * runs_[r].stride];
        high += runs_[r].upper[cell * runs_[r].stride];
      }
      out[c] = TransitionTable::sum_range(low, high);
    }
  }

 private:
  struct Run {
    const std::int64_t* lower;
    const std::int64_t* upper;
    std::int64_t stride;
  };

  static constexpr std::size_t kMostRuns = 16;
  Run runs_[kMostRuns];
  std::size_t count_ = 0;
  std::int64_t lower_ = 0;
  std::int64_t upper_ = 0;
};

}  // namespace

TableRows::TableRows(const TransitionTable& table, std::size_t state, std::size_t along)
    : table_(&table),
      state_(state),
      along_(along),
      stride_(table_->state_stride[along]),
      shifts_along_(table_->shift && state == along) {
  varies_ = stride_ != 0 || std::any_of(table_->terms.begin(), table_->terms.end(),
                                        [&](const auto& term) { return term.state_stride[along] != 0; });
}

void TableRows::read(std::span<const std::int64_t> states, std::span<const std::int64_t> inputs,
                     std::span<IndexRange> out) const {
  const std::size_t base = row_position(*table_, along_, states, inputs);
  const std::int64_t offset = table_->shift && !shifts_along_ ? states[state_] : 0;
  if (table_->is_sum()) {
    read_sum(states, inputs, base, offset, out);
    return;
  }
  const IndexRange* entry = table_->entries.data() + (static_cast<std::int64_t>(base) - table_->before);
  for (std::size_t c = 0; c < out.size(); ++c, entry += stride_) {
    out[c] =
        table_->shift ? moved(*entry, offset + (shifts_along_ ? static_cast<std::int64_t>(c) : 0)) : *entry;
  }
}

void TableRows::read_sum(std::span<const std::int64_t> states, std::span<const std::int64_t> inputs,
                         std::size_t base, std::int64_t offset, std::span<IndexRange> out) const {
  RowSum sum;
  sum.add(table_->base_lower.data() + base, table_->base_upper.data() + base, stride_);
  for (const TransitionTerm& term : table_->terms) {
    const std::size_t position = row_position(term, along_, states, inputs);
    sum.add(term.lower.data() + position, term.upper.data() + position, term.state_stride[along_]);
  }
  const std::int64_t moved = offset << TransitionTable::kFractionBits;
  sum.add(moved, moved);
  // A shift along the row adds a whole step a cell.
  sum.write(shifts_along_ ? std::int64_t{1} << TransitionTable::kFractionBits : 0, out);
}

}  // namespace coordreq
