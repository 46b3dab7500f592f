#pragma once

#include <cstdint>
#include <vector>

#include "answers/requirements/result_requirement.hpp"
#include "base/thread_team.hpp"
#include "expression/program.hpp"
#include "model/uniform_grid.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// What is found about a cell and the region of a requirement. How hard the analysis tries to tell them apart
/// decides which cells it counts; that it tells no more apart than are is checked.
enum class Meeting : std::uint8_t {
  off,      ///< they do not meet: the cell must not be counted
  doubted,  ///< nor must this one, since the analysis tells them apart, but here that is neither shown nor
            ///< refuted
  perhaps,  ///< they do not, or are not told apart: the cell may be counted, if another version did
  counted,  ///< they have a point in common, or are not told apart: the cell must be counted
};

/// All cells and one region (contract, section 2, `where`), remembered for the states that `where` mentions.
class RegionJudge {
 public:
  /// @param same_version the file is written by this version of the program, which tells apart what it told
  RegionJudge(const ProblemSpec& spec, const Program& where, const UniformGrid& grid, bool same_version,
              ThreadTeam& team);

  [[nodiscard]] Meeting of(std::int64_t cell) const {
    std::int64_t number = 0;
    for (const std::size_t i : states_) number = number * (*grid_)[i].count + grid_->index(cell, i);
    return meetings_[static_cast<std::size_t>(number)];
  }

 private:
  const UniformGrid* grid_;
  std::vector<std::size_t> states_;  ///< mentioned
  std::vector<Meeting> meetings_;    ///< row-major over them
};

/// What is found about a region and what lies beyond one side of the domain.
enum class Reach : std::uint8_t {
  never,    ///< natural interval evaluation over all that lies there shows that it does not reach there
  not_far,  ///< it does not, but that takes more to see
  open,     ///< neither shown nor refuted
  reached,  ///< a point there is in the region
};

/// @pre the side is `unsafe`
[[nodiscard]] Reach reach_beyond(const ProblemSpec& spec, const Program& where, const UniformGrid& grid,
                                 const ResultSide& side);

}  // namespace coordreq
