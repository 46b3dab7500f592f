#pragma once

#include <functional>
#include <string>

namespace coordreq {

/// A file that appears whole or not at all: its content is written to a temporary file in the same folder,
/// which commit() syncs and gives its name. Without commit() the destructor removes it, and what was there
/// before stays untouched.
///
/// Removes temporary files in the folder that killed processes of this machine have left.
///
/// Where `path` is a symbolic link, the file that it points to is replaced and the link stays. A replaced
/// file keeps its permission bits.
class OutputFile {
 public:
  /// Makes the temporary file, empty.
  /// @param what a label of the content, for messages
  /// @param suffix of the temporary file, whose name begins with that of `path`: for remove_unfinished().
  /// Empty:
  ///   any name
  /// @throws IoError if the folder is missing or no file can be made in it, or `path` is a folder, a device,
  ///   a pipe or a file without write permission
  explicit OutputFile(const std::string& path, std::string what = "the results",
                      const std::string& suffix = "");
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Path of the file to write to.
  [[nodiscard]] const std::string& temporary() const { return temporary_; }

  /// @throws IoError if the content could not be brought to the disk
  void commit();
  /// commit(), unless there is a file of this name already. @returns false if there is
  [[nodiscard]] bool commit_new();

 private:
  std::string what_;
  std::string target_;  // links resolved
  std::string folder_;
  std::string temporary_;  // empty once committed
};

/// Removes what processes that were killed have left of an OutputFile with this path and suffix.
/// @pre unchecked: no other process of another machine writes it.
void remove_unfinished(const std::string& path, const std::string& suffix);

/// Makes a file that appears whole or not at all (OutputFile): `write` fills the temporary one, whose path it
/// is given.
/// @param what a label of the content, for messages: "the results"
/// @throws IoError naming `path` where `write` throws an hdf5::Failure or the file cannot be made; else what
///   `write` throws
void write_whole_file(const std::string& path, const std::string& what,
                      const std::function<void(const std::string& temporary)>& write);

}  // namespace coordreq
