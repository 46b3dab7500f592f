#pragma once

#include <optional>

#include "answers/one_cell/cell_members.hpp"
#include "answers/one_cell/cell_posts.hpp"
#include "base/thread_team.hpp"
#include "engine/cell_set.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// TubeSets::beyond, with S from a results file. How far beyond a limit cells must be safe is a question to
/// all tubes, so that it is computed only when it is first needed. Not thread-safe.
class SafeBeyondFile {
 public:
  /// @pre the spec asks for safety between the samples. @pre unchecked: all outlive this object
  SafeBeyondFile(const ResultsReader& results, CellPosts& posts, ThreadTeam& team);

  /// Null if it is S.
  [[nodiscard]] CellMembers* members();

 private:
  const ResultsReader& results_;
  CellPosts& posts_;
  ThreadTeam& team_;
  bool is_known_ = false;
  std::optional<CellSet> cells_;
  std::optional<MembersByCell> members_;
};

}  // namespace coordreq
