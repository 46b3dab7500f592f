#include "spec/sight.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "base/error.hpp"
#include "base/index.hpp"
#include "spec/partition_names.hpp"
#include "spec/problem_spec.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

/// States of the spec as written, which come first.
std::size_t written_states(const SystemSpec& spec) {
  std::size_t count = 0;
  while (count < spec.states.size() && !spec.dynamics.is_kept(count)) ++count;
  return count;
}

bool keeps(const MemorySpec& memory, const std::string& state) {
  return std::ranges::find(memory.states, state) != memory.states.end();
}

/// The memory that keeps a state.
const MemorySpec& memory_of(const ProblemSpec& spec, std::size_t state) {
  return *std::ranges::find_if(
      spec.memory, [&](const MemorySpec& memory) { return keeps(memory, spec.states[state].name); });
}

/// [state] of those as written that the formula of a memory reads, itself or through others.
void add_states_read(const ProblemSpec& spec, const MemorySpec& memory, std::vector<bool>& read) {
  const auto add = [&](const std::vector<std::uint32_t>& slots) {
    for (const std::uint32_t slot : slots) {
      if (slot >= spec.states.size() || read[slot]) continue;
      read[slot] = true;
      if (spec.dynamics.is_kept(slot)) add_states_read(spec, memory_of(spec, slot), read);
    }
  };
  add(memory.truth.variables());
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    if (keeps(memory, spec.states[i].name)) add(spec.dynamics.update(i)->variables());
  }
}

}  // namespace

bool has_limited_sight(const SystemSpec& spec) {
  const std::size_t states = written_states(spec);
  return std::ranges::any_of(
      spec.agents, [&](const AgentSpec& agent) { return agent.sees && agent.sees->size() < states; });
}

std::vector<std::size_t> seen_states(const ProblemSpec& spec, const std::vector<std::int32_t>& agents) {
  const std::size_t written = written_states(spec);
  std::vector<bool> is_seen(spec.states.size(), false);
  for (const std::int32_t agent : agents) {
    const auto& sees = spec.agents[at(agent)].sees;
    for (std::size_t i = 0; i < written; ++i) is_seen[i] = is_seen[i] || !sees || contains(*sees, i);
  }
  for (std::size_t i = written; i < is_seen.size(); ++i) {
    std::vector<bool> read(spec.states.size(), false);
    add_states_read(spec, memory_of(spec, i), read);
    is_seen[i] = true;
    for (std::size_t j = 0; j < written; ++j) is_seen[i] = is_seen[i] && (!read[j] || is_seen[j]);
  }
  std::vector<std::size_t> seen;
  for (std::size_t i = 0; i < is_seen.size(); ++i) {
    if (is_seen[i]) seen.push_back(i);
  }
  return seen;
}

void add_states_read(const ProblemSpec& spec, std::size_t state, std::vector<bool>& read) {
  if (read[state]) return;
  read[state] = true;
  if (spec.dynamics.is_kept(state)) add_states_read(spec, memory_of(spec, state), read);
}

std::string memory_that_keeps(const ProblemSpec& spec, std::size_t state) {
  return spec.dynamics.is_kept(state) ? memory_of(spec, state).name : "";
}

bool has_limited_sight(const ProblemSpec& spec, const PartitionSpec& partition) {
  return partition.classes.size() > 1 && std::ranges::any_of(partition.classes, [&](const auto& agents) {
           return seen_states(spec, agents).size() < spec.states.size();
         });
}

void check_sight(const ProblemSpec& spec) {
  if (!has_limited_sight(spec)) return;
  for (const PartitionSpec& partition : spec.coordination.partitions) {
    std::vector<const std::vector<std::int32_t>*> owner(spec.states.size(), nullptr);
    for (const std::vector<std::int32_t>& agents : partition.classes) {
      for (const std::size_t i : seen_states(spec, agents)) {
        if (spec.states[i].measurement_error == 0) continue;
        if (owner[i] == nullptr) {
          owner[i] = &agents;
          continue;
        }
        throw SpecError(
            fmt::format("a state with a measurement error, expected one class of the partition {} that sees "
                        "it, found {} and {}",
                        quote_text(partition.name), quote_text(class_name(spec.agents, *owner[i])),
                        quote_text(class_name(spec.agents, agents))),
            fmt::format("/states/{}/measurement_error", i));
      }
    }
  }
}

}  // namespace coordreq
