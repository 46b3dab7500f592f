#include "model/condition_table.hpp"

#include <algorithm>

#include "engine/row_operations.hpp"
#include "model/condition.hpp"
#include "model/condition_atoms.hpp"
#include "model/pieces.hpp"

namespace coordreq {
namespace {

std::size_t at(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

RationalInterval point_interval(const Rational& point) {
  return {.lower = point, .upper = point};
}

/// The ranges of every index of every variable, exactly and in doubles: mostly one, two for a cell on a seam.
struct Ranges {
  std::vector<std::vector<std::vector<RationalInterval>>> exact;  // [slot][index][piece]
  std::vector<std::vector<std::vector<Interval>>> fast;
  bool in_parts = false;  // some index has two

  Ranges(const UniformGrid& grid, const InputSpace& inputs, Sampling sampling, const std::vector<bool>& used)
      : exact(grid.size() + inputs.size()), fast(exact.size()) {
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const std::size_t slot = grid.state(i);
      for (std::int64_t k = 0; used[slot] && k < grid[i].count; ++k) add_state(slot, grid[i], k, sampling);
    }
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      if (!used[grid.size() + i]) continue;
      for (const Rational& value : inputs[i].values)
        exact[grid.size() + i].push_back({point_interval(value)});
    }
    for (std::size_t slot = 0; slot < exact.size(); ++slot) {
      for (const std::vector<RationalInterval>& parts : exact[slot]) {
        in_parts = in_parts || parts.size() > 1;
        std::vector<Interval>& enclosed = fast[slot].emplace_back();
        for (const RationalInterval& part : parts) enclosed.push_back(enclose(part));
      }
    }
  }

 private:
  void add_state(std::size_t slot, const GridDimension& dimension, std::int64_t k, Sampling sampling) {
    std::vector<RationalInterval>& parts = exact[slot].emplace_back();
    if (sampling == Sampling::centres) {
      parts.push_back(point_interval(dimension.point(k)));
      return;
    }
    for (const Piece& piece : pieces(dimension, k))
      parts.push_back({.lower = piece.lower, .upper = piece.upper});
  }
};

/// Evaluates one bit of the table after the other; scratch of one thread.
class Filler {
 public:
  Filler(const Program& condition, const Ranges& ranges, const ConditionTable::Undecided& undecided,
         Question question)
      : decider_(condition, question),
        ranges_(ranges),
        undecided_(undecided),
        indices_(ranges.exact.size(), 0),
        parts_(ranges.exact.size(), 0),
        fast_(ranges.exact.size()),
        exact_(ranges.exact.size()) {}

  void set(std::size_t slot, std::int64_t index) {
    indices_[slot] = index;
    set_part(slot, 0);
  }

  [[nodiscard]] bool holds() {
    const Truth truth = ranges_.in_parts ? on_all_parts() : on_these_parts();
    return truth == Truth::undecided ? undecided_(indices_) : truth == Truth::yes;
  }

 private:
  void set_part(std::size_t slot, std::size_t part) {
    parts_[slot] = part;
    fast_[slot] = ranges_.fast[slot][static_cast<std::size_t>(indices_[slot])][part];
  }

  Truth on_all_parts() {
    Truth truth = on_these_parts();
    while (next_parts()) {
      // After a difference only the parts are left to go round.
      if (truth != Truth::undecided && on_these_parts() != truth) truth = Truth::undecided;
    }
    return truth;
  }

  /// Goes on to the next combination; @returns false back at the first one
  bool next_parts() {
    for (std::size_t slot = 0; slot < parts_.size(); ++slot) {
      if (ranges_.exact[slot].empty()) continue;
      const std::size_t count = ranges_.exact[slot][static_cast<std::size_t>(indices_[slot])].size();
      if (count == 1) continue;
      const bool more = parts_[slot] + 1 < count;
      set_part(slot, more ? parts_[slot] + 1 : 0);
      if (more) return true;
    }
    return false;
  }

  Truth on_these_parts() {
    return decider_.decide(std::span<const Interval>(fast_), [&] { return exact_box(); });
  }

  std::span<const RationalInterval> exact_box() {
    for (std::size_t slot = 0; slot < exact_.size(); ++slot) {
      if (ranges_.exact[slot].empty()) continue;
      exact_[slot] = ranges_.exact[slot][static_cast<std::size_t>(indices_[slot])][parts_[slot]];
    }
    return exact_;
  }

  ConditionDecider decider_;
  const Ranges& ranges_;
  const ConditionTable::Undecided& undecided_;
  std::vector<std::int64_t> indices_;
  std::vector<std::size_t> parts_;
  std::vector<Interval> fast_;
  std::vector<RationalInterval> exact_;
};

/// True if every cell of the row is set in one of the two.
bool settles_row(ConstRow yes, ConstRow no, std::int64_t length) {
  for (std::size_t w = 0; w < yes.size(); ++w) {
    const std::int64_t rest = length - static_cast<std::int64_t>(w) * CellSet::kWordBits;
    const Word all = rest < CellSet::kWordBits ? (Word{1} << rest) - 1 : ~Word{0};
    if ((yes[w] | no[w]) != all) return false;
  }
  return true;
}

/// The row of an atom's table for row `r` of the table of the whole condition.
ConstRow row_of_atom(const ConditionTable& atom, const ConditionTable& whole, std::int64_t r) {
  std::int64_t position = 0;
  for (const std::int32_t i : atom.states())
    position += whole.state_index(r, at(i)) * atom.state_stride()[at(i)];
  for (const std::int32_t i : atom.inputs())
    position += whole.input_index(r, at(i)) * atom.input_stride()[at(i)];
  return atom.bits().row(position);
}

/// By Kleene's logic, where a bit that is not set means `not proven`.
void join_atoms(const ConditionAtoms& atoms, const std::vector<ConditionTable>& tables,
                const ConditionTable& whole, std::int64_t r, std::vector<std::vector<Word>>& values,
                MutableRow out) {
  using Join = ConditionAtoms::Join;
  for (std::size_t i = 0; i < atoms.nodes.size(); ++i) {
    const ConditionAtoms::Node& node = atoms.nodes[i];
    std::vector<Word>& value = values[i];
    if (node.join == Join::atom) {
      const ConstRow row = row_of_atom(tables[node.a], whole, r);
      value.assign(row.begin(), row.end());
    } else if (node.join == Join::always || node.join == Join::never) {
      value.assign(out.size(), 0);
      if (node.join == Join::always) set_bits(value, 0, whole.bits().row_length());
    } else {
      value = values[node.a];
      const std::vector<Word>& other = values[node.b];
      for (std::size_t w = 0; w < value.size(); ++w) {
        value[w] = node.join == Join::both ? value[w] & other[w] : value[w] | other[w];
      }
    }
  }
  std::copy(values.back().begin(), values.back().end(), out.begin());
}

}  // namespace

ConditionTable::ConditionTable(const Program& condition, const UniformGrid& grid, const InputSpace& inputs,
                               Sampling sampling, const Undecided& undecided, ThreadTeam& team,
                               Question question)
    : grid_(&grid), input_space_(&inputs), state_stride_(grid.size(), 0), input_stride_(inputs.size(), 0) {
  std::vector<bool> used(grid.size() + inputs.size(), false);
  for (const std::uint32_t slot : condition.variables()) used[slot] = true;
  const std::size_t last = grid.size() - 1;
  const std::size_t last_slot = grid.state(last);

  std::int64_t rows = 1;
  for (std::size_t i = inputs.size(); i-- > 0;) {
    if (!used[grid.size() + i]) continue;
    inputs_.insert(inputs_.begin(), static_cast<std::int32_t>(i));
    input_stride_[i] = rows;
    rows *= inputs[i].count();
  }
  for (std::size_t i = last; i-- > 0;) {
    if (!used[grid.state(i)]) continue;
    states_.insert(states_.begin(), static_cast<std::int32_t>(i));
    state_stride_[i] = rows;
    rows *= grid[i].count;
  }
  bits_ = CellSet(rows, grid.row_length());

  // Comparisons that depend on few variables settle most cells; the others are looked at one by one.
  const CellSet proven = proven_by_atoms(condition, false, sampling, team);
  const CellSet refuted = proven.rows() > 0 ? proven_by_atoms(condition, true, sampling, team) : CellSet();
  const auto is_settled = [&](std::int64_t r, std::int64_t k) {
    return refuted.rows() > 0 &&
           (bits_.test(r * grid.row_length() + k) || refuted.test(r * grid.row_length() + k));
  };
  if (proven.rows() > 0) bits_ = proven;

  const Ranges ranges(grid, inputs, sampling, used);
  const std::int64_t grain = std::max<std::int64_t>(1, 4096 / grid.row_length());
  team.for_each(rows, grain, [&](ThreadTeam::Range range, int) {
    Filler filler(condition, ranges, undecided, question);
    for (std::int64_t r = range.begin; r < range.end; ++r) {
      for (const std::int32_t i : states_)
        filler.set(grid.state(at(i)), r / state_stride_[at(i)] % grid[at(i)].count);
      for (const std::int32_t i : inputs_) {
        filler.set(grid.size() + at(i), r / input_stride_[at(i)] % inputs[at(i)].count());
      }
      if (refuted.rows() > 0 && settles_row(bits_.row(r), refuted.row(r), grid.row_length())) continue;
      if (!used[last_slot]) {
        if (filler.holds()) set_bits(bits_.row(r), 0, grid.row_length());
        continue;
      }
      for (std::int64_t k = 0; k < grid.row_length(); ++k) {
        if (is_settled(r, k)) continue;
        filler.set(last_slot, k);
        if (filler.holds()) set_bits(bits_.row(r), k, k + 1);
      }
    }
  });
}

CellSet ConditionTable::proven_by_atoms(const Program& condition, bool negated, Sampling sampling,
                                        ThreadTeam& team) const {
  const std::optional<ConditionAtoms> found = find_atoms(condition, negated);
  if (!found) return {};
  std::vector<ConditionTable> tables;
  const Undecided is_not_proven = [](const std::vector<std::int64_t>&) { return false; };
  for (const Program& atom : found->atoms) {
    tables.emplace_back(atom, *grid_, *input_space_, sampling, is_not_proven, team, Question::everywhere);
  }
  CellSet result(bits_.rows(), bits_.row_length());
  team.for_each(result.rows(), 256, [&](ThreadTeam::Range range, int) {
    std::vector<std::vector<Word>> values(found->nodes.size());
    for (std::int64_t r = range.begin; r < range.end; ++r)
      join_atoms(*found, tables, *this, r, values, result.row(r));
  });
  return result;
}

std::int64_t ConditionTable::position(std::int64_t row, std::int64_t u) const {
  std::int64_t position = 0;
  for (const std::int32_t i : states_) {
    position += grid_->index(row * grid_->row_length(), at(i)) * state_stride_[at(i)];
  }
  for (const std::int32_t i : inputs_) position += input_space_->index(u, at(i)) * input_stride_[at(i)];
  return position;
}

std::span<const CellSet::Word> ConditionTable::row(std::int64_t row, std::int64_t u) const {
  return bits_.row(position(row, u));
}

}  // namespace coordreq
