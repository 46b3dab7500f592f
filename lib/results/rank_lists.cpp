#include "results/rank_lists.hpp"

#include <algorithm>
#include <cstring>

namespace coordreq {
namespace {

/// Cells of which lists are told at a time, by each process to each.
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
    std::vector<GatheredStretch> stretches;
    for (int r = 0; r < ranks.count(); ++r) {
      const std::int64_t begin = first_cell(r) + done;
      const std::int64_t count = std::min(kCellsAtATime, first_cell(r + 1) - begin);
      if (count > 0)
        stretches.push_back({r, static_cast<std::uint64_t>(begin), static_cast<std::uint64_t>(count)});
    }
    gather_stretches(ranks, team, owners, numbers, stretches);
    for (const GatheredStretch& stretch : stretches) {
      const std::size_t before = result.size();
      result.resize(before + stretch.count);
      std::memcpy(result.data() + before, stretch.bytes.data(), stretch.bytes.size());
    }
  }
  return result;
}

void RankLists::count(const std::vector<std::uint32_t>& list_of, std::size_t lists) {
  Ranks& ranks = share_.ranks();
  const auto all = static_cast<std::size_t>(ranks.count()), own = static_cast<std::size_t>(ranks.rank());
  std::vector<std::int64_t> sizes(lists * all, 0);
  for (const std::uint32_t list : list_of) {
    if (list != CellLists::kNone) ++sizes[list * all + own];
  }
  ranks.add(sizes);
  owners_.emplace(sizes, ranks.count());
  own_start_ = {0};
  std::uint64_t before = 0;
  for (std::size_t piece = 0; piece < sizes.size(); ++piece) {
    const auto size = static_cast<std::uint64_t>(sizes[piece]);
    if (piece % all == own) {
      start_.push_back(before);
      own_start_.push_back(own_start_.back() + size);
    }
    before += size;
  }
}

template <class Index>
void RankLists::sort(const std::vector<std::uint32_t>& list_of) {
  sorted_.resize(own_start_.back() * sizeof(Index));
  std::vector<std::uint64_t> next = own_start_;
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
    const std::uint64_t end = std::min(start_[list] + own_start_[list + 1] - own_start_[list], begin + count);
    if (first >= end) continue;
    const std::byte* const from = sorted_.data() + (own_start_[list] + first - start_[list]) * size;
    std::copy_n(from, (end - first) * size, out + (first - begin) * size);
  }
}

ResultArray RankLists::array() const {
  return {type_, [this](std::uint64_t begin, std::uint64_t count, void* out) {
            fill(begin, count, static_cast<std::byte*>(out));
          }};
}

}  // namespace coordreq
