#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/checkpoint_options.hpp"
#include "analysis/checkpoint_segments.hpp"
#include "answers/stage.hpp"
#include "base/archive.hpp"
#include "base/json.hpp"
#include "results/checkpoint_file.hpp"
#include "results/file_lock.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The state of an analysis in a file, so that it can go on after it was killed: of each stage that is
/// finished what it has found, and of the current fixed point its levels or sets.
///
/// 1. The file appears whole or not at all, and an older one stays until then; it has checksums of everything
/// (see
///    CheckpointWriter).
/// 2. It belongs to one spec, one controller file and one version of the program, by their SHA-256; for
///    another it is refused. Nothing else has an influence on the result.
/// 3. What stages load is read straight to where it is needed: nothing is held twice. Nothing in the file is
///    trusted, right checksums or not: see Archive.
/// 4. Saving takes at most a tenth of the time, however long it takes. Where it fails, work goes on.
/// 5. One process at a time has the file, from the construction of this object on.
///
/// The checkpoint of several processes is a folder with a manifest and segments (see CheckpointSegments), and
/// they call all functions together. The first one has the manifest, decides when to save, and reports to the
/// user.
class Checkpoint : public StageStore {
 public:
  struct Listener {
    /// Before and after there is a temporary file, and often in between; what it throws ends the work.
    std::function<void(bool has_temporary)> progress;
    /// A line for the user.
    std::function<void(const std::string&)> notice;
  };

  /// Goes through the file if there is one, else makes one in which nothing is saved yet.
  /// @pre unchecked: check_checkpoint(options) has passed.
  /// @param ranks the processes that share the folder; null: there is one, and a file
  /// @throws IoError if the file cannot be read, or another process has it; ResultsError if it is damaged,
  ///   none of ours, or of something else
  Checkpoint(CheckpointOptions options, const ProblemSpec& spec, Listener listener, Ranks* ranks = nullptr);

  /// From now on the current stage is this one. @returns this object
  StageStore* enter(const std::string& stage);
  [[nodiscard]] Kept take(const Serialise& load) override;
  void finish(Serialise save) override;
  void step(const Serialise& save) override;

  /// The file is of no more use.
  void remove();

 private:
  using Clock = std::chrono::steady_clock;
  struct Record {
    std::string stage;
    bool is_finished = false;
    Serialise save;
  };
  class Loading;
  class Saving;

  [[nodiscard]] bool is_first() const { return !segments_ || segments_->ranks().rank() == 0; }
  [[nodiscard]] bool take_or_make();
  void make_first();
  void open();
  void close();
  void check_identity();
  [[nodiscard]] bool next_record();
  [[nodiscard]] Json header() const;
  [[nodiscard]] bool is_due() const;
  void save(const Record* current);
  void write_records(CheckpointWriter* file, const Record* current);
  void replace(const Record* current);
  void replace_together(const Record* current);
  void commit(OutputFile& output);
  [[noreturn]] void refuse(const std::string& reason) const;

  /// The problem that the checkpoint belongs to.
  struct Identity {
    std::string spec;        ///< SHA-256
    std::string controller;  ///< likewise, empty without one
    std::string program;
  };

  CheckpointOptions options_;
  std::optional<CheckpointSegments> segments_;
  std::string file_;  ///< or manifest
  Identity identity_;
  Listener listener_;
  std::optional<FileLock> lock_;
  std::unique_ptr<CheckpointReader> reader_;  ///< while there is something to take up
  std::size_t records_read_ = 0;              ///< records that have been read
  std::string next_stage_;                    ///< of the record that is to be read
  bool next_is_finished_ = false;
  std::string stage_;  ///< the current one
  std::vector<Record> finished_;
  bool is_failing_ = false;                ///< the last one could not be saved
  Clock::time_point saved_;                ///< when that was last done, or begun
  std::chrono::duration<double> cost_{0};  ///< how long it took
};

/// Tries whether the file can be written; leaves nothing behind. A folder is made if there is none.
/// @param is_folder whether several processes have a folder
/// @throws IoError if not; UsageError if the file is there already and not to be resumed
void check_checkpoint(const CheckpointOptions& options, bool is_folder);

}  // namespace coordreq
