#include "engine/tuple_walk.hpp"

#include "base/requires.hpp"

namespace coordreq {

void TupleWalk::begin(const ActionGrouping& grouping, const RowPosition& position, const RowGroups& groups,
                      const Candidates& candidates, std::size_t fastest) {
  REQUIRES(std::ranges::none_of(candidates, [](const auto& of_class) { return of_class.empty(); }));
  grouping_ = &grouping;
  candidates_ = candidates;
  sources_ = grouping.sources().size();
  offset_.resize(grouping.size());
  sum_.resize((grouping.size() + 1) * sources_);
  position_.assign(grouping.size(), 0);
  ids_.resize(grouping.engine().slices().size());
  order_.clear();
  for (std::size_t t = 0; t < sources_; ++t) sum_[t] = grouping.sources()[t].base(position);
  for (std::size_t c = 0; c < grouping.size(); ++c) {
    if (c != fastest) order_.push_back(c);
    offset_[c].clear();
    for (const std::uint32_t g : candidates_[c]) {
      const std::uint32_t action = groups.classes[c]->representative[g];
      for (std::size_t t = 0; t < sources_; ++t) offset_[c].push_back(grouping.contribution(c, t, action));
    }
  }
  order_.push_back(fastest);
  add_up(0);
}

/// Adds up sum_ from a position in order_ on.
void TupleWalk::add_up(std::size_t from) {
  for (std::size_t k = from; k < order_.size(); ++k) {
    const std::int64_t* offset = offset_[order_[k]].data() + position_[order_[k]] * sources_;
    for (std::size_t t = 0; t < sources_; ++t)
      sum_[(k + 1) * sources_ + t] = sum_[k * sources_ + t] + offset[t];
  }
}

void TupleWalk::find_ids(std::uint32_t* ids) const {
  const std::int64_t* sum = sum_.data() + order_.size() * sources_;
  for (std::size_t t = 0; t < ids_.size(); ++t) ids[t] = grouping_->sources()[t].id(sum[t]);
}

std::span<const std::uint32_t> TupleWalk::slice_ids() {
  find_ids(ids_.data());
  return ids_;
}

std::span<const std::uint32_t> TupleWalk::all_slice_ids() {
  const std::size_t tables = ids_.size(), count = candidates_[order_.back()].size();
  all_ids_.resize(count * tables);
  const std::int64_t* const others = sum_.data() + (order_.size() - 1) * sources_;
  const std::int64_t* const offset = offset_[order_.back()].data();
  for (std::size_t t = 0; t < tables; ++t) {
    const ActionSource& source = grouping_->sources()[t];
    for (std::size_t k = 0; k < count; ++k)
      all_ids_[k * tables + t] = source.id(others[t] + offset[k * sources_ + t]);
  }
  return all_ids_;
}

ConstRow TupleWalk::allowed() const {
  const PairTable* allow = grouping_->engine().allow();
  if (allow == nullptr) return {};
  return allow->row(sum_[order_.size() * sources_ + ids_.size()]);
}

void TupleWalk::choose_fastest(std::size_t position) {
  position_[order_.back()] = position;
  add_up(order_.size() - 1);
}

bool TupleWalk::next() {
  if (position_[order_.back()] + 1 == candidates_[order_.back()].size()) return next_of_others();
  choose_fastest(position_[order_.back()] + 1);
  return true;
}

bool TupleWalk::next_of_others() {
  position_[order_.back()] = 0;
  for (std::size_t k = order_.size() - 1; k-- > 0;) {
    const std::size_t c = order_[k];
    if (++position_[c] < candidates_[c].size()) {
      add_up(k);
      return true;
    }
    position_[c] = 0;
  }
  return false;
}

void choose_groups(const RowGroups& groups, GroupChoice choice, TupleWalk::Candidates& candidates) {
  candidates.clear();
  for (const ActionGroups* of_class : groups.classes) {
    candidates.emplace_back(choice == GroupChoice::minimal   ? of_class->minimal
                            : choice == GroupChoice::maximal ? of_class->maximal
                                                             : of_class->all);
  }
}

}  // namespace coordreq
