#include "model/input_class.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "spec/coordination_spec.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

constexpr std::int64_t kMostTabulated = std::int64_t{1} << 20U;

}  // namespace

InputClass::InputClass(const InputSpace& space, std::vector<std::int32_t> inputs)
    : inputs_(std::move(inputs)), space_size_(space.size()), joint_inputs_(space.count()) {
  std::sort(inputs_.begin(), inputs_.end());
  members_.resize(inputs_.size());
  for (std::size_t j = members_.size(); j-- > 0;) {
    const auto input = static_cast<std::size_t>(inputs_[j]);
    members_[j] = {.count = space[input].count(), .stride = space.stride(input), .action_stride = actions_};
    actions_ *= members_[j].count;
  }
}

bool InputClass::contains(std::int32_t input) const {
  return std::binary_search(inputs_.begin(), inputs_.end(), input);
}

std::int64_t InputClass::compute_action(std::int64_t u) const {
  std::int64_t number = 0;
  for (const Input& input : members_) number = number * input.count + u / input.stride % input.count;
  return number;
}

std::vector<std::int64_t> InputClass::offsets(const std::vector<std::int64_t>& stride) const {
  std::vector<std::int64_t> result = {0};
  for (std::size_t j = 0; j < members_.size(); ++j) {
    std::vector<std::int64_t> longer;
    longer.reserve(result.size() * static_cast<std::size_t>(members_[j].count));
    for (const std::int64_t offset : result) {
      for (std::int64_t k = 0; k < members_[j].count; ++k)
        longer.push_back(offset + k * stride[static_cast<std::size_t>(inputs_[j])]);
    }
    result = std::move(longer);
  }
  return result;
}

std::vector<std::int64_t> InputClass::strides() const {
  std::vector<std::int64_t> stride(space_size_, 0);
  for (std::size_t j = 0; j < members_.size(); ++j)
    stride[static_cast<std::size_t>(inputs_[j])] = members_[j].action_stride;
  return stride;
}

std::vector<std::int64_t> InputClass::offsets() const {
  std::vector<std::int64_t> stride(space_size_, 0);
  for (std::size_t j = 0; j < members_.size(); ++j)
    stride[static_cast<std::size_t>(inputs_[j])] = members_[j].stride;
  return offsets(stride);
}

std::vector<std::int64_t> InputClass::project(const std::vector<std::int64_t>& joint_inputs) const {
  std::vector<bool> seen(static_cast<std::size_t>(actions_), false);
  for (const std::int64_t u : joint_inputs) seen[static_cast<std::size_t>(action(u))] = true;
  std::vector<std::int64_t> result;
  for (std::size_t a = 0; a < seen.size(); ++a) {
    if (seen[a]) result.push_back(static_cast<std::int64_t>(a));
  }
  return result;
}

void InputClass::tabulate() {
  if (joint_inputs_ > kMostTabulated || !table_.empty()) return;
  for (std::int64_t u = 0; u < joint_inputs_; ++u)
    table_.push_back(static_cast<std::int32_t>(compute_action(u)));
}

InputClass class_of(const SystemSpec& spec, const InputSpace& space,
                    const std::vector<std::int32_t>& agents) {
  std::vector<std::int32_t> inputs;
  for (const std::int32_t agent : agents) {
    const auto& agent_inputs = spec.agents[static_cast<std::size_t>(agent)].inputs;
    inputs.insert(inputs.end(), agent_inputs.begin(), agent_inputs.end());
  }
  return {space, std::move(inputs)};
}

std::vector<InputClass> input_classes(const SystemSpec& spec, const InputSpace& space,
                                      const PartitionSpec& partition) {
  std::vector<InputClass> classes;
  for (const auto& agents : partition.classes) classes.push_back(class_of(spec, space, agents));
  return classes;
}

std::vector<InputClass> agent_classes(const SystemSpec& spec, const InputSpace& space) {
  std::vector<InputClass> classes;
  for (const AgentSpec& agent : spec.agents) classes.emplace_back(space, agent.inputs);
  return classes;
}

std::vector<InputClass> single_classes(const InputSpace& space) {
  std::vector<InputClass> classes;
  for (std::size_t i = 0; i < space.size(); ++i)
    classes.emplace_back(space, std::vector<std::int32_t>{static_cast<std::int32_t>(i)});
  return classes;
}

InputClass whole_class(const InputSpace& space) {
  std::vector<std::int32_t> inputs(space.size());
  std::iota(inputs.begin(), inputs.end(), 0);
  return {space, std::move(inputs)};
}

}  // namespace coordreq
