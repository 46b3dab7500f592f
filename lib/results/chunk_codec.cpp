#include "results/chunk_codec.hpp"

#include <isa-l/igzip_lib.h>
#include <libdeflate.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <stdexcept>

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

/// What packing comes to at most: as it is, in blocks with a header each, within the frame of zlib.
std::size_t most_packed(std::size_t bytes) {
  constexpr std::size_t kBlock = 65535, kHeader = 5, kFrame = 16;
  return bytes + (bytes / kBlock + 1) * kHeader + kFrame;
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

void ChunkCodec::Free::operator()(isal_zstream* stream) const {
  delete stream;
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
  scratch_.resize(most_packed(raw.size()));
  if (!stream_) stream_.reset(new isal_zstream());
  tables_.resize(ISAL_DEF_LVL1_DEFAULT);
  isal_deflate_stateless_init(stream_.get());
  stream_->hist_bits = 0;  // the greatest distance; the call before leaves it alone
  stream_->level = kDeflateLevel;
  stream_->level_buf = tables_.data();
  stream_->level_buf_size = static_cast<std::uint32_t>(tables_.size());
  stream_->gzip_flag = IGZIP_ZLIB;
  stream_->end_of_stream = 1;
  stream_->next_in =
      const_cast<std::uint8_t*>(reinterpret_cast<const std::uint8_t*>(raw.data()));  // only read
  stream_->avail_in = static_cast<std::uint32_t>(raw.size());
  stream_->next_out = reinterpret_cast<std::uint8_t*>(scratch_.data());
  stream_->avail_out = static_cast<std::uint32_t>(scratch_.size());
  if (isal_deflate_stateless(stream_.get()) != COMP_OK) throw std::logic_error("a chunk cannot be packed");
  packed.assign(scratch_.begin(), scratch_.begin() + static_cast<std::ptrdiff_t>(stream_->total_out));
}

}  // namespace coordreq
