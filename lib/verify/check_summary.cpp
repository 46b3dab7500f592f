#include "verify/check_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace coordreq {
namespace {

/// Compares one number after the other.
class Comparison {
 public:
  explicit Comparison(std::string check) : tally_(std::move(check)) {}

  template <class Number>
  void expect(std::string_view what, Number found, Number expected) {
    tally_.add_checked(1);
    if (found == expected) return;
    tally_.add_wrong(number_++, [&] { return fmt::format("{}: {}, expected {}", what, found, expected); });
  }
  [[nodiscard]] Finding finding() const { return tally_.finding(); }

 private:
  Tally tally_;
  std::int64_t number_ = 0;
};

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

Finding check_layers(const ProblemSpec& spec, const PartitionClaims& claims, std::size_t& longest) {
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

std::uint64_t members(const std::vector<std::uint8_t>& set) {
  return static_cast<std::uint64_t>(
      std::count_if(set.begin(), set.end(), [](std::uint8_t b) { return b != 0; }));
}

}  // namespace

std::vector<Finding> check_summary(const ProblemSpec& spec, const Claims& claims) {
  Comparison sets("sizes");
  sets.expect("|S|", claims.safe_cells, members(claims.safe));
  sets.expect("|K|", claims.invariant_cells, members(claims.invariant));
  for (std::size_t mode = 0; mode < claims.network.size(); ++mode) {
    sets.expect(fmt::format("cells of mode {}", spec.network->modes[mode].name), claims.network_cells[mode],
                members(claims.network[mode]));
  }
  std::int64_t last = 0;
  for (const std::int32_t time : claims.collision_time) {
    if (time != kForever) last = std::max(last, std::int64_t{time});
  }
  sets.expect("iterations", claims.iterations, last + 1);  // the last sweep removes nothing
  std::vector<Finding> findings;
  std::size_t longest = 1;
  for (const PartitionClaims& partition : claims.partitions)
    findings.push_back(check_layers(spec, partition, longest));
  const std::size_t row = claims.partitions.empty() ? longest : claims.partitions.front().layer_sizes.size();
  sets.expect("length of /layer", row, longest);
  findings.insert(findings.begin(), sets.finding());
  return findings;
}

}  // namespace coordreq
