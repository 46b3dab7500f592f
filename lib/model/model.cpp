#include "model/model.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "model/row_sample.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

std::vector<std::size_t> natural_order(const ProblemSpec& spec) {
  std::vector<std::size_t> order(spec.states.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

/// For each state the first of those that it moves together with.
std::vector<std::size_t> components(const std::vector<TableShape>& shapes) {
  std::vector<std::size_t> first(shapes.size());
  std::iota(first.begin(), first.end(), std::size_t{0});
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    for (const std::int32_t j : shapes[i].states) {
      const std::size_t a = std::min(first[i], first[static_cast<std::size_t>(j)]);
      const std::size_t b = std::max(first[i], first[static_cast<std::size_t>(j)]);
      std::replace(first.begin(), first.end(), b, a);
    }
  }
  return first;
}

/// Where motion is coupled (sums) and led by states that move independently, the sums come last, the longest
/// of them along the rows; nothing if there is no such order.
std::optional<std::vector<std::size_t>> sums_last(const ProblemSpec& spec,
                                                  const std::vector<TableShape>& shapes) {
  const auto is_sum = [&](std::size_t i) { return shapes[i].sum; };
  std::vector<std::size_t> order = natural_order(spec);
  const auto sums =
      std::stable_partition(order.begin(), order.end(), [&](std::size_t i) { return !is_sum(i); });
  if (sums == order.begin() || sums == order.end()) return std::nullopt;
  const bool leads = std::all_of(order.begin(), sums, [&](std::size_t i) {
    return std::none_of(shapes[i].states.begin(), shapes[i].states.end(),
                        [&](std::int32_t j) { return is_sum(static_cast<std::size_t>(j)); });
  });
  const bool ring = std::any_of(sums, order.end(),
                                [&](std::size_t i) { return spec.states[i].below == Outside::periodic; });
  if (!leads || ring) return std::nullopt;
  std::stable_sort(sums, order.end(), [&](std::size_t a, std::size_t b) {
    return spec.states[a].grid.count < spec.states[b].grid.count;
  });
  return order;
}

/// These are read and written row by row, in the order of the spec; so are the cells of a controller's file.
bool is_bound_to_the_spec(const ProblemSpec& spec) {
  return spec.output.actions || spec.output.controller || spec.output.abstraction ||
         spec.controller.file.has_value();
}

/// Or in rows along the last dimension alone.
bool is_read_by_runs(const ProblemSpec& spec) {
  return is_bound_to_the_spec(spec) || spec.controller.allow || spec.network ||
         spec.coordination.convention || spec.coordination.horizon || spec.silence ||
         !spec.requirements.empty();
}

/// Rows along several dimensions take no tubes.
bool can_join_rows(const ProblemSpec& spec) {
  return !is_read_by_runs(spec) && !spec.abstraction.between_samples;
}

std::vector<TableShape> arranged(const std::vector<TableShape>& shapes, const UniformGrid& grid) {
  std::vector<TableShape> result;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    TableShape& shape = result.emplace_back(shapes[grid.state(i)]);
    for (std::int32_t& j : shape.states)
      j = static_cast<std::int32_t>(grid.dimension_of(static_cast<std::size_t>(j)));
    std::sort(shape.states.begin(), shape.states.end());
  }
  return result;
}

}  // namespace

StateOrder choose_order(const ProblemSpec& spec, const std::vector<TableShape>& shapes) {
  std::vector<std::size_t> order = natural_order(spec);
  if (is_bound_to_the_spec(spec)) return {order};
  const auto quality = [&](std::size_t i) {
    return std::tuple(shapes[i].shift, spec.states[i].grid.count, i);
  };
  const std::size_t last = *std::max_element(
      order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return quality(a) < quality(b); });
  if (const auto summed = sums_last(spec, shapes)) return {*summed};
  const std::vector<std::size_t> component = components(shapes);
  const auto rank = [&](std::size_t i) {
    const bool with_last = component[i] == component[last];
    return std::tuple(i == last, with_last, component[i], with_last ? shapes[i].states.size() : 0, i);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  if (!can_join_rows(spec)) return {order};
  const auto along = find_similar_rows(spec, shapes, order);
  if (!along) return {order};
  const auto is_across = [&](std::size_t i) {
    return std::find(along->begin(), along->end(), i) == along->end();
  };
  std::stable_partition(order.begin(), order.end(), is_across);
  return {order, along->size()};
}

Model::Model(const ProblemSpec& spec, std::vector<TableShape> shapes)
    : spec_(&spec),
      shapes_(std::move(shapes)),
      order_(choose_order(spec, shapes_)),
      most_along_(can_join_rows(spec) ? order_.most_along : 1),
      keeps_sums_(!is_bound_to_the_spec(spec) && sums_last(spec, shapes_).has_value()),
      grid_(make_grid(spec).arranged(order_.states)),
      inputs_(make_input_space(spec)) {
  arranged_shapes_ = arranged(shapes_, grid_);
}

}  // namespace coordreq
