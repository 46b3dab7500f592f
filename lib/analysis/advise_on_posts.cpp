#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "analysis/advice.hpp"
#include "analysis/motion.hpp"
#include "base/grouped.hpp"
#include "base/json.hpp"
#include "base/requires.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Bounds for the post of one index of a state, in steps and relative to that index.
struct Spread {
  double first = 0, last = 0;          ///< bounds for its ends
  double least_sum = 0, most_sum = 0;  ///< for the sum of its ends, twice the motion of the middle
};

/// Bounds by the index of the state itself. Terms of a table, each with separate entries, are added up.
class Spreads {
 public:
  explicit Spreads(std::int64_t count) : all_(static_cast<std::size_t>(count)) {}

  /// @param stride of this index among the entries; 0: they do not depend on it
  template <class Entries, class Ends>
  void add(const Entries& entries, std::int64_t stride, const Ends& ends) {
    const auto count = static_cast<std::int64_t>(all_.size());
    std::vector<Spread> term_spreads(stride == 0 ? 1 : all_.size(), {kFar, -kFar, kFar, -kFar});
    for (std::size_t at = 0; at < entries.size(); ++at) {
      const auto [first, last] = ends(at);
      Spread& spread =
          term_spreads[stride == 0
                           ? 0
                           : static_cast<std::size_t>(static_cast<std::int64_t>(at) / stride % count)];
      spread.first = std::min(spread.first, first);
      spread.last = std::max(spread.last, last);
      spread.least_sum = std::min(spread.least_sum, first + last);
      spread.most_sum = std::max(spread.most_sum, first + last);
    }
    for (std::size_t k = 0; k < all_.size(); ++k) {
      const Spread& spread = term_spreads[stride == 0 ? 0 : k];
      all_[k].first += spread.first;
      all_[k].last += spread.last;
      all_[k].least_sum += spread.least_sum;
      all_[k].most_sum += spread.most_sum;
    }
  }

  /// From indices to differences from the index of the state itself.
  void make_relative() {
    for (std::size_t k = 0; k < all_.size(); ++k) {
      const auto index = static_cast<double>(k);
      all_[k].first -= index;
      all_[k].last -= index;
      all_[k].least_sum -= 2 * index;
      all_[k].most_sum -= 2 * index;
    }
  }

  [[nodiscard]] const std::vector<Spread>& all() const { return all_; }

 private:
  static constexpr double kFar = 1e300;
  std::vector<Spread> all_;
};

/// Rounding of what is added up here, in steps.
constexpr double kSlack = 1e-6;

Spreads spreads_of(const TransitionTable& table, std::size_t axis, std::int64_t count) {
  Spreads spreads(count);
  const std::int64_t stride = table.state_stride[axis];
  if (!table.is_sum()) {
    spreads.add(table.entries, stride, [&](std::size_t at) {
      return std::pair<double, double>(table.entries[at].first, table.entries[at].last);
    });
  } else {
    // The upper end as the lower one is kept: a cell further.
    const double unit = 1.0 / static_cast<double>(std::int64_t{1} << TransitionTable::kFractionBits);
    const auto add = [&](const std::vector<std::int64_t>& lower, const std::vector<std::int64_t>& upper,
                         std::int64_t axis_stride) {
      spreads.add(lower, axis_stride, [&](std::size_t at) {
        return std::pair(static_cast<double>(lower[at]) * unit, static_cast<double>(upper[at]) * unit);
      });
    };
    add(table.base_lower, table.base_upper, stride);
    for (const TransitionTerm& term : table.terms) add(term.lower, term.upper, term.state_stride[axis]);
  }
  if (!table.shift) spreads.make_relative();
  return spreads;
}

/// Every post holds the cell itself, or reaches no further than a neighbour, and its middle moves by less
/// than a cell: with ends at indices first and last that is |first + last| < 2, where the ends of a sum are
/// real numbers, of which the upper one is a cell further.
bool moves_less_than_a_cell(const Spreads& spreads, bool is_sum) {
  const double middle = is_sum ? 1 : 0;
  const double slack = is_sum ? kSlack : 0;
  return std::all_of(spreads.all().begin(), spreads.all().end(), [&](const Spread& spread) {
    const bool is_near = spread.first >= -1 - slack && spread.last < 2 - slack;
    return is_near && spread.least_sum - middle > -2 + slack && spread.most_sum - middle < 2 - slack;
  });
}

/// False where one of some entries shows a motion of a cell, so that a large table need not be
/// searched in full.
bool may_move_less_than_a_cell(const TransitionTable& table, std::size_t axis, std::int64_t count) {
  constexpr std::size_t kLook = 4096;
  const std::int64_t stride = table.state_stride[axis];
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
                     [](const Spread& spread) { return spread.first == 0 && spread.last == 0; });
}

std::string amount(const Rational& value, const std::string& unit) {
  return fmt::format("{:.6g}{}{}", nearest_double(value), unit.empty() ? "" : " ", unit);
}

/// ", to 0.01 m or 0.25 s": where a state just moves by a cell, as far as a sample shows.
std::string numbers_to_set(const ProblemSpec& spec, std::size_t state, const StateMotion& moved) {
  if (!(moved.amount > 0)) return "";
  const auto rough = [](double value, const std::string& unit) {
    return fmt::format("{:.3g}{}{}", value, unit.empty() ? "" : " ", unit);
  };
  const double period = nearest_double(spec.dynamics.period) / moved.cells;
  const std::string step = fmt::format(", e.g. to {}", rough(moved.amount, spec.states[state].unit));
  return spec.dynamics.time == Time::discrete
             ? step
             : fmt::format("{} or {}", step, rough(period, spec.dynamics.unit));
}

void advise_on_motion(const AnalysisContext& context, std::size_t i, const Spreads& spreads,
                      const std::vector<StateMotion>& motion, Warnings& found) {
  const GridDimension& dimension = context.abstraction->grid[i];
  const bool is_sum = context.abstraction->tables[i].is_sum();
  if (dimension.discrete || dimension.count < 3 || !moves_less_than_a_cell(spreads, is_sum)) return;
  if (!is_sum && stands_still(spreads)) return;
  const std::size_t state = context.abstraction->grid.state(i);
  // At its fastest it moves by a cell, though the middle of no reachable set does.
  constexpr double kRounding = 1e-6;
  if (motion[state].cells >= 1 - kRounding) return;
  const DynamicsSpec& dynamics = context.spec.dynamics;
  found.push_back(
      {"motion", fmt::format("/states/{}", state),
       fmt::format(
           "{} moves by less than one cell ({}) in a period ({}), so that every reachable set spreads "
           "to the next cell and answers show the grid rather than the system; make the step smaller "
           "or the period longer{}",
           dimension.name, amount(dimension.step, context.spec.states[state].unit),
           amount(dynamics.period, dynamics.unit), numbers_to_set(context.spec, state, motion[state]))});
}

/// Whether the spec says nothing about a side of one of its states.
bool is_left_at_default(const Json& states, std::size_t state, const char* side) {
  if (state >= states.size()) return false;
  const auto outside = states[state].find("outside");
  return outside == states[state].end() || (outside->is_object() && !outside->contains(side));
}

/// "4,410 below p1", where pairs are blocked at that side; else empty.
std::string blocked_at(const AnalysisContext& context, std::size_t i, const Spreads& spreads, bool above) {
  const GridDimension& dimension = context.abstraction->grid[i];
  const auto count = static_cast<double>(dimension.count);
  const double slack = context.abstraction->tables[i].is_sum() ? kSlack : 0;
  std::vector<bool> may_leave;
  for (std::size_t k = 0; k < spreads.all().size(); ++k) {
    const Spread& spread = spreads.all()[k];
    const auto at = static_cast<double>(k);
    may_leave.push_back(above ? at + spread.last >= count - slack : at + spread.first < slack);
  }
  if (std::find(may_leave.begin(), may_leave.end(), true) == may_leave.end()) return "";
  const BlockedPairs blocked = count_blocked(context, i, above, may_leave);
  if (blocked.pairs == 0) return "";
  return fmt::format("{}{} {} {}", blocked.is_all ? "" : "at least ", grouped(blocked.pairs),
                     above ? "above" : "below", dimension.name);
}

}  // namespace

Warnings advise_on_posts(const AnalysisContext& context, const std::vector<StateMotion>& motion) {
  REQUIRES(context.engine && context.hull);
  constexpr std::size_t kLongText = std::size_t{1} << 20;
  const bool is_short = context.spec.text.size() <= kLongText;
  const Json states =
      is_short ? parse_json(context.spec.text, JsonComments::skipped).at("states") : Json::array();
  const Abstraction& abstraction = *context.abstraction;
  Warnings found;
  std::vector<std::string> blocked;
  for (std::size_t state = 0; state < context.spec.states.size(); ++state) {
    const std::size_t i = abstraction.grid.dimension_of(state);
    const GridDimension& dimension = abstraction.grid[i];
    std::vector<bool> sides;  // above
    for (const bool above : {false, true}) {
      const Outside rule = above ? dimension.above : dimension.below;
      if (rule != Outside::unsafe) continue;
      if (is_left_at_default(states, state, above ? "above" : "below")) sides.push_back(above);
    }
    if (sides.empty() && !may_move_less_than_a_cell(abstraction.tables[i], i, dimension.count)) continue;
    const Spreads spreads = spreads_of(abstraction.tables[i], i, dimension.count);
    advise_on_motion(context, i, spreads, motion, found);
    for (const bool above : sides) {
      const std::string text = blocked_at(context, i, spreads, above);
      if (!text.empty()) blocked.push_back(text);
    }
  }
  if (blocked.empty()) return found;
  found.push_back(
      {"blocked", "/states",
       fmt::format("transitions leave the domain and count as unsafe, since \"outside\" is not set there: {}",
                   fmt::join(blocked, ", "))});
  return found;
}

}  // namespace coordreq
