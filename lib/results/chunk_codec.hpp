#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

struct libdeflate_compressor;

namespace coordreq {

/// The level named in the filter pipeline of the file; readers do not need it.
inline constexpr int kDeflateLevel = 1;

/// Packs chunks as HDF5's filters "shuffle" and "deflate" do, the first only for elements of several bytes.
///
/// libdeflate rather than HDF5's own filter: it is faster, and works on several chunks at a time while the
/// HDF5 library admits one caller. The output depends on the input alone. One object a thread.
///
/// Far from where anything happens whole chunks hold one value: the last of them is remembered with what
/// became of it.
class ChunkCodec {
 public:
  /// Of a compressor, beside its chunks.
  static constexpr double kBytes = 256.0 * 1024;

  ChunkCodec();

  /// Replaces `packed` by the zlib stream of `raw`, a whole number of elements.
  /// @throws std::bad_alloc
  void pack(std::span<const std::byte> raw, std::size_t element_size, std::vector<std::byte>& packed);

 private:
  void compress(std::span<const std::byte> raw, std::size_t element_size, std::vector<std::byte>& packed);

  struct Free {
    void operator()(libdeflate_compressor* compressor) const;
  };
  std::unique_ptr<libdeflate_compressor, Free> compressor_;
  std::vector<std::byte> shuffled_;
  std::vector<std::byte> scratch_;
  std::vector<std::byte> uniform_;         ///< the last element that a whole chunk consisted of
  std::size_t uniform_bytes_ = 0;          ///< length of that chunk; 0: none yet
  std::vector<std::byte> uniform_packed_;  ///< and what became of it
};

/// All first bytes of the elements, then all second bytes, and so on: HDF5's "shuffle" filter.
/// REQUIRES: both of the same size, a multiple of `element_size`.
void shuffle_bytes(std::span<const std::byte> raw, std::size_t element_size, std::span<std::byte> shuffled);

/// Undoes what was done to a chunk of so many bytes, and never makes more of it.
/// @param element_size of the elements whose bytes were shuffled; 1: they were not
/// @returns false if it is not such a chunk
[[nodiscard]] bool unpack_chunk(std::span<const std::byte> packed, std::size_t bytes, bool deflated,
                                std::size_t element_size, std::vector<std::byte>& raw);

}  // namespace coordreq
