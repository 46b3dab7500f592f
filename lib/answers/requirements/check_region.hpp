#pragma once

#include <cstdint>
#include <vector>

#include "answers/requirements/result_requirement.hpp"
#include "base/thread_team.hpp"
#include "expression/program.hpp"
#include "model/uniform_grid.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The verdict on a cell and the region of a requirement. The effort of the analysis to show that they do not
/// meet decides which cells it counts; this check confirms that it counts all cells that meet the region.
enum class Meeting : std::uint8_t {
  off,      ///< cell and region do not meet: the cell must not be counted
  doubted,  ///< it must not be counted, since the analysis has shown that they do not meet; this check
            ///< neither shows nor refutes it
  perhaps,  ///< they do not meet, or it is not shown whether: another version may have counted the cell
  counted,  ///< they meet, or it is not shown that they do not: the cell must be counted
};

/// Judges cells against one region (contract, section 2, `where`); verdicts are remembered by the states that
/// `where` mentions.
class RegionJudge {
 public:
  /// @param same_version the file was written by this version of the program, which shows the same cells not
  ///   to meet
  RegionJudge(const ProblemSpec& spec, const Program& where, const UniformGrid& grid, bool same_version,
              ThreadTeam& team);

  [[nodiscard]] Meeting of(std::int64_t cell) const {
    std::int64_t number = 0;
    for (const std::size_t i : states_) number = number * (*grid_)[i].count + grid_->index(cell, i);
    return meetings_[static_cast<std::size_t>(number)];
  }

 private:
  const UniformGrid* grid_;
  std::vector<std::size_t> states_;  ///< that `where` mentions
  std::vector<Meeting> meetings_;    ///< row-major over states_
};

/// The verdict on a region and the states beyond one side of the domain.
enum class Reach : std::uint8_t {
  never,    ///< natural interval evaluation over all states there shows that the region does not reach them
  not_far,  ///< it does not reach them, but natural evaluation does not show it
  open,     ///< neither shown nor refuted
  reached,  ///< a state there is in the region
};

/// @pre the side is `unsafe`
[[nodiscard]] Reach reach_beyond(const ProblemSpec& spec, const Program& where, const UniformGrid& grid,
                                 const ResultSide& side);

}  // namespace coordreq
