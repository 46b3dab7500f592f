#include "engine/tuple_walk.hpp"

namespace coordreq {

void TupleWalk::begin(const ActionGrouping& grouping, const RowPlace& place, const RowGroups& groups,
                      const Candidates& candidates) {
  grouping_ = &grouping;
  candidates_ = candidates;
  sources_ = grouping.sources().size();
  offset_.resize(grouping.size());
  sum_.resize((grouping.size() + 1) * sources_);
  position_.assign(grouping.size(), 0);
  ids_.resize(grouping.engine().slices().size());
  for (std::size_t t = 0; t < sources_; ++t) sum_[t] = grouping.sources()[t].base(place);
  for (std::size_t c = 0; c < grouping.size(); ++c) {
    offset_[c].clear();
    for (const std::uint32_t g : candidates_[c]) {
      const std::uint32_t action = groups.classes[c]->representative[g];
      for (std::size_t t = 0; t < sources_; ++t) offset_[c].push_back(grouping.contribution(c, t, action));
    }
  }
  add_up(0);
}

void TupleWalk::add_up(std::size_t from_class) {
  for (std::size_t c = from_class; c < position_.size(); ++c) {
    const std::int64_t* offset = offset_[c].data() + position_[c] * sources_;
    for (std::size_t t = 0; t < sources_; ++t)
      sum_[(c + 1) * sources_ + t] = sum_[c * sources_ + t] + offset[t];
  }
}

std::span<const std::uint32_t> TupleWalk::slice_ids() {
  const std::int64_t* sum = sum_.data() + position_.size() * sources_;
  for (std::size_t t = 0; t < ids_.size(); ++t) {
    ids_[t] = grouping_->sources()[t].id(sum[t]);
  }
  return ids_;
}

ConstRow TupleWalk::allowed() const {
  const PairTable* allow = grouping_->engine().allow();
  if (allow == nullptr) return {};
  return allow->row(sum_[position_.size() * sources_ + ids_.size()]);
}

bool TupleWalk::next() {
  for (std::size_t c = position_.size(); c-- > 0;) {
    if (++position_[c] < candidates_[c].size()) {
      add_up(c);
      return true;
    }
    position_[c] = 0;
  }
  return false;
}

void choose_groups(const RowGroups& groups, GroupChoice choice, TupleWalk::Candidates& candidates) {
  candidates.clear();
  for (const ActionGroups* own : groups.classes) {
    candidates.emplace_back(choice == GroupChoice::minimal   ? own->minimal
                            : choice == GroupChoice::maximal ? own->maximal
                                                             : own->all);
  }
}

}  // namespace coordreq
