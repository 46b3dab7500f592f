#include "answers/layers/independent_actions.hpp"

#include <algorithm>

namespace coordreq {

template <class Level>
IndependentActions<Level>::IndependentActions(const Projections& projections, const RowHull& hull,
                                              const CellSet& invariant, int workers)
    : projections_(projections),
      grouping_(projections.grouping()),
      hull_(hull),
      boxes_(grouping_),
      invariant_(invariant),
      work_(static_cast<std::size_t>(workers)) {}

template <class Level>
bool IndependentActions<Level>::next_levels(const RowPlace& place, PostReader<Level>& posts, const Level* old,
                                            Level* next, int worker) {
  Workspace& work = work_[static_cast<std::size_t>(worker)];
  const auto n = static_cast<std::size_t>(grouping_.engine().row_length());
  hull_.box(place, work.box);
  if (work.box.covers && posts.kernels().is_settled(posts.minimum(work.box), old, n)) return false;
  find_minimum(place, posts, next, worker);
  return true;
}

template <class Level>
void IndependentActions<Level>::find_minimum(const RowPlace& place, PostReader<Level>& posts, Level* next,
                                             int worker) {
  Workspace& work = work_[static_cast<std::size_t>(worker)];
  std::fill_n(next, posts.lanes(), PostReader<Level>::kTop);
  switch (projections_.form(place.row)) {
    case Projections::Form::product:
      lower_by_boxes(place, posts, next, work);
      break;
    case Projections::Form::full:
      grouping_.group(place, work.groups);
      lower_by_all(place, posts, next, work);
      break;
    case Projections::Form::masks:
      grouping_.group(place, work.groups);
      lower_by_projections(place, posts, next, work);
  }
}

template <class Level>
void IndependentActions<Level>::lower_by_boxes(const RowPlace& place, PostReader<Level>& posts, Level* next,
                                               Workspace& work) const {
  const RowEngine& engine = grouping_.engine();
  IndependentPosts::unpack(projections_.packed(place.row), boxes_, grouping_.size(), engine.row_words(),
                           work.row);
  work.is_moved = projections_.find_shift(place.row, work.shift);
  work.box.resize(engine.grid());
  work.labels = nullptr;
  for (std::size_t p = 0; p < work.row.parts.size(); ++p) {
    if (!work.row.pages.empty() && p % IndependentPosts::kLabelsOfPage == 0)
      enter_page(work.row.pages[p / IndependentPosts::kLabelsOfPage], posts.lanes(), work);
    work.label = static_cast<Level>(p % IndependentPosts::kLabelsOfPage + 1);
    lower_by_class(work.row.parts[p], 0, posts, next, work);
  }
}

/// Labels as wide as levels.
template <class Level>
void IndependentActions<Level>::enter_page(const std::uint8_t* labels, std::size_t lanes,
                                           Workspace& work) const {
  if constexpr (sizeof(Level) == 1) {
    work.labels = labels;
  } else {
    const auto n = static_cast<std::size_t>(grouping_.engine().row_length());
    work.lanes.assign(lanes, 0);
    std::copy_n(labels, n, work.lanes.begin());
    work.labels = work.lanes.data();
  }
}

/// Chooses a box for class c and those after it, in all ways.
template <class Level>
void IndependentActions<Level>::lower_by_class(const IndependentPosts::Part& part, std::size_t c,
                                               PostReader<Level>& posts, Level* next, Workspace& work) const {
  if (c == grouping_.size()) return lower_by_box(part, posts, next, work);
  const IndependentPosts::Boxes& boxes = work.row.lists[part.boxes[c]];
  for (std::size_t i = 0; i < boxes.count; ++i) {
    boxes_.put(c, boxes[i], work.box);
    if (work.is_moved) boxes_.move(c, work.shift, work.box);
    lower_by_class(part, c + 1, posts, next, work);
  }
}

template <class Level>
void IndependentActions<Level>::lower_by_box(const IndependentPosts::Part& part, PostReader<Level>& posts,
                                             Level* next, Workspace& work) const {
  if (work.labels == nullptr) {
    const auto n = static_cast<std::size_t>(grouping_.engine().row_length());
    const Level* pair[] = {next, posts.minimum(work.box)};
    posts.kernels().minimum(pair, 2, next, n);
    return;
  }
  posts.kernels().lower_at(posts.minimum(work.box, part.begin, part.end), work.labels + part.begin,
                           work.label, next + part.begin, static_cast<std::size_t>(part.end - part.begin));
}

template <class Level>
void IndependentActions<Level>::lower_by_all(const RowPlace& place, PostReader<Level>& posts, Level* next,
                                             Workspace& work) const {
  const auto n = static_cast<std::size_t>(grouping_.engine().row_length());
  choose_groups(work.groups, GroupChoice::maximal, work.candidates);
  work.tuple.begin(grouping_, place, work.groups, work.candidates);
  do {
    const Level* pair[] = {next, posts.minimum(work.tuple.slice_ids())};
    posts.kernels().minimum(pair, 2, next, n);
  } while (work.tuple.next());
}

template <class Level>
void IndependentActions<Level>::lower_by_projections(const RowPlace& place, PostReader<Level>& posts,
                                                     Level* next, Workspace& work) const {
  const auto n = grouping_.engine().row_length();
  work.worst.resize(grouping_.size());
  work.candidates.clear();
  for (std::size_t c = 0; c < grouping_.size(); ++c) {
    find_worst(place.row, work.groups, c, work.worst[c]);
    if (work.worst[c].empty()) return;
    work.candidates.emplace_back(work.worst[c]);
  }
  work.lanes.resize(posts.lanes(), 0);
  work.tuple.begin(grouping_, place, work.groups, work.candidates);
  do {
    const ConstRow invariant = invariant_.row(place.row);
    work.reasonable.assign(invariant.begin(), invariant.end());
    for (std::size_t c = 0; c < grouping_.size(); ++c) {
      const ConstRow projection = projections_.mask(place.row, work.groups, c, work.tuple.chosen(c));
      for (std::size_t w = 0; w < projection.size(); ++w) work.reasonable[w] &= projection[w];
    }
    if (!any_set(work.reasonable)) continue;
    posts.kernels().spread(work.reasonable.data(), work.lanes.data(), static_cast<std::size_t>(n));
    posts.kernels().lower_where(posts.minimum(work.tuple.slice_ids()), work.lanes.data(), next,
                                static_cast<std::size_t>(n));
  } while (work.tuple.next());
}

/// The groups of class c that can make a difference: reasonable somewhere, and not with a post inside that
/// of another group that is reasonable wherever they are.
template <class Level>
void IndependentActions<Level>::find_worst(std::int64_t row, const RowGroups& groups, std::size_t c,
                                           std::vector<std::uint32_t>& result) const {
  const ActionGroups& own = *groups.classes[c];
  result.clear();
  for (std::uint32_t g = 0; g < own.size(); ++g) {
    const ConstRow projection = projections_.mask(row, groups, c, g);
    bool needed = any_set(projection);
    for (const std::uint32_t h : own.holders[g]) {
      if (!needed) break;
      const ConstRow other = projections_.mask(row, groups, c, h);
      if (!is_subset(projection, other)) continue;
      // Of two that cover each other the lower one stays.
      needed = own.is_within(h, g) && g < h && is_subset(other, projection);
    }
    if (needed) result.push_back(g);
  }
}

template class IndependentActions<std::uint8_t>;
template class IndependentActions<std::uint16_t>;
template class IndependentActions<std::uint32_t>;

}  // namespace coordreq
