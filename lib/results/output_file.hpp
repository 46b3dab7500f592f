#pragma once

#include <string>

namespace coordreq {

/// A file that appears whole or not at all: its content is written to a temporary file in the same folder,
/// which commit() syncs and gives its name. Without commit() the destructor removes it, and what was there
/// before stays untouched.
///
/// Where `path` is a symbolic link, the file that it points to is replaced and the link stays. A replaced
/// file keeps its permission bits.
class OutputFile {
 public:
  /// Makes the temporary file, empty.
  /// @param what the content in words, for messages
  /// @param suffix of the temporary file, to be put behind the name of `path`: one that was left behind is
  /// used
  ///   again then, and there can be one at a time only. Empty: any free name
  /// @throws IoError if the folder is missing or no file can be made in it, or `path` is a folder, a device,
  /// a pipe
  ///   or a file without write permission
  explicit OutputFile(const std::string& path, std::string what = "the results",
                      const std::string& suffix = "");
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Path of the file to write to.
  [[nodiscard]] const std::string& temporary() const { return temporary_; }

  /// @throws IoError if the content could not be brought to the disk
  void commit();

 private:
  std::string what_;
  std::string target_;  // links resolved
  std::string folder_;
  std::string temporary_;  // empty once committed
};

}  // namespace coordreq
