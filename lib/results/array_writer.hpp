#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "answers/field.hpp"
#include "base/thread_team.hpp"
#include "results/chunk_codec.hpp"
#include "results/chunk_layout.hpp"
#include "results/hdf5_handle.hpp"
#include "results/output_driver.hpp"
#include "results/rank_chunks.hpp"

namespace coordreq {

/// Writes arrays as datasets: small ones as they are, others in compressed chunks that are filled and packed
/// by several threads and written in order by the caller's.
///
/// Memory: about 1.5 MiB for each chunk at work, those that are remembered (KnownChunks::most), and the
/// packed chunks of a batch, at most kChunksPerThread MiB a thread.
class ArrayWriter {
 public:
  static constexpr std::size_t kChunksPerThread = 4;

  /// How many chunks are packed at a time: not by all of many threads, so that these need little more memory
  /// than two.
  [[nodiscard]] static int packers(int threads) { return std::min(threads, 8); }

  /// Memory of writing arrays of at most `longest` bytes.
  [[nodiscard]] static double bytes(double longest, int threads);

  /// @param driver the one that the files are written with
  /// @param ranks who knows arrays of cells, if there are several processes; else null
  /// @pre unchecked: both outlive the writer.
  ArrayWriter(ThreadTeam& team, const hdf5::OutputDriver& driver, RankChunks* ranks = nullptr);

  /// Creates the dataset `path` and writes all its elements.
  /// @throws hdf5::Failure, and what `array.fill` throws
  [[nodiscard]] hdf5::Handle write(const hdf5::Handle& file, const std::string& path,
                                   const std::vector<hsize_t>& shape, const ResultArray& array);

  /// Creates the dataset `path` with the elements of `original`, which write() has made of the same shape and
  /// array: what is packed already is not packed again.
  [[nodiscard]] hdf5::Handle write_copy(const hdf5::Handle& file, const std::string& path,
                                        const std::vector<hsize_t>& shape, const ResultArray& array,
                                        const hdf5::Handle& original);

 private:
  struct Scratch {
    ChunkCodec codec;
    std::vector<std::byte> raw;
  };

  void write_chunks(const hdf5::Handle& dataset, const std::string& path, const ChunkLayout& layout,
                    const ResultArray& array);
  void pack_batch(const ChunkLayout& layout, const ResultArray& array, std::uint64_t first,
                  std::size_t count);

  ThreadTeam& team_;
  const hdf5::OutputDriver& driver_;
  RankChunks* ranks_;
  std::vector<Scratch> scratch_;                // one a packer
  std::vector<std::vector<std::byte>> packed_;  // one a chunk of the batch
};

}  // namespace coordreq
