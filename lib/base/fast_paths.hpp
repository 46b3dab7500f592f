#pragma once

namespace coordreq {

/// The fast paths of the program, each with a switch: tests turn them off one at a time and compare results,
/// and `scripts/scaling --switches` measures how much time each saves. Users cannot change them.
///
/// All are on. A switch is read where a path is chosen and is written before work begins, by one thread.
struct FastPaths {
  // Without these results are the same to the byte.
  bool vector_instructions = true;  ///< kernels for AVX2 and AVX-512
  bool narrow_levels = true;        ///< 8 bits a level as long as they are enough
  bool similar_rows = true;         ///< states in an order that makes many rows equal
  bool joined_rows = true;          ///< rows along several dimensions
  bool added_rows = true;           ///< sums are read cell by cell, not written out as segments
  bool shared_minima = true;        ///< of the leading dimensions, for all rows of a unit
  bool equal_rows = true;           ///< rows and units that are equal are worked out, held and packed once
  bool like_agents = true;          ///< one order of agents that are alike stands for all
  bool grouped_actions = true;      ///< actions with the same posts in a row are one
  bool shared_groups = true;        ///< which these are is found once for all rows with the same slices
  bool covered_actions = true;      ///< posts inside those of other actions are not tried
  bool product_posts = true;        ///< joint posts as products of one box a class
  bool joined_boxes = true;         ///< of a class, those that make up one box
  bool pair_projections = true;     ///< projections of two classes on bits
  bool choice_bounds = true;        ///< one box a cell for several choices of sums
  bool level_delta = true;          ///< of sums, levels that have changed since the last sweep alone
  // Without these posts may be wider.
  bool sum_tables = true;        ///< a term for each state in which motion is affine
  bool face_flow = true;         ///< bounds by the derivative on faces of the box
  bool turning_products = true;  ///< long products of sensitivities in a turning frame
  bool tangents = true;          ///< how solutions of a subbox differ, by Taylor series too
  bool halved_boxes = true;      ///< initial boxes in halves, where solutions come less close to the ends
  bool divided_boxes = true;     ///< initial boxes in ever smaller subboxes, as far as `effort` goes
};

/// A switch with its name.
struct FastPath {
  const char* name;
  bool FastPaths::*is_on;
  bool keeps_results;  ///< results are the same without it
};

inline constexpr FastPath kFastPaths[] = {
    {"vector_instructions", &FastPaths::vector_instructions, true},
    {"narrow_levels", &FastPaths::narrow_levels, true},
    {"similar_rows", &FastPaths::similar_rows, true},
    {"joined_rows", &FastPaths::joined_rows, true},
    {"added_rows", &FastPaths::added_rows, true},
    {"shared_minima", &FastPaths::shared_minima, true},
    {"equal_rows", &FastPaths::equal_rows, true},
    {"like_agents", &FastPaths::like_agents, true},
    {"grouped_actions", &FastPaths::grouped_actions, true},
    {"shared_groups", &FastPaths::shared_groups, true},
    {"covered_actions", &FastPaths::covered_actions, true},
    {"product_posts", &FastPaths::product_posts, true},
    {"joined_boxes", &FastPaths::joined_boxes, true},
    {"pair_projections", &FastPaths::pair_projections, true},
    {"choice_bounds", &FastPaths::choice_bounds, true},
    {"level_delta", &FastPaths::level_delta, true},
    {"sum_tables", &FastPaths::sum_tables, false},
    {"face_flow", &FastPaths::face_flow, false},
    {"turning_products", &FastPaths::turning_products, false},
    {"tangents", &FastPaths::tangents, false},
    {"halved_boxes", &FastPaths::halved_boxes, false},
    {"divided_boxes", &FastPaths::divided_boxes, false},
};
static_assert(sizeof(kFastPaths) / sizeof(FastPath) == sizeof(FastPaths), "each switch has a name");

/// The switches of this process.
[[nodiscard]] inline FastPaths& fast_paths() {
  static constinit FastPaths paths;
  return paths;
}

}  // namespace coordreq
