#pragma once

#include "spec/spec_types.hpp"

// The rules of silent agents (contract, section 9).
namespace coordreq {

/// A rule of an agent reads its own inputs and states that it sees; a memory counts as the states that its
/// formula reads. What is measured with an error is in another cell for everybody who measures it, so that
/// one agent at most may go by it. @pre unchecked: memories have been added. @throws SpecError that names
/// what a rule must not read
void check_silence(const ProblemSpec& spec);

/// Every agent has a rule of its own while it is silent: then nothing that they do depends on the partition.
[[nodiscard]] bool all_have_rules(const SilenceSpec& silence);

}  // namespace coordreq
