#pragma once

#include <cstdint>
#include <vector>

#include "base/thread_team.hpp"
#include "model/odometer.hpp"
#include "ranks/ranks.hpp"
#include "reach/abstraction.hpp"

namespace coordreq {

/// The entries of a table in full while they are computed, each for one choice of indices. One process
/// writes them into the table; of several each keeps those of its own choices, and in the end all hear of
/// them and put into their tables what these hold.
class DividedEntries {
 public:
  /// Where entries lie: position = first + sum of index * stride.
  struct Places {
    std::vector<std::int64_t> counts;   ///< of indices; choices are numbered row by row
    std::vector<std::int64_t> strides;  ///< one for each of them
    std::int64_t first = 0;
  };

  /// @param own numbers of the choices of this process
  /// @pre unchecked: the table, which has its final length, and `ranks`, null if there is one process,
  /// outlive this object.
  DividedEntries(TransitionTable& table, Places places, ThreadTeam::Range own, Ranks* ranks);

  /// The entry of one of its own choices. @param position of the entry
  [[nodiscard]] IndexRange& at(std::int64_t choice, std::int64_t position) {
    return ranks_ == nullptr ? table_->entries[static_cast<std::size_t>(position)]
                             : part_[static_cast<std::size_t>(choice - own_.begin)];
  }

  /// Together, once all are there.
  void join();

 private:
  TransitionTable* table_;
  Places places_;
  ThreadTeam::Range own_;
  Ranks* ranks_;
  std::vector<IndexRange> part_;
};

}  // namespace coordreq
