#pragma once

#include <cstdint>
#include <vector>

#include "model/input_space.hpp"
#include "model/uniform_grid.hpp"
#include "spec/problem_spec.hpp"
#include "verify/budget.hpp"

namespace coordreq {

/// The work of finding the posts that checks rest on, roughly.
struct WorkOfPosts {
  Work of_all = 0;
  Work of_cell = 0;  ///< those of one cell, with all inputs
};
/// @param stored the file has posts that are not exact, which need not be found then
[[nodiscard]] WorkOfPosts work_of_posts(const ProblemSpec& spec, const UniformGrid& grid,
                                        const InputSpace& inputs, bool stored);

}  // namespace coordreq
