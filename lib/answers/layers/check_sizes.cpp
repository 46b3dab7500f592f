#include "answers/layers/check_sizes.hpp"

#include <algorithm>
#include <optional>

#include "answers/layers/stored_partition.hpp"
#include "answers/step_codes.hpp"
#include "spec/partition_names.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Layers as they follow from the delays of the cells.
struct Layers {
  std::vector<std::int64_t> sizes;  ///< |Z_0|, ..., |Z_F| or, if truncated, up to max_delay
  std::int64_t fixed_point_index = -1;
};

/// @returns nothing if the delays cannot be those of an iteration that max_delay stops, or does not
std::optional<Layers> layers_of(const ProblemSpec& spec, const PartitionClaims& claims) {
  std::int32_t longest = -1;
  bool unbounded = false;
  std::int64_t invariant = 0;
  for (const std::int32_t delay : claims.delay) {
    invariant += delay >= 0 ? 1 : 0;
    unbounded = unbounded || delay == kUnbounded;
    if (delay != kUnbounded) longest = std::max(longest, delay);
  }
  const std::int64_t limit = spec.coordination.max_delay.value_or(INT64_MAX);
  if (longest > limit || longest >= static_cast<std::int64_t>(claims.delay.size())) return std::nullopt;
  const bool truncated = claims.fixed_point_index < 0;
  // Stopped: some cell has the limit as a lower bound, and none a delay that was never tried.
  if (truncated && (longest != limit || unbounded)) return std::nullopt;
  // Not stopped: Z_limit is empty, or was found to be fixed before.
  if (!truncated && longest + 1 >= limit && (longest == limit || unbounded)) return std::nullopt;

  std::vector<std::int64_t> leaving(static_cast<std::size_t>(longest + 1), 0);
  for (const std::int32_t delay : claims.delay) {
    if (delay >= 0 && delay != kUnbounded) ++leaving[static_cast<std::size_t>(delay)];
  }
  Layers layers{.sizes = {invariant}, .fixed_point_index = truncated ? -1 : longest + 1};
  for (std::size_t k = 0; k + (truncated ? 1 : 0) < leaving.size(); ++k) {
    if (leaving[k] == 0) return std::nullopt;  // Z_k is a fixed point: no cell can leave later
    layers.sizes.push_back(layers.sizes.back() - leaving[k]);
  }
  return layers;
}

void check_lists(const PartitionClaims& claims, const StoredLayers& stored, const Layers& layers,
                 Comparison& comparison) {
  const auto layer_of = [&](std::int32_t delay) {
    return delay == kUnbounded ? layers.sizes.size() - 1 : static_cast<std::size_t>(delay);
  };
  std::vector<std::vector<std::uint64_t>> lists(layers.sizes.size());
  for (std::size_t x = 0; x < claims.delay.size(); ++x) {
    if (claims.delay[x] >= 0) lists[layer_of(claims.delay[x])].push_back(x);
  }
  comparison.expect("length of start", stored.start.size(), lists.size() + 1);
  std::uint64_t position = 0;
  for (std::size_t k = 0; k < lists.size() && k < stored.start.size(); ++k) {
    comparison.expect(fmt::format("start[{}]", k), stored.start[k], position);
    for (const std::uint64_t cell : lists[k]) {
      const std::uint64_t value = position < stored.cell.size() ? stored.cell[position] : UINT64_MAX;
      comparison.expect(fmt::format("cell[{}]", position), value, cell);
      ++position;
    }
  }
  if (!stored.start.empty()) comparison.expect("end of start", stored.start.back(), position);
  comparison.expect<std::uint64_t>("length of cell", stored.cell.size(), position);
}

void check_sizes(const PartitionClaims& claims, const Layers& layers, Comparison& comparison) {
  comparison.expect("F", claims.fixed_point_index, layers.fixed_point_index);
  for (std::size_t k = 0; k < claims.layer_sizes.size(); ++k) {
    comparison.expect(fmt::format("|{}_{}|", claims.kind.letter, k), claims.layer_sizes[k],
                      layers.sizes[std::min(k, layers.sizes.size() - 1)]);
  }
}

}  // namespace

PartitionClaims::PartitionClaims(const ProblemSpec& spec, const Claims& claims, std::size_t p,
                                 const CountdownKind& countdown, const std::string& root)
    : kind(countdown),
      partition(spec.coordination.partitions[p]),
      delay(claims.values(kind.layered, p)),
      fixed_point_index(claims.at(kind.prefix() + "fixed_point_index").integers[p]) {
  const std::vector<std::int64_t>& sizes = claims.at(kind.prefix() + "layer_size").integers;
  const auto length = static_cast<std::ptrdiff_t>(sizes.size() / spec.coordination.partitions.size());
  const auto row = sizes.begin() + static_cast<std::ptrdiff_t>(p) * length;
  layer_sizes.assign(row, row + length);
  if (fixed_point_index < 0 && spec.coordination.max_delay)
    most = static_cast<std::int32_t>(*spec.coordination.max_delay);
  for (const auto& agents : partition.classes) {
    const std::string name = class_name(spec.agents, agents);
    const auto* const bits = claims.bits(root + "/" + partition.name + "/" + name);
    if (bits != nullptr) actions.push_back(bits);
  }
}

Finding compare_layers(const ProblemSpec& spec, const Claims& claims, const PartitionClaims& partition,
                       std::size_t& longest) {
  Comparison comparison(partition.kind.label + (" " + partition.partition.name));
  const std::optional<Layers> layers = layers_of(spec, partition);
  if (!layers) {
    comparison.expect<std::string_view>(
        "F and the delays", "contradict each other",
        partition.fixed_point_index < 0 ? "an iteration stopped by max_delay" : "a fixed point");
    return comparison.finding();
  }
  longest = std::max(longest, layers->sizes.size());
  check_sizes(partition, *layers, comparison);
  if (spec.output.layers && *partition.kind.name == '\0')
    check_lists(partition, read_layer_lists(spec, partition.partition, claims), *layers, comparison);
  return comparison.finding();
}

}  // namespace coordreq
