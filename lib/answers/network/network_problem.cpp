#include "answers/network/network_problem.hpp"

#include <algorithm>
#include <map>
#include <string>

#include "answers/invariance/answer.hpp"
#include "base/requires.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

std::vector<const PartitionSpec*> network_partitions(const NetworkSpec& network) {
  std::vector<const PartitionSpec*> partitions;
  for (const NetworkModeSpec& mode : network.modes) {
    const bool is_known = std::any_of(partitions.begin(), partitions.end(), [&](const PartitionSpec* known) {
      return known->classes == mode.partition.classes;
    });
    if (!is_known) partitions.push_back(&mode.partition);
  }
  return partitions;
}

NetworkProblem network_problem(const ProblemSpec& spec, const Controller& controller, const RowHull& hull) {
  REQUIRES(spec.network.has_value());
  const NetworkSpec& network = *spec.network;
  NetworkProblem problem{.controller = &controller,
                         .invariant = controller.invariant,
                         .hull = &hull,
                         .partitions = {},
                         .rules = {},
                         .modes = std::vector<NetworkMode>(network.modes.size()),
                         .resynthesise = network.resynthesise};
  std::map<std::string, std::size_t> number;
  for (const PartitionSpec* partition : network_partitions(network)) {
    number.emplace(partition->canonical, number.size());
    problem.partitions.push_back(input_classes(spec, controller.engine->abstraction().inputs, *partition));
  }
  problem.rules.assign(problem.partitions.size(), nullptr);
  for (std::size_t mode = 0; mode < network.modes.size(); ++mode)
    problem.modes[mode].partition = number.at(network.modes[mode].partition.canonical);
  for (const auto& [from, to] : network.transitions)
    problem.modes[static_cast<std::size_t>(from)].successors.push_back(static_cast<std::size_t>(to));
  return problem;
}

NetworkProblem network_problem(const Answers& answers) {
  REQUIRES(answers.context.spec.network.has_value());
  const AnalysisContext& context = answers.context;
  NetworkProblem problem =
      network_problem(context.spec, answers.get<NonterminalController>().controller, *context.hull);
  problem.invariant = &answers.get<Invariance>().invariant;
  problem.terminal = context.terminal_or_null();
  return problem;
}

}  // namespace coordreq
