#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/checkpoint_options.hpp"
#include "analysis/saved_lists.hpp"
#include "base/thread_team.hpp"
#include "engine/level_map.hpp"
#include "engine/row_bytes.hpp"
#include "engine/row_engine.hpp"
#include "results/block_file.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// Levels, or sets, with which a stage was broken off or finished.
template <class State>
struct SavedState {
  State state;
  bool is_finished = false;
};

/// The state of an analysis in a file, so that it can go on after it was killed: of each stage that is
/// finished what it has found, and of a fixed point that is under way its levels or sets.
///
/// 1. The file appears whole or not at all, and an older one stays until then; every block has a checksum.
/// 2. It belongs to one spec, one controller file and one version of the program, by their SHA-256; for
///    another it is refused. Nothing else has an influence on the result.
/// 3. Stages come in the order in which they are worked out, which is the same in the file. So it is read
///    once, from front to back, straight to where the levels are needed: nothing is held twice.
/// 4. Saving takes at most a tenth of the time, however long it takes. Where it fails, work goes on.
class Checkpoint {
 public:
  struct Listener {
    /// Before and after there is a temporary file, and often in between; what it throws ends the work.
    std::function<void(bool has_temporary)> progress;
    /// A line for the user.
    std::function<void(const std::string&)> notice;
  };

  /// Goes through the file, if there is one, before any work is done.
  /// REQUIRES: check_checkpoint(options) has passed.
  /// @throws IoError if the file cannot be read; ResultsError if it is damaged, none of ours, or of something
  ///   else
  Checkpoint(CheckpointOptions options, const ProblemSpec& spec, ThreadTeam& team, Listener listener);

  /// What the file has of a stage; none, or false, if it has nothing.
  /// @param load makes use of the numbers and then reads all lists
  /// @throws ResultsError if that is of another kind
  [[nodiscard]] bool take_lists(
      const std::string& stage,
      const std::function<void(const std::vector<std::uint64_t>& numbers, const ReadList& read)>& load);
  [[nodiscard]] std::optional<SavedState<LevelMap>> take_levels(const std::string& stage,
                                                                const RowEngine& engine);
  [[nodiscard]] std::optional<SavedState<std::vector<CellSet>>> take_sets(const std::string& stage,
                                                                          const CellSet& like);

  /// The stage is over. From now on the file is to hold its result, which must stay where it is in memory:
  /// the lists of an object that is moved do.
  void finish(const std::string& stage, SavedLists lists);
  void finish(const std::string& stage, const LevelMap& levels);
  void finish(const std::string& stage, const std::vector<CellSet>& sets);

  /// The stage under way has come this far; saves it if it is time.
  void step(const std::string& stage, std::span<const RowBytes> state);

  /// The file is of no more use.
  void remove();

 private:
  using Clock = std::chrono::steady_clock;
  /// What the file says of one stage before its rows.
  struct Record {
    std::string stage;
    bool is_finished = false;
    std::vector<std::uint64_t> numbers;
    std::vector<RowBytes> rows;
  };

  void open();
  [[nodiscard]] std::optional<Record> next_record(const std::string& stage);
  template <class Level>
  [[nodiscard]] LevelMap read_levels(const RowBytes& stored, const RowEngine& engine);
  void read_rows(const RowBytes& stored, std::int64_t rows, std::int64_t row_bytes,
                 const std::function<std::byte*(std::int64_t)>& row_at);
  void end_record();
  void add_finished(Record record);
  [[nodiscard]] bool is_due() const;
  void save(const Record* under_way);
  void write(const Record* under_way);
  [[noreturn]] void refuse(const std::string& reason) const;

  /// What it belongs to.
  struct Identity {
    std::string spec;        ///< SHA-256
    std::string controller;  ///< likewise, empty without one
    std::string program;
  };

  CheckpointOptions options_;
  Identity identity_;
  ThreadTeam& team_;
  Listener listener_;
  std::unique_ptr<BlockFileReader> reader_;  ///< while there is something to take up
  std::vector<Record> finished_;
  bool is_failing_ = false;                ///< the last one could not be saved
  Clock::time_point saved_;                ///< when that was last done, or begun
  std::chrono::duration<double> cost_{0};  ///< how long it took
};

/// Tries whether the file can be written; leaves nothing behind.
/// @throws IoError if not; UsageError if the file is there already and not to be resumed, or if the file to
///   write it to is there and none of ours
void check_checkpoint(const CheckpointOptions& options);

}  // namespace coordreq
