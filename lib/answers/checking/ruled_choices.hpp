#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "answers/checking/allowed_pairs.hpp"
#include "answers/checking/check_context.hpp"
#include "model/input_class.hpp"

namespace coordreq {

/// The joint inputs that agents can choose by rules of their own (contract, section 9), by definition. One
/// object a thread.
class RuledChoices {
 public:
  /// @param conditions [agent] @param key of `silence` under which the conditions stand @param partition its
  ///   classes, by agents
  RuledChoices(const CheckContext& context, const std::vector<std::optional<Program>>& conditions,
               const std::string& key, const std::vector<std::vector<std::int32_t>>& partition);

  /// The joint inputs that all rules permit, and in which the action of each class with an agent without a
  /// rule occurs in some joint input of C(x). @param admitted C(x): [joint input] 0 or 1
  [[nodiscard]] std::vector<std::int64_t> of(std::int64_t cell, const std::vector<std::uint8_t>& admitted);

 private:
  std::int64_t joint_inputs_;
  std::deque<PermittedPairs> rules_;  ///< of all agents that have a rule
  std::vector<InputClass> asking_;    ///< classes with an agent that has no rule
};

}  // namespace coordreq
