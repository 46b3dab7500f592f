#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "answers/field.hpp"
#include "base/thread_team.hpp"
#include "model/cell_order.hpp"
#include "ranks/row_share.hpp"
#include "results/chunk_codec.hpp"
#include "results/chunk_layout.hpp"
#include "results/element_owners.hpp"
#include "results/rank_lists.hpp"

namespace coordreq {

/// The chunks of arrays of cells, or of lists of them, of which each of several processes knows some. Each
/// chunk is packed by one of them, one that owns elements of it as long as it has no more than its share of
/// the chunks; what others know of it they send. Then rank 0 takes the chunks in the order of the file. No
/// rank ever holds more than some chunks, what it has packed, and its share of the lists at work.
///
/// Chunks do not depend on the number of processes. All functions are called by all ranks together, but for
/// take() and send_packed().
class RankChunks {
 public:
  /// @pre unchecked: the arguments outlive this object.
  RankChunks(ThreadTeam& team, const RowShare& share, const CellOrder& order);

  [[nodiscard]] bool is_first() const { return share_.ranks().rank() == 0; }

  /// Fills all chunks of an array and packs them; one that is not chunked is one segment that is not packed.
  /// @pre the array is divided
  void pack(const ChunkLayout& layout, const ResultArray& array);
  /// Rank 0 takes every chunk, in their order, or the whole; meanwhile the others send theirs.
  [[nodiscard]] Bytes take(std::uint64_t chunk);
  void send_packed();

 private:
  [[nodiscard]] std::uint64_t chunk_count() const { return layout_->chunked() ? layout_->chunk_count() : 1; }
  [[nodiscard]] ChunkLayout::Segment segment(std::uint64_t chunk) const;
  [[nodiscard]] int wanted_packer(std::uint64_t chunk) const;
  void choose_packers();
  void pack_group(const ResultArray& array, std::size_t group);

  ThreadTeam& team_;
  const RowShare& share_;
  const CellOrder& order_;
  std::size_t group_size_;          ///< chunks that a rank has at work at a time
  std::vector<ChunkCodec> codecs_;  ///< one a thread
  const ChunkLayout* layout_ = nullptr;
  std::optional<RankLists> lists_;   ///< of the array at work, if it is one
  std::optional<CellOwners> cells_;  ///< else
  const ElementOwners* owners_ = nullptr;
  std::vector<int> packer_;                            ///< [chunk]
  std::vector<std::vector<std::uint64_t>> chunks_of_;  ///< [rank] that it packs, ascending
  std::deque<Bytes> packed_;                           ///< local ones, not sent yet
  std::vector<std::deque<Bytes>> received_;            ///< [rank] in rank 0: of the group requested last
};

}  // namespace coordreq
