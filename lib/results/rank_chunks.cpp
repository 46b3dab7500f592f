#include "results/rank_chunks.hpp"

#include <algorithm>
#include <utility>

#include "base/requires.hpp"
#include "results/rank_lists.hpp"

namespace coordreq {
namespace {

constexpr std::size_t kGroupOfThread = 4;  // chunks

}  // namespace

RankChunks::RankChunks(ThreadTeam& team, const RowShare& share, const CellOrder& order)
    : team_(team),
      share_(share),
      order_(order),
      group_size_(kGroupOfThread * static_cast<std::size_t>(team.size())),
      codecs_(ChunkCodec::make(team.size())) {}

ChunkLayout::Segment RankChunks::segment(std::uint64_t chunk) const {
  return layout_->chunked() ? layout_->segment(chunk)
                            : ChunkLayout::Segment{.begin = 0, .count = layout_->elements()};
}

/// The owner of some element of it: where every chunk has some of all ranks, each is chosen as often.
int RankChunks::wanted_packer(std::uint64_t chunk) const {
  constexpr std::uint64_t kPositions = 8;
  if (!layout_->chunked()) return 0;
  const ChunkLayout::Segment segment = layout_->segment(chunk);
  return owners_->owner_of(segment.begin + segment.count * (2 * (chunk % kPositions) + 1) / (2 * kPositions));
}

/// Where agents that are alike are exchanged some ranks own many more cells than others.
void RankChunks::choose_packers() {
  const auto ranks = static_cast<std::uint64_t>(share_.ranks().count());
  const std::uint64_t share = (chunk_count() + ranks - 1) / ranks;
  chunks_of_.assign(ranks, {});
  packer_.clear();
  const auto is_shorter = [](const auto& a, const auto& b) { return a.size() < b.size(); };
  for (std::uint64_t chunk = 0; chunk < chunk_count(); ++chunk) {
    auto packer = chunks_of_.begin() + wanted_packer(chunk);
    if (packer->size() == share) packer = std::ranges::min_element(chunks_of_, is_shorter);
    packer->push_back(chunk);
    packer_.push_back(static_cast<int>(packer - chunks_of_.begin()));
  }
}

void RankChunks::pack(const ChunkLayout& layout, const ResultArray& array) {
  REQUIRES(array.is_divided());
  layout_ = &layout;
  lists_.reset();
  packed_.clear();
  received_.assign(static_cast<std::size_t>(share_.ranks().count()), {});
  if (layout.elements() == 0) return chunks_of_.assign(received_.size(), {});
  if (array.lists != nullptr) {
    lists_.emplace(team_, share_, order_, array);
    owners_ = &lists_->owners();
  } else {
    owners_ = &cells_.emplace(share_, order_, array.of_cell);
  }
  choose_packers();
  std::size_t most = 0;
  for (const auto& chunks : chunks_of_) most = std::max(most, chunks.size());
  const ResultArray known = lists_ ? lists_->array() : array;
  for (std::size_t group = 0; group * group_size_ < most; ++group) pack_group(known, group);
}

void RankChunks::pack_group(const ResultArray& array, std::size_t group) {
  std::vector<GatheredSegment> works;
  for (int packer = 0; packer < share_.ranks().count(); ++packer) {
    const std::vector<std::uint64_t>& chunks = chunks_of_[static_cast<std::size_t>(packer)];
    for (std::size_t i = group * group_size_; i < std::min((group + 1) * group_size_, chunks.size()); ++i) {
      const ChunkLayout::Segment all = segment(chunks[i]);
      works.push_back({.taker = packer, .begin = all.begin, .count = all.count});
    }
  }
  gather_segments(share_.ranks(), team_, *owners_, array, works);
  const std::size_t before = packed_.size();
  packed_.resize(before + works.size());
  const std::size_t size = element_size(array.type);
  team_.for_each(static_cast<std::int64_t>(works.size()), 1, [&](ThreadTeam::Range range, int worker) {
    for (auto i = static_cast<std::size_t>(range.begin); i < static_cast<std::size_t>(range.end); ++i) {
      if (layout_->chunked()) {
        works[i].bytes.resize(layout_->chunk_elements() * size);
        codecs_[static_cast<std::size_t>(worker)].pack(works[i].bytes, size, packed_[before + i]);
      } else {
        packed_[before + i] = std::move(works[i].bytes);
      }
    }
  });
}

Bytes RankChunks::take(std::uint64_t chunk) {
  const int packer = packer_[chunk];
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

void RankChunks::send_packed() {
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
