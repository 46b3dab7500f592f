#pragma once

#include <cstdint>
#include <vector>

#include "model/input_space.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Inputs that are chosen together. A joint action of the class is a value for each of them; actions are
/// numbered row-major over the inputs, ascending, the last one fastest.
class InputClass {
 public:
  /// @param inputs indices, all different, in any order
  InputClass(const InputSpace& space, std::vector<std::int32_t> inputs);

  /// Ascending.
  [[nodiscard]] const std::vector<std::int32_t>& inputs() const { return inputs_; }
  [[nodiscard]] bool contains(std::int32_t input) const;
  /// Number of joint actions, and of bytes that one bit for each takes.
  [[nodiscard]] std::int64_t actions() const { return actions_; }
  [[nodiscard]] std::int64_t bytes() const { return (actions_ + 7) / 8; }

  /// The class's action in joint input u. Cost: a division or two an input, or a look-up: see tabulate().
  [[nodiscard]] std::int64_t action(std::int64_t u) const {
    return table_.empty() ? compute_action(u) : table_[static_cast<std::size_t>(u)];
  }
  /// [action] what it adds to a position in a table with these strides by input of the space.
  [[nodiscard]] std::vector<std::int64_t> offsets(const std::vector<std::int64_t>& stride) const;
  /// [input of the space] its stride in the number of an action; 0 for those of other classes.
  [[nodiscard]] std::vector<std::int64_t> strides() const;
  /// [action] what it adds to the number of a joint input.
  [[nodiscard]] std::vector<std::int64_t> offsets() const;
  /// The projection of a set of joint inputs onto the class, ascending.
  [[nodiscard]] std::vector<std::int64_t> project(const std::vector<std::int64_t>& joint_inputs) const;

  /// Keeps the action of every joint input, unless there are millions of these.
  void tabulate();

 private:
  struct Input {
    std::int64_t count = 0;
    std::int64_t stride = 1;         ///< in the number of a joint input
    std::int64_t action_stride = 1;  ///< in the number of an action
  };

  [[nodiscard]] std::int64_t compute_action(std::int64_t u) const;

  std::vector<std::int32_t> inputs_;
  std::vector<Input> members_;  ///< [position in inputs_]
  std::size_t space_size_ = 0;
  std::int64_t joint_inputs_ = 1;
  std::int64_t actions_ = 1;
  std::vector<std::int32_t> table_;
};

/// The inputs of some agents.
[[nodiscard]] InputClass class_of(const SystemSpec& spec, const InputSpace& space,
                                  const std::vector<std::int32_t>& agents);
/// The classes of a partition, in its order: the inputs of all agents of each.
[[nodiscard]] std::vector<InputClass> input_classes(const SystemSpec& spec, const InputSpace& space,
                                                    const PartitionSpec& partition);
/// Every agent alone, in the order of the spec.
[[nodiscard]] std::vector<InputClass> agent_classes(const SystemSpec& spec, const InputSpace& space);
/// Every input alone.
[[nodiscard]] std::vector<InputClass> single_classes(const InputSpace& space);
/// All inputs together: actions are joint inputs.
[[nodiscard]] InputClass whole_class(const InputSpace& space);

}  // namespace coordreq
