#include "results/chunk_codec.hpp"

#include <libdeflate.h>
#define ZLIB_CONST  // what is read is const
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>
#include <new>
#include <stdexcept>
#include <utility>

#include "base/requires.hpp"

namespace coordreq {
namespace {

// The size is a constant here because the compiler then makes vector code of the inner loop.
template <std::size_t size>
void shuffle_fixed(std::span<const std::byte> raw, std::byte* shuffled, std::size_t stride) {
  const std::size_t count = raw.size() / size;
  for (std::size_t byte = 0; byte < size; ++byte) {
    std::byte* out = shuffled + byte * stride;
    for (std::size_t i = 0; i < count; ++i) out[i] = raw[i * size + byte];
  }
}

/// Byte after byte of all elements, each `stride` bytes after the one before.
void shuffle(std::span<const std::byte> raw, std::size_t element_size, std::byte* shuffled,
             std::size_t stride) {
  switch (element_size) {
    case 2:
      return shuffle_fixed<2>(raw, shuffled, stride);
    case 4:
      return shuffle_fixed<4>(raw, shuffled, stride);
    case 8:
      return shuffle_fixed<8>(raw, shuffled, stride);
    default:
      std::ranges::copy(raw, shuffled);
  }
}

// No header, the largest window. A small table of hashes: zlib goes through all of it for each window.
constexpr int kRawWindow = -15;
constexpr int kMemoryLevel = 6;
constexpr std::size_t kOutputBytes = std::size_t{16} << 10U;  // at a time

/// Whether runs of one byte are so long that coding them alone packs best.
bool has_long_runs(std::span<const std::byte> bytes) {
  constexpr std::size_t kLong = 50;
  std::size_t ends = 0;
  for (std::size_t i = 1; i < bytes.size(); ++i) ends += bytes[i] != bytes[i - 1] ? 1U : 0U;
  return ends * kLong < bytes.size();
}

/// A hash of some positions, so that a chunk is compared as a whole with hardly any that it is not equal to.
std::uint64_t mark_of(std::span<const std::byte> bytes) {
  constexpr std::size_t kLooks = 256;
  std::uint64_t mark = bytes.size();
  std::uint64_t sample = 0;
  const std::size_t step = std::max(sizeof(sample), bytes.size() / kLooks);
  for (std::size_t at = 0; at + sizeof(sample) <= bytes.size(); at += step) {
    std::memcpy(&sample, bytes.data() + at, sizeof(sample));
    mark = (mark ^ sample) * 0x9E3779B97F4A7C15U;
    mark ^= mark >> 32U;
  }
  return mark;
}

}  // namespace

void shuffle_bytes(std::span<const std::byte> raw, std::size_t element_size, std::span<std::byte> shuffled) {
  REQUIRES(raw.size() == shuffled.size() && raw.size() % element_size == 0);
  shuffle(raw, element_size, shuffled.data(), raw.size() / element_size);
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
    // Without an argument for the length found, another length than that of the buffer is an error.
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

void ChunkCodec::Free::operator()(z_stream* stream) const {
  deflateEnd(stream);
  delete stream;
}

ChunkCodec::ChunkCodec(std::shared_ptr<KnownChunks> known)
    : stream_(new z_stream{}), known_(std::move(known)) {
  if (deflateInit2(stream_.get(), kDeflateLevel, Z_DEFLATED, kRawWindow, kMemoryLevel, Z_DEFAULT_STRATEGY) !=
      Z_OK) {
    throw std::bad_alloc();
  }
}

std::vector<ChunkCodec> ChunkCodec::make(int count) {
  const auto known = std::make_shared<KnownChunks>(count);
  std::vector<ChunkCodec> codecs;
  for (int k = 0; k < count; ++k) codecs.emplace_back(known);
  return codecs;
}

bool KnownChunks::find(std::span<const std::byte> bytes, std::vector<std::byte>& packed) const {
  const std::uint64_t mark = mark_of(bytes);
  const std::shared_lock lock(mutex_);
  const auto known = std::ranges::find_if(known_, [&](const Known& one) {
    return one.mark == mark && one.bytes.size() == bytes.size() &&
           (bytes.empty() || std::memcmp(one.bytes.data(), bytes.data(), bytes.size()) == 0);
  });
  if (known == known_.end()) return false;
  packed = known->packed;
  return true;
}

void KnownChunks::add(std::vector<std::byte>& bytes, std::span<const std::byte> packed) {
  Known known{.mark = mark_of(bytes), .bytes = {}, .packed = {packed.begin(), packed.end()}};
  const std::lock_guard lock(mutex_);
  if (known_.size() < most_) known_.emplace_back();
  known.bytes.swap(bytes);
  std::swap(known_[oldest_], known);
  bytes.swap(known.bytes);
  oldest_ = (oldest_ + 1) % most_;
}

void ChunkCodec::begin(std::size_t bytes, std::size_t element_size) {
  shuffled_.assign(bytes, std::byte{0});
  element_size_ = element_size;
  elements_ = 0;
}

void ChunkCodec::put(std::span<const std::byte> raw) {
  const std::size_t all = shuffled_.size() / element_size_, count = raw.size() / element_size_;
  REQUIRES(raw.size() % element_size_ == 0 && elements_ + count <= all);
  shuffle(raw, element_size_, shuffled_.data() + elements_, all);
  elements_ += count;
}

void ChunkCodec::finish(std::vector<std::byte>& packed) {
  if (known_->find(shuffled_, packed)) return;
  compress(packed);
  known_->add(shuffled_, packed);
}

void ChunkCodec::pack(std::span<const std::byte> raw, std::size_t element_size,
                      std::vector<std::byte>& packed) {
  begin(raw.size(), element_size);
  put(raw);
  finish(packed);
}

void ChunkCodec::compress(std::vector<std::byte>& packed) {
  // zlib's header and checksum stand around a raw stream: libdeflate's checksum is many times as fast.
  constexpr std::array<std::byte, 2> kHeader = {std::byte{0x78}, std::byte{0x01}};
  constexpr std::size_t kChecksum = 4;
  packed.assign(kHeader.begin(), kHeader.end());
  deflate_raw(packed);
  const std::uint32_t checksum = libdeflate_adler32(1, shuffled_.data(), shuffled_.size());
  for (std::size_t i = kChecksum; i-- > 0;) packed.push_back(static_cast<std::byte>(checksum >> (8 * i)));
}

void ChunkCodec::deflate_raw(std::vector<std::byte>& packed) {
  z_stream& stream = *stream_;
  std::array<std::byte, kOutputBytes> output;
  const auto make_room = [&] {
    stream.next_out = reinterpret_cast<Bytef*>(output.data());
    stream.avail_out = static_cast<uInt>(output.size());
  };
  deflateReset(&stream);
  make_room();
  stream.avail_in = 0;
  deflateParams(&stream, kDeflateLevel, has_long_runs(shuffled_) ? Z_RLE : Z_DEFAULT_STRATEGY);
  stream.next_in = reinterpret_cast<const Bytef*>(shuffled_.data());
  stream.avail_in = static_cast<uInt>(shuffled_.size());
  for (int state = Z_OK; state != Z_STREAM_END;) {
    state = deflate(&stream, Z_FINISH);
    if (state != Z_OK && state != Z_STREAM_END) throw std::logic_error("a chunk is packed in part");
    packed.insert(packed.end(), output.begin(), output.end() - static_cast<std::ptrdiff_t>(stream.avail_out));
    make_room();
  }
}

}  // namespace coordreq
