#include "results/rank_lists.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "base/requires.hpp"

namespace coordreq {
namespace {

/// Gaps between own elements that are rather filled too than gone round.
constexpr std::uint64_t kGap = 4096;

/// Elements of a stretch, all of one owner.
struct Part {
  int owner = 0;
  std::uint64_t begin = 0;
  std::uint64_t count = 0;
};

struct Work {
  GatheredStretch* stretch;
  std::vector<Part> parts = {};
};

std::vector<Part> parts_of(const ElementOwners& owners, const GatheredStretch& stretch) {
  std::vector<Part> parts;
  owners.for_each_run(stretch.begin, stretch.count, [&](int owner, std::uint64_t first, std::uint64_t count) {
    if (parts.empty() || parts.back().owner != owner) parts.push_back({owner, first, 0});
    parts.back().count = first + count - parts.back().begin;
  });
  return parts;
}

/// Fills in the values of a stretch that this rank has: at their places if it takes the stretch, else one
/// part after the other.
void fill_own(Work& work, int own, const ResultArray& array) {
  GatheredStretch& all = *work.stretch;
  const std::size_t size = element_size(array.type);
  const bool is_taker = all.taker == own;
  if (is_taker) all.bytes.resize(all.count * size);
  std::vector<std::byte> filled;
  for (std::size_t i = 0; i < work.parts.size();) {
    if (work.parts[i].owner != own) {
      ++i;
      continue;
    }
    std::size_t next = i + 1;
    std::size_t last = i;  // that is own, with no large gap before it
    for (; next < work.parts.size(); ++next) {
      if (work.parts[next].owner != own) continue;
      if (work.parts[next].begin - work.parts[last].begin - work.parts[last].count > kGap) break;
      last = next;
    }
    const std::uint64_t begin = work.parts[i].begin;
    const std::uint64_t count = work.parts[last].begin + work.parts[last].count - begin;
    filled.resize(count * size);
    array.fill(begin, count, filled.data());
    for (; i <= last; ++i) {
      const Part& part = work.parts[i];
      if (part.owner != own) continue;
      const std::byte* const from = filled.data() + (part.begin - begin) * size;
      if (is_taker) {
        std::copy_n(from, part.count * size,
                    all.bytes.begin() + static_cast<std::ptrdiff_t>((part.begin - all.begin) * size));
      } else {
        all.bytes.insert(all.bytes.end(), from, from + part.count * size);
      }
    }
  }
}

[[maybe_unused]] bool follow_by_taker(const std::vector<Work>& works) {
  std::set<int> takers;
  for (std::size_t i = 0; i < works.size(); ++i) {
    const int taker = works[i].stretch->taker;
    if ((i == 0 || works[i - 1].stretch->taker != taker) && !takers.insert(taker).second) return false;
  }
  return true;
}

/// Sends what others take. @pre stretches of one taker follow one another
void send_parts(Ranks& ranks, std::vector<Work>& works) {
  REQUIRES(follow_by_taker(works));
  for (std::size_t first = 0; first < works.size();) {
    const int taker = works[first].stretch->taker;
    Bytes message;
    for (; first < works.size() && works[first].stretch->taker == taker; ++first) {
      if (taker == ranks.rank()) continue;
      const Bytes bytes = std::exchange(works[first].stretch->bytes, {});
      message.insert(message.end(), bytes.begin(), bytes.end());
    }
    if (!message.empty()) ranks.send(taker, std::move(message));
  }
}

/// Takes in what another rank knows of stretches that this one takes.
void receive_parts(Ranks& ranks, int other, std::size_t size, std::vector<Work>& works) {
  const auto is_theirs = [other](const Part& part) { return part.owner == other; };
  const bool sends = std::any_of(works.begin(), works.end(), [&](const Work& work) {
    return work.stretch->taker == ranks.rank() &&
           std::any_of(work.parts.begin(), work.parts.end(), is_theirs);
  });
  if (!sends) return;
  const Bytes message = ranks.receive(other);
  MessageReader reader(message);
  for (Work& work : works) {
    GatheredStretch& all = *work.stretch;
    if (all.taker != ranks.rank()) continue;
    for (const Part& part : work.parts) {
      if (part.owner != other) continue;
      const auto bytes = reader.take(part.count * size);
      std::copy(bytes.begin(), bytes.end(),
                all.bytes.begin() + static_cast<std::ptrdiff_t>((part.begin - all.begin) * size));
    }
  }
}

}  // namespace

void gather_stretches(Ranks& ranks, ThreadTeam& team, const ElementOwners& owners, const ResultArray& array,
                      std::vector<GatheredStretch>& stretches) {
  std::stable_sort(stretches.begin(), stretches.end(),
                   [](const auto& a, const auto& b) { return a.taker < b.taker; });
  std::vector<Work> works;
  for (GatheredStretch& stretch : stretches) works.push_back({&stretch});
  team.for_each(static_cast<std::int64_t>(works.size()), 1, [&](ThreadTeam::Range range, int) {
    for (std::int64_t i = range.begin; i < range.end; ++i) {
      Work& work = works[static_cast<std::size_t>(i)];
      work.parts = parts_of(owners, *work.stretch);
      fill_own(work, ranks.rank(), array);
    }
  });
  send_parts(ranks, works);
  const std::size_t size = element_size(array.type);
  for (int other = 0; other < ranks.count(); ++other) {
    if (other != ranks.rank()) receive_parts(ranks, other, size, works);
  }
  std::erase_if(stretches, [&](const GatheredStretch& one) { return one.taker != ranks.rank(); });
}

}  // namespace coordreq
