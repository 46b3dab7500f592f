#include "choices/independent_actions.hpp"

#include <algorithm>

#include "engine/tuple_walk.hpp"

namespace coordreq {
namespace {

/// For fewer choices a common bound saves too little.
constexpr std::size_t kFewChoices = 4;

/// The class whose choices are tried one after the other: where rows are added up a class that moves the
/// cells of a row alike, so that its choices have common bounds.
std::size_t choose_fastest(const ActionGrouping& grouping) {
  const auto is_steady = [&](const InputClass& inputs) {
    return std::ranges::none_of(grouping.engine().posts().slices, [&](const RowSlices& slices) {
      return slices.sums && std::ranges::any_of(inputs.inputs(), [&](std::int32_t input) {
               return slices.sums->tells_profiles_apart(input);
             });
    });
  };
  std::size_t fastest = grouping.size() - 1;
  while (fastest > 0 && !is_steady(grouping[fastest])) --fastest;
  return is_steady(grouping[fastest]) ? fastest : grouping.size() - 1;
}

}  // namespace

template <class Level>
IndependentActions<Level>::IndependentActions(const Projections& projections, const CellSet& invariant,
                                              int workers, LostLevels lost_levels)
    : projections_(projections),
      grouping_(projections.grouping()),
      boxes_(grouping_),
      invariant_(invariant),
      lost_levels_(lost_levels),
      fastest_(choose_fastest(grouping_)),
      work_(static_cast<std::size_t>(workers)) {}

template <class Level>
bool IndependentActions<Level>::next_levels(const RowPosition& position, PostReader<Level>& posts,
                                            const Level* old, Level* next, int worker) {
  Workspace& work = work_[static_cast<std::size_t>(worker)];
  constexpr Level kTop = PostReader<Level>::kTop;
  if (lost_levels_ == LostLevels::flag) {
    if (!is_open(old, posts.lanes())) return false;
    const auto lost_or_not = [](Level level) { return level == kTop ? kTop : Level{0}; };
    std::transform(old, old + posts.lanes(), next, lost_or_not);
    lower(position, posts, next, work);
    std::transform(next, next + posts.lanes(), next, lost_or_not);
    return true;
  }
  // No level rises: posts that cannot lower a cell are not read.
  std::transform(old, old + posts.lanes(), next, [](Level level) {
    return level == 0 || level == kTop ? level : static_cast<Level>(level - 1);
  });
  lower(position, posts, next, work);
  return true;
}

template <class Level>
void IndependentActions<Level>::find_minimum(const RowPosition& position, PostReader<Level>& posts,
                                             Level* next, int worker) {
  std::fill_n(next, posts.lanes(), PostReader<Level>::kTop);
  lower(position, posts, next, work_[static_cast<std::size_t>(worker)]);
}

template <class Level>
void IndependentActions<Level>::lower(const RowPosition& position, PostReader<Level>& posts, Level* next,
                                      Workspace& work) const {
  switch (projections_.form(position.row)) {
    case Projections::Form::product:
      lower_by_boxes(position, posts, next, work);
      break;
    case Projections::Form::full:
      grouping_.group(position, work.groups);
      lower_by_all(position, posts, next, work);
      break;
    case Projections::Form::masks:
      grouping_.group(position, work.groups);
      lower_by_projections(position, posts, next, work);
  }
  for_each_bit(projections_.forbidden(position.row), [next](std::int64_t x) { next[x] = 0; });
}

template <class Level>
void IndependentActions<Level>::lower_by_boxes(const RowPosition& position, PostReader<Level>& posts,
                                               Level* next, Workspace& work) const {
  const RowEngine& engine = grouping_.engine();
  IndependentPosts::unpack(projections_.packed(position.row), boxes_, grouping_.size(), work.row);
  work.is_moved = projections_.find_shift(position.row, work.shift);
  work.box.resize(engine.grid());
  work.labels.resize(posts.lanes());
  for (std::size_t p = 0; p < work.row.subsets.size(); ++p) {
    if (!work.row.pages.empty() && p % IndependentPosts::kLabelsOfPage == 0)
      IndependentPosts::put_labels(work.row.pages[p / IndependentPosts::kLabelsOfPage], work.labels);
    work.label = static_cast<Level>(p % IndependentPosts::kLabelsOfPage + 1);
    const IndependentPosts::Subset& subset = work.row.subsets[p];
    if (!work.row.pages.empty() &&
        !is_open(next + subset.begin, static_cast<std::size_t>(subset.end - subset.begin)))
      continue;
    lower_by_class(subset, 0, posts, next, work);
  }
}

/// Goes through all choices of a box for class c and the classes after it.
template <class Level>
void IndependentActions<Level>::lower_by_class(const IndependentPosts::Subset& subset, std::size_t c,
                                               PostReader<Level>& posts, Level* next, Workspace& work) const {
  if (c == grouping_.size()) return lower_by_box(subset, posts, next, work);
  const IndependentPosts::Boxes& boxes = work.row.lists[subset.boxes[c]];
  for (std::size_t i = 0; i < boxes.count; ++i) {
    boxes_.put(c, boxes[i], work.box);
    if (work.is_moved) boxes_.move(c, work.shift, work.box);
    lower_by_class(subset, c + 1, posts, next, work);
  }
}

template <class Level>
void IndependentActions<Level>::lower_by_box(const IndependentPosts::Subset& subset, PostReader<Level>& posts,
                                             Level* next, Workspace& work) const {
  if (work.row.pages.empty()) {
    const auto n = static_cast<std::size_t>(grouping_.engine().row_length());
    if (!is_open(next, n)) return;
    const Level* pair[] = {next, posts.minimum(work.box)};
    posts.kernels().minimum(pair, 2, next, n);
    return;
  }
  if (!is_open(next + subset.begin, static_cast<std::size_t>(subset.end - subset.begin))) return;
  posts.kernels().lower_at(posts.minimum(work.box, subset.begin, subset.end),
                           work.labels.data() + subset.begin, work.label, next + subset.begin,
                           static_cast<std::size_t>(subset.end - subset.begin));
}

template <class Level>
void IndependentActions<Level>::lower_by_all(const RowPosition& position, PostReader<Level>& posts,
                                             Level* next, Workspace& work) const {
  choose_groups(work.groups, GroupChoice::maximal, work.candidates);
  work.lanes_of_others.assign(posts.lanes(), PostReader<Level>::kTop);
  lower_by_tuples(position, {.number = position.row, .is_full = true, .posts = posts, .next = next}, work);
}

template <class Level>
void IndependentActions<Level>::lower_by_projections(const RowPosition& position, PostReader<Level>& posts,
                                                     Level* next, Workspace& work) const {
  work.worst.resize(grouping_.size());
  work.candidates.clear();
  for (std::size_t c = 0; c < grouping_.size(); ++c) {
    find_worst(position.row, work.groups, c, work.worst[c]);
    if (work.worst[c].empty()) return;
    work.candidates.emplace_back(work.worst[c]);
  }
  work.lanes.resize(posts.lanes(), 0);
  work.lanes_of_others.resize(posts.lanes(), 0);
  lower_by_tuples(position, {.number = position.row, .is_full = false, .posts = posts, .next = next}, work);
}

template <class Level>
void IndependentActions<Level>::lower_by_tuples(const RowPosition& position, const Row& row,
                                                Workspace& work) const {
  work.tuple.begin(grouping_, position, work.groups, work.candidates, fastest_);
  do {
    if (!is_open(row.next, row.posts.lanes())) return;
    if (!row.is_full && !is_some_reasonable(row, work)) continue;
    row.posts.take(work.tuple.all_slice_ids());
    lower_by_several(row, 0, work.candidates[fastest_].size(), grouping_.engine().all_lanes(), work);
  } while (work.tuple.next_of_others());
}

/// Finds the cells where the choice of the other classes is reasonable.
template <class Level>
bool IndependentActions<Level>::is_some_reasonable(const Row& row, Workspace& work) const {
  const ConstRow invariant = invariant_.row(row.number);
  work.reasonable_for_others.assign(invariant.begin(), invariant.end());
  for (std::size_t c = 0; c < grouping_.size(); ++c) {
    if (c == fastest_) continue;
    const ConstRow projection = projections_.mask(row.number, work.groups, c, work.tuple.chosen(c));
    for (std::size_t w = 0; w < projection.size(); ++w) work.reasonable_for_others[w] &= projection[w];
  }
  if (!any_set(work.reasonable_for_others)) return false;
  row.posts.kernels().spread(work.reasonable_for_others.data(), work.lanes_of_others.data(),
                             static_cast<std::size_t>(grouping_.engine().row_length()));
  return true;
}

/// Lowers some lanes by the candidates [begin, end) of the fastest class: if their bound does not show that
/// they lower nothing, by each half of them.
template <class Level>
void IndependentActions<Level>::lower_by_several(const Row& row, std::size_t begin, std::size_t end,
                                                 LaneRange lanes, Workspace& work) const {
  if (end - begin < kFewChoices) {
    for (std::size_t k = begin; k < end; ++k) lower_by_one(row, k, lanes, work);
    return;
  }
  if (const Level* const bound = row.posts.bound(begin, end, lanes)) {
    const LaneRange open = row.posts.kernels().below(bound, work.lanes_of_others.data() + lanes.begin,
                                                     row.next + lanes.begin, lanes.size());
    if (open.size() == 0) return;
    lanes = {open.begin + lanes.begin, open.end + lanes.begin};
  }
  const std::size_t middle = begin + (end - begin) / 2;
  lower_by_several(row, begin, middle, lanes, work);
  lower_by_several(row, middle, end, lanes, work);
}

template <class Level>
void IndependentActions<Level>::lower_by_one(const Row& row, std::size_t position, LaneRange lanes,
                                             Workspace& work) const {
  const LevelKernels<Level>& kernels = row.posts.kernels();
  Level* const next = row.next + lanes.begin;
  if (row.is_full) {
    const Level* pair[] = {next, row.posts.minimum_of(position, lanes, PostReader<Level>::kTop)};
    kernels.minimum(pair, 2, next, lanes.size());
    return;
  }
  const std::uint32_t group = work.candidates[fastest_][position];
  const ConstRow projection = projections_.mask(row.number, work.groups, fastest_, group);
  work.reasonable.assign(projection.begin(), projection.end());
  for (std::size_t w = 0; w < projection.size(); ++w) work.reasonable[w] &= work.reasonable_for_others[w];
  if (!any_set(work.reasonable)) return;
  kernels.spread(work.reasonable.data(), work.lanes.data(),
                 static_cast<std::size_t>(grouping_.engine().row_length()));
  kernels.lower_where(row.posts.minimum_of(position, lanes, PostReader<Level>::kTop),
                      work.lanes.data() + lanes.begin, next, lanes.size());
}

/// Finds the groups of class c that can make a difference: reasonable in some cell, and without another group
/// whose post holds theirs and that is reasonable in all of their cells.
template <class Level>
void IndependentActions<Level>::find_worst(std::int64_t row, const RowGroups& groups, std::size_t c,
                                           std::vector<std::uint32_t>& result) const {
  const ActionGroups& class_groups = *groups.classes[c];
  result.clear();
  for (std::uint32_t g = 0; g < class_groups.size(); ++g) {
    const ConstRow projection = projections_.mask(row, groups, c, g);
    bool needed = any_set(projection);
    for (const std::uint32_t h : class_groups.holders[g]) {
      if (!needed) break;
      const ConstRow other = projections_.mask(row, groups, c, h);
      if (!is_subset(projection, other)) continue;
      // The lower one of two groups that cover each other stays.
      needed = class_groups.is_within(h, g) && g < h && is_subset(other, projection);
    }
    if (needed) result.push_back(g);
  }
}

template class IndependentActions<std::uint8_t>;
template class IndependentActions<std::uint16_t>;
template class IndependentActions<std::uint32_t>;
template class IndependentActions<std::uint64_t>;

}  // namespace coordreq
