#include "results/block_file.hpp"

#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <new>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/error.hpp"
#include "results/chunk_codec.hpp"

namespace coordreq {
namespace {

constexpr std::string_view kSignature = "coordreq-blocks-1\n";
constexpr std::size_t kHeadBytes = 16;
/// Blocks to compress between two writes.
constexpr std::size_t kBlocksPerThread = 4;

using Head = std::array<std::byte, kHeadBytes>;

void put_number(Head& head, std::size_t place, std::uint32_t number) {
  for (std::size_t i = 0; i < 4; ++i) head[4 * place + i] = static_cast<std::byte>(number >> (8 * i) & 255U);
}

std::uint32_t number_at(const Head& head, std::size_t place) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i)
    number |= std::to_integer<std::uint32_t>(head[4 * place + i]) << (8 * i);
  return number;
}

std::uint32_t checksum(const Head& head, std::span<const std::byte> packed) {
  const std::uint32_t sum = libdeflate_crc32(0, head.data(), kHeadBytes - 4);
  // Without bytes there may be no address, which the library takes for something else.
  return packed.empty() ? sum : libdeflate_crc32(sum, packed.data(), packed.size());
}

std::string because(int error) {
  return std::generic_category().message(error == 0 ? EIO : error);
}

}  // namespace

bool may_be_block_file(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::symlink_status(path, error);
  if (!std::filesystem::exists(status)) return true;
  if (!std::filesystem::is_regular_file(status)) return false;
  std::ifstream file(path, std::ios::binary);
  std::string begin(kSignature.size(), '\0');
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return file.gcount() == 0 || begin == kSignature;
}

struct BlockFileWriter::Scratch {
  struct Free {
    void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
  };
  std::unique_ptr<libdeflate_compressor, Free> compressor{libdeflate_alloc_compressor(kDeflateLevel)};
  std::vector<std::byte> raw;

  void pack(std::uint64_t begin, std::uint64_t count, const FillBytes& fill, std::vector<std::byte>& packed) {
    if (!compressor) throw std::bad_alloc();
    raw.resize(count);
    fill(begin, count, raw.data());
    packed.resize(libdeflate_deflate_compress_bound(compressor.get(), count));
    packed.resize(
        libdeflate_deflate_compress(compressor.get(), raw.data(), count, packed.data(), packed.size()));
  }
};

BlockFileWriter::BlockFileWriter(const std::string& path, std::string where, ThreadTeam& team,
                                 std::function<void()> progress)
    : where_(std::move(where)),
      team_(team),
      progress_(std::move(progress)),
      file_(path, std::ios::binary),
      scratch_(static_cast<std::size_t>(team.size())),
      packed_(static_cast<std::size_t>(team.size()) * kBlocksPerThread) {
  file_.write(kSignature.data(), static_cast<std::streamsize>(kSignature.size()));
  check();
}

BlockFileWriter::~BlockFileWriter() = default;

void BlockFileWriter::add(std::uint64_t bytes, const FillBytes& fill) {
  const std::uint64_t blocks = (bytes + kBlockBytes - 1) / kBlockBytes;
  for (std::uint64_t first = 0; first < blocks; first += packed_.size()) {
    const std::uint64_t count = std::min<std::uint64_t>(packed_.size(), blocks - first);
    const auto size_of = [&](std::uint64_t block) {
      return std::min(kBlockBytes, bytes - block * kBlockBytes);
    };
    team_.for_each(static_cast<std::int64_t>(count), 1, [&](ThreadTeam::Range range, int worker) {
      for (auto i = static_cast<std::uint64_t>(range.begin); i < static_cast<std::uint64_t>(range.end); ++i) {
        scratch_[static_cast<std::size_t>(worker)].pack((first + i) * kBlockBytes, size_of(first + i), fill,
                                                        packed_[i]);
      }
    });
    for (std::uint64_t i = 0; i < count; ++i) put(size_of(first + i), packed_[i]);
    if (progress_) progress_();
  }
}

void BlockFileWriter::finish() {
  put(0, {});
  file_.close();
  check();
}

void BlockFileWriter::put(std::uint64_t raw_bytes, std::span<const std::byte> packed) {
  Head head{};
  put_number(head, 0, blocks_++);
  put_number(head, 1, static_cast<std::uint32_t>(raw_bytes));
  put_number(head, 2, static_cast<std::uint32_t>(packed.size()));
  put_number(head, 3, checksum(head, packed));
  file_.write(reinterpret_cast<const char*>(head.data()), kHeadBytes);
  file_.write(reinterpret_cast<const char*>(packed.data()), static_cast<std::streamsize>(packed.size()));
  check();
}

void BlockFileWriter::check() const {
  if (!file_) throw IoError("cannot write: " + because(errno), where_);
}

BlockFileReader::BlockFileReader(const std::string& path, std::string what)
    : path_(path), what_(std::move(what)) {
  rewind();
  do {
    read_block(packed_);
  } while (packed_.raw_bytes > 0);
  if (file_.peek() != std::ifstream::traits_type::eof()) fail("something follows its end");
  rewind();
}

void BlockFileReader::rewind() {
  file_ = std::ifstream();
  errno = 0;
  file_.open(path_, std::ios::binary);
  if (!file_) throw IoError("cannot be read: " + because(errno), path_);
  std::string signature(kSignature.size(), '\0');
  file_.read(signature.data(), static_cast<std::streamsize>(signature.size()));
  if (!file_ && !file_.eof()) throw IoError("cannot be read: " + because(errno), path_);
  if (!file_ || signature != kSignature) throw ResultsError(fmt::format("this is no {}", what_), path_);
  blocks_ = 0;
}

void BlockFileReader::read_exactly(void* out, std::size_t count) {
  file_.read(static_cast<char*>(out), static_cast<std::streamsize>(count));
  if (!file_) fail("it ends too early");
}

void BlockFileReader::read_block(Block& block) {
  Head head{};
  read_exactly(head.data(), head.size());
  block.raw_bytes = number_at(head, 1);
  const std::uint32_t packed_bytes = number_at(head, 2);
  // Before so much memory is asked for: a damaged size is no block of ours.
  const bool is_possible = number_at(head, 0) == blocks_ && block.raw_bytes <= BlockFileWriter::kBlockBytes &&
                           packed_bytes <= 2 * BlockFileWriter::kBlockBytes;
  if (is_possible) {
    block.packed.resize(packed_bytes);
    read_exactly(block.packed.data(), packed_bytes);
  }
  if (!is_possible || checksum(head, block.packed) != number_at(head, 3)) {
    fail(fmt::format("the checksum of block {} is wrong", blocks_));
  }
  ++blocks_;
}

void BlockFileReader::next_block() {
  read_block(packed_);
  raw_.resize(packed_.raw_bytes);
  position_ = 0;
  ended_ = raw_.empty();
  if (ended_) return;
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> unpacker(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  if (!unpacker) throw std::bad_alloc();
  const libdeflate_result result = libdeflate_deflate_decompress(
      unpacker.get(), packed_.packed.data(), packed_.packed.size(), raw_.data(), raw_.size(), nullptr);
  if (result != LIBDEFLATE_SUCCESS) fail(fmt::format("block {} cannot be unpacked", blocks_ - 1));
}

bool BlockFileReader::at_end() {
  if (!ended_ && position_ == raw_.size()) next_block();
  return ended_;
}

void BlockFileReader::read(std::uint64_t count, std::byte* out) {
  while (count > 0) {
    if (at_end()) fail("it holds less than it should");
    const std::size_t here = std::min<std::uint64_t>(count, raw_.size() - position_);
    std::memcpy(out, raw_.data() + position_, here);
    position_ += here;
    out += here;
    count -= here;
  }
}

void BlockFileReader::fail(const std::string& reason) const {
  throw ResultsError(fmt::format("this {} is damaged: {}", what_, reason), path_);
}

}  // namespace coordreq
