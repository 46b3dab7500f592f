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

/// What a difference between a claim and its check means.
enum class PostsAre : std::uint8_t {
  those_of_the_result,  ///< every claim must be met exactly
  perhaps_others,  ///< also sound, but perhaps not those of the analysis that wrote the file: a claim of more
                   ///< safety is wrong, one of less is left open
};

/// What all checks stand on. Sizes are compared before there are posts.
struct CheckGround {
  const ProblemSpec* spec = nullptr;
  const UniformGrid* grid = nullptr;
  const InputSpace* inputs = nullptr;
  const Claims* claims = nullptr;
  const Posts* posts = nullptr;
  const Tubes* tubes = nullptr;  ///< null: only the samples count
  PostsAre posts_are = PostsAre::those_of_the_result;
  bool is_full = false;  ///< what takes many looks at all cells is asked for too

  /// A claim of less safety is left open.
  [[nodiscard]] bool sound_only() const { return posts_are == PostsAre::perhaps_others; }
};

}  // namespace coordreq
