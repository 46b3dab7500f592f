#include "engine/like_agents.hpp"

#include <algorithm>

#include "base/fast_paths.hpp"
#include "base/index.hpp"
#include "base/union_find.hpp"
#include "engine/row_symmetry.hpp"
#include "model/odometer.hpp"

namespace coordreq {
namespace {

/// Dimensions are in one set if one of them depends on the other, directly or by way of others.
UnionFind find_components(const Abstraction& abstraction) {
  UnionFind components(abstraction.tables.size());
  for (const auto* tables : {&abstraction.tables, &abstraction.tubes}) {
    for (std::size_t t = 0; t < tables->size(); ++t) {
      for (const std::int32_t state : (*tables)[t].states) components.merge(t, at(state));
    }
  }
  return components;
}

/// Whether table `a` is table `b` with the two agents exchanged.
bool are_alike(const Abstraction& abstraction, const TransitionTable& a, const TransitionTable& b,
               const AbstractAgent& one, const AbstractAgent& other) {
  if (a.is_sum() || b.is_sum() || a.shift != b.shift || a.before != 0 || b.before != 0) return false;
  if (a.entries.size() != b.entries.size()) return false;
  std::vector<std::int64_t> counts, strides, other_strides;
  for (std::size_t d = 0; d < a.state_stride.size(); ++d) {
    const std::int64_t stride = b.state_stride[exchanged(one.dimensions, other.dimensions, d)];
    if ((a.state_stride[d] == 0) != (stride == 0)) return false;
    if (stride == 0) continue;
    counts.push_back(abstraction.grid[d].count);
    strides.push_back(a.state_stride[d]);
    other_strides.push_back(stride);
  }
  for (std::size_t i = 0; i < a.input_stride.size(); ++i) {
    const auto like = exchanged(one.inputs, other.inputs, static_cast<std::int32_t>(i));
    const std::int64_t stride = b.input_stride[at(like)];
    if ((a.input_stride[i] == 0) != (stride == 0)) return false;
    if (stride == 0) continue;
    counts.push_back(abstraction.inputs[i].count());
    strides.push_back(a.input_stride[i]);
    other_strides.push_back(stride);
  }
  Odometer choice(counts);
  do {
    std::int64_t position = 0, like = 0;
    for (std::size_t k = 0; k < counts.size(); ++k) {
      position += choice[k] * strides[k];
      like += choice[k] * other_strides[k];
    }
    if (a.entries[at(position)] != b.entries[at(like)]) return false;
  } while (choice.advance());
  return true;
}

bool are_alike(const GridDimension& a, const GridDimension& b) {
  return a.count == b.count && a.below == b.below && a.above == b.above;
}

/// Whether the agents match, their dimensions and inputs being taken in this order.
bool are_alike(const Abstraction& abstraction, const AbstractAgent& a, const AbstractAgent& b) {
  for (std::size_t i = 0; i < a.inputs.size(); ++i) {
    const auto points = [&](std::int32_t input) { return abstraction.inputs[at(input)].count(); };
    if (points(a.inputs[i]) != points(b.inputs[i])) return false;
  }
  for (std::size_t k = 0; k < a.dimensions.size(); ++k) {
    if (!are_alike(abstraction.grid[a.dimensions[k]], abstraction.grid[b.dimensions[k]])) return false;
  }
  for (std::size_t k = 0; k < a.dimensions.size(); ++k) {
    for (const auto* tables : {&abstraction.tables, &abstraction.tubes}) {
      if (tables->empty()) continue;
      if (!are_alike(abstraction, (*tables)[a.dimensions[k]], (*tables)[b.dimensions[k]], a, b)) return false;
    }
  }
  return true;
}

/// Agents with more dimensions are not compared: there are too many orders.
constexpr std::size_t kMostDimensions = 6;

}  // namespace

std::optional<AbstractAgent> agent_like(const Abstraction& abstraction, const AbstractAgent& one,
                                        const AbstractAgent& other) {
  if (one.dimensions.empty() || one.dimensions.size() > kMostDimensions ||
      one.dimensions.size() != other.dimensions.size() || one.inputs.size() != other.inputs.size())
    return std::nullopt;
  AbstractAgent agent = other;
  std::ranges::sort(agent.dimensions);
  do {
    if (are_alike(abstraction, one, agent)) return agent;
  } while (std::ranges::next_permutation(agent.dimensions).found);
  return std::nullopt;
}

std::vector<AbstractAgent> abstract_agents(const Abstraction& abstraction,
                                           const std::vector<std::vector<std::int32_t>>& inputs) {
  const UnionFind components = find_components(abstraction);
  const std::size_t dimensions = abstraction.tables.size();
  const auto uses = [&](std::size_t d, const auto& test) {
    return std::ranges::any_of(abstraction.tables[d].inputs, test) ||
           (!abstraction.tubes.empty() && std::ranges::any_of(abstraction.tubes[d].inputs, test));
  };
  std::vector<AbstractAgent> agents;
  for (const std::vector<std::int32_t>& of_agent : inputs) {
    const auto is_of_agent = [&of_agent](std::int32_t input) { return contains(of_agent, input); };
    const auto is_of_others = [&of_agent](std::int32_t input) { return !contains(of_agent, input); };
    std::vector<std::uint8_t> is_moved(dimensions, 0), is_shared(dimensions, 0);  // [root]
    for (std::size_t d = 0; d < dimensions; ++d) {
      if (uses(d, is_of_agent)) is_moved[components.root(d)] = 1;
      if (uses(d, is_of_others)) is_shared[components.root(d)] = 1;
    }
    AbstractAgent& agent = agents.emplace_back(AbstractAgent{of_agent, {}});
    bool is_apart = true;
    for (std::size_t d = 0; d < dimensions; ++d) {
      if (is_moved[components.root(d)] == 0) continue;
      is_apart = is_apart && is_shared[components.root(d)] == 0;
      agent.dimensions.push_back(d);
    }
    if (!is_apart) agent.dimensions.clear();
  }
  return agents;
}

std::vector<AbstractAgent> find_like_agents(const Abstraction& abstraction,
                                            std::span<const AbstractAgent> agents,
                                            std::span<const CellSet* const> sets, ThreadTeam* team) {
  const auto is_across = [&](const AbstractAgent& agent) {
    return !agent.dimensions.empty() && std::ranges::all_of(agent.dimensions, [&](std::size_t d) {
      return d < abstraction.grid.across();
    });
  };
  std::vector<AbstractAgent> most;
  if (!fast_paths().like_agents) return most;
  std::vector<std::uint8_t> is_known(agents.size(), 0);
  // Being alike is transitive, so that each agent is in one set of like agents.
  for (std::size_t a = 0; a < agents.size(); ++a) {
    if (is_known[a] != 0 || !is_across(agents[a])) continue;
    std::vector<AbstractAgent> like{agents[a]};
    for (std::size_t b = a + 1; b < agents.size() && like.size() < RowSymmetry::kMostAgents; ++b) {
      if (is_known[b] != 0 || !is_across(agents[b])) continue;
      std::optional<AbstractAgent> agent = agent_like(abstraction, agents[a], agents[b]);
      if (!agent) continue;
      const RowSymmetry symmetry(abstraction.grid, {agents[a].dimensions, agent->dimensions});
      if (!std::ranges::all_of(sets, [&](const CellSet* set) { return symmetry.keeps(*set, team); }))
        continue;
      like.push_back(*std::move(agent));
      is_known[b] = 1;
    }
    if (like.size() > std::max<std::size_t>(1, most.size())) most = std::move(like);
  }
  return most;
}

}  // namespace coordreq
