#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "answers/checking/post_table.hpp"
#include "answers/checking/tally.hpp"
#include "base/thread_team.hpp"
#include "verify/budget.hpp"

namespace coordreq {

/// Which claims about a state's next values, or its way there, are to be proven, and how.
struct PostQuestion {
  const SystemSpec* spec = nullptr;
  const UniformGrid* grid = nullptr;
  const InputSpace* inputs = nullptr;
  std::size_t state = 0;
  const PostTable* claimed = nullptr;
  const std::vector<std::int64_t>* cells = nullptr;  ///< whose entries `claimed` has, ascending; all if empty
  std::string check;                                 ///< name of the finding
};

/// Receives how many posts of all are settled, on the thread of the caller. May be empty.
using PostProgress = std::function<void(std::size_t done, std::size_t all)>;

/// Parts of cells that are left for the next round take at most so many bytes together, and as many again
/// while it goes on.
inline constexpr double kMostBytesOfOpenSubboxes = 1024.0 * 1024;

/// Proves the entries of states' tables by enclosures in ball arithmetic: a little work for all, then more
/// and more for those that do not fit, until the budget ends. What follows its own present value is proven
/// once for all its cells; states with the same influences are enclosed together. An entry is wrong only if a
/// value that does come next is not in it.
/// @param questions that differ in state, table and name
/// @returns a finding for each; nothing where these do not do: jumps in a flow, another table's shape
[[nodiscard]] std::vector<std::optional<Finding>> check_outward_posts(
    const std::vector<PostQuestion>& questions, Budget& budget, const PostProgress& progress,
    ThreadTeam& team);

}  // namespace coordreq
