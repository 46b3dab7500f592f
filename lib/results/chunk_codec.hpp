#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <shared_mutex>
#include <span>
#include <vector>

struct z_stream_s;

namespace coordreq {

/// The level named in the filter pipeline of the file; readers do not need it.
inline constexpr int kDeflateLevel = 1;

/// The last chunks that were packed, for several threads: their bytes as they are compressed, and what became
/// of them.
class KnownChunks {
 public:
  /// How many are remembered: fewer where many codecs have a chunk each, so that all need much the same
  /// memory.
  [[nodiscard]] static constexpr std::size_t most(int codecs) {
    return static_cast<std::size_t>(std::clamp(kMostBuffers - codecs, 2, 8));
  }

  explicit KnownChunks(int codecs) : most_(most(codecs)) {}

  /// Replaces `packed` by what became of equal bytes. @returns false if none are known
  bool find(std::span<const std::byte> bytes, std::vector<std::byte>& packed) const;
  /// Takes the bytes, and leaves the memory of those that are forgotten.
  void add(std::vector<std::byte>& bytes, std::span<const std::byte> packed);

 private:
  static constexpr int kMostBuffers = 10;
  struct Known {
    std::uint64_t mark = 0;
    std::vector<std::byte> bytes;
    std::vector<std::byte> packed;
  };

  std::size_t most_;
  mutable std::shared_mutex mutex_;
  std::vector<Known> known_;
  std::size_t oldest_ = 0;  ///< of them, the next to be forgotten
};

/// Packs chunks as HDF5's filters "shuffle" and "deflate" do, the first only for elements of several bytes.
///
/// zlib itself rather than HDF5's filter: that way it works on several chunks at a time, while the HDF5
/// library admits one caller, and in the way that suits rows of levels: long matches are skipped, where
/// libdeflate enters every byte of them into its tables. The output depends on the input alone; that of ISA-L
/// is not always the same for the same input on a busy machine. One object a thread.
///
/// Where rows are often equal, so are chunks, and far from where anything happens they hold one value: some
/// of the last ones are remembered with what became of them, for all threads together.
class ChunkCodec {
 public:
  /// Memory of a compressor, beside its chunks.
  static constexpr double kBytes = 256.0 * 1024;

  explicit ChunkCodec(std::shared_ptr<KnownChunks> known = std::make_shared<KnownChunks>(1));
  /// Several, which know the same chunks.
  [[nodiscard]] static std::vector<ChunkCodec> make(int count);

  /// Begins a chunk of so many bytes, a whole number of elements, all 0.
  void begin(std::size_t bytes, std::size_t element_size);
  /// Puts some elements after those put before: so nobody has to hold the chunk as it is unshuffled.
  void put(std::span<const std::byte> raw);
  /// Replaces `packed` by the zlib stream of the chunk.
  /// @throws std::bad_alloc
  void finish(std::vector<std::byte>& packed);
  /// All of this, for a chunk that is at hand.
  void pack(std::span<const std::byte> raw, std::size_t element_size, std::vector<std::byte>& packed);

 private:
  void compress(std::vector<std::byte>& packed);
  /// Adds the stream without header and checksum.
  void deflate_raw(std::vector<std::byte>& packed);

  struct Free {
    void operator()(z_stream_s* stream) const;
  };
  std::unique_ptr<z_stream_s, Free> stream_;
  std::vector<std::byte> shuffled_;  ///< the chunk
  std::size_t element_size_ = 1;
  std::size_t elements_ = 0;  ///< that have been put
  std::shared_ptr<KnownChunks> known_;
};

/// All first bytes of the elements, then all second bytes, and so on: HDF5's "shuffle" filter.
/// @pre both of the same size, a multiple of `element_size`
void shuffle_bytes(std::span<const std::byte> raw, std::size_t element_size, std::span<std::byte> shuffled);

/// Undoes what was done to a chunk of so many bytes, and never makes more of it.
/// @param element_size of the elements whose bytes were shuffled; 1: they were not
/// @returns false if it is not such a chunk
[[nodiscard]] bool unpack_chunk(std::span<const std::byte> packed, std::size_t bytes, bool deflated,
                                std::size_t element_size, std::vector<std::byte>& raw);

}  // namespace coordreq
