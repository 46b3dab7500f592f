#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cell/cell_controller.hpp"
#include "cell/log_position.hpp"

namespace coordreq {

/// Whether all agents agreed on a step.
enum class Contact : std::uint8_t {
  no,
  yes,
  possible,  ///< the log does not say so, and does not rule it out
};

/// Follows the countdowns of a log as ClosedLoop runs them (paper, Definition 3): one begins at the first
/// sample and after each step with contact, with the delay of the cell, or 0 if that is below D; each silent
/// step takes one off. Of a policy with an aim likewise, from a cell in which it holds and as long as classes
/// keep to it; the longest countdown counts.
///
/// Where contact is possible a countdown is the longest that the log leaves open.
class SilenceWatch {
 public:
  /// @pre unchecked: all outlive this object.
  SilenceWatch(const ResultsReader& results, std::size_t partition, CellController& controller);

  /// A first sample.
  void begin(const LogPosition& position);
  /// Steps that the agents may still go on alone, kUnbounded without end; nothing outside K.
  [[nodiscard]] std::optional<std::int32_t> countdown() const;
  /// The step from a sample on. @param actions [class] in joint actions of the class; -1: none of these;
  /// nothing: not known
  /// @returns whether agents are silent for longer than their countdown
  [[nodiscard]] bool leave(const LogPosition& position, Contact contact,
                           const std::vector<std::optional<std::int64_t>>& actions);
  /// The sample after a step. @returns whether it tolerates less silence than the countdown promised
  [[nodiscard]] bool arrive(const LogPosition& position, Contact contact);
  /// The delay of a cell: steps, kUnbounded, -1 outside K, -2 outside S.
  [[nodiscard]] std::int32_t delay(std::int64_t cell) { return steps_.front()(cell); }

 private:
  using Steps = std::optional<std::int32_t>;

  [[nodiscard]] std::int32_t most_steps(std::size_t policy, const LogPosition& position);
  [[nodiscard]] Steps begun(std::size_t policy, const LogPosition& position);
  [[nodiscard]] bool keeps(std::size_t policy, const LogPosition& position,
                           const std::vector<std::optional<std::int64_t>>& actions);
  [[nodiscard]] bool has_aim(std::size_t policy) const { return !policies_[policy].aim.path.empty(); }
  void look_for_aims(const LogPosition& position);

  CellController& controller_;
  std::size_t partition_;
  std::int64_t connection_delay_;
  std::vector<AnswerPolicy> policies_;  ///< of the loop, that of the delays first
  std::vector<CellValue> steps_;        ///< [policy]
  std::vector<CellValue> aims_;         ///< [policy]; of those without an aim that can be reached none
  std::vector<Steps> left_;             ///< [policy] of the countdown; nothing: there is none
  bool has_arrived_ = false;
};

}  // namespace coordreq
