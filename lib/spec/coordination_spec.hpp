#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "numeric/rational.hpp"
#include "spec/spec_types.hpp"

// Who acts together: partitions of the agents, networks, and what their losses risk.
namespace coordreq {

/// Classes of agents that coordinate within a step. Canonical: agents ascending within a class, classes by
/// their first agents; every agent is in exactly one class.
struct PartitionSpec {
  std::string name;       ///< the given name, else the canonical one
  std::string canonical;  ///< "a+b|c"
  std::vector<std::vector<std::int32_t>> classes;
};

struct LinkCostSpec {
  std::int32_t first = 0;  ///< agent indices, first < second
  std::int32_t second = 0;
  Rational cost;
};

struct CoordinationSpec {
  std::vector<PartitionSpec> partitions;  ///< at least one, all different
  bool all_partitions = false;  ///< the spec says "all"; `partitions` are as make_all_partitions() has them
  std::optional<std::int64_t> max_delay;  ///< steps
  std::int64_t connection_delay = 0;      ///< D, steps
  /// Steps; from "horizon_time" by ceil(time / period). At most `max_delay`, if there is one.
  std::optional<std::int64_t> horizon;
  std::optional<Rational> horizon_time;  ///< as written; `horizon` has its steps
  std::vector<LinkCostSpec> link_cost;   ///< none without `horizon`
  bool convention = false;
};

struct NetworkModeSpec {
  std::string name;         ///< as given, or the history of losses (see loss_automaton.hpp)
  PartitionSpec partition;  ///< who is connected; not necessarily one of CoordinationSpec::partitions
};
/// The range of a probability, 0 <= low <= high <= 1: any value in it, another one in each step.
struct ProbabilityRange {
  Rational low;
  Rational high;
};
/// A network of any kind as an automaton, and the numbers that it was unfolded from.
struct NetworkSpec {
  NetworkKind kind = NetworkKind::automaton;
  std::vector<NetworkModeSpec> modes;                              ///< the first one is the initial mode
  std::vector<std::pair<std::int32_t, std::int32_t>> transitions;  ///< indices into modes; each has one
  /// [transition], empty if the network has no numbers. The probabilities of a mode can add up to 1 with each
  /// of them at either end of its range; every upper end is above 0.
  std::vector<ProbabilityRange> probabilities;
  std::int64_t delay = 0;
  std::int64_t burst_length = 0, burst_gap = 0;
  std::int64_t misses = 0, window = 0;
  ProbabilityRange loss, after_loss;  ///< as written
  bool resynthesise = false;
  /// In modes of more than one class agents act by the communication-loss rule (contract, section 9), else
  /// independently. Only beside `silence`.
  bool acts_by_rule = false;
  bool has_actions = false;  ///< the spec says which of the two
};

/// The question about the probability of leaving K. Only beside a network with numbers.
struct RiskSpec {
  std::int64_t horizon = 0;              ///< steps, at least 1; from "horizon_time" by ceil(time / period)
  std::optional<Rational> horizon_time;  ///< as written; `horizon` has its steps
  bool is_safest = false;  ///< agents who are all connected agree on the least risk; else on anything
  std::size_t start = 0;   ///< the mode of the first step
  bool is_drawn = false;   ///< the mode of the first step is drawn as one that follows `start`
};

}  // namespace coordreq
