#include "answers/goal/progress_engine.hpp"

#include <utility>

#include "answers/countdown/leaving_cells.hpp"
#include "base/requires.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// The grid with `unsafe` in place of `safe` sides. @pre unchecked: it has a `safe` side
UniformGrid without_safe_sides(const UniformGrid& grid) {
  std::vector<GridDimension> dimensions = grid.dimensions();
  for (GridDimension& dimension : dimensions) {
    if (traits(dimension.below).is_only_safe()) dimension.below = Outside::unsafe;
    if (traits(dimension.above).is_only_safe()) dimension.above = Outside::unsafe;
  }
  return grid.with(std::move(dimensions));
}

}  // namespace

ProgressEngine::ProgressEngine(const AnalysisContext& context) : context_(&context) {
  REQUIRES(context.engine && context.hull);
  if (!has_safe_side(context.spec)) return;
  abstraction_ = *context.abstraction;
  abstraction_->grid = without_safe_sides(abstraction_->grid);
  TubeSets tubes = context.tubes();
  tubes.grid = &context.abstraction->grid;
  engine_.emplace(*abstraction_, &context.pairs, tubes, context.shared_rows());
  hull_.emplace(*engine_);
}

}  // namespace coordreq
