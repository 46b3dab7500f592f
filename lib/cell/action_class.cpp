#include <algorithm>
#include <utility>

#include "cell/admissible_inputs.hpp"

namespace coordreq {
namespace {

constexpr std::int64_t kMostTabulated = std::int64_t{1} << 20U;

}  // namespace

ActionClass::ActionClass(const InputSpace& space, std::vector<std::int32_t> inputs)
    : space_(&space), inputs_(std::move(inputs)) {
  for (const std::int32_t i : inputs_) count_ *= space[static_cast<std::size_t>(i)].count();
  for (std::int64_t u = 0; u < space.count() && space.count() <= kMostTabulated; ++u) {
    actions_.push_back(static_cast<std::int32_t>(compute_action(u)));
  }
}

std::int64_t ActionClass::compute_action(std::int64_t u) const {
  std::int64_t number = 0;
  for (const std::int32_t j : inputs_) {
    const auto i = static_cast<std::size_t>(j);
    number = number * (*space_)[i].count() + space_->index(u, i);
  }
  return number;
}

std::int64_t ActionClass::part(std::int64_t a) const {
  std::int64_t sum = 0;
  for (std::size_t j = inputs_.size(); j-- > 0;) {
    const auto i = static_cast<std::size_t>(inputs_[j]);
    sum += a % (*space_)[i].count() * space_->stride(i);
    a /= (*space_)[i].count();
  }
  return sum;
}

std::vector<std::int64_t> ActionClass::project(const std::vector<std::int64_t>& joint_inputs) const {
  std::vector<bool> seen(static_cast<std::size_t>(count_), false);
  for (const std::int64_t u : joint_inputs) seen[static_cast<std::size_t>(action(u))] = true;
  std::vector<std::int64_t> actions;
  for (std::size_t a = 0; a < seen.size(); ++a) {
    if (seen[a]) actions.push_back(static_cast<std::int64_t>(a));
  }
  return actions;
}

std::vector<ActionClass> action_classes(const ProblemSpec& spec, const PartitionSpec& partition,
                                        const InputSpace& space) {
  std::vector<ActionClass> classes;
  for (const auto& agents : partition.classes) {
    std::vector<std::int32_t> inputs;
    for (const std::int32_t agent : agents) {
      const auto& own = spec.agents[static_cast<std::size_t>(agent)].inputs;
      inputs.insert(inputs.end(), own.begin(), own.end());
    }
    std::sort(inputs.begin(), inputs.end());
    classes.emplace_back(space, std::move(inputs));
  }
  return classes;
}

}  // namespace coordreq
