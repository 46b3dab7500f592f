#include "results/chunk_codec.hpp"

#include <libdeflate.h>

#include <algorithm>
#include <cstring>
#include <new>

namespace coordreq {
namespace {

// The size is a constant here because the compiler then makes vector code of the inner loop.
template <std::size_t size>
void shuffle_fixed(std::span<const std::byte> raw, std::span<std::byte> shuffled) {
  const std::size_t count = raw.size() / size;
  for (std::size_t byte = 0; byte < size; ++byte) {
    std::byte* out = shuffled.data() + byte * count;
    for (std::size_t i = 0; i < count; ++i) out[i] = raw[i * size + byte];
  }
}

/// A look at some places, so that a chunk is compared as a whole with hardly any that it is not equal to.
std::uint64_t mark_of(std::span<const std::byte> bytes) {
  constexpr std::size_t kLooks = 256;
  std::uint64_t mark = bytes.size();
  std::uint64_t word = 0;
  const std::size_t step = std::max(sizeof(word), bytes.size() / kLooks);
  for (std::size_t at = 0; at + sizeof(word) <= bytes.size(); at += step) {
    std::memcpy(&word, bytes.data() + at, sizeof(word));
    mark = (mark ^ word) * 0x9E3779B97F4A7C15U;
    mark ^= mark >> 32U;
  }
  return mark;
}

}  // namespace

void shuffle_bytes(std::span<const std::byte> raw, std::size_t element_size, std::span<std::byte> shuffled) {
  switch (element_size) {
    case 2:
      return shuffle_fixed<2>(raw, shuffled);
    case 4:
      return shuffle_fixed<4>(raw, shuffled);
    case 8:
      return shuffle_fixed<8>(raw, shuffled);
    default:
      return shuffle_fixed<1>(raw, shuffled);
  }
}

bool unpack_chunk(std::span<const std::byte> packed, std::size_t bytes, bool deflated,
                  std::size_t element_size, std::vector<std::byte>& raw) {
  raw.assign(packed.begin(), packed.end());
  if (deflated) {
    struct Free {
      void operator()(libdeflate_decompressor* decompressor) const {
        libdeflate_free_decompressor(decompressor);
      }
    };
    const std::unique_ptr<libdeflate_decompressor, Free> decompressor(libdeflate_alloc_decompressor());
    if (!decompressor) throw std::bad_alloc();
    raw.resize(bytes);
    // Without a place for the length found, another length than that of the buffer is an error.
    if (libdeflate_zlib_decompress(decompressor.get(), packed.data(), packed.size(), raw.data(), bytes,
                                   nullptr) != LIBDEFLATE_SUCCESS) {
      return false;
    }
  }
  if (raw.size() != bytes || bytes % element_size != 0) return false;
  if (element_size == 1) return true;
  const std::vector<std::byte> shuffled = raw;
  const std::size_t count = bytes / element_size;
  for (std::size_t byte = 0; byte < element_size; ++byte) {
    for (std::size_t i = 0; i < count; ++i) raw[i * element_size + byte] = shuffled[byte * count + i];
  }
  return true;
}

void ChunkCodec::Free::operator()(libdeflate_compressor* compressor) const {
  libdeflate_free_compressor(compressor);
}

ChunkCodec::ChunkCodec() : compressor_(libdeflate_alloc_compressor(kDeflateLevel)) {
  if (!compressor_) throw std::bad_alloc();
}

void ChunkCodec::pack(std::span<const std::byte> raw, std::size_t element_size,
                      std::vector<std::byte>& packed) {
  const std::uint64_t mark = mark_of(raw) ^ element_size;
  for (const Known& known : known_) {
    if (known.mark != mark || known.element_size != element_size || known.raw.size() != raw.size()) continue;
    if (!raw.empty() && std::memcmp(known.raw.data(), raw.data(), raw.size()) != 0) continue;
    packed = known.packed;
    return;
  }
  compress(raw, element_size, packed);
  if (known_.size() < kMostKnown) known_.emplace_back();
  Known& oldest = known_[oldest_];
  oldest_ = (oldest_ + 1) % kMostKnown;
  oldest.mark = mark;
  oldest.element_size = element_size;
  oldest.raw.assign(raw.begin(), raw.end());
  oldest.packed = packed;
}

void ChunkCodec::compress(std::span<const std::byte> raw, std::size_t element_size,
                          std::vector<std::byte>& packed) {
  if (element_size > 1) {
    shuffled_.resize(raw.size());
    shuffle_bytes(raw, element_size, shuffled_);
    raw = shuffled_;
  }
  scratch_.resize(libdeflate_zlib_compress_bound(compressor_.get(), raw.size()));
  const std::size_t size =
      libdeflate_zlib_compress(compressor_.get(), raw.data(), raw.size(), scratch_.data(), scratch_.size());
  packed.assign(scratch_.begin(), scratch_.begin() + static_cast<std::ptrdiff_t>(size));
}

}  // namespace coordreq
