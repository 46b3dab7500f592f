#include "results/rank_lists.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "base/requires.hpp"

namespace coordreq {
namespace {

/// Gaps between local elements that are filled too rather than skipped.
constexpr std::uint64_t kGap = 4096;

/// Elements of a segment, all of one owner.
struct OwnedRun {
  int owner = 0;
  std::uint64_t begin = 0;
  std::uint64_t count = 0;
};

struct Work {
  GatheredSegment* segment;
  std::vector<OwnedRun> runs = {};
};

std::vector<OwnedRun> owned_runs(const ElementOwners& owners, const GatheredSegment& segment) {
  std::vector<OwnedRun> runs;
  owners.for_each_run(segment.begin, segment.count, [&](int owner, std::uint64_t first, std::uint64_t count) {
    if (runs.empty() || runs.back().owner != owner) runs.push_back({owner, first, 0});
    runs.back().count = first + count - runs.back().begin;
  });
  return runs;
}

/// Fills in the values of a segment that this rank has: at their positions if it takes the segment, else one
/// run after the other.
void fill_local(Work& work, int self, const ResultArray& array) {
  GatheredSegment& all = *work.segment;
  const std::size_t size = element_size(array.type);
  const bool is_taker = all.taker == self;
  if (is_taker) all.bytes.resize(all.count * size);
  std::vector<std::byte> filled;
  for (std::size_t i = 0; i < work.runs.size();) {
    if (work.runs[i].owner != self) {
      ++i;
      continue;
    }
    std::size_t next = i + 1;
    std::size_t last = i;  // that is local, with no large gap before it
    for (; next < work.runs.size(); ++next) {
      if (work.runs[next].owner != self) continue;
      if (work.runs[next].begin - work.runs[last].begin - work.runs[last].count > kGap) break;
      last = next;
    }
    const std::uint64_t begin = work.runs[i].begin;
    const std::uint64_t count = work.runs[last].begin + work.runs[last].count - begin;
    filled.resize(count * size);
    array.fill(begin, count, filled.data());
    for (; i <= last; ++i) {
      const OwnedRun& run = work.runs[i];
      if (run.owner != self) continue;
      const std::byte* const from = filled.data() + (run.begin - begin) * size;
      if (is_taker) {
        std::copy_n(from, run.count * size,
                    all.bytes.begin() + static_cast<std::ptrdiff_t>((run.begin - all.begin) * size));
      } else {
        all.bytes.insert(all.bytes.end(), from, from + run.count * size);
      }
    }
  }
}

[[maybe_unused]] bool follow_by_taker(const std::vector<Work>& works) {
  std::set<int> takers;
  for (std::size_t i = 0; i < works.size(); ++i) {
    const int taker = works[i].segment->taker;
    if ((i == 0 || works[i - 1].segment->taker != taker) && !takers.insert(taker).second) return false;
  }
  return true;
}

/// Sends what others take. @pre segments of one taker follow one another
void send_runs(Ranks& ranks, std::vector<Work>& works) {
  REQUIRES(follow_by_taker(works));
  for (std::size_t first = 0; first < works.size();) {
    const int taker = works[first].segment->taker;
    Bytes message;
    for (; first < works.size() && works[first].segment->taker == taker; ++first) {
      if (taker == ranks.rank()) continue;
      const Bytes bytes = std::exchange(works[first].segment->bytes, {});
      message.insert(message.end(), bytes.begin(), bytes.end());
    }
    if (!message.empty()) ranks.send(taker, std::move(message));
  }
}

/// Takes in what another rank knows of segments that this one takes.
void receive_runs(Ranks& ranks, int other, std::size_t size, std::vector<Work>& works) {
  const auto is_theirs = [other](const OwnedRun& run) { return run.owner == other; };
  const bool sends = std::any_of(works.begin(), works.end(), [&](const Work& work) {
    return work.segment->taker == ranks.rank() && std::any_of(work.runs.begin(), work.runs.end(), is_theirs);
  });
  if (!sends) return;
  const Bytes message = ranks.receive(other);
  MessageReader reader(message);
  for (Work& work : works) {
    GatheredSegment& all = *work.segment;
    if (all.taker != ranks.rank()) continue;
    for (const OwnedRun& run : work.runs) {
      if (run.owner != other) continue;
      const auto bytes = reader.take(run.count * size);
      std::copy(bytes.begin(), bytes.end(),
                all.bytes.begin() + static_cast<std::ptrdiff_t>((run.begin - all.begin) * size));
    }
  }
}

}  // namespace

void gather_segments(Ranks& ranks, ThreadTeam& team, const ElementOwners& owners, const ResultArray& array,
                     std::vector<GatheredSegment>& segments) {
  std::stable_sort(segments.begin(), segments.end(),
                   [](const auto& a, const auto& b) { return a.taker < b.taker; });
  std::vector<Work> works;
  for (GatheredSegment& segment : segments) works.push_back({&segment});
  team.for_each(static_cast<std::int64_t>(works.size()), 1, [&](ThreadTeam::Range range, int) {
    for (std::int64_t i = range.begin; i < range.end; ++i) {
      Work& work = works[static_cast<std::size_t>(i)];
      work.runs = owned_runs(owners, *work.segment);
      fill_local(work, ranks.rank(), array);
    }
  });
  send_runs(ranks, works);
  const std::size_t size = element_size(array.type);
  for (int other = 0; other < ranks.count(); ++other) {
    if (other != ranks.rank()) receive_runs(ranks, other, size, works);
  }
  std::erase_if(segments, [&](const GatheredSegment& one) { return one.taker != ranks.rank(); });
}

}  // namespace coordreq
