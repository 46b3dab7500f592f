#pragma once

#include <cstddef>
#include <vector>

#include "answers/answers.hpp"
#include "choices/controller.hpp"
#include "engine/row_hull.hpp"
#include "model/input_class.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

class Projections;

/// One mode of a network: who is connected in a step, and which modes the next step can be in.
struct NetworkMode {
  std::size_t partition = 0;            ///< index into NetworkProblem::partitions
  std::vector<std::size_t> successors;  ///< indices of modes; at least one
};

struct NetworkProblem {
  const Controller* controller = nullptr;  ///< C in K, without the cells of a goal that ends the task
  const CellSet* invariant = nullptr;      ///< K
  const CellSet* terminal =
      nullptr;  ///< G of a goal that ends the task, which is in every W(q); null: there is none
  const RowHull* hull = nullptr;
  std::vector<std::vector<InputClass>> partitions;  ///< the different partitions: the classes of each
  /// [partition] A(x) in K of agents that act by rules; null: they choose from IND_C(x). The objects outlive
  /// this one.
  std::vector<const Projections*> rules;
  std::vector<NetworkMode> modes;
  bool resynthesise = false;
};

/// The network of a spec as input of find_network_safety() and find_risk(); modes that connect the same
/// agents share a partition. Without a goal that ends the task.
/// @pre the spec has a network. @pre unchecked: `controller` and `hull` outlive the result
[[nodiscard]] NetworkProblem network_problem(const ProblemSpec& spec, const Controller& controller,
                                             const RowHull& hull);
/// The network of the spec, with K. @pre the spec has a network. @pre unchecked: K is known; `answers`
/// outlive the result
[[nodiscard]] NetworkProblem network_problem(const Answers& answers);

/// The different partitions of the modes of a network, in the order of the modes.
[[nodiscard]] std::vector<const PartitionSpec*> network_partitions(const NetworkSpec& network);

}  // namespace coordreq
