#pragma once

#include <cstdint>
#include <vector>

#include "base/thread_team.hpp"
#include "model/odometer.hpp"
#include "ranks/ranks.hpp"
#include "reach/abstraction.hpp"

namespace coordreq {

/// The entries of a table in full while they are computed, each for one choice of indices. One process
/// writes them into the table; of several each keeps those of its local choices, and in the end all receive
/// them and put into their tables what these hold.
class DividedEntries {
 public:
  /// Where entries lie: position = first + sum of index * stride.
  struct Positions {
    std::vector<std::int64_t> counts;   ///< of indices; choices are numbered row by row
    std::vector<std::int64_t> strides;  ///< one for each of them
    std::int64_t first = 0;
  };

  /// @param local numbers of the choices of this process
  /// @pre unchecked: the table, which has its final length, and `ranks`, null if there is one process,
  /// outlive this object.
  DividedEntries(TransitionTable& table, Positions positions, ThreadTeam::Range local, Ranks* ranks);

  /// The entry of a local choice. @param position of the entry
  [[nodiscard]] IndexRange& at(std::int64_t choice, std::int64_t position) {
    return ranks_ == nullptr ? table_->entries[static_cast<std::size_t>(position)]
                             : local_entries_[static_cast<std::size_t>(choice - local_.begin)];
  }

  /// Together, once all are there.
  void join();

 private:
  TransitionTable* table_;
  Positions positions_;
  ThreadTeam::Range local_;
  Ranks* ranks_;
  std::vector<IndexRange> local_entries_;
};

}  // namespace coordreq
