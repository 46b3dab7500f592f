#include "answers/network/careful_actions.hpp"

#include <algorithm>

namespace coordreq {
namespace {

using Level = std::uint8_t;

/// Words that are remembered from one walk over all choices to the next.
constexpr std::size_t kMostKnown = std::size_t{1} << 16U;

void keep_only(MutableRow row, ConstRow other) {
  for (std::size_t w = 0; w < row.size(); ++w) row[w] &= other[w];
}

}  // namespace

CarefulActions::CarefulActions(const ActionGrouping& grouping, int workers)
    : grouping_(grouping), work_(static_cast<std::size_t>(workers)) {}

bool CarefulActions::next_levels(const RowPosition& position, PostReader<Level>& posts, const Level* old,
                                 Level* next, int worker) {
  Workspace& work = work_[static_cast<std::size_t>(worker)];
  const RowEngine& engine = grouping_.engine();
  const auto n = static_cast<std::size_t>(engine.row_length());
  work.wanted.resize(engine.row_words());
  posts.kernels().top_bits(old, work.wanted.data(), n);
  grouping_.group(position, work.groups);
  choose_groups(work.groups, GroupChoice::all, work.candidates);
  find_projections(position, posts, work);
  remove_bad_mixtures(position, posts, work);
  posts.kernels().spread(work.stays.data(), next, n);
  return true;
}

/// The cells of `wanted` at which the tuple is in C_q.
void CarefulActions::find_good(PostReader<Level>& posts, std::size_t length, Workspace& work) {
  work.good.resize(work.wanted.size());
  posts.kernels().top_bits(posts.minimum(work.tuple.slice_ids()), work.good.data(), length);
  keep_only(work.good, work.wanted);
  const ConstRow allowed = work.tuple.allowed();
  if (!allowed.empty()) keep_only(work.good, allowed);
}

void CarefulActions::find_projections(const RowPosition& position, PostReader<Level>& posts,
                                      Workspace& work) const {
  const std::size_t words = work.wanted.size();
  work.projection.resize(grouping_.size());
  for (std::size_t c = 0; c < grouping_.size(); ++c)
    work.projection[c].assign(work.groups.classes[c]->size() * words, 0);
  work.stays.assign(words, 0);
  work.known.clear();
  work.tuple.begin(grouping_, position, work.groups, work.candidates);
  do {
    find_good(posts, static_cast<std::size_t>(grouping_.engine().row_length()), work);
    if (work.known.size() < kMostKnown)
      work.known.insert(work.known.end(), work.good.begin(), work.good.end());
    for (std::size_t w = 0; w < words; ++w) work.stays[w] |= work.good[w];
    for (std::size_t c = 0; c < grouping_.size(); ++c) {
      Word* const projected = work.projection[c].data() + work.tuple.chosen(c) * words;
      for (std::size_t w = 0; w < words; ++w) projected[w] |= work.good[w];
    }
  } while (work.tuple.next());
}

void CarefulActions::remove_bad_mixtures(const RowPosition& position, PostReader<Level>& posts,
                                         Workspace& work) const {
  if (grouping_.size() == 1) return;
  const std::size_t words = work.wanted.size();
  work.tuple.begin(grouping_, position, work.groups, work.candidates);
  std::size_t choice = 0;
  do {
    const std::size_t begin = choice++ * words;
    work.mixed = work.stays;
    for (std::size_t c = 0; c < grouping_.size(); ++c)
      keep_only(work.mixed, {work.projection[c].data() + work.tuple.chosen(c) * words, words});
    if (!any_set(work.mixed)) continue;
    if (begin < work.known.size()) {
      std::copy_n(work.known.begin() + static_cast<std::ptrdiff_t>(begin), words, work.good.begin());
    } else {
      find_good(posts, static_cast<std::size_t>(grouping_.engine().row_length()), work);
    }
    for (std::size_t w = 0; w < words; ++w) work.stays[w] &= ~(work.mixed[w] & ~work.good[w]);
  } while (work.tuple.next());
}

}  // namespace coordreq
