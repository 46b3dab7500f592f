#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/thread_team.hpp"

namespace coordreq {

/// Fills `out` with bytes [begin, begin + count) of something; called from several threads at once.
using FillBytes = std::function<void(std::uint64_t begin, std::uint64_t count, std::byte* out)>;

/// Whether the file is what is left of a block file, or may be: nothing there, or nothing in it.
[[nodiscard]] bool may_be_block_file(const std::string& path);

/// Writes a long string of bytes as a file of compressed blocks. Each has its number and a checksum over all
/// of it, and an empty one is the last: a byte that is damaged, missing, or from another place shows.
///
/// Format: the signature, then for each block four 32-bit little-endian numbers (its number from 0 on, bytes
/// once unpacked, bytes packed, CRC-32 of these three and what follows) and the deflate stream.
///
/// Memory: a block of kBlockBytes a thread, and as much again for the packed ones.
class BlockFileWriter {
 public:
  static constexpr std::uint64_t kBlockBytes = std::uint64_t{1} << 20U;

  /// @param progress called now and then by the calling thread; what it throws ends the writing
  /// @throws IoError naming `where`, as all functions here
  BlockFileWriter(const std::string& path, std::string where, ThreadTeam& team,
                  std::function<void()> progress);
  ~BlockFileWriter();
  BlockFileWriter(const BlockFileWriter&) = delete;
  BlockFileWriter& operator=(const BlockFileWriter&) = delete;

  /// Appends bytes; they begin a block.
  void add(std::uint64_t bytes, const FillBytes& fill);
  /// REQUIRES: all has been added.
  void finish();

 private:
  struct Scratch;
  void put(std::uint64_t raw_bytes, std::span<const std::byte> packed);
  void check() const;

  std::string where_;
  ThreadTeam& team_;
  std::function<void()> progress_;
  std::ofstream file_;
  std::vector<Scratch> scratch_;                // one a thread
  std::vector<std::vector<std::byte>> packed_;  // one a block of a batch
  std::uint32_t blocks_ = 0;
};

/// Reads such a file from its beginning to its end.
class BlockFileReader {
 public:
  /// Goes through the whole file, so that no later read finds it damaged.
  /// @param what it should be, for messages: "checkpoint"
  /// @throws IoError if it cannot be read; ResultsError if it is something else, or damaged
  BlockFileReader(const std::string& path, std::string what);

  /// The next `count` bytes. @throws ResultsError if there are no more
  void read(std::uint64_t count, std::byte* out);
  /// True after the last byte.
  [[nodiscard]] bool at_end();

 private:
  struct Block {
    std::uint32_t raw_bytes = 0;
    std::vector<std::byte> packed;
  };
  void rewind();
  void read_block(Block& block);
  void read_exactly(void* out, std::size_t count);
  void next_block();
  [[noreturn]] void fail(const std::string& reason) const;

  std::string path_;
  std::string what_;
  std::ifstream file_;
  std::uint32_t blocks_ = 0;  ///< that have been read
  Block packed_;
  std::vector<std::byte> raw_;  ///< the block under way
  std::size_t position_ = 0;    ///< in it
  bool ended_ = false;
};

}  // namespace coordreq
