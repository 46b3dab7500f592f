#pragma once

#include <cstdint>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/archive.hpp"
#include "base/json.hpp"
#include "results/chunk_codec.hpp"
#include "results/sha256.hpp"

// Lists of numbers in a plain file, made again every minute and read once. One after the other it has:
//
//     coordreq-checkpoint 3                        what it is, a line
//     {"spec": "1f...", ...}                       the header, a line
//     {"section": "stage0", ...}                   a section, a line; what follows belongs to it
//     {"type": "u1", "rows": 3, "length": 500}     a list, a line; then its blocks, and the SHA-256 of all
//     before end                                          a line; then the SHA-256 of all before
//
// The numbers of a list stand one after the other, little-endian. Cut into blocks of kBlockBytes, the last
// one shorter, they are packed by zlib, their bytes shuffled (see ChunkCodec); before each block stands its
// length, 4 bytes. A SHA-256 is 64 hexadecimal digits and the end of a line.
namespace coordreq {

/// Writes such a file. Memory: some blocks, 2 MiB.
class CheckpointWriter {
 public:
  /// @param where named in errors
  /// @param progress called now and then; what it throws ends the writing
  /// @throws IoError, as all functions here
  CheckpointWriter(const std::string& path, std::string where, const Json& header,
                   std::function<void()> progress);
  CheckpointWriter(const CheckpointWriter&) = delete;
  CheckpointWriter& operator=(const CheckpointWriter&) = delete;

  /// Begins a section: lists that are added from now on belong to it. @param more members of its head, an
  /// object
  void begin(const std::string& section, const Json& more);
  void add(const NumberRows& rows);
  /// @pre unchecked: all has been added. @returns the SHA-256 at the end of the file
  std::string finish();

 private:
  void put(std::string_view bytes);
  void put_block(std::size_t number_bytes);
  std::string put_digest();

  std::string where_;
  std::function<void()> progress_;
  std::ofstream file_;
  Sha256 digest_;
  ChunkCodec codec_;
  std::vector<std::byte> block_;
  std::vector<std::byte> packed_;
};

/// Reads such a file: sections by name, and their lists in the order in which they were added. Nothing in it
/// is trusted: what is read has its expected location, or is refused.
class CheckpointReader {
 public:
  /// Goes through the whole file, so that no later read finds it damaged.
  /// @throws IoError if it cannot be read; ResultsError if it is damaged, something else, or made by an
  /// earlier
  ///   version
  explicit CheckpointReader(const std::string& path);

  /// An object.
  [[nodiscard]] Json header() const;
  /// SHA-256 at its end.
  [[nodiscard]] const std::string& digest() const { return digest_; }

  /// Begins to read a section. @returns the members of its head; null if it is not there
  [[nodiscard]] Json begin(const std::string& section);
  /// Fills in the next list. @returns false if it has other numbers, or another count of them
  [[nodiscard]] bool read(const NumberRows& rows);
  /// Fills in rows of a list of the section. @param item number of the list @param first of its rows
  /// @param count of its rows. @returns false if it has other numbers, or another count of them
  /// @pre it would have these rows
  [[nodiscard]] bool read_some(std::size_t item, const NumberRows& rows, std::int64_t first,
                               std::int64_t count);

 private:
  class Scan;
  struct List {
    std::string type;
    std::int64_t rows = 0;
    std::int64_t length = 0;    ///< of a row
    std::streamoff offset = 0;  ///< of its first block
  };
  struct Section {
    std::string head;
    std::vector<List> lists;
  };

  std::string path_;
  std::ifstream file_;
  std::string header_;
  std::map<std::string, Section> sections_;
  std::string digest_;
  const Section* section_ = nullptr;
  std::size_t item_ = 0;  ///< that is next
  std::vector<std::byte> packed_;
  std::vector<std::byte> block_;
};

}  // namespace coordreq
