#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/checkpoint.hpp"
#include "answers/convention/convention_freedom.hpp"
#include "answers/invariance/controller.hpp"
#include "answers/invariance/invariance.hpp"
#include "answers/layers/delay_layers.hpp"
#include "answers/network/network_safety.hpp"
#include "base/thread_team.hpp"
#include "engine/pair_table.hpp"
#include "engine/row_engine.hpp"
#include "model/cell_order.hpp"
#include "model/model.hpp"
#include "reach/abstraction.hpp"
#include "results/controller_file.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// What is found of one partition. Groups and projections of its classes are not kept: with many partitions
/// they would take more memory than all else.
struct PartitionResult {
  const PartitionSpec* spec = nullptr;
  DelayLayers layers;
};

/// A convention and what it costs; the actions of each agent are a class of their own.
struct ConventionResult {
  ActionGrouping agents;
  ConventionFreedom freedom;
};

/// Told that a stage begins.
using EnterStage = std::function<void(const std::string& stage)>;

/// Who is told how the work goes on, and where it can be taken up. All functions are there.
struct SolutionWatch {
  EnterStage enter;
  /// A part of the stage begins: "projections", or "" for the stage itself.
  std::function<void(const std::string& part)> part;
  /// A step of the stage's fixed point, and how many cells a row has.
  std::function<void(const WaveStep& step, std::int64_t row_length)> step;
  Checkpoint* checkpoint = nullptr;  ///< may be none
};

/// What the fixed points of a problem have found, with all that it refers to. What is derived from it
/// (summary, arrays) reads it and changes nothing.
///
/// 1. Rows, columns and dimensions are those of abstraction.grid, with the states in the order of the model;
///    `order` maps cells of the spec's grid to them. Inputs and agents are the spec's.
/// 2. Neither copied nor moved: its parts refer to one another.
struct Solution {
  /// The stages "controller" if there is a file with one, "abstraction", "safe set", "invariance", "layers
  /// PARTITION" for each partition, coarser ones before finer ones, and what is derived from them: see
  /// Progress. REQUIRES: `problem` outlives the solution.
  /// @throws as analyze()
  Solution(const ProblemSpec& problem, ThreadTeam& team, const SolutionWatch& watch);
  Solution(const Solution&) = delete;
  Solution& operator=(const Solution&) = delete;

  const ProblemSpec& spec;
  Model model;
  std::optional<ControllerFile> listed;  ///< `controller.file`; then the order is that of the spec
  Abstraction abstraction;
  CellSet safe;
  std::optional<PairTable> allow;
  std::optional<CellSet> beyond;  ///< TubeSets::beyond
  RowEngine engine;
  RowHull hull;
  Invariance invariance;
  Controller controller;
  std::deque<PartitionResult> partitions;      ///< in the order of the spec; a deque, so that references stay
  std::optional<NetworkSafety> network;        ///< if the spec has one
  std::optional<ConventionResult> convention;  ///< if the spec asks for one
  CellOrder order;

 private:
  void find_convention(ThreadTeam& team, const SolutionWatch& watch);
  void find_layers(ThreadTeam& team, const SolutionWatch& watch);
  [[nodiscard]] Invariance find_invariance_set(ThreadTeam& team, const SolutionWatch& watch) const;
  void find_network(ThreadTeam& team, const SolutionWatch& watch);
  [[nodiscard]] DelayLayers layers_of(std::size_t p, const std::string& stage, ThreadTeam& team,
                                      const SolutionWatch& watch) const;
};

}  // namespace coordreq
