#include "analysis/advice.hpp"

#include <bit>

#include "base/index.hpp"
#include "base/requires.hpp"
#include "model/odometer.hpp"

namespace coordreq {
namespace {

/// Counts pairs of safe cells and joint inputs that are blocked at a side.
class PairCounter {
 public:
  PairCounter(const AnalysisContext& context, std::size_t dimension, bool above)
      : context_(context), abstraction_(*context.abstraction), i_(dimension), above_(above) {
    // Without `allow` only the inputs of the table make a difference.
    for (const std::int32_t j : abstraction_.tables[i_].inputs)
      inputs_.push_back(static_cast<std::size_t>(j));
    if (context.pairs.admissible() != nullptr) {
      inputs_.clear();
      for (std::size_t j = 0; j < abstraction_.inputs.size(); ++j) inputs_.push_back(j);
    }
    for (const std::size_t j : inputs_) counts_.push_back(abstraction_.inputs[j].count());
    for (const std::int64_t count : counts_) choices_ *= count;
  }

  /// @param may_leave by the index of the state, for those that are worth a look
  BlockedPairs run(const std::vector<bool>& may_leave) {
    known_.assign(positions(), -1);
    const CellSet& safe = context_.safe;
    const UniformGrid& grid = abstraction_.grid;
    for (std::int64_t r = 0; r < safe.rows() && looked_at_ < kMost; ++r) {
      const bool is_along = i_ >= grid.across();
      if (!is_along && !may_leave[at(grid.index(r * safe.row_length(), i_))]) continue;
      const auto words = safe.row(r);
      for (std::size_t w = 0; w < words.size(); ++w) {
        for (CellSet::Word rest = words[w]; rest != 0; rest &= rest - 1) {
          const std::int64_t column =
              static_cast<std::int64_t>(w) * CellSet::kWordBits + std::countr_zero(rest);
          const std::int64_t cell = r * safe.row_length() + column;
          if (!is_along || may_leave[at(grid.index(cell, i_))]) blocked_ += blocked_at_cell(cell, r, column);
        }
      }
    }
    return {blocked_, looked_at_ < kMost};
  }

 private:
  static constexpr std::int64_t kMost = std::int64_t{1} << 22;

  /// Number of values of position_of(); 0 where position_of() does not determine the post, or they are too
  /// many to be kept.
  [[nodiscard]] std::size_t positions() const {
    const TransitionTable& table = abstraction_.tables[i_];
    if (context_.pairs.admissible() != nullptr || table.is_sum()) return 0;
    const std::int64_t indices = table.shift ? abstraction_.grid[i_].count : 1;
    const std::int64_t all = static_cast<std::int64_t>(table.entries.size()) / choices_ * indices;
    return all <= kMost ? at(all) : 0;
  }

  /// All that the post of a cell depends on besides the inputs, which are last in the layout of tables.
  [[nodiscard]] std::int64_t position_of(std::int64_t cell) const {
    const TransitionTable& table = abstraction_.tables[i_];
    std::int64_t position = 0;
    for (const std::int32_t j : table.states)
      position += abstraction_.grid.index(cell, at(j)) * table.state_stride[at(j)];
    position /= choices_;
    return table.shift ? position * abstraction_.grid[i_].count + abstraction_.grid.index(cell, i_)
                       : position;
  }

  [[nodiscard]] std::int64_t blocked_at_cell(std::int64_t cell, std::int64_t row, std::int64_t column) {
    if (known_.empty()) return count_inputs(cell, row, column);
    std::int64_t& known = known_[at(position_of(cell))];
    if (known < 0) known = count_inputs(cell, row, column);
    return known;
  }

  [[nodiscard]] std::int64_t count_inputs(std::int64_t cell, std::int64_t row, std::int64_t column) {
    std::int64_t blocked = 0;
    Odometer choice(counts_);
    do {
      std::int64_t u = 0;
      for (std::size_t v = 0; v < inputs_.size(); ++v)
        u += choice.indices()[v] * abstraction_.inputs.stride(inputs_[v]);
      ++looked_at_;
      if (is_blocked(cell, u) && is_allowed(row, column, u)) ++blocked;
    } while (choice.advance());
    return blocked * (abstraction_.inputs.count() / choices_);
  }

  [[nodiscard]] bool is_blocked(std::int64_t cell, std::int64_t u) const {
    const IndexRange raw = abstraction_.raw(i_, cell, u);
    return above_ ? raw.last >= abstraction_.grid[i_].count : raw.first < 0;
  }
  [[nodiscard]] bool is_allowed(std::int64_t row, std::int64_t column, std::int64_t u) const {
    const PairTable* const allow = context_.pairs.admissible();
    if (allow == nullptr) return true;
    const auto bits = allow->row(row, u);
    return (bits[static_cast<std::size_t>(column / CellSet::kWordBits)] >> (column % CellSet::kWordBits) &
            1) != 0;
  }

  const AnalysisContext& context_;
  const Abstraction& abstraction_;
  std::size_t i_;
  bool above_;
  std::vector<std::size_t> inputs_;
  std::vector<std::int64_t> counts_;
  std::int64_t choices_ = 1;         ///< product of those counts
  std::vector<std::int64_t> known_;  ///< [position] how many joint inputs are blocked; -1: not counted yet
  std::int64_t looked_at_ = 0;
  std::int64_t blocked_ = 0;
};

}  // namespace

BlockedPairs count_blocked(const AnalysisContext& context, std::size_t dimension, bool above,
                           const std::vector<bool>& may_leave) {
  REQUIRES(context.engine && context.hull);
  return PairCounter(context, dimension, above).run(may_leave);
}

}  // namespace coordreq
