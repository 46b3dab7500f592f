#include "verify/checks.hpp"

#include "verify/parameter_choices.hpp"

namespace coordreq {
namespace {

/// Work of a flow that the analysis has to enclose; stiff ones take more.
constexpr double kOfEnclosure = 3000;

double of_corners(std::size_t moving) {
  constexpr double kOfRational = 5;
  return kOfRational * static_cast<double>(moving + 1) * static_cast<double>(std::uint64_t{1} << moving);
}

double of_entry(const ProblemSpec& spec, const UniformGrid& grid, const InputSpace& inputs, std::size_t state,
                const Influences& influences, bool stored) {
  if (const UpdateSpec* const update = spec.dynamics.update(state)) {
    const std::size_t nodes = update->past ? update->past->first.nodes.size() : update->value.nodes.size();
    return 50 * static_cast<double>(nodes);
  }
  // A table of one cell, for the strides.
  const PostTable one = empty_table(grid, inputs, influences, {0});
  const ParameterChoices choices(spec, grid, inputs, influences, one);
  const bool is_affine =
      sampled_map(spec, influences, state, choices.slots(Odometer(choices.counts()))).has_value();
  if (is_affine) return of_corners(influences.moving.size());
  return stored ? 0 : kOfEnclosure;
}

}  // namespace

WorkOfPosts work_of_posts(const ProblemSpec& spec, const UniformGrid& grid, const InputSpace& inputs,
                          bool stored) {
  double all = 0;
  double cell = 0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Influences influences = influences_on(spec, i);
    double entries = 1;
    for (const std::size_t j : influences.inputs) entries *= static_cast<double>(inputs[j].count());
    const double one = of_entry(spec, grid, inputs, i, influences, stored);
    cell += entries * one;
    for (const std::size_t j : influences.moving) entries *= static_cast<double>(grid[j].count);
    for (const std::size_t j : influences.parameters) entries *= static_cast<double>(grid[j].count);
    all += entries * one;
  }
  constexpr double kMost = 1e18;
  return {static_cast<Work>(std::min(all, kMost)), static_cast<Work>(std::min(cell, kMost)) + 1};
}

}  // namespace coordreq
