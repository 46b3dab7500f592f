#include "engine/sum_rows.hpp"

#include <algorithm>
#include <utility>

#include "base/index.hpp"
#include "model/odometer.hpp"

namespace coordreq {

/// One term of a sum as the table stores it.
struct SumSource {
  const std::int64_t* lower;
  const std::int64_t* upper;
  std::size_t size;
  const std::vector<std::int64_t>* state_stride;
  const std::vector<std::int64_t>* input_stride;
};

namespace {

/// Cells of a profile are read in blocks of this many.
constexpr std::int64_t kProfileBlock = kLevelBlock / sizeof(std::int32_t);

constexpr int kFractionBits = TransitionTable::kFractionBits;

/// With more numbers than this in its profiles a table is not small any more.
constexpr std::int64_t kMostProfileNumbers = std::int64_t{1} << 22;

std::vector<SumSource> sources(const TransitionTable& table) {
  std::vector<SumSource> result{{table.base_lower.data(), table.base_upper.data(), table.base_lower.size(),
                                 &table.state_stride, &table.input_stride}};
  for (const TransitionTerm& term : table.terms) {
    result.push_back(
        {term.lower.data(), term.upper.data(), term.lower.size(), &term.state_stride, &term.input_stride});
  }
  return result;
}

}  // namespace

/// Divides a table into terms that vary along rows and terms that do not.
class SumRows::Builder {
 public:
  Builder(const Abstraction& abstraction, const TransitionTable& table, std::size_t state)
      : grid_(abstraction.grid), inputs_(abstraction.inputs), table_(table), state_(state) {
    for (const SumSource& source : sources(table))
      ((*source.state_stride)[last()] != 0 ? along_ : apart_).push_back(source);
  }

  [[nodiscard]] std::optional<SumRows> build() {
    if (along_.empty()) return std::nullopt;
    rows_.length_ = grid_.row_length();
    rows_.profile_stride_ = (rows_.length_ + kProfileBlock - 1) / kProfileBlock * kProfileBlock;
    number_rows();
    lay_out_profiles();
    if (rows_.size_ > std::int64_t{UINT32_MAX} ||
        profiles_.size() > kMostProfileNumbers / rows_.profile_stride_)
      return std::nullopt;
    add_up_profiles();
    rows_.profile_strides_ = strides(profile_state_stride_, profile_input_stride_);
    for (const SumSource& source : apart_) {
      rows_.terms_.push_back(
          {source.lower, source.upper, strides(*source.state_stride, *source.input_stride)});
    }
    rows_.find_bounds();
    rows_.find_widths(table_);
    // Blocks are read from any lane on.
    for (std::int64_t c = 0; c < kProfileBlock; ++c) {
      rows_.lower_.add(0);
      rows_.upper_.add(0);
    }
    return std::move(rows_);
  }

 private:
  [[nodiscard]] std::size_t last() const { return grid_.size() - 1; }

  void number_rows() {
    for (const std::int32_t j : table_.inputs) rows_.combinations_ *= inputs_[at(j)].count();
    rows_.size_ = rows_.combinations_;
    for (const std::int32_t j : table_.states) {
      if (at(j) == last()) continue;
      if (table_.shift && at(j) == state_) rows_.shifted_state_ = rows_.counts_.size();
      rows_.counts_.push_back(grid_[at(j)].count);
      rows_.size_ *= grid_[at(j)].count;
    }
  }

  /// Profiles are distinguished by the variables of terms that vary along the row.
  void lay_out_profiles() {
    std::vector<std::int64_t> counts;
    const auto is_used = [&](std::size_t i, auto strides) {
      return std::any_of(along_.begin(), along_.end(),
                         [&](const SumSource& s) { return (*(s.*strides))[i] != 0; });
    };
    for (const std::int32_t j : table_.states) {
      if (at(j) == last() || !is_used(at(j), &SumSource::state_stride)) continue;
      profile_states_.push_back(at(j));
      counts.push_back(grid_[at(j)].count);
    }
    for (const std::int32_t j : table_.inputs) {
      if (!is_used(at(j), &SumSource::input_stride)) continue;
      profile_inputs_.push_back(at(j));
      rows_.profile_inputs_.push_back(j);
      counts.push_back(inputs_[at(j)].count());
    }
    profiles_ = Odometer(counts);
    profile_state_stride_.assign(grid_.size(), 0);
    profile_input_stride_.assign(inputs_.size(), 0);
    std::int64_t stride = 1;
    for (std::size_t v = counts.size(); v-- > 0;) {
      const bool is_state = v < profile_states_.size();
      (is_state ? profile_state_stride_[profile_states_[v]]
                : profile_input_stride_[profile_inputs_[v - profile_states_.size()]]) = stride;
      stride *= counts[v];
    }
  }

  void add_up_profiles() {
    do {
      // Blocks are read as a whole: beyond the row its last cell comes again.
      for (std::int64_t c = 0; c < rows_.profile_stride_; ++c) add_up_cell(std::min(c, rows_.length_ - 1));
    } while (profiles_.advance());
  }

  void add_up_cell(std::int64_t cell) {
    const std::int64_t shift = table_.shift && state_ == last() ? cell << kFractionBits : 0;
    std::int64_t lower = shift;
    std::int64_t upper = shift;
    for (const SumSource& source : along_) {
      std::int64_t entry = cell * (*source.state_stride)[last()];
      std::size_t v = 0;
      for (const std::size_t j : profile_states_)
        entry += profiles_.indices()[v++] * (*source.state_stride)[j];
      for (const std::size_t j : profile_inputs_)
        entry += profiles_.indices()[v++] * (*source.input_stride)[j];
      lower += source.lower[entry];
      upper += source.upper[entry];
    }
    rows_.lower_.add(lower);
    rows_.upper_.add(upper);
  }

  /// The strides of an entry in the variables that number the rows, given its strides by state and by input.
  [[nodiscard]] Strides strides(const std::vector<std::int64_t>& of_state,
                                const std::vector<std::int64_t>& of_input) const {
    Strides result;
    for (const std::int32_t j : table_.states) {
      if (at(j) != last()) result.state.push_back(of_state[at(j)]);
    }
    std::vector<std::int64_t> counts;
    for (const std::int32_t j : table_.inputs) counts.push_back(inputs_[at(j)].count());
    Odometer inputs(counts);
    do {
      std::int64_t offset = 0;
      for (std::size_t v = 0; v < counts.size(); ++v)
        offset += inputs.indices()[v] * of_input[at(table_.inputs[v])];
      result.input.push_back(offset);
    } while (inputs.advance());
    return result;
  }

  const UniformGrid& grid_;
  const InputSpace& inputs_;
  const TransitionTable& table_;
  std::size_t state_;
  std::vector<SumSource> along_, apart_;
  std::vector<std::size_t> profile_states_, profile_inputs_;
  std::vector<std::int64_t> profile_state_stride_, profile_input_stride_;
  Odometer profiles_{{}};
  SumRows rows_;
};

std::optional<SumRows> SumRows::make(const Abstraction& abstraction, const TransitionTable& table,
                                     std::size_t state) {
  if (!table.is_sum() || abstraction.grid[state].periodic()) return std::nullopt;
  return Builder(abstraction, table, state).build();
}

void SumRows::SplitProfiles::add(std::int64_t number) {
  whole.push_back(static_cast<std::int32_t>(number >> kFractionBits));
  fraction.push_back(static_cast<std::uint32_t>(static_cast<std::uint64_t>(number)));
}

std::int64_t SumRows::SplitProfiles::operator[](std::size_t i) const {
  return (std::int64_t{whole[i]} << kFractionBits) + fraction[i];
}

void SumRows::find_bounds() {
  for (std::size_t first = 0; first < lower_.whole.size();
       first += static_cast<std::size_t>(profile_stride_)) {
    Bounds& bounds = bounds_.emplace_back(Bounds{INT64_MAX, INT64_MIN, INT64_MAX, INT64_MIN, 0});
    for (std::int64_t c = 0; c < length_; ++c) {
      const std::int64_t lower = lower_[first + static_cast<std::size_t>(c)];
      const std::int64_t upper = upper_[first + static_cast<std::size_t>(c)];
      bounds.least = std::min(bounds.least, lower);
      bounds.greatest = std::max(bounds.greatest, upper);
      bounds.widest = std::max(bounds.widest, upper - lower);
      bounds.least_offset = std::min(bounds.least_offset, lower - (c << kFractionBits));
      bounds.greatest_offset = std::max(bounds.greatest_offset, upper - (c << kFractionBits));
    }
  }
}

/// floor(a + d) - floor(a) is floor(d) or one more for all a; d is a sum of one difference a term.
void SumRows::find_widths(const TransitionTable& table) {
  std::int64_t least = 0;
  std::int64_t greatest = 0;
  for (const SumSource& source : sources(table)) {
    std::int64_t low = INT64_MAX;
    std::int64_t high = 0;
    for (std::size_t i = 0; i < source.size; ++i) {
      low = std::min(low, source.upper[i] - source.lower[i]);
      high = std::max(high, source.upper[i] - source.lower[i]);
    }
    least += low;
    greatest += high;
  }
  widths_ = TransitionTable::sum_range(least, greatest);
  ++widths_.last;
}

IndexRange SumRows::hull(const Row& row) const {
  const Bounds& bounds = bounds_[row.profile];
  return TransitionTable::sum_range(row.lower + bounds.least, row.upper + bounds.greatest);
}

IndexRange SumRows::offset_hull(const Row& row) const {
  const Bounds& bounds = bounds_[row.profile];
  return TransitionTable::sum_range(row.lower + bounds.least_offset, row.upper + bounds.greatest_offset);
}

std::uint64_t SumRows::bytes() const {
  return (lower_.whole.size() + upper_.whole.size()) * sizeof(std::int64_t);
}

SumRows::Reader::Reader(const SumRows& rows) : rows_(&rows), base_(rows.terms_.size()) {}

/// Goes to the choice of states that a row belongs to.
void SumRows::Reader::go_to(std::uint32_t number) {
  // Rows are read choice by choice: a division for each would take longer than the rest.
  if (number >= first_ && number < first_ + rows_->combinations_) return;
  const std::int64_t choice = number / rows_->combinations_;
  first_ = choice * rows_->combinations_;
  std::fill(base_.begin(), base_.end(), 0);
  profile_base_ = 0;
  shift_ = 0;
  std::int64_t rest = choice;
  for (std::size_t v = rows_->counts_.size(); v-- > 0;) {
    const std::int64_t index = rest % rows_->counts_[v];
    rest /= rows_->counts_[v];
    for (std::size_t p = 0; p < base_.size(); ++p) base_[p] += index * rows_->terms_[p].strides.state[v];
    profile_base_ += index * rows_->profile_strides_.state[v];
    if (v == rows_->shifted_state_) shift_ = index << kFractionBits;
  }
}

SumRows::Row SumRows::Reader::row(std::uint32_t number) {
  go_to(number);
  const auto combination = static_cast<std::size_t>(number - first_);
  Row row{.lower = shift_, .upper = shift_};
  for (std::size_t p = 0; p < base_.size(); ++p) {
    const Term& term = rows_->terms_[p];
    const std::int64_t entry = base_[p] + term.strides.input[combination];
    row.lower += term.lower[entry];
    row.upper += term.upper[entry];
  }
  row.profile = static_cast<std::size_t>(profile_base_ + rows_->profile_strides_.input[combination]);
  return row;
}

void SumRows::Reader::read(std::span<const std::uint32_t> numbers, std::size_t step, Rows& rows) {
  const std::size_t count = (numbers.size() + step - 1) / step;
  go_to(numbers[0]);
  rows.lower.assign(count, shift_);
  rows.upper.assign(count, shift_);
  rows.profile.resize(count);
  for (std::size_t p = 0; p < base_.size(); ++p) {
    const Term& term = rows_->terms_[p];
    const std::int64_t* const lower = term.lower + base_[p];
    const std::int64_t* const upper = term.upper + base_[p];
    for (std::size_t k = 0; k < count; ++k) {
      const std::int64_t entry = term.strides.input[static_cast<std::size_t>(numbers[k * step] - first_)];
      rows.lower[k] += lower[entry];
      rows.upper[k] += upper[entry];
    }
  }
  rows.has_one_profile = true;
  for (std::size_t k = 0; k < count; ++k) {
    const auto combination = static_cast<std::size_t>(numbers[k * step] - first_);
    rows.profile[k] = static_cast<std::size_t>(profile_base_ + rows_->profile_strides_.input[combination]);
    rows.has_one_profile = rows.has_one_profile && rows.profile[k] == rows.profile[0];
  }
}

}  // namespace coordreq
