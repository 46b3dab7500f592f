#include "answers/requirements/pair_posts.hpp"

namespace coordreq {
namespace {

/// Notes the unsafe sides that a range passes.
void add_sides(std::size_t i, IndexRange raw, const GridDimension& dimension, PairPosts::Post& post) {
  const bool below = raw.first < 0 && traits(dimension.below).blocks;
  const bool above = raw.last >= dimension.count && traits(dimension.above).blocks;
  if (below) post.sides.push_back({.dimension = i, .above = false});
  if (above) post.sides.push_back({.dimension = i, .above = true});
  if (below || above) post.blocked = PairPosts::Blocked::left_domain;
}

}  // namespace

PairPosts::Post PairPosts::of(std::int64_t x, std::int64_t u) const {
  Post post;
  for (std::size_t i = 0; i < abstraction_->grid.size(); ++i) {
    add_sides(i, abstraction_->raw(i, x, u), abstraction_->grid[i], post);
    const IndexRange inside = abstraction_->resolved(i, x, u).inside;
    post.all_left = post.all_left || inside.first > inside.last;
    post.box.push_back(inside);
  }
  if (post.blocked == Blocked::no && tubes_.inside != nullptr) follow_tube(x, u, post);
  return post;
}

void PairPosts::follow_tube(std::int64_t x, std::int64_t u, Post& post) const {
  const UniformGrid& grid = abstraction_->grid;
  std::vector<IndexRange> tube;
  bool passes = false;
  bool all_left = false;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const IndexRange raw = abstraction_->raw_tube(i, x, u);
    const ResolvedRange range = abstraction_->resolved_tube(i, x, u);
    add_sides(i, raw, grid[i], post);
    passes = passes || passes_a_limit(raw, grid[i]);
    all_left = all_left || range.all_left();
    tube.push_back(range.inside);
  }
  if (post.blocked != Blocked::no || all_left) return;
  const CellSet& safe = passes && tubes_.beyond != nullptr ? *tubes_.beyond : *tubes_.inside;
  if (!for_each_cell(grid, tube, [&safe](std::int64_t cell) { return safe.test(cell); })) {
    post.blocked = Blocked::unsafe_between_samples;
  }
}

}  // namespace coordreq
