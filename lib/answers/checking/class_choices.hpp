#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "answers/checking/check_context.hpp"
#include "answers/checking/permitted_inputs.hpp"
#include "base/index.hpp"
#include "model/input_class.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// What classes that do not coordinate can choose at single cells, by definition: any action that occurs in
/// some joint input of C(x) (IND_C); or of agents with rules those that the rules permit (contract,
/// section 9). One object a thread.
class ClassChoices {
 public:
  using Numbers = std::vector<std::int64_t>;
  using Partition = std::vector<std::vector<std::int32_t>>;  ///< [class] its agents
  enum class Rules : std::uint8_t { none, actions, then };   ///< of `silence`
  /// Those in a mode of a network, in which one class alone coordinates.
  [[nodiscard]] static Rules rules_in_mode(bool act_by_rule, const Partition& partition) {
    return act_by_rule && partition.size() > 1 ? Rules::actions : Rules::none;
  }

  /// @pre unchecked: spec, grid and inputs outlive this object, and the spec has these rules
  ClassChoices(const ProblemSpec& spec, const UniformGrid& grid, const InputSpace& inputs,
               const Partition& partition, Rules rules = Rules::none);
  ClassChoices(const CheckContext& context, const Partition& partition, Rules rules = Rules::none)
      : ClassChoices(*context.spec, *context.grid, *context.inputs, partition, rules) {}

  /// Finds the choices at a cell. @param joint what agents who coordinate could choose, such as C(x): [joint
  ///   input] 0 or 1, or numbers of joint inputs
  void go_to(std::int64_t cell, const std::vector<std::uint8_t>& joint);
  void go_to(std::int64_t cell, const Numbers& joint);

  // @pre unchecked: go_to() was called
  /// [class][action] 0 or 1.
  [[nodiscard]] const std::vector<std::vector<std::uint8_t>>& actions() const { return actions_; }
  /// [class] Actions, ascending.
  [[nodiscard]] std::vector<Numbers> numbers() const;
  /// Takes the actions of a class from its choices whose bit is not set. @param bytes [cell, action / 8]
  void restrict_to(std::size_t c, const std::vector<std::uint8_t>& bytes, std::size_t cell);
  /// Whether each class can choose its action in u.
  [[nodiscard]] bool has(std::int64_t u) const {
    for (std::size_t c = 0; c < actions_.size(); ++c) {
      if (actions_[c][at(inputs_[c].action(u))] == 0) return false;
    }
    return true;
  }
  /// Whether there is no such joint input, as some class has no action.
  [[nodiscard]] bool is_empty() const;
  /// All such joint inputs, ascending.
  [[nodiscard]] Numbers joint() const;
  [[nodiscard]] std::int64_t joint_inputs() const { return joint_inputs_; }

 private:
  struct Class {
    Numbers offsets;                    ///< [action] what it adds to the number of a joint input
    std::deque<PermittedInputs> rules;  ///< of its agents
    bool asks_controller;               ///< an agent has no rule
  };

  template <class ForEachJoint>
  void find(std::int64_t cell, const ForEachJoint& for_each_joint);

  std::int64_t joint_inputs_;
  std::vector<InputClass> inputs_;  ///< [class]
  std::deque<Class> classes_;
  std::vector<std::vector<std::uint8_t>> actions_;
};

}  // namespace coordreq
