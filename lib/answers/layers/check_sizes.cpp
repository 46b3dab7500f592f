#include "answers/layers/check_sizes.hpp"

#include <algorithm>
#include <optional>

#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// The layers as the delays of the cells say.
struct Layers {
  std::vector<std::uint64_t> sizes;  ///< |Z_0|, ..., |Z_F| or, if truncated, up to max_delay
  std::int32_t fixed_point_index = -1;
};

/// @returns nothing if the delays cannot be those of an iteration that max_delay stops, or does not
std::optional<Layers> layers_of(const ProblemSpec& spec, const PartitionClaims& claims) {
  std::int32_t longest = -1;
  bool unbounded = false;
  std::uint64_t invariant = 0;
  for (const std::int32_t delay : claims.delay) {
    invariant += delay >= 0 ? 1 : 0;
    unbounded = unbounded || delay == kForever;
    if (delay != kForever) longest = std::max(longest, delay);
  }
  const std::int64_t limit = spec.coordination.max_delay.value_or(INT64_MAX);
  if (longest > limit || longest >= static_cast<std::int64_t>(claims.delay.size())) return std::nullopt;
  const bool truncated = claims.fixed_point_index < 0;
  // Stopped: some cell has the limit as a lower bound, and none a delay that was never tried.
  if (truncated && (longest != limit || unbounded)) return std::nullopt;
  // Not stopped: Z_limit is empty, or was found to be fixed before.
  if (!truncated && longest + 1 >= limit && (longest == limit || unbounded)) return std::nullopt;

  std::vector<std::uint64_t> leaving(static_cast<std::size_t>(longest + 1), 0);
  for (const std::int32_t delay : claims.delay) {
    if (delay >= 0 && delay != kForever) ++leaving[static_cast<std::size_t>(delay)];
  }
  Layers layers{.sizes = {invariant}, .fixed_point_index = truncated ? -1 : longest + 1};
  for (std::size_t k = 0; k + (truncated ? 1 : 0) < leaving.size(); ++k) {
    if (leaving[k] == 0) return std::nullopt;  // Z_k is a fixed point: no cell can leave later
    layers.sizes.push_back(layers.sizes.back() - leaving[k]);
  }
  return layers;
}

void check_lists(const PartitionClaims& claims, const Layers& layers, Comparison& comparison) {
  const auto layer_of = [&](std::int32_t delay) {
    return delay == kForever ? layers.sizes.size() - 1 : static_cast<std::size_t>(delay);
  };
  std::vector<std::vector<std::uint64_t>> lists(layers.sizes.size());
  for (std::size_t x = 0; x < claims.delay.size(); ++x) {
    if (claims.delay[x] >= 0) lists[layer_of(claims.delay[x])].push_back(x);
  }
  comparison.expect("length of start", claims.layer_start.size(), lists.size() + 1);
  std::uint64_t position = 0;
  for (std::size_t k = 0; k < lists.size() && k < claims.layer_start.size(); ++k) {
    comparison.expect(fmt::format("start[{}]", k), claims.layer_start[k], position);
    for (const std::uint64_t cell : lists[k]) {
      const std::uint64_t found =
          position < claims.layer_cell.size() ? claims.layer_cell[position] : UINT64_MAX;
      comparison.expect(fmt::format("cell[{}]", position), found, cell);
      ++position;
    }
  }
  if (!claims.layer_start.empty()) comparison.expect("end of start", claims.layer_start.back(), position);
  comparison.expect<std::uint64_t>("length of cell", claims.layer_cell.size(), position);
}

void check_sizes(const PartitionClaims& claims, const Layers& layers, Comparison& comparison) {
  comparison.expect("F", claims.fixed_point_index, layers.fixed_point_index);
  for (std::size_t k = 0; k < claims.layer_sizes.size(); ++k) {
    comparison.expect(fmt::format("|Z_{}|", k), claims.layer_sizes[k],
                      layers.sizes[std::min(k, layers.sizes.size() - 1)]);
  }
}

}  // namespace

Finding compare_layers(const ProblemSpec& spec, const PartitionClaims& claims, std::size_t& longest) {
  Comparison comparison("layers " + claims.name);
  const std::optional<Layers> layers = layers_of(spec, claims);
  if (!layers) {
    comparison.expect<std::string_view>(
        "F and the delays", "contradict each other",
        claims.fixed_point_index < 0 ? "an iteration stopped by max_delay" : "a fixed point");
    return comparison.finding();
  }
  longest = std::max(longest, layers->sizes.size());
  check_sizes(claims, *layers, comparison);
  if (claims.has_layers) check_lists(claims, *layers, comparison);
  return comparison.finding();
}

}  // namespace coordreq
