#include "abstraction/enclosure_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "abstraction/cells_meeting.hpp"
#include "abstraction/counter.hpp"
#include "abstraction/state_enclosure.hpp"
#include "base/error.hpp"
#include "dynamics/shift.hpp"
#include "grid/pieces.hpp"

namespace coordreq {
namespace {

std::size_t at(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

constexpr IndexRange kEverywhere{std::numeric_limits<std::int32_t>::min(),
                                 std::numeric_limits<std::int32_t>::max()};

Interval box_of(const Rational& lower, const Rational& upper) {
  return {.lower = lower_double(lower), .upper = upper_double(upper)};
}

/// Boxes of every index of every variable that the table ranges over.
struct VariableBoxes {
  std::uint32_t slot = 0;
  std::string name;
  std::vector<Rational> points;               ///< [index], for messages
  std::vector<std::vector<Interval>> pieces;  ///< [index][piece]
  std::int64_t stride = 0;                    ///< in the table
};

class EnclosureTable {
 public:
  EnclosureTable(const ProblemSpec& spec, const Dependencies& dependencies, Abstraction& abstraction,
                 std::size_t state)
      : spec_(spec),
        enclosure_(spec, dependencies, state),
        target_(abstraction.grid[state]),
        table_(abstraction.tables[state]),
        tube_(abstraction.tubes.empty() ? nullptr : &abstraction.tubes[state]),
        state_(state) {
    table_.states = dependencies.moving;
    table_.states.insert(table_.states.end(), dependencies.parameters.begin(), dependencies.parameters.end());
    std::sort(table_.states.begin(), table_.states.end());
    table_.inputs = dependencies.inputs;
    table_.shift = is_shift(spec, dependencies, state);
    table_.entries.resize(
        static_cast<std::size_t>(lay_out(table_, state, abstraction.grid, abstraction.inputs)));
    if (tube_ != nullptr) *tube_ = table_;
    for (const std::int32_t j : table_.states) {
      const bool own_of_shift = table_.shift && at(j) == state;
      if (own_of_shift && enclosure_.shifts()) continue;
      if (at(j) == state) own_ = variables_.size();
      const GridDimension& dimension = abstraction.grid[at(j)];
      add_state(dimension, at(j), own_of_shift ? 1 : dimension.count);
    }
    for (const std::int32_t j : table_.inputs) add_input(abstraction.inputs[at(j)], at(j));
  }

  void build(ThreadTeam& team) {
    std::vector<std::int64_t> counts;
    for (const VariableBoxes& variable : variables_) {
      counts.push_back(static_cast<std::int64_t>(variable.pieces.size()));
    }
    const Counter all(counts);
    std::vector<StateEnclosure> enclosures(static_cast<std::size_t>(team.size()), enclosure_);
    team.for_each(all.size(), 64, [&](ThreadTeam::Range range, int worker) {
      Counter choice = all;
      choice.seek(range.begin);
      for (std::int64_t i = range.begin; i < range.end; ++i, choice.next()) {
        fill(choice.indices(), enclosures[static_cast<std::size_t>(worker)]);
      }
    });
  }

 private:
  /// With its first `count` indices.
  void add_state(const GridDimension& dimension, std::size_t state, std::int64_t count) {
    VariableBoxes& variable = variables_.emplace_back();
    variable.slot = spec_.state_slot(state);
    variable.name = dimension.name;
    variable.stride = table_.state_stride[state];
    for (std::int64_t k = 0; k < count; ++k) {
      variable.points.push_back(dimension.point(k));
      std::vector<Interval>& boxes = variable.pieces.emplace_back();
      const std::vector<Piece> parts = pieces(dimension, k);
      for (const Piece& piece : parts) boxes.push_back(box_of(piece.lower, piece.upper));
      if (state == state_) own_pieces_.push_back(parts);
    }
  }

  void add_input(const InputSpace::Dimension& input, std::size_t index) {
    VariableBoxes& variable = variables_.emplace_back();
    variable.slot = spec_.input_slot(index);
    variable.name = input.name;
    variable.stride = table_.input_stride[index];
    for (const Rational& value : input.values) {
      variable.points.push_back(value);
      variable.pieces.push_back({box_of(value, value)});
    }
  }

  void fill(const std::vector<std::int64_t>& choice, StateEnclosure& enclosure) {
    std::int64_t base = 0;
    std::vector<std::int64_t> piece_counts;
    for (std::size_t v = 0; v < choice.size(); ++v) {
      base += choice[v] * variables_[v].stride;
      piece_counts.push_back(static_cast<std::int64_t>(boxes_of(choice, v).size()));
    }
    std::optional<IndexRange> range;
    std::optional<IndexRange> tube;
    const auto add = [&](std::optional<IndexRange>& sum, IndexRange next) {
      sum = sum ? merge_ranges(*sum, next, target_) : next;
    };
    Counter piece(piece_counts);
    do {
      for (std::size_t v = 0; v < choice.size(); ++v) {
        enclosure.set(variables_[v].slot, boxes_of(choice, v)[static_cast<std::size_t>(piece.indices()[v])]);
      }
      const StateEnclosure::Result result = enclosure.enclose();
      add(range, indices(result, choice));
      if (tube_ != nullptr) add(tube, tube_indices(result, choice, piece.indices()));
    } while (piece.next());
    table_.entries[static_cast<std::size_t>(base)] = *range;
    if (tube_ != nullptr) tube_->entries[static_cast<std::size_t>(base)] = *tube;
  }

  [[nodiscard]] const std::vector<Interval>& boxes_of(const std::vector<std::int64_t>& choice,
                                                      std::size_t v) const {
    return variables_[v].pieces[static_cast<std::size_t>(choice[v])];
  }

  [[nodiscard]] IndexRange indices(const StateEnclosure::Result& result,
                                   const std::vector<std::int64_t>& choice) const {
    if (result.status != StateEnclosure::Status::ok) return indices_of_failure(result, choice);
    const Interval& value = result.value;
    if (!std::isfinite(value.lower) || !std::isfinite(value.upper)) {
      throw SpecError(fmt::format("the next value of '{}' has no bound{}", target_.name, place(choice)),
                      where());
    }
    if (target_.discrete) return index_of_point(value, choice);
    if (enclosure_.shifts()) return cells_meeting_shifted(target_, spec_.abstraction.cells, value);
    return cells_meeting(target_, spec_.abstraction.cells, value);
  }

  /// From both bounds: where the state is, and how far it can have moved from the exact piece it started in.
  [[nodiscard]] IndexRange tube_indices(const StateEnclosure::Result& result,
                                        const std::vector<std::int64_t>& choice,
                                        const std::vector<std::int64_t>& piece) const {
    if (result.status != StateEnclosure::Status::ok) return kEverywhere;  // and so is its post
    if (enclosure_.shifts()) {
      return cells_covering_shifted(target_, intersect(result.tube, result.drift).value_or(result.tube));
    }
    const Piece& start =
        own_pieces_[static_cast<std::size_t>(choice[own_])][static_cast<std::size_t>(piece[own_])];
    const Rational from_below = start.lower + exact(result.drift.lower);
    const Rational from_above = start.upper + exact(result.drift.upper);
    return cells_covering(target_, std::max(from_below, exact(result.tube.lower)),
                          std::min(from_above, exact(result.tube.upper)));
  }

  /// A solution without an enclosure is no harm where its state has left the domain through an unsafe side by
  /// then.
  [[nodiscard]] IndexRange indices_of_failure(const StateEnclosure::Result& result,
                                              const std::vector<std::int64_t>& choice) const {
    if (result.left_unsafely) return kEverywhere;
    const std::string& name = spec_.states[result.culprit].name;
    const std::string what =
        result.status == StateEnclosure::Status::undefined
            ? fmt::format("the equation of '{}' is not defined everywhere", name)
            : fmt::format("the solution of '{}' may escape to infinity within one period", name);
    throw SpecError(what + place(choice), "/dynamics/equations/" + name);
  }

  [[nodiscard]] IndexRange index_of_point(const Interval& value,
                                          const std::vector<std::int64_t>& choice) const {
    const Rational origin = enclosure_.shifts() ? Rational(0) : target_.first;
    const Rational index = (exact(value.lower) - origin) / target_.step;
    if (!value.is_point() || !is_integer(index)) {
      throw SpecError(
          fmt::format("the next value of the discrete state '{}' is in [{}, {}]{}, expected one of {} + k * "
                      "{} with an integer k",
                      target_.name, value.lower, value.upper, place(choice), to_text(target_.first),
                      to_text(target_.step)),
          where());
    }
    const std::int32_t k = saturate_index(floor_to_int(index));
    return {k, k};
  }

  [[nodiscard]] std::string place(const std::vector<std::int64_t>& choice) const {
    std::string text;
    for (std::size_t v = 0; v < choice.size(); ++v) {
      text += fmt::format("{}{} = {}", text.empty() ? " near " : ", ", variables_[v].name,
                          to_text(variables_[v].points[static_cast<std::size_t>(choice[v])]));
    }
    return text;
  }

  [[nodiscard]] std::string where() const { return "/dynamics/equations/" + target_.name; }

  const ProblemSpec& spec_;
  StateEnclosure enclosure_;
  const GridDimension& target_;
  TransitionTable& table_;
  TransitionTable* tube_;  ///< null if not asked for
  std::size_t state_;
  std::vector<VariableBoxes> variables_;  ///< all that the table ranges over, but for a shifted own state
  std::size_t own_ = 0;                   ///< among them, unless shifted
  std::vector<std::vector<Piece>> own_pieces_;  ///< [index][piece], exactly
};

}  // namespace

void build_enclosure_table(const ProblemSpec& spec, const Dependencies& dependencies,
                           Abstraction& abstraction, std::size_t state, ThreadTeam& team) {
  EnclosureTable(spec, dependencies, abstraction, state).build(team);
}

}  // namespace coordreq
