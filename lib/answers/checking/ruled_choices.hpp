#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "answers/checking/allowed_pairs.hpp"
#include "answers/checking/check_ground.hpp"
#include "model/input_class.hpp"

namespace coordreq {

/// What agents do by rules of their own (contract, section 9), by definition. One object a thread.
class RuledChoices {
 public:
  /// @param conditions [agent] @param key of `silence` that they stand under @param partition its classes, by
  /// agents
  RuledChoices(const CheckGround& ground, const std::vector<std::optional<Program>>& conditions,
               const std::string& key, const std::vector<std::vector<std::int32_t>>& partition);

  /// The joint inputs that all rules permit and of which the part of each class in which an agent has none is
  /// that of some in C(x). @param admitted C(x): [joint input] 0 or 1
  [[nodiscard]] std::vector<std::int64_t> of(std::int64_t cell, const std::vector<std::uint8_t>& admitted);

 private:
  std::int64_t joint_inputs_;
  std::deque<PermittedPairs> rules_;  ///< of all agents that have one
  std::vector<InputClass> asking_;    ///< classes in which an agent has none
};

}  // namespace coordreq
