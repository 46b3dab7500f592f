#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "answers/checking/corner_truth.hpp"
#include "expression/evaluate.hpp"
#include "model/uniform_grid.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The verdict on a cell and `safe`, or the condition of the goal.
enum class SafeVerdict : std::uint8_t {
  unknown,  ///< not judged yet
  safe,     ///< natural interval evaluation proves it: the cell has to be in S
  proven,   ///< the whole cell is safe, but natural evaluation does not prove it: the cell may be in S
  unsafe,   ///< the cell holds a point that is not safe: it must not be in S
  open,     ///< neither proven nor refuted; as good as unsafe
};

/// Verdicts, shared by cells that differ only in states that `safe` does not mention.
class SafeMemory {
 public:
  SafeMemory(const Program& condition, const UniformGrid& grid);
  [[nodiscard]] std::atomic<SafeVerdict>& of(std::int64_t cell);
  [[nodiscard]] const std::vector<std::size_t>& states() const { return states_; }

 private:
  const UniformGrid& grid_;
  std::vector<std::size_t> states_;  ///< that the condition mentions
  std::vector<std::atomic<SafeVerdict>> verdicts_;
};

/// Decides whether a cell belongs to S (contract, "Safe set"), or to the goal likewise. One object a thread;
/// all share the memory.
class SafeJudge {
 public:
  SafeJudge(const ProblemSpec& spec, const Program& condition, const UniformGrid& grid, SafeMemory& memory);

  /// @param claimed whether the file has the cell in S: only then are cells judged that natural evaluation
  ///   leaves open
  [[nodiscard]] SafeVerdict judge(std::int64_t cell, bool claimed);

 private:
  using Box = std::vector<RationalInterval>;

  [[nodiscard]] bool proven_naturally(std::int64_t cell);
  [[nodiscard]] SafeVerdict look_closer(std::int64_t cell);
  [[nodiscard]] Truth natural(const Box& box);
  template <class Visit>
  void for_each_piece(std::int64_t cell, const Visit& visit) const;

  const UniformGrid& grid_;
  SafeMemory& memory_;
  std::size_t slots_;
  std::vector<std::vector<std::vector<RationalInterval>>> pieces_;  ///< [position in states()][index][piece]
  Evaluator<Interval> rough_;
  Evaluator<RationalInterval> exact_;
  CornerTruth corner_truth_;
};

}  // namespace coordreq
