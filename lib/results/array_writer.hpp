#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
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
/// in batches by several threads. The caller's writes a batch while the others pack the next one: HDF5 admits
/// one thread.
///
/// Memory: about 1.5 MiB for each chunk at work, those that are remembered (KnownChunks::most), and the
/// packed chunks of two batches, at most kChunksPerThread MiB a thread.
class ArrayWriter {
 public:
  static constexpr std::size_t kChunksPerThread = 4;

  /// How many chunks of an array are packed at a time: not by all of many threads where there are few, so
  /// that these need little more memory than two.
  [[nodiscard]] static int packers(int threads, std::uint64_t chunks) {
    return static_cast<int>(
        std::min<std::uint64_t>(static_cast<std::uint64_t>(threads), std::max<std::uint64_t>(8, chunks / 2)));
  }

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

  /// Chunks of an array one after the other, packed.
  struct Batch {
    std::uint64_t first = 0;
    std::span<std::vector<std::byte>> packed;
  };
  /// Where they go.
  struct Target {
    const hdf5::Handle& dataset;
    const std::string& path;
    const ChunkLayout& layout;
  };

  void write_chunks(const Target& target, const ResultArray& array);
  void write_batch(const Target& target, const Batch& batch) const;
  /// Packs a batch, and writes the one before.
  void pack_batch(const Target& target, const ResultArray& array, const Batch& batch, const Batch& before);
  void pack_chunk(const ChunkLayout& layout, const ResultArray& array, std::uint64_t chunk, Scratch& scratch,
                  std::vector<std::byte>& packed) const;

  ThreadTeam& team_;
  const hdf5::OutputDriver& driver_;
  RankChunks* ranks_;
  std::shared_ptr<KnownChunks> known_;
  std::vector<Scratch> scratch_;                // one a packer
  std::vector<std::vector<std::byte>> packed_;  // one a chunk of two batches
};

}  // namespace coordreq
