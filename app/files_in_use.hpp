#pragma once

#include <map>
#include <string>

#include "spec/spec_types.hpp"

// Files under names that no user has typed: what lies there may be something else that is still wanted.
namespace coordreq {

/// The files that one run of the program reads and writes, so that none replaces another.
///
/// Two paths are one file if they lead to the same device and inode, whatever links lie between; where
/// nothing is there yet, if they lead to one name in one folder.
class FilesInUse {
 public:
  /// @param what it is, for messages: "the spec". "-": standard input, where a file has been put there.
  void reads(const std::string& path, const std::string& what);

  /// @param option that names the file, for messages
  /// @throws UsageError if the file is read or is written already
  void writes(const std::string& path, const std::string& what, const std::string& option);

 private:
  std::map<std::string, std::string> uses_;  ///< what is said of the file, by its identity
};

/// For a command that reads one results file and writes one file. @throws UsageError if they are one
void check_output(const std::string& results, const std::string& output, const std::string& what);

/// @throws UsageError if there is a file that does not hold results of this very spec
void check_replaces_own_results(const std::string& path, const ProblemSpec& spec);

/// @param spec_sha256 of the results that the report is of
/// @throws UsageError if there is a file that is no report on results of this very spec
void check_replaces_own_report(const std::string& path, const std::string& spec_sha256);

}  // namespace coordreq
