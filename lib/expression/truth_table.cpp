#include "expression/truth_table.hpp"

#include <algorithm>
#include <optional>

#include "expression/cell_truth.hpp"
#include "expression/condition.hpp"

namespace coordreq {
namespace {

using Join = ConditionAtoms::Join;

using Word = TruthTable::Word;

constexpr std::int64_t kWordBits = 64;

bool test(std::span<const Word> row, std::int64_t k) {
  return (row[static_cast<std::size_t>(k / kWordBits)] >> (k % kWordBits) & 1U) != 0;
}

void set(std::span<Word> row, std::int64_t k) {
  row[static_cast<std::size_t>(k / kWordBits)] |= Word{1} << (k % kWordBits);
}

/// The bits of word w that stand for one of `length` cells.
Word cells_of_word(std::size_t w, std::int64_t length) {
  const std::int64_t rest = length - static_cast<std::int64_t>(w) * kWordBits;
  return rest < kWordBits ? (Word{1} << rest) - 1 : ~Word{0};
}

void set_all(std::span<Word> row, std::int64_t length) {
  for (std::size_t w = 0; w < row.size(); ++w) row[w] = cells_of_word(w, length);
}

using FastRanges = std::vector<Interval>;

FastRanges enclosed(const ConditionAxis::Ranges& exact) {
  FastRanges result;
  for (const RationalInterval& range : exact) result.push_back(enclose(range));
  return result;
}

/// The ranges of all indices of an axis in doubles; nothing if they are not needed often enough to keep
/// them.
std::vector<FastRanges> kept_ranges(const ConditionAxis& axis, std::int64_t queries, ThreadTeam& team) {
  constexpr std::int64_t kOften = 16;
  std::vector<FastRanges> result;
  if (queries < kOften) return result;
  result.resize(static_cast<std::size_t>(axis.count));
  team.for_each(axis.count, 16, [&](ThreadTeam::Range range, int) {
    for (std::int64_t k = range.begin; k < range.end; ++k)
      result[static_cast<std::size_t>(k)] = enclosed(axis.ranges(k));
  });
  return result;
}

/// The slots whose indices decide, ascending: those that others follow, instead of these.
std::vector<std::uint32_t> leading_slots(const Program& condition, std::span<const ConditionAxis> axes) {
  std::vector<std::uint32_t> slots;
  for (const std::uint32_t slot : condition.variables()) slots.push_back(axes[slot].follows.value_or(slot));
  std::sort(slots.begin(), slots.end());
  slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
  return slots;
}

bool has_followers(const Program& condition, std::span<const ConditionAxis> axes) {
  const std::vector<std::uint32_t> slots = condition.variables();
  return std::any_of(slots.begin(), slots.end(),
                     [&](std::uint32_t slot) { return axes[slot].follows.has_value(); });
}

/// By Kleene's logic, where a bit that is not set means `not proven`.
void join_atoms(const ConditionAtoms& atoms, const std::vector<std::span<const Word>>& rows,
                std::int64_t length, std::vector<std::vector<Word>>& values, std::span<Word> out) {
  for (std::size_t i = 0; i < atoms.nodes.size(); ++i) {
    const ConditionAtoms::Node& node = atoms.nodes[i];
    std::vector<Word>& value = values[i];
    if (node.join == Join::atom) {
      value.assign(rows[node.a].begin(), rows[node.a].end());
    } else if (node.join == Join::always || node.join == Join::never) {
      value.assign(out.size(), 0);
      if (node.join == Join::always) set_all(value, length);
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

/// Neighbouring rows often are alike: where a condition depends on a difference most of all.
bool are_equal(const std::vector<std::span<const Word>>& a, const std::vector<std::span<const Word>>& b) {
  return std::ranges::equal(a, b, [](std::span<const Word> x, std::span<const Word> y) {
    return x.data() == y.data() || std::ranges::equal(x, y);
  });
}

}  // namespace

/// Evaluates one bit of the table after the other; scratch of one thread.
class TruthTable::Filler {
 public:
  /// @param kept by slot: see kept_ranges()
  Filler(const Program& condition, std::span<const ConditionAxis> axes,
         const std::vector<std::vector<FastRanges>>& kept, const Undecided& undecided, Question question)
      : decider_(condition, question),
        axes_(axes),
        kept_(kept),
        undecided_(undecided),
        variables_(condition.variables()),
        indices_(axes.size(), 0),
        pieces_(axes.size(), 0),
        made_(axes.size()),
        ranges_(axes.size()),
        fast_(axes.size()),
        exact_(axes.size()) {
    if (!has_followers(condition, axes)) return;
    cell_truth_.emplace(condition, std::vector<ConditionAxis>(axes.begin(), axes.end()));
    for (const std::uint32_t slot : variables_) {
      if (axes[slot].follows) followers_.emplace_back(slot, *axes[slot].follows);
    }
  }

  void set(std::size_t slot, std::int64_t index) {
    indices_[slot] = index;
    if (cell_truth_) return;
    if (kept_[slot].empty()) {
      made_[slot] = enclosed(axes_[slot].ranges(index));
      ranges_[slot] = made_[slot];
    } else {
      ranges_[slot] = kept_[slot][static_cast<std::size_t>(index)];
    }
    set_piece(slot, 0);
  }

  [[nodiscard]] bool holds() {
    for (const auto& [follower, slot] : followers_) indices_[follower] = indices_[slot];
    const Truth truth = cell_truth_ ? cell_truth_->at(indices_) : on_all_pieces();
    return truth == Truth::undecided ? undecided_(indices_) : truth == Truth::yes;
  }

 private:
  void set_piece(std::size_t slot, std::size_t range) {
    pieces_[slot] = range;
    fast_[slot] = ranges_[slot][range];
  }

  Truth on_all_pieces() {
    Truth truth = on_these_pieces();
    while (next_pieces()) {
      // After a difference only the parts are left to go round.
      if (truth != Truth::undecided && on_these_pieces() != truth) truth = Truth::undecided;
    }
    return truth;
  }

  /// Goes on to the next combination; @returns false back at the first one
  bool next_pieces() {
    for (const std::uint32_t slot : variables_) {
      const std::size_t count = ranges_[slot].size();
      if (count == 1) continue;
      const bool more = pieces_[slot] + 1 < count;
      set_piece(slot, more ? pieces_[slot] + 1 : 0);
      if (more) return true;
    }
    return false;
  }

  Truth on_these_pieces() {
    return decider_.decide(std::span<const Interval>(fast_), [&] { return exact_box(); });
  }

  std::span<const RationalInterval> exact_box() {
    for (const std::uint32_t slot : variables_) {
      exact_[slot] = axes_[slot].ranges(indices_[slot])[pieces_[slot]];
    }
    return exact_;
  }

  ConditionDecider decider_;
  std::optional<CellTruth> cell_truth_;                             ///< if there are followers
  std::vector<std::pair<std::uint32_t, std::uint32_t>> followers_;  ///< and whom they follow
  std::span<const ConditionAxis> axes_;
  const std::vector<std::vector<FastRanges>>& kept_;
  const Undecided& undecided_;
  std::vector<std::uint32_t> variables_;
  std::vector<std::int64_t> indices_;
  std::vector<std::size_t> pieces_;
  std::vector<FastRanges> made_;                   ///< of indices whose ranges are not kept
  std::vector<std::span<const Interval>> ranges_;  ///< of the indices
  std::vector<Interval> fast_;
  std::vector<RationalInterval> exact_;
};

TruthTable::TruthTable(const Program& condition, std::span<const ConditionAxis> axes, std::uint32_t along,
                       const Undecided& undecided, ThreadTeam& team, Question question)
    : along_(along), row_length_(axes[along].count) {
  lay_out(condition, axes, along);
  // Comparisons that depend on few variables settle most cells; the others are looked at one by one.
  ZeroedArray<Word> refuted;
  ZeroedArray<Word> proven;
  if (!has_followers(condition, axes)) proven = proven_by_atoms(condition, axes, false, team);
  if (proven.size() > 0) {
    bits_ = std::move(proven);
    refuted = proven_by_atoms(condition, axes, true, team);
  } else {
    bits_ = ZeroedArray<Word>(static_cast<std::size_t>(rows_ * words_per_row()));
  }
  std::vector<std::vector<FastRanges>> kept(axes.size());
  if (along_in_use_) kept[along] = kept_ranges(axes[along], rows_, team);
  for (const std::size_t slot : across_) kept[slot] = kept_ranges(axes[slot], rows_ / counts_[slot], team);
  const auto words = static_cast<std::size_t>(words_per_row());
  const std::int64_t grain = std::max<std::int64_t>(1, 1024 / row_length_);
  team.for_each(rows_, grain, [&](ThreadTeam::Range range, int) {
    std::optional<Filler> filler;  // most ranges need none
    for (std::int64_t r = range.begin; r < range.end; ++r) {
      std::span<const Word> settled;
      if (refuted.size() > 0) settled = {refuted.data() + static_cast<std::size_t>(r) * words, words};
      if (is_settled(r, settled)) continue;
      if (!filler) filler.emplace(condition, axes, kept, undecided, question);
      fill_row(r, settled, *filler);
    }
  });
}

void TruthTable::lay_out(const Program& condition, std::span<const ConditionAxis> axes, std::uint32_t along) {
  strides_.assign(axes.size(), 0);
  for (const ConditionAxis& axis : axes) counts_.push_back(axis.count);
  const std::vector<std::uint32_t> used = leading_slots(condition, axes);
  for (std::size_t i = used.size(); i-- > 0;) {
    if (used[i] == along) {
      along_in_use_ = true;
      continue;
    }
    across_.insert(across_.begin(), used[i]);
    strides_[used[i]] = rows_;
    rows_ *= counts_[used[i]];
  }
}

/// Every bit of the row is known: set already, or refuted.
bool TruthTable::is_settled(std::int64_t position, std::span<const Word> refuted) const {
  const std::span<const Word> bits = row(position);
  bool all = !refuted.empty();
  for (std::size_t w = 0; all && w < bits.size(); ++w)
    all = (bits[w] | refuted[w]) == cells_of_word(w, row_length_);
  return all;
}

/// @param refuted the cells of the row that need no look as the condition is false there; empty if bits that
///   are set already do not count either
void TruthTable::fill_row(std::int64_t position, std::span<const Word> refuted, Filler& filler) {
  const std::span<Word> bits = row(position);
  const bool has_settled = !refuted.empty();
  const auto is_known = [&](std::int64_t k) { return has_settled && (test(bits, k) || test(refuted, k)); };
  for (const std::size_t slot : across_) filler.set(slot, index_of(position, slot));
  if (!along_in_use_) {
    if (filler.holds()) set_all(bits, row_length_);
    return;
  }
  for (std::int64_t k = 0; k < row_length_; ++k) {
    if (is_known(k)) continue;
    filler.set(along_, k);
    if (filler.holds()) set(bits, k);
  }
}

/// The bits where the atoms of the condition (or of its negation) prove it, laid out as this table; empty if
/// it has no atoms of its own.
ZeroedArray<Word> TruthTable::proven_by_atoms(const Program& condition, std::span<const ConditionAxis> axes,
                                              bool negated, ThreadTeam& team) const {
  const std::optional<ConditionAtoms> found = find_atoms(condition, negated);
  if (!found) return {};
  const Undecided is_not_proven = [](const std::vector<std::int64_t>&) { return false; };
  std::vector<TruthTable> tables;
  for (const Program& atom : found->atoms)
    tables.emplace_back(atom, axes, along_, is_not_proven, team, Question::everywhere);
  const auto words = static_cast<std::size_t>(words_per_row());
  ZeroedArray<Word> result(static_cast<std::size_t>(rows_) * words);
  team.for_each(rows_, 256, [&](ThreadTeam::Range range, int) {
    std::vector<std::vector<Word>> values(found->nodes.size());
    std::vector<std::span<const Word>> rows, before;
    std::vector<std::int64_t> index;  // by slot in use
    for (const std::size_t slot : across_) index.push_back(index_of(range.begin, slot));
    for (std::int64_t r = range.begin; r < range.end; ++r) {
      rows.swap(before);
      rows.clear();
      for (const TruthTable& table : tables) {
        std::int64_t position = 0;
        for (std::size_t i = 0; i < index.size(); ++i) position += index[i] * table.strides_[across_[i]];
        rows.push_back(table.row(position));
      }
      for (std::size_t i = index.size(); i-- > 0 && ++index[i] == counts_[across_[i]];) index[i] = 0;
      Word* const out = result.data() + static_cast<std::size_t>(r) * words;
      if (r > range.begin && are_equal(rows, before)) {
        std::copy_n(out - words, words, out);
      } else {
        join_atoms(*found, rows, row_length_, values, {out, words});
      }
    }
  });
  return result;
}

}  // namespace coordreq
