#include "results/rank_lists.hpp"

#include <algorithm>
#include <cstring>

namespace coordreq {
namespace {

/// Cells of which lists are exchanged at a time, by each process with each.
constexpr std::int64_t kCellsAtATime = std::int64_t{1} << 16U;

}  // namespace

RankLists::RankLists(ThreadTeam& team, const RowShare& share, const CellOrder& order,
                     const ResultArray& array)
    : share_(share), type_(array.type), cells_(order.cells()) {
  const std::vector<std::uint32_t> list_of = gather(team, order, *array.lists);
  count(list_of, array.lists->count);
  if (element_size(type_) == sizeof(std::uint32_t)) {
    sort<std::uint32_t>(list_of);
  } else {
    sort<std::uint64_t>(list_of);
  }
}

std::int64_t RankLists::first_cell(int rank) const {
  const std::int64_t ranks = share_.ranks().count();
  return cells_ / ranks * rank + cells_ % ranks * rank / ranks;
}

std::vector<std::uint32_t> RankLists::gather(ThreadTeam& team, const CellOrder& order,
                                             const CellLists& lists) const {
  Ranks& ranks = share_.ranks();
  const ResultArray numbers{.type = ElementType::uint32, .fill = lists.of_cell, .of_cell = 1};
  const CellOwners owners(share_, order, 1);
  std::int64_t longest = 0;
  for (int r = 0; r < ranks.count(); ++r) longest = std::max(longest, first_cell(r + 1) - first_cell(r));
  std::vector<std::uint32_t> result;
  for (std::int64_t done = 0; done < longest; done += kCellsAtATime) {
    std::vector<GatheredSegment> segments;
    for (int r = 0; r < ranks.count(); ++r) {
      const std::int64_t begin = first_cell(r) + done;
      const std::int64_t count = std::min(kCellsAtATime, first_cell(r + 1) - begin);
      if (count > 0)
        segments.push_back({r, static_cast<std::uint64_t>(begin), static_cast<std::uint64_t>(count)});
    }
    gather_segments(ranks, team, owners, numbers, segments);
    for (const GatheredSegment& segment : segments) {
      const std::size_t before = result.size();
      result.resize(before + segment.count);
      std::memcpy(result.data() + before, segment.bytes.data(), segment.bytes.size());
    }
  }
  return result;
}

void RankLists::count(const std::vector<std::uint32_t>& list_of, std::size_t lists) {
  Ranks& ranks = share_.ranks();
  const auto all = static_cast<std::size_t>(ranks.count()), self = static_cast<std::size_t>(ranks.rank());
  std::vector<std::int64_t> sizes(lists * all, 0);
  for (const std::uint32_t list : list_of) {
    if (list != CellLists::kNone) ++sizes[list * all + self];
  }
  ranks.add(sizes);
  owners_.emplace(sizes, ranks.count());
  local_start_ = {0};
  std::uint64_t before = 0;
  for (std::size_t run = 0; run < sizes.size(); ++run) {
    const auto size = static_cast<std::uint64_t>(sizes[run]);
    if (run % all == self) {
      start_.push_back(before);
      local_start_.push_back(local_start_.back() + size);
    }
    before += size;
  }
}

template <class Index>
void RankLists::sort(const std::vector<std::uint32_t>& list_of) {
  sorted_.resize(local_start_.back() * sizeof(Index));
  std::vector<std::uint64_t> next = local_start_;
  auto cell = static_cast<Index>(first_cell(share_.ranks().rank()));
  for (const std::uint32_t list : list_of) {
    if (list != CellLists::kNone)
      std::memcpy(sorted_.data() + next[list]++ * sizeof(Index), &cell, sizeof(Index));
    ++cell;
  }
}

void RankLists::fill(std::uint64_t begin, std::uint64_t count, std::byte* out) const {
  const std::size_t size = element_size(type_);
  std::fill_n(out, count * size, std::byte{0});
  const auto after = std::upper_bound(start_.begin(), start_.end(), begin) - start_.begin();
  for (auto list = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - 1, 0));
       list < start_.size() && start_[list] < begin + count; ++list) {
    const std::uint64_t first = std::max(start_[list], begin);
    const std::uint64_t end =
        std::min(start_[list] + local_start_[list + 1] - local_start_[list], begin + count);
    if (first >= end) continue;
    const std::byte* const from = sorted_.data() + (local_start_[list] + first - start_[list]) * size;
    std::copy_n(from, (end - first) * size, out + (first - begin) * size);
  }
}

ResultArray RankLists::array() const {
  return {type_, [this](std::uint64_t begin, std::uint64_t count, void* out) {
            fill(begin, count, static_cast<std::byte*>(out));
          }};
}

}  // namespace coordreq
