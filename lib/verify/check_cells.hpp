#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/thread_team.hpp"
#include "model/input_space.hpp"
#include "model/uniform_grid.hpp"
#include "spec/problem_spec.hpp"
#include "verify/cell_tubes.hpp"
#include "verify/claims.hpp"
#include "verify/posts.hpp"
#include "verify/tally.hpp"

namespace coordreq {

/// What a difference between a claim and its check means.
enum class PostsAre : std::uint8_t {
  those_of_the_result,  ///< every claim must be met exactly
  perhaps_others,  ///< also sound, but perhaps not those of the analysis that wrote the file: a claim of more
                   ///< safety is wrong, one of less is left open
};

struct CellCheck {
  const ProblemSpec* spec = nullptr;
  const UniformGrid* grid = nullptr;
  const InputSpace* inputs = nullptr;
  const Claims* claims = nullptr;
  const Posts* posts = nullptr;
  const Tubes* tubes = nullptr;  ///< null: only the samples count
  PostsAre posts_are = PostsAre::those_of_the_result;
  std::vector<std::int64_t> cells;  ///< to be checked, ascending; empty: all
  std::function<void(std::int64_t done, std::int64_t all)>
      progress;  ///< may be empty; called by the caller's thread
};

/// Checks everything that is said about single cells, straight from the definitions, one cell after the other
/// and for each every joint input. With the conventions that a pair without post is worth 0, one that has
/// left safely and every cell of K are worth infinity, and that a pair whose tube is not safe has no post:
/// - S by its definition;
/// - each cell of K keeps an allowed input whose post lies in K (`given`: every allowed input, and there is
/// one);
/// - for x in S but not in K: collision_time(x) = 1 + max (`given`: min) over allowed u of min over y in f(x,
/// u) of
///   collision_time(y), 1 without allowed inputs. By induction on the time no cell outside K could be in a
///   larger K;
/// - for x in K: delay(x) = 1 + min over u in IND_C(x), y in f(x, u) of delay(y), where cells outside K and
/// pairs
///   without post are worth -1. By induction on the delay that is membership in every layer, and the reason
///   why a cell is not in the next;
/// - triggers, and stored actions and controllers.
[[nodiscard]] std::vector<Finding> check_cells(const CellCheck& check, ThreadTeam& team);

}  // namespace coordreq
