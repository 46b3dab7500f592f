#include "reach/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/error.hpp"
#include "base/index.hpp"
#include "expression/place.hpp"
#include "model/pieces.hpp"
#include "ranks/divided_loop.hpp"
#include "reach/box_choices.hpp"
#include "reach/cells_meeting.hpp"
#include "reach/divided_entries.hpp"
#include "reach/state_enclosure.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

constexpr IndexRange kEverywhere{std::numeric_limits<std::int32_t>::min(),
                                 std::numeric_limits<std::int32_t>::max()};

/// What one state has: its table and maybe its tube, and what an enclosure means for them.
class EnclosureTable {
 public:
  EnclosureTable(const SystemSpec& spec, const Dependencies& dependencies, Abstraction& abstraction,
                 const BoxChoices& choices, std::size_t state, bool differences)
      : spec_(spec),
        choices_(choices),
        target_(abstraction.grid[state]),
        table_(abstraction.tables[state]),
        tube_(abstraction.tubes.empty() ? nullptr : &abstraction.tubes[state]),
        state_(state),
        differences_(differences) {
    table_ = full_layout(spec, dependencies, state, abstraction);
    if (tube_ != nullptr) *tube_ = table_;
  }

  [[nodiscard]] std::size_t state() const { return state_; }
  [[nodiscard]] const TransitionTable& table() const { return table_; }

  /// Says where entries lie and which choices are those of this process; null: there is one.
  void divide(const DividedEntries::Positions& positions, ThreadTeam::Range local, Ranks* ranks) {
    entries_.emplace(table_, positions, local, ranks);
    if (tube_ != nullptr) tube_entries_.emplace(*tube_, positions, local, ranks);
  }

  /// Says where the state itself is among the choices; only a tube asks for it, and not of differences.
  void set_target(std::size_t position, std::int64_t first, std::int64_t count) {
    target_choice_ = position;
    if (tube_ == nullptr) return;
    for (std::int64_t k = first; k < first + count; ++k) target_pieces_.push_back(pieces(target_, k));
  }

  /// A choice that is worked on: its number, and the position of its entry.
  struct Entry {
    std::int64_t choice = 0;
    std::int64_t position = 0;
  };
  /// Widens the entry by an enclosure of one choice of pieces.
  void add(const Entry& entry, bool first, const StateEnclosure& enclosure,
           const std::vector<std::int64_t>& choice, const std::vector<std::int64_t>& piece) {
    const StateEnclosure::Result result = enclosure.result(state_);
    const auto widen = [&](DividedEntries& entries, IndexRange next) {
      IndexRange& range = entries.at(entry.choice, entry.position);
      range = first ? next : merge_ranges(range, next, target_);
    };
    widen(*entries_, indices(result, enclosure, choice));
    if (tube_entries_) widen(*tube_entries_, tube_indices(result, choice, piece));
  }

  /// Together: takes in the entries that other processes have filled.
  void join() {
    entries_->join();
    if (tube_entries_) tube_entries_->join();
  }

 private:
  [[nodiscard]] IndexRange indices(const StateEnclosure::Result& result, const StateEnclosure& enclosure,
                                   const std::vector<std::int64_t>& choice) const {
    if (result.status != StateEnclosure::Status::ok) return indices_of_failure(enclosure, result, choice);
    const Interval& value = result.value;
    if (!std::isfinite(value.lower) || !std::isfinite(value.upper)) {
      throw SpecError(fmt::format("the next value of '{}', {}, has no bound{}", target_.name,
                                  equation_text(state_), choices_.location(choice)),
                      where());
    }
    if (target_.discrete) return index_of_point(value, choice);
    if (differences_) return cells_meeting_shifted(target_, spec_.abstraction.cells, value);
    return cells_meeting(target_, spec_.abstraction.cells, value);
  }

  /// From both bounds, as far as there are: where the state is, and how far it can have moved from the exact
  /// piece it started in. An end can have a bound where the way there has none.
  [[nodiscard]] IndexRange tube_indices(const StateEnclosure::Result& result,
                                        const std::vector<std::int64_t>& choice,
                                        const std::vector<std::int64_t>& piece) const {
    if (result.status != StateEnclosure::Status::ok) return kEverywhere;  // and so is its post
    const bool is_bounded = result.tube.is_finite();
    if (!is_bounded && !result.drift.is_finite()) return kEverywhere;
    if (differences_) {
      return cells_covering_shifted(
          target_, intersect(result.tube, result.drift).value_or(is_bounded ? result.tube : result.drift));
    }
    if (!result.drift.is_finite())
      return cells_covering(target_, exact(result.tube.lower), exact(result.tube.upper));
    const Piece& start = target_pieces_[static_cast<std::size_t>(choice[target_choice_])]
                                       [static_cast<std::size_t>(piece[target_choice_])];
    const Rational from_below = start.lower + exact(result.drift.lower);
    const Rational from_above = start.upper + exact(result.drift.upper);
    if (!is_bounded) return cells_covering(target_, from_below, from_above);
    return cells_covering(target_, std::max(from_below, exact(result.tube.lower)),
                          std::min(from_above, exact(result.tube.upper)));
  }

  /// A solution without an enclosure is no harm where its state has left the domain through an unsafe side by
  /// then.
  [[nodiscard]] IndexRange indices_of_failure(const StateEnclosure& enclosure,
                                              const StateEnclosure::Result& result,
                                              const std::vector<std::int64_t>& choice) const {
    if (result.left_unsafely) return kEverywhere;
    const std::string& name = spec_.states[result.culprit].name;
    const std::string equation = equation_text(result.culprit);
    const std::string pointer = "/dynamics/equations/" + name;
    if (result.status == StateEnclosure::Status::undefined) {
      const std::string reason = enclosure.reason(result);
      throw SpecError(fmt::format("the equation of '{}', {}, is not defined everywhere{}{}{}", name, equation,
                                  choices_.location(choice), reason.empty() ? "" : ": ", reason),
                      pointer);
    }
    if (result.status == StateEnclosure::Status::too_stiff) {
      throw SpecError(
          fmt::format("the equation of '{}', {}, is too stiff{}: it decays at a rate of {:.3g}, "
                      "expected one that can be followed for a period of {}",
                      name, equation, choices_.location(choice), result.rate, to_text(spec_.dynamics.period)),
          pointer);
    }
    throw SpecError(fmt::format("the solution of '{}', with the equation {}, may escape to infinity within "
                                "one period{}, or change too fast to be followed that long",
                                name, equation, choices_.location(choice)),
                    pointer);
  }

  [[nodiscard]] IndexRange index_of_point(const Interval& value,
                                          const std::vector<std::int64_t>& choice) const {
    const Rational origin = differences_ ? Rational(0) : target_.first;
    const Rational index = (exact(value.lower) - origin) / target_.step;
    if (!value.is_point() || !is_integer(index)) {
      throw SpecError(
          fmt::format("the next value of the discrete state '{}' is in [{}, {}]{}, expected one of {} + k * "
                      "{} with an integer k",
                      target_.name, value.lower, value.upper, choices_.location(choice),
                      to_text(target_.first), to_text(target_.step)),
          where());
    }
    const std::int64_t k = floor_to_int(index);
    return raw_range(target_, k, k);
  }

  [[nodiscard]] std::string equation_text(std::size_t state) const {
    return in_quotes(spec_.dynamics.equations[state].text);
  }

  [[nodiscard]] std::string where() const { return "/dynamics/equations/" + target_.name; }

  const SystemSpec& spec_;
  const BoxChoices& choices_;
  const GridDimension& target_;
  TransitionTable& table_;
  TransitionTable* tube_;  ///< null if not asked for
  std::optional<DividedEntries> entries_, tube_entries_;
  std::size_t state_;
  bool differences_;               ///< enclosures are of the next value less the present one
  std::size_t target_choice_ = 0;  ///< its position among the choices, unless these are differences
  std::vector<std::vector<Piece>> target_pieces_;  ///< [index][piece], exactly
};

}  // namespace

void build_enclosure_tables(const SystemSpec& spec, const AffineDynamics& dynamics, Abstraction& abstraction,
                            const std::vector<std::size_t>& states, ThreadTeam& team,
                            std::optional<std::int64_t> index, Ranks* ranks) {
  const Dependencies& dependencies = dynamics.dependencies(states.front());
  const StateEnclosure enclosure(spec, dependencies, states);
  BoxChoices choices;
  std::vector<EnclosureTable> tables;
  for (const std::size_t state : states) {
    tables.emplace_back(spec, dependencies, abstraction, choices, state, enclosure.shifts());
  }
  const TransitionTable& layout = tables.front().table();
  DividedEntries::Positions positions;
  for (const std::int32_t j : layout.states) {
    const bool is_shifted = layout.shift && at(j) == states.front();
    if (is_shifted && enclosure.shifts()) continue;
    const GridDimension& dimension = abstraction.grid[at(j)];
    const bool only_one = index && at(j) == states.front();
    const std::int64_t from = only_one && !is_shifted ? *index : 0;
    const std::int64_t count = only_one || is_shifted ? 1 : dimension.count;
    for (EnclosureTable& table : tables) {
      if (table.state() == at(j)) table.set_target(positions.counts.size(), from, count);
    }
    choices.add_state(dimension, spec.state_slot(at(j)), count, from);
    positions.first += from * layout.state_stride[at(j)];
    positions.strides.push_back(layout.state_stride[at(j)]);
    positions.counts.push_back(count);
  }
  for (const std::int32_t j : layout.inputs) {
    choices.add_input(abstraction.inputs[at(j)], spec.input_slot(at(j)));
    positions.strides.push_back(layout.input_stride[at(j)]);
    positions.counts.push_back(abstraction.inputs[at(j)].count());
  }

  std::vector<StateEnclosure> enclosures(static_cast<std::size_t>(team.size()), enclosure);
  const Odometer all = choices.odometer();
  for (EnclosureTable& table : tables) table.divide(positions, divided_range(ranks, all.size()), ranks);
  for_each_divided(ranks, team, all.size(), 4, [&](ThreadTeam::Range range, int worker) {
    StateEnclosure& mine = enclosures[static_cast<std::size_t>(worker)];
    Odometer choice = all;
    choice.seek(range.begin);
    for (std::int64_t i = range.begin; i < range.end; ++i, choice.advance()) {
      EnclosureTable::Entry entry{i, positions.first};
      for (std::size_t v = 0; v < positions.strides.size(); ++v)
        entry.position += choice.indices()[v] * positions.strides[v];
      bool first = true;
      choices.for_each_piece(choice.indices(), mine, [&](const std::vector<std::int64_t>& piece) {
        mine.enclose();
        for (EnclosureTable& table : tables) {
          table.add(entry, first, mine, choice.indices(), piece);
        }
        first = false;
      });
    }
  });
  for (EnclosureTable& table : tables) table.join();
  for (const std::size_t state : states) fill_cells_off_limits(spec, dynamics, abstraction, state, team);
}

}  // namespace coordreq
