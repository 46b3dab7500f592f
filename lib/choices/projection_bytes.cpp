#include "choices/projection_bytes.hpp"

#include <algorithm>

#include "choices/forbidden_choices.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// True if no state is moved by two classes, so that projections are kept as boxes of posts.
bool is_product(const Model& model, const std::vector<InputClass>& classes) {
  return std::ranges::all_of(model.shapes(), [&](const TableShape& shape) {
    return std::ranges::count_if(classes, [&](const InputClass& input_class) {
             return std::ranges::any_of(shape.inputs,
                                        [&](std::int32_t j) { return input_class.contains(j); });
           }) <= 1;
  });
}

}  // namespace

double projection_bytes(const EngineSizes& sizes, const std::vector<InputClass>& classes) {
  constexpr double kBytesOfList = 48;  // its vector, and the overhead of the allocator
  constexpr double kBytesOfLabel = 1.45;
  constexpr double kBytesOfBoxes = 220, kBytesOfMoreBoxes = 100;  // of two classes, and of each further class
  if (classes.size() == 1) return 0;
  double actions = 0;
  for (const InputClass& inputs : classes) actions += static_cast<double>(inputs.actions());
  const ProblemSpec& spec = sizes.model().spec();
  const double forbidden = allow_joins_agents(spec) ? sizes.set() : 0;  // at most
  const double masks = sizes.set() * actions + forbidden + sizes.rows() * kBytesOfList;
  const bool is_simple = !spec.abstraction.between_samples && !spec.controller.allow &&
                         !spec.controller.file && spec.controller.synthesis == Synthesis::maximal;
  if (!is_simple || !is_product(sizes.model(), classes)) return masks;
  const UniformGrid& grid = sizes.grid();
  const bool is_joined = grid.size() - grid.across() > 1;
  const double boxes =
      sizes.rows() * (is_joined
                          ? kBytesOfLabel * static_cast<double>(grid.row_length())
                          : kBytesOfBoxes + kBytesOfMoreBoxes * static_cast<double>(classes.size() - 2));
  // Two classes with few actions have few subsets, too.
  return classes.size() > 2 ? boxes : std::min(masks, boxes);
}

}  // namespace coordreq
