#include "answers/invariance/check_safe.hpp"

#include <algorithm>

#include "answers/checking/cell_pieces.hpp"
#include "model/odometer.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

std::vector<RationalInterval> pieces_of_index(const ProblemSpec& spec, const GridDimension& dimension,
                                              std::int64_t k) {
  const Rational centre = dimension.point(k);
  if (spec.abstraction.safe == Membership::center) return {{.lower = centre, .upper = centre}};
  return pieces_of(dimension, k);
}

}  // namespace

SafeMemory::SafeMemory(const Program& condition, const UniformGrid& grid) : grid_(grid) {
  std::size_t size = 1;
  for (const std::uint32_t slot : condition.variables()) {
    states_.push_back(slot);
    size *= static_cast<std::size_t>(grid[slot].count);
  }
  verdicts_ = std::vector<std::atomic<SafeVerdict>>(size);
}

std::atomic<SafeVerdict>& SafeMemory::of(std::int64_t cell) {
  std::int64_t number = 0;
  for (const std::size_t i : states_) number = number * grid_[i].count + grid_.index(cell, i);
  return verdicts_[static_cast<std::size_t>(number)];
}

SafeJudge::SafeJudge(const ProblemSpec& spec, const Program& condition, const UniformGrid& grid,
                     SafeMemory& memory)
    : grid_(grid),
      memory_(memory),
      slots_(spec.slot_count()),
      rough_(condition),
      exact_(condition),
      corner_truth_(condition, memory.states()) {
  for (const std::size_t i : memory.states()) {
    auto& indices = pieces_.emplace_back();
    for (std::int64_t k = 0; k < grid[i].count; ++k) indices.push_back(pieces_of_index(spec, grid[i], k));
  }
}

SafeVerdict SafeJudge::judge(std::int64_t cell, bool claimed) {
  std::atomic<SafeVerdict>& remembered = memory_.of(cell);
  SafeVerdict verdict = remembered;
  if (verdict == SafeVerdict::unknown)
    verdict = proven_naturally(cell) ? SafeVerdict::safe : SafeVerdict::unknown;
  if (verdict == SafeVerdict::unknown && claimed) verdict = look_closer(cell);
  remembered = verdict;
  return verdict == SafeVerdict::unknown ? SafeVerdict::open : verdict;
}

/// Calls `visit` with the boxes of a cell until it returns false.
template <class Visit>
void SafeJudge::for_each_piece(std::int64_t cell, const Visit& visit) const {
  const std::vector<std::size_t>& states = memory_.states();
  std::vector<const std::vector<RationalInterval>*> pieces;
  std::vector<std::int64_t> counts;
  for (std::size_t s = 0; s < states.size(); ++s) {
    pieces.push_back(&pieces_[s][static_cast<std::size_t>(grid_.index(cell, states[s]))]);
    counts.push_back(static_cast<std::int64_t>(pieces.back()->size()));
  }
  Box box(slots_);
  Odometer piece(counts);
  do {
    for (std::size_t s = 0; s < states.size(); ++s)
      box[states[s]] = (*pieces[s])[static_cast<std::size_t>(piece[s])];
    if (!visit(box)) return;
  } while (piece.advance());
}

bool SafeJudge::proven_naturally(std::int64_t cell) {
  bool proven = true;
  for_each_piece(cell, [&](const Box& box) { return proven = natural(box) == Truth::yes; });
  return proven;
}

Truth SafeJudge::natural(const Box& box) {
  std::vector<Interval> rough;
  for (const RationalInterval& range : box) rough.push_back(enclose(range));
  const Truth truth = rough_.condition(rough);
  return truth == Truth::undecided ? exact_.condition(box) : truth;
}

SafeVerdict SafeJudge::look_closer(std::int64_t cell) {
  SafeVerdict worst = SafeVerdict::proven;
  for_each_piece(cell, [&](const Box& box) {
    const Truth truth = corner_truth_.everywhere(box);
    if (truth == Truth::no) worst = SafeVerdict::unsafe;
    if (truth == Truth::undecided) worst = SafeVerdict::open;
    return truth != Truth::no;
  });
  return worst;
}

}  // namespace coordreq
