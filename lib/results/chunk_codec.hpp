#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

struct z_stream_s;

namespace coordreq {

/// The level named in the filter pipeline of the file; readers do not need it.
inline constexpr int kDeflateLevel = 1;

/// The last chunks that were packed, for several threads.
class KnownChunks {
 public:
  /// Replaces `packed` by what became of an equal chunk. @returns false if none is known
  bool find(std::span<const std::byte> raw, std::size_t element_size, std::vector<std::byte>& packed) const;
  void add(std::span<const std::byte> raw, std::size_t element_size, std::span<const std::byte> packed);

 private:
  static constexpr std::size_t kMost = 8;
  /// Never changed once it is known, so that threads may compare while others forget it.
  struct Known {
    std::uint64_t mark = 0;
    std::size_t element_size = 0;
    std::vector<std::byte> raw;
    std::vector<std::byte> packed;
  };

  mutable std::mutex mutex_;
  std::vector<std::shared_ptr<const Known>> known_;
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

  explicit ChunkCodec(std::shared_ptr<KnownChunks> known = std::make_shared<KnownChunks>());

  /// Replaces `packed` by the zlib stream of `raw`, a whole number of elements.
  /// @throws std::bad_alloc
  void pack(std::span<const std::byte> raw, std::size_t element_size, std::vector<std::byte>& packed);

 private:
  void compress(std::span<const std::byte> raw, std::size_t element_size, std::vector<std::byte>& packed);
  /// To scratch_, without header and checksum. @returns how many bytes
  std::size_t deflate_raw(std::span<const std::byte> raw);

  struct Free {
    void operator()(z_stream_s* stream) const;
  };
  std::unique_ptr<z_stream_s, Free> stream_;
  std::vector<std::byte> shuffled_;
  std::unique_ptr<std::byte[]> scratch_;
  std::size_t scratch_size_ = 0;
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
