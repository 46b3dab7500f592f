#include "results/rank_chunks.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace coordreq {
namespace {

constexpr std::size_t kGroupOfThread = 4;  // chunks
/// Gaps between own elements that are rather filled too than gone round.
constexpr std::uint64_t kGap = 4096;

}  // namespace

RankChunks::RankChunks(ThreadTeam& team, const RowShare& share, const CellOrder& order)
    : team_(team),
      share_(share),
      order_(order),
      group_size_(kGroupOfThread * static_cast<std::size_t>(team.size())),
      codecs_(static_cast<std::size_t>(team.size())) {}

ChunkLayout::Stretch RankChunks::stretch(std::uint64_t chunk) const {
  return layout_->chunked() ? layout_->stretch(chunk)
                            : ChunkLayout::Stretch{.begin = 0, .count = layout_->elements()};
}

int RankChunks::owner_of(std::uint64_t element) const {
  const auto cells = static_cast<std::uint64_t>(order_.cells());
  int owner = 0;
  order_.for_each_run(static_cast<std::int64_t>(element / array_->of_cell % cells), 1,
                      [&](const CellOrder::Run& run) { owner = share_.owner(run.row); });
  return owner;
}

/// The owner of some cell of it: where every chunk has cells of all ranks, each is chosen as often.
int RankChunks::packer_of(std::uint64_t chunk) const {
  constexpr std::uint64_t kPlaces = 8;
  if (!layout_->chunked()) return 0;
  const ChunkLayout::Stretch own = layout_->stretch(chunk);
  return owner_of(own.begin + own.count * (2 * (chunk % kPlaces) + 1) / (2 * kPlaces));
}

void RankChunks::choose_packers() {
  chunks_of_.assign(static_cast<std::size_t>(share_.ranks().count()), {});
  for (std::uint64_t chunk = 0; chunk < chunk_count(); ++chunk)
    chunks_of_[static_cast<std::size_t>(packer_of(chunk))].push_back(chunk);
}

void RankChunks::pack(const ChunkLayout& layout, const ResultArray& array) {
  layout_ = &layout;
  array_ = &array;
  packed_.clear();
  received_.assign(static_cast<std::size_t>(share_.ranks().count()), {});
  if (layout.elements() == 0) return chunks_of_.assign(received_.size(), {});
  choose_packers();
  std::size_t most = 0;
  for (const auto& chunks : chunks_of_) most = std::max(most, chunks.size());
  for (std::size_t group = 0; group * group_size_ < most; ++group) pack_group(group);
}

void RankChunks::pack_group(std::size_t group) {
  const int own = share_.ranks().rank();
  std::vector<Work> works;
  for (int packer = 0; packer < share_.ranks().count(); ++packer) {
    const std::vector<std::uint64_t>& chunks = chunks_of_[static_cast<std::size_t>(packer)];
    for (std::size_t i = group * group_size_; i < std::min((group + 1) * group_size_, chunks.size()); ++i)
      works.push_back({.packer = packer, .chunk = chunks[i]});
  }
  team_.for_each(static_cast<std::int64_t>(works.size()), 1, [&](ThreadTeam::Range range, int) {
    for (std::int64_t i = range.begin; i < range.end; ++i) fill_own(works[static_cast<std::size_t>(i)]);
  });
  swap_parts(works);
  std::erase_if(works, [own](const Work& work) { return work.packer != own; });
  const std::size_t before = packed_.size();
  packed_.resize(before + works.size());
  const std::size_t size = element_size(array_->type);
  team_.for_each(static_cast<std::int64_t>(works.size()), 1, [&](ThreadTeam::Range range, int worker) {
    for (auto i = static_cast<std::size_t>(range.begin); i < static_cast<std::size_t>(range.end); ++i) {
      if (layout_->chunked()) {
        codecs_[static_cast<std::size_t>(worker)].pack(works[i].bytes, size, packed_[before + i]);
      } else {
        packed_[before + i] = std::move(works[i].bytes);
      }
    }
  });
}

std::vector<RankChunks::Part> RankChunks::parts_of(const ChunkLayout::Stretch& stretch) const {
  std::vector<Part> parts;
  const std::uint64_t end = stretch.begin + stretch.count;
  const std::uint64_t of_cell = array_->of_cell;
  const auto cells = static_cast<std::uint64_t>(order_.cells());
  const auto add = [&](int owner, std::uint64_t first, std::uint64_t count) {
    const std::uint64_t from = std::max(first * of_cell, stretch.begin);
    const std::uint64_t to = std::min((first + count) * of_cell, end);
    if (parts.empty() || parts.back().owner != owner) parts.push_back({owner, from, 0});
    parts.back().count = to - parts.back().begin;
  };
  const std::uint64_t last = (end + of_cell - 1) / of_cell;
  for (std::uint64_t cell = stretch.begin / of_cell; cell < last;) {
    const std::uint64_t here = std::min(last - cell, cells - cell % cells);
    order_.for_each_run(
        static_cast<std::int64_t>(cell % cells), static_cast<std::int64_t>(here), [&](const auto& run) {
          for (std::int64_t i = 0; i < run.count;) {
            const std::int64_t row = run.row + i * run.row_step;
            const int owner = share_.owner(row);
            std::int64_t count = run.count - i;
            if (run.row_step != 0)
              count = std::min(count, (share_.run_of(owner).end - 1 - row) / run.row_step + 1);
            add(owner, cell + static_cast<std::uint64_t>(run.offset + i), static_cast<std::uint64_t>(count));
            i += count;
          }
        });
    cell += here;
  }
  return parts;
}

/// What this rank knows of a chunk: at its place if it packs it, else one part after the other.
void RankChunks::fill_own(Work& work) const {
  const int own = share_.ranks().rank();
  const ChunkLayout::Stretch all = stretch(work.chunk);
  work.parts = parts_of(all);
  const std::size_t size = element_size(array_->type);
  const bool is_packer = work.packer == own;
  if (is_packer) work.bytes.resize((layout_->chunked() ? layout_->chunk_elements() : all.count) * size);
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
    array_->fill(begin, count, filled.data());
    for (; i <= last; ++i) {
      const Part& part = work.parts[i];
      if (part.owner != own) continue;
      const std::byte* const from = filled.data() + (part.begin - begin) * size;
      if (is_packer) {
        std::copy_n(from, part.count * size,
                    work.bytes.begin() + static_cast<std::ptrdiff_t>((part.begin - all.begin) * size));
      } else {
        work.bytes.insert(work.bytes.end(), from, from + part.count * size);
      }
    }
  }
}

/// Every rank sends what it knows of chunks that others pack.
void RankChunks::swap_parts(std::vector<Work>& works) const {
  Ranks& ranks = share_.ranks();
  const std::size_t size = element_size(array_->type);
  for (std::size_t first = 0; first < works.size();) {
    const int packer = works[first].packer;
    Bytes message;
    for (; first < works.size() && works[first].packer == packer; ++first) {
      if (packer == ranks.rank()) continue;
      message.insert(message.end(), works[first].bytes.begin(), works[first].bytes.end());
      works[first].bytes = {};
    }
    if (!message.empty()) ranks.send(packer, std::move(message));
  }
  for (int other = 0; other < ranks.count(); ++other) {
    if (other == ranks.rank()) continue;
    const auto is_theirs = [other](const Part& part) { return part.owner == other; };
    const bool sends = std::any_of(works.begin(), works.end(), [&](const Work& work) {
      return work.packer == ranks.rank() && std::any_of(work.parts.begin(), work.parts.end(), is_theirs);
    });
    if (!sends) continue;
    const Bytes message = ranks.receive(other);
    MessageReader reader(message);
    for (Work& work : works) {
      if (work.packer != ranks.rank()) continue;
      const std::uint64_t begin = stretch(work.chunk).begin;
      for (const Part& part : work.parts) {
        if (part.owner != other) continue;
        const auto bytes = reader.take(part.count * size);
        std::copy(bytes.begin(), bytes.end(),
                  work.bytes.begin() + static_cast<std::ptrdiff_t>((part.begin - begin) * size));
      }
    }
  }
}

Bytes RankChunks::take(std::uint64_t chunk) {
  const int packer = packer_of(chunk);
  std::deque<Bytes>& ready = packer == 0 ? packed_ : received_[static_cast<std::size_t>(packer)];
  if (ready.empty()) {
    share_.ranks().send(packer, {});  // asks for the next ones
    const Bytes message = share_.ranks().receive(packer);
    for (MessageReader reader(message); !reader.is_at_end();) {
      const auto bytes = reader.take(static_cast<std::size_t>(reader.number()));
      ready.emplace_back(bytes.begin(), bytes.end());
    }
  }
  Bytes result = std::move(ready.front());
  ready.pop_front();
  return result;
}

void RankChunks::hand_over() {
  while (!packed_.empty()) {
    static_cast<void>(share_.ranks().receive(0));
    Bytes message;
    for (std::size_t i = 0; i < group_size_ && !packed_.empty(); ++i) {
      const auto bytes = static_cast<std::int64_t>(packed_.front().size());
      put_numbers<std::int64_t>(message, {&bytes, 1});
      put_numbers<std::byte>(message, packed_.front());
      packed_.pop_front();
    }
    share_.ranks().send(0, std::move(message));
  }
}

}  // namespace coordreq
