#include "coordination/projections.hpp"

#include <algorithm>

namespace coordreq {
namespace {

std::size_t group_offset(const RowGroups& groups, std::size_t c) {
  std::size_t offset = 0;
  for (std::size_t i = 0; i < c; ++i) offset += groups.classes[i]->size();
  return offset;
}

}  // namespace

void controller_row(const Controller& controller, std::int64_t row, ActionGrouping::Tuples& tuple,
                    MutableRow out, RowEngine::Scratch& scratch) {
  const ConstRow invariant = controller.invariant->set().row(row);
  const ConstRow allowed = tuple.allowed();
  if (controller.synthesis == Synthesis::maximal) {
    controller.engine->inside(tuple.slice_ids(), *controller.invariant, out, scratch);
    for (std::size_t w = 0; w < out.size(); ++w) out[w] &= invariant[w];
  } else {
    std::copy(invariant.begin(), invariant.end(), out.begin());
  }
  for (std::size_t w = 0; w < allowed.size(); ++w) out[w] &= allowed[w];
}

Projections::Projections(const Controller& controller, const ActionGrouping& grouping, ThreadTeam& team)
    : grouping_(&grouping),
      words_(controller.engine->row_words()),
      rows_(static_cast<std::size_t>(controller.engine->rows())) {
  struct Workspace {
    RowGroups groups;
    RowEngine::Scratch scratch;
  };
  std::vector<Workspace> work(static_cast<std::size_t>(team.size()));
  team.for_each(controller.engine->rows(), 4, [&](ThreadTeam::Range range, int worker) {
    Workspace& own = work[static_cast<std::size_t>(worker)];
    for (std::int64_t r = range.begin; r < range.end; ++r) {
      if (any_set(controller.invariant->set().row(r))) project(controller, r, own.groups, own.scratch);
    }
  });
}

void Projections::project(const Controller& controller, std::int64_t row, RowGroups& groups,
                          RowEngine::Scratch& scratch) {
  grouping_->group(row, groups);
  std::vector<Word>& bits = rows_[static_cast<std::size_t>(row)];
  bits.assign(group_offset(groups, groups.classes.size()) * words_, 0);
  std::vector<Word> members(words_);
  const auto all = ActionGrouping::all_groups(groups);
  const auto minimal = ActionGrouping::minimal_groups(groups);
  for (std::size_t c = 0; c < groups.classes.size(); ++c) {
    // An action of class c is in the projection if some action of the others goes with it; their minimal ones
    // do.
    auto candidates = minimal;
    candidates[c] = all[c];
    ActionGrouping::Tuples tuple(*grouping_, row, groups, std::move(candidates));
    do {
      controller_row(controller, row, tuple, members, scratch);
      Word* target = bits.data() + (group_offset(groups, c) + tuple.chosen(c)) * words_;
      for (std::size_t w = 0; w < words_; ++w) target[w] |= members[w];
    } while (tuple.next());
  }
}

ConstRow Projections::row(std::int64_t row, const RowGroups& groups, std::size_t c, std::uint32_t g) const {
  return {rows_[static_cast<std::size_t>(row)].data() + (group_offset(groups, c) + g) * words_, words_};
}

}  // namespace coordreq
