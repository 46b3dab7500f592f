#include "results/sample_content.hpp"

#include <cstring>
#include <functional>
#include <limits>
#include <numeric>

namespace coordreq::sample {
namespace {

using Formula = std::function<std::int64_t(std::uint64_t)>;

template <typename Value>
FillArray fill_with(Formula formula) {
  return [formula = std::move(formula)](std::uint64_t begin, std::uint64_t count, void* out) {
    auto* values = static_cast<Value*>(out);
    for (std::uint64_t i = 0; i < count; ++i) values[i] = static_cast<Value>(formula(begin + i));
  };
}

ResultArray array(ElementType type, Formula formula) {
  switch (type) {
    case ElementType::uint8:
      return {type, fill_with<std::uint8_t>(std::move(formula))};
    case ElementType::int16:
      return {type, fill_with<std::int16_t>(std::move(formula))};
    case ElementType::uint32:
      return {type, fill_with<std::uint32_t>(std::move(formula))};
    default:
      return {type, fill_with<std::int32_t>(std::move(formula))};
  }
}

std::vector<double> grid(double first, double step, std::uint64_t count) {
  std::vector<double> points(count);
  for (std::uint64_t i = 0; i < count; ++i) points[i] = first + step * static_cast<double>(i);
  return points;
}

ResultBits bits(std::string name, std::vector<std::string> inputs, std::uint64_t actions) {
  return {std::move(name), std::move(inputs), actions,
          fill_with<std::uint8_t>([](std::uint64_t i) { return std::int64_t{action_byte(i)}; })};
}

ResultPartition partition(std::uint64_t number, const Options& options) {
  ResultPartition result;
  const std::uint64_t cells = cell_count(options);
  const ElementType steps = options.steps;
  result.truncated = options.truncated;
  result.layer_sizes = {cells / 2, cells / 4, cells / 8};
  if (number == 1) result.layer_sizes.push_back(cells / 16);
  const auto last = static_cast<std::int32_t>(result.layer_sizes.size()) - 1;
  result.fixed_point_index = options.truncated ? -1 : last;
  result.unbounded = options.truncated ? 0 : result.layer_sizes.back();
  result.delay = array(steps, [=](std::uint64_t i) { return delay(number, i, steps); });
  result.trigger = array(steps, [=](std::uint64_t i) { return trigger(number, i, steps); });
  if (options.with_extras) {
    result.layers =
        ResultLayers{{0, cells / 8, cells / 4, cells / 2, cells / 2},
                     array(ElementType::uint32, [](std::uint64_t i) { return 2 * std::int64_t(i); })};
  }
  return result;
}

std::vector<ResultTable> tables(const Options& options) {
  ResultTable moving{"x1", {"x1", "u1"}, {}, {}};
  for (std::uint64_t i = 0; i < options.points[0] * 5; ++i) {
    moving.first.push_back(static_cast<std::int32_t>(i) - 3);
    moving.last.push_back(static_cast<std::int32_t>(i) + 3);
  }
  return {moving, {"x2", {}, {7}, {9}}};
}

}  // namespace

std::int64_t maximum(ElementType steps) {
  return steps == ElementType::int16 ? std::numeric_limits<std::int16_t>::max()
                                     : std::numeric_limits<std::int32_t>::max();
}

bool is_safe(std::uint64_t cell) {
  return cell % 7 != 0;
}

bool is_invariant(std::uint64_t cell) {
  return is_safe(cell) && cell % 3 != 0;
}

std::int64_t collision_time(std::uint64_t cell, ElementType steps) {
  if (!is_safe(cell)) return 0;
  return is_invariant(cell) ? maximum(steps) : static_cast<std::int64_t>(cell % 100) + 1;
}

std::int64_t delay(std::uint64_t partition, std::uint64_t cell, ElementType steps) {
  if (!is_safe(cell)) return -2;
  if (!is_invariant(cell)) return -1;
  return cell % 11 == 0 ? maximum(steps) : static_cast<std::int64_t>((cell + partition) % 50);
}

std::int64_t trigger(std::uint64_t partition, std::uint64_t cell, ElementType steps) {
  const std::int64_t steps_left = delay(partition, cell, steps);
  if (steps_left < 0 || steps_left == maximum(steps)) return steps_left;
  return steps_left < kConnectionDelay ? -3 : steps_left - kConnectionDelay;
}

std::uint8_t action_byte(std::uint64_t i) {
  return static_cast<std::uint8_t>(i * 37 % 251);
}

std::uint64_t cell_count(const Options& options) {
  return std::accumulate(options.points.begin(), options.points.end(), std::uint64_t{1}, std::multiplies<>());
}

ResultContent make_content(const Options& options) {
  const ElementType steps = options.steps;
  ResultContent content;
  content.name = "sample";
  content.spec_text = kSpecText;
  content.guarantee = "samples";
  content.period = 0.25;
  content.period_unit = "seconds";
  content.connection_delay = kConnectionDelay;
  content.axes = {{"x1", "m", grid(-1, 0.125, options.points[0]), 0.125, true},
                  {"x2", "seconds", grid(0, 0.5, options.points[1]), 0.5, true},
                  {"heading", "", grid(0, 1, options.points[2]), 1.0, true},
                  {"u1", "m/second", grid(-2, 1, 5), 1.0, false},
                  {"u2", "rad", {-1, 0, 3}, std::nullopt, false}};
  for (std::uint64_t i = 0; i < cell_count(options); ++i) {
    content.safe_cells += is_safe(i) ? 1U : 0U;
    content.invariant_cells += is_invariant(i) ? 1U : 0U;
  }
  content.safe = array(ElementType::uint8, [](std::uint64_t i) { return is_safe(i) ? 1 : 0; });
  content.invariant = array(ElementType::uint8, [](std::uint64_t i) { return is_invariant(i) ? 1 : 0; });
  content.collision_time = array(steps, [=](std::uint64_t i) { return collision_time(i, steps); });
  content.iterations = 12;

  content.partitions = {partition(0, options), partition(1, options)};
  content.partitions[0].name = "alone";
  content.partitions[0].classes = {"a", "b", "c"};
  content.partitions[1].name = "a|b+c";
  content.partitions[1].classes = {"a", "b+c"};
  if (options.with_extras) {
    content.partitions[1].actions = {bits("a", {"u1"}, 5), bits("b+c", {"u1", "u2"}, 15)};
    content.controller = bits("all", {"u1", "u2"}, 20);
    content.abstraction = tables(options);
  }
  return content;
}

}  // namespace coordreq::sample
