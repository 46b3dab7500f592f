#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/archive.hpp"
#include "base/thread_team.hpp"
#include "ranks/ranks.hpp"
#include "results/checkpoint_file.hpp"
#include "results/output_file.hpp"

namespace coordreq {

/// The name of a checkpoint in messages, and the end of names of unfinished files.
inline constexpr const char* kCheckpointName = "the checkpoint";
inline constexpr const char* kUnfinished = ".new";

/// The checkpoint of several processes is a folder: a *manifest* with all that does not lie in rows of the
/// grid, and of each process a *segment*, a file with the rows that it owns.
///
/// A set of segments counts from the moment at which the manifest that names their digests has its name;
/// until then the older set stays. Any number of processes reads it: each the rows that it holds, from the
/// segments that have them.
class CheckpointSegments {
 public:
  /// @pre unchecked: `ranks` outlives this object.
  CheckpointSegments(std::string folder, Ranks& ranks) : folder_(std::move(folder)), ranks_(&ranks) {}

  [[nodiscard]] static std::string manifest(const std::string& folder);
  [[nodiscard]] Ranks& ranks() const { return *ranks_; }

  /// A new segment of this process, to which records are added.
  /// @throws IoError, as all that follows up to agree()
  void start(std::function<void()> progress);
  void begin(const std::string& section);
  void add(const NumberRows& all, ThreadTeam::Range local_rows);
  /// Brings the segment to the disk.
  void finish();

  /// Together: says whether all of that has gone well here. @returns whether it has everywhere
  [[nodiscard]] bool agree(bool is_well);
  /// Writes into the manifest the segments that all processes have agreed on.
  void describe(CheckpointWriter& manifest) const;
  /// Together: the new segments count, or do not; those that do not count are removed.
  void settle(bool is_kept);

  /// Reads what a manifest says, if it says anything. @returns false if that is not possible
  [[nodiscard]] bool take(CheckpointReader& manifest);
  /// Together: looks at all segments, each process at some.
  /// @throws IoError if one cannot be read; ResultsError if it is damaged or of another checkpoint
  void check() const;
  /// The lists of this section are read from now on.
  void read_from(const std::string& section);
  /// Fills in the rows of the next list. @returns false if the segments have other rows
  [[nodiscard]] bool read(const NumberRows& all, std::span<const ThreadTeam::Range> held);

  void close();  ///< nothing is read any more

  /// Removes segments that do not count, whichever process has left them; or all. By one process.
  void remove_others() const;
  void remove_all() const;

 private:
  /// Segments that belong together.
  struct Set {
    std::int64_t number = 0;
    std::vector<std::int64_t> bounds = {0};  ///< segment p has the rows [bounds[p], bounds[p + 1])
    std::vector<std::string> digests;        ///< SHA-256
  };

  [[nodiscard]] std::string path(std::int64_t set, std::size_t segment) const;
  [[nodiscard]] bool read_segment(std::size_t segment, const NumberRows& all, ThreadTeam::Range run);
  template <class IsKept>
  void remove_unless(const IsKept& is_kept) const;

  std::string folder_;
  Ranks* ranks_;
  Set set_;  ///< that counts
  Set next_;
  std::int64_t end_ = 0;  ///< of the rows in the new segment
  std::string digest_;    ///< of the new segment
  std::optional<OutputFile> output_;
  std::optional<CheckpointWriter> writer_;
  std::map<std::size_t, CheckpointReader> readers_;  ///< [segment]
  std::string section_;                              ///< that is read
  std::size_t item_ = 0;                             ///< its list that is next
};

}  // namespace coordreq
