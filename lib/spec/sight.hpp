#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "spec/spec_types.hpp"

// The states that agents see on their own while they are silent (contract, section 8).
namespace coordreq {

/// Some agent does not see all states: only then is there anything to ask.
[[nodiscard]] bool has_limited_sight(const SystemSpec& spec);

/// The states that some of these agents see, ascending. One that a memory keeps is seen by agents who
/// together see every state that its formula reads, through other memories too: they can keep it themselves.
[[nodiscard]] std::vector<std::size_t> seen_states(const ProblemSpec& spec,
                                                   const std::vector<std::int32_t>& agents);

/// Adds a state as written that is read by who reads `state`: itself, or, if a memory keeps it, those that
/// its formula reads, through other memories too. @param read [state]
void add_states_read(const ProblemSpec& spec, std::size_t state, std::vector<bool>& read);
/// The name of the memory that keeps a state; empty: none does.
[[nodiscard]] std::string memory_that_keeps(const ProblemSpec& spec, std::size_t state);

/// Some class of the partition, of two or more, does not see all states.
[[nodiscard]] bool has_limited_sight(const ProblemSpec& spec, const PartitionSpec& partition);

/// Classes that measure one state, each with an error of its own, might find it in different cells.
/// @throws SpecError that names two of them, if sight is limited at all
void check_sight(const ProblemSpec& spec);

}  // namespace coordreq
