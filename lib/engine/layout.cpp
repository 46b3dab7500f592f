#include "engine/layout.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <tuple>

#include "reach/build_abstraction.hpp"

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

/// Where motion is coupled (sums) and led by what moves by itself, the sums come last, the longest of them
/// along the rows; nothing if there is no such order.
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

void remap(Program& program, const std::vector<std::uint32_t>& slot_of) {
  for (Program::Node& node : program.nodes) {
    if (node.op == Operator::variable && node.a < slot_of.size()) node.a = slot_of[node.a];
  }
}

}  // namespace

std::vector<std::size_t> choose_layout(const ProblemSpec& spec) {
  std::vector<std::size_t> order = natural_order(spec);
  // These are written row by row, in the order of the spec.
  if (spec.output.actions || spec.output.controller || spec.output.abstraction) return order;
  if (spec.controller.file) return order;  // so are the cells of the file
  const std::vector<TableShape> shapes = table_shapes(spec);
  const auto quality = [&](std::size_t i) {
    return std::tuple(shapes[i].shift, spec.states[i].grid.count, i);
  };
  const std::size_t last = *std::max_element(
      order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return quality(a) < quality(b); });
  if (const auto summed = sums_last(spec, shapes)) return *summed;
  const std::vector<std::size_t> component = components(shapes);
  const auto place = [&](std::size_t i) {
    const bool with_last = component[i] == component[last];
    return std::tuple(i == last, with_last, component[i], with_last ? shapes[i].states.size() : 0, i);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
  return order;
}

bool is_layout_of_sums(const ProblemSpec& spec) {
  return !spec.output.actions && !spec.output.controller && !spec.output.abstraction &&
         sums_last(spec, table_shapes(spec)).has_value();
}

bool is_read_by_runs(const ProblemSpec& spec) {
  const bool pairs = spec.controller.file || spec.controller.allow;
  const bool lists = spec.output.actions || spec.output.controller || spec.output.abstraction;
  return pairs || lists || spec.network || spec.coordination.convention || spec.coordination.horizon ||
         !spec.requirements.empty();
}

ProblemSpec laid_out(const ProblemSpec& spec, const std::vector<std::size_t>& order) {
  ProblemSpec result = spec;
  std::vector<std::uint32_t> slot_of(order.size());
  for (std::size_t d = 0; d < order.size(); ++d) {
    result.states[d] = spec.states[order[d]];
    result.dynamics.equations[d] = spec.dynamics.equations[order[d]];
    slot_of[order[d]] = static_cast<std::uint32_t>(d);
  }
  for (Program& equation : result.dynamics.equations) remap(equation, slot_of);
  remap(result.safe, slot_of);
  if (result.controller.allow) remap(*result.controller.allow, slot_of);
  for (AgentSpec& agent : result.agents) {
    if (agent.prefer) remap(*agent.prefer, slot_of);
  }
  for (RequirementSpec& requirement : result.requirements) remap(requirement.where, slot_of);
  return result;
}

}  // namespace coordreq
