#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "analysis/advice.hpp"
#include "base/grouped.hpp"
#include "base/index.hpp"
#include "model/odometer.hpp"
#include "spec/json_document.hpp"

namespace coordreq {
namespace {

/// Bounds for the post of one index of a state, in steps and relative to that index.
struct Spread {
  double first = 0, last = 0;          ///< bounds for its ends
  double least_sum = 0, most_sum = 0;  ///< for the sum of its ends, twice the motion of the middle
};

/// Bounds by own index. Parts of a table, each with entries of its own, are added up.
class Spreads {
 public:
  explicit Spreads(std::int64_t count) : all_(static_cast<std::size_t>(count)) {}

  /// @param stride of the own index among the entries; 0: they do not depend on it
  template <class Entries, class Ends>
  void add(const Entries& entries, std::int64_t stride, const Ends& ends) {
    const auto count = static_cast<std::int64_t>(all_.size());
    std::vector<Spread> part(stride == 0 ? 1 : all_.size(), {kFar, -kFar, kFar, -kFar});
    for (std::size_t at = 0; at < entries.size(); ++at) {
      const auto [first, last] = ends(at);
      Spread& own =
          part[stride == 0 ? 0 : static_cast<std::size_t>(static_cast<std::int64_t>(at) / stride % count)];
      own.first = std::min(own.first, first);
      own.last = std::max(own.last, last);
      own.least_sum = std::min(own.least_sum, first + last);
      own.most_sum = std::max(own.most_sum, first + last);
    }
    for (std::size_t k = 0; k < all_.size(); ++k) {
      const Spread& own = part[stride == 0 ? 0 : k];
      all_[k].first += own.first;
      all_[k].last += own.last;
      all_[k].least_sum += own.least_sum;
      all_[k].most_sum += own.most_sum;
    }
  }

  /// From indices to what they are away from the own one.
  void make_relative() {
    for (std::size_t k = 0; k < all_.size(); ++k) {
      const auto own = static_cast<double>(k);
      all_[k].first -= own;
      all_[k].last -= own;
      all_[k].least_sum -= 2 * own;
      all_[k].most_sum -= 2 * own;
    }
  }

  [[nodiscard]] const std::vector<Spread>& all() const { return all_; }

 private:
  static constexpr double kFar = 1e300;
  std::vector<Spread> all_;
};

/// Rounding of what is added up here, in steps.
constexpr double kSlack = 1e-6;

Spreads spreads_of(const TransitionTable& table, std::size_t own, std::int64_t count) {
  Spreads spreads(count);
  const std::int64_t stride = table.state_stride[own];
  if (!table.is_sum()) {
    spreads.add(table.entries, stride, [&](std::size_t at) {
      return std::pair<double, double>(table.entries[at].first, table.entries[at].last);
    });
  } else {
    // The upper end as the lower one is kept: a cell further.
    const double unit = 1.0 / static_cast<double>(std::int64_t{1} << TransitionTable::kFractionBits);
    const auto add = [&](const std::vector<std::int64_t>& lower, const std::vector<std::int64_t>& upper,
                         std::int64_t own_stride) {
      spreads.add(lower, own_stride, [&](std::size_t at) {
        return std::pair(static_cast<double>(lower[at]) * unit, static_cast<double>(upper[at]) * unit);
      });
    };
    add(table.base_lower, table.base_upper, stride);
    for (const TransitionTerm& term : table.terms) add(term.lower, term.upper, term.state_stride[own]);
  }
  if (!table.shift) spreads.make_relative();
  return spreads;
}

/// Every post holds its own cell, or reaches no further than a neighbour, and its middle moves by less than a
/// cell: with ends at indices first and last that is |first + last| < 2, where the ends of a sum are real
/// numbers, of which the upper one is a cell further.
bool moves_less_than_a_cell(const Spreads& spreads, bool is_sum) {
  const double middle = is_sum ? 1 : 0;
  const double slack = is_sum ? kSlack : 0;
  return std::all_of(spreads.all().begin(), spreads.all().end(), [&](const Spread& own) {
    const bool is_near = own.first >= -1 - slack && own.last < 2 - slack;
    return is_near && own.least_sum - middle > -2 + slack && own.most_sum - middle < 2 - slack;
  });
}

/// False where one of some entries shows a motion of a cell, so that nobody need look at all of a large
/// table.
bool may_move_less_than_a_cell(const TransitionTable& table, std::size_t own, std::int64_t count) {
  constexpr std::size_t kLook = 4096;
  const std::int64_t stride = table.state_stride[own];
  for (std::size_t at = 0; at < table.entries.size(); at += table.entries.size() / kLook + 1) {
    const std::int64_t k = stride == 0 ? 0 : static_cast<std::int64_t>(at) / stride % count;
    const std::int64_t first = table.entries[at].first - k, last = table.entries[at].last - k;
    if (first < -1 || last > 1 || std::abs(first + last) > 1) return false;
  }
  return true;
}

/// Half-open cells that stay where they are lose nothing.
bool stands_still(const Spreads& spreads) {
  return std::all_of(spreads.all().begin(), spreads.all().end(),
                     [](const Spread& own) { return own.first == 0 && own.last == 0; });
}

std::string amount(const Rational& value, const std::string& unit) {
  return fmt::format("{:.6g}{}{}", nearest_double(value), unit.empty() ? "" : " ", unit);
}

void advise_on_motion(const Ground& ground, std::size_t i, const Spreads& spreads, Warnings& found) {
  const GridDimension& dimension = ground.abstraction->grid[i];
  const bool is_sum = ground.abstraction->tables[i].is_sum();
  if (dimension.discrete || dimension.count < 3 || !moves_less_than_a_cell(spreads, is_sum)) return;
  if (!is_sum && stands_still(spreads)) return;
  const std::size_t state = ground.abstraction->grid.state(i);
  const DynamicsSpec& dynamics = ground.spec.dynamics;
  found.push_back(
      {"motion", fmt::format("/states/{}", state),
       fmt::format(
           "{} moves by less than one cell ({}) in a period ({}), so that every reachable set spreads "
           "to the next cell and answers show the grid rather than the system; make the step smaller "
           "or the period longer",
           dimension.name, amount(dimension.step, ground.spec.states[state].unit),
           amount(dynamics.period, dynamics.unit))});
}

/// Counts pairs of safe cells and joint inputs that are blocked at a side.
class BlockedPairs {
 public:
  BlockedPairs(const Ground& ground, std::size_t dimension)
      : ground_(ground), abstraction_(*ground.abstraction), i_(dimension) {
    // Without `allow` only the inputs of the table make a difference.
    for (const std::int32_t j : abstraction_.tables[i_].inputs)
      inputs_.push_back(static_cast<std::size_t>(j));
    if (ground.allow) {
      inputs_.clear();
      for (std::size_t j = 0; j < abstraction_.inputs.size(); ++j) inputs_.push_back(j);
    }
    for (const std::size_t j : inputs_) counts_.push_back(abstraction_.inputs[j].count());
    for (const std::int64_t count : counts_) choices_ *= count;
  }

  /// @param may_leave by own index, for those that are worth a look
  void count(const std::vector<bool>& may_leave, bool above) {
    above_ = above;
    known_.assign(places(), -1);
    const CellSet& safe = ground_.safe;
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
  }

  [[nodiscard]] std::int64_t blocked() const { return blocked_; }
  [[nodiscard]] bool is_all() const { return looked_at_ < kMost; }

 private:
  static constexpr std::int64_t kMost = std::int64_t{1} << 22;

  /// How many numbers place_of() has; 0 where it says too little, or they are too many to be remembered.
  [[nodiscard]] std::size_t places() const {
    const TransitionTable& table = abstraction_.tables[i_];
    if (ground_.allow || table.is_sum()) return 0;
    const std::int64_t own = table.shift ? abstraction_.grid[i_].count : 1;
    const std::int64_t all = static_cast<std::int64_t>(table.entries.size()) / choices_ * own;
    return all <= kMost ? at(all) : 0;
  }

  /// All that the post of a cell depends on besides the inputs, which are last in the layout of tables.
  [[nodiscard]] std::int64_t place_of(std::int64_t cell) const {
    const TransitionTable& table = abstraction_.tables[i_];
    std::int64_t place = 0;
    for (const std::int32_t j : table.states)
      place += abstraction_.grid.index(cell, at(j)) * table.state_stride[at(j)];
    place /= choices_;
    return table.shift ? place * abstraction_.grid[i_].count + abstraction_.grid.index(cell, i_) : place;
  }

  [[nodiscard]] std::int64_t blocked_at_cell(std::int64_t cell, std::int64_t row, std::int64_t column) {
    if (known_.empty()) return count_inputs(cell, row, column);
    std::int64_t& known = known_[at(place_of(cell))];
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
      if (is_blocked(cell, u) && (!ground_.allow || is_allowed(row, column, u))) ++blocked;
    } while (choice.advance());
    return blocked * (abstraction_.inputs.count() / choices_);
  }

  [[nodiscard]] bool is_blocked(std::int64_t cell, std::int64_t u) const {
    const IndexRange raw = abstraction_.raw(i_, cell, u);
    return above_ ? raw.last >= abstraction_.grid[i_].count : raw.first < 0;
  }
  [[nodiscard]] bool is_allowed(std::int64_t row, std::int64_t column, std::int64_t u) const {
    const auto bits = ground_.allow->row(row, u);
    return (bits[static_cast<std::size_t>(column / CellSet::kWordBits)] >> (column % CellSet::kWordBits) &
            1) != 0;
  }

  const Ground& ground_;
  const Abstraction& abstraction_;
  std::size_t i_;
  bool above_ = false;
  std::vector<std::size_t> inputs_;
  std::vector<std::int64_t> counts_;
  std::int64_t choices_ = 1;         ///< product of those counts
  std::vector<std::int64_t> known_;  ///< [place] how many joint inputs are blocked; -1: not counted yet
  std::int64_t looked_at_ = 0;
  std::int64_t blocked_ = 0;
};

/// Whether the spec says nothing about a side of one of its states.
bool is_left_at_default(const nlohmann::json& states, std::size_t state, const char* side) {
  if (state >= states.size()) return false;
  const auto outside = states[state].find("outside");
  return outside == states[state].end() || (outside->is_object() && !outside->contains(side));
}

/// "4,410 below p1", where pairs are blocked at that side; else empty.
std::string blocked_at(const Ground& ground, std::size_t i, const Spreads& spreads, bool above) {
  const GridDimension& dimension = ground.abstraction->grid[i];
  const auto count = static_cast<double>(dimension.count);
  const double slack = ground.abstraction->tables[i].is_sum() ? kSlack : 0;
  std::vector<bool> may_leave;
  for (std::size_t k = 0; k < spreads.all().size(); ++k) {
    const Spread& own = spreads.all()[k];
    const auto at = static_cast<double>(k);
    may_leave.push_back(above ? at + own.last >= count - slack : at + own.first < slack);
  }
  if (std::find(may_leave.begin(), may_leave.end(), true) == may_leave.end()) return "";
  BlockedPairs pairs(ground, i);
  pairs.count(may_leave, above);
  if (pairs.blocked() == 0) return "";
  return fmt::format("{}{} {} {}", pairs.is_all() ? "" : "at least ", grouped(pairs.blocked()),
                     above ? "above" : "below", dimension.name);
}

}  // namespace

Warnings advise_on_posts(const Ground& ground) {
  constexpr std::size_t kLongText = std::size_t{1} << 20;
  const bool is_short = ground.spec.text.size() <= kLongText;
  const JsonDocument document =
      JsonDocument::parse(is_short ? ground.spec.text : R"({"states": []})", "the spec");
  const Abstraction& abstraction = *ground.abstraction;
  Warnings found;
  std::vector<std::string> blocked;
  for (std::size_t state = 0; state < ground.spec.states.size(); ++state) {
    const std::size_t i = abstraction.grid.dimension_of(state);
    const GridDimension& dimension = abstraction.grid[i];
    std::vector<bool> sides;  // above
    for (const bool above : {false, true}) {
      const Outside rule = above ? dimension.above : dimension.below;
      if (rule != Outside::unsafe) continue;
      if (is_left_at_default(document.value()["states"], state, above ? "above" : "below"))
        sides.push_back(above);
    }
    if (sides.empty() && !may_move_less_than_a_cell(abstraction.tables[i], i, dimension.count)) continue;
    const Spreads spreads = spreads_of(abstraction.tables[i], i, dimension.count);
    advise_on_motion(ground, i, spreads, found);
    for (const bool above : sides) {
      const std::string text = blocked_at(ground, i, spreads, above);
      if (!text.empty()) blocked.push_back(text);
    }
  }
  if (blocked.empty()) return found;
  found.push_back(
      {"blocked", "/states",
       fmt::format("pairs of a safe cell and a joint input are blocked where the domain ends: {}; "
                   "\"outside\" is \"unsafe\" there because the spec does not say what leaving means",
                   fmt::join(blocked, ", "))});
  return found;
}

}  // namespace coordreq
