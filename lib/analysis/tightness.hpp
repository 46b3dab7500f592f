#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "analysis/advice.hpp"
#include "answers/analysis_context.hpp"
#include "base/json.hpp"

namespace coordreq {

/// The excess of posts: the cells that they have in a dimension beyond those that solutions reach from
/// corners, middles of faces and the centre of their cell, under disturbances that stay where they are: at
/// their lower ends, in the middle, at their upper ends. Solutions are followed without a guarantee; a post
/// that is as tight as can be may have a cell more, as they are few.
struct Tightness {
  /// A post that was looked at.
  struct Post {
    std::size_t state = 0;
    std::vector<std::int64_t> cell;  ///< index of each state of the spec
    std::int64_t input = 0;          ///< number of the joint input
    std::int64_t excess = 0;         ///< cells
  };
  std::vector<Post> posts;
  std::int64_t left_out = 0;  ///< posts of the sample that have no bound, or whose solutions are not known

  [[nodiscard]] double mean() const;
  /// The excess that 99 of 100 posts do not exceed.
  [[nodiscard]] std::int64_t p99() const;
  [[nodiscard]] std::int64_t most() const;
  /// The share of posts that have more than a cell too many.
  [[nodiscard]] double share() const;
};

/// The tightness of a sample of at most a dozen posts of each state, the same sample every time and for any
/// number of processes. Together.
/// @returns nothing if every post is an exact hull. @pre the context is set up
[[nodiscard]] std::optional<Tightness> find_tightness(const AnalysisContext& context);

/// `posts`, `mean`, `p99`, `most`, `share`; null if there is none.
[[nodiscard]] Json tightness_json(const std::optional<Tightness>& tightness);

/// If posts are wider than solutions need: what would help, with what it brings the widest of the sample to.
[[nodiscard]] Warnings advise_on_tightness(const ProblemSpec& spec,
                                           const std::optional<Tightness>& tightness);

}  // namespace coordreq
