#pragma once

#include <cstdint>
#include <vector>

#include "answers/checking/cell_tubes.hpp"
#include "answers/checking/claims.hpp"
#include "answers/checking/posts.hpp"
#include "model/input_space.hpp"
#include "model/uniform_grid.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// How the posts of a check relate to those of the analysis: what a difference between claim and check means.
enum class PostsAre : std::uint8_t {
  those_of_the_result,  ///< every claim must hold exactly
  perhaps_others,  ///< also sound, but perhaps not those of the analysis that wrote the file: a claim of more
                   ///< safety is wrong, one of less is left open
};

/// The data that all checks use. Posts are not there yet while sizes are compared.
struct CheckContext {
  const ProblemSpec* spec = nullptr;
  const UniformGrid* grid = nullptr;
  const InputSpace* inputs = nullptr;
  const Claims* claims = nullptr;
  const Posts* posts = nullptr;
  const Tubes* tubes = nullptr;  ///< null: cells are safe at the samples alone
  PostsAre posts_are = PostsAre::those_of_the_result;
  bool is_full = false;  ///< checks that go over all cells many times are requested, too

  /// Posts may be others than those of the analysis: a claim of less safety is left open.
  [[nodiscard]] bool sound_only() const { return posts_are == PostsAre::perhaps_others; }
};

}  // namespace coordreq
