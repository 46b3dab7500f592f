#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "base/archive.hpp"

namespace coordreq {

/// Writes lists of numbers into an HDF5 file, in groups, each list a dataset: compressed chunks, each with
/// the checksum of the library. Behind the end of what is HDF5's stands the SHA-256 of all that is before, so
/// that a byte that is damaged or missing anywhere shows.
///
/// Memory: a chunk, 1 MiB, and what the library takes for it.
class CheckpointWriter {
 public:
  /// @param where named in errors
  /// @param progress called now and then; what it throws ends the writing
  /// @throws IoError, as all functions here
  CheckpointWriter(std::string path, std::string where, std::function<void()> progress);
  ~CheckpointWriter();
  CheckpointWriter(const CheckpointWriter&) = delete;
  CheckpointWriter& operator=(const CheckpointWriter&) = delete;

  /// What is added from now on belongs to this group.
  void begin(const std::string& group);
  void add(const NumberRows& rows);
  void add(const std::string& text);
  /// REQUIRES: all has been added. @returns the SHA-256 at the end of the file
  std::string finish();

 private:
  struct Open;
  void guarded(const std::function<void()>& write);

  std::string path_;
  std::string where_;
  std::function<void()> progress_;
  std::unique_ptr<Open> open_;
};

/// Reads a whole file once, part of it in a child process (see try_in_child()), so that no later read finds
/// it damaged.
/// @returns the SHA-256 at its end
/// @throws IoError if it cannot be read; ResultsError if it is something else, or damaged
std::string check_checkpoint_file(const std::string& path);

/// Reads such a file: groups by name, and their lists in the order in which they were added.
class CheckpointReader {
 public:
  /// REQUIRES: check_checkpoint_file() has passed, here or in another process.
  /// @throws IoError if it cannot be read; ResultsError if it is something else
  explicit CheckpointReader(std::string path);
  ~CheckpointReader();
  CheckpointReader(const CheckpointReader&) = delete;
  CheckpointReader& operator=(const CheckpointReader&) = delete;

  /// What is read from now on is in this group. @returns whether it is there
  [[nodiscard]] bool begin(const std::string& group);
  /// Fills in the next list. @returns false if it has other numbers, or another count of them
  [[nodiscard]] bool read(const NumberRows& rows);
  /// Fills in rows of a list of the group. @param item number of the list @param first of its rows
  /// @param count of its rows. @returns false if it has other numbers, or another count of them
  [[nodiscard]] bool read_some(std::size_t item, const NumberRows& rows, std::int64_t first,
                               std::int64_t count);
  /// The next list as a text; nothing if it is none.
  [[nodiscard]] std::string read_text();

 private:
  struct Open;
  std::string path_;
  std::unique_ptr<Open> open_;
};

}  // namespace coordreq
