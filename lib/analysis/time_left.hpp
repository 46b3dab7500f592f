#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "analysis/progress.hpp"

namespace coordreq {

/// Estimates how long the current stage will still take, from what was done in it so far. Says nothing
/// where that would be a guess.
///
/// - A pass goes on at the rate it had.
/// - Sweeps look at fewer and fewer rows; if this one looks at less than the one before, later ones are
///   taken to shrink in the same ratio. In the first sweep, and where they do not shrink, nothing is known.
class TimeLeft {
 public:
  /// @param now seconds on any clock. @pre never less than before
  void update(const Progress& progress, double now);
  /// Seconds until the stage, or its substage, ends.
  [[nodiscard]] std::optional<double> seconds() const { return left_; }
  /// Seconds since it began.
  [[nodiscard]] double elapsed() const { return now_ - begin_; }
  /// The share of the pass or of the sweep that is done, in [0, 1]; none if not known.
  [[nodiscard]] std::optional<double> share() const { return share_; }

 private:
  void begin(const Progress& progress, double now);
  void update_sweep(const Progress& progress);
  [[nodiscard]] std::optional<double> rows_to_come(const Progress& progress) const;

  std::string stage_;
  std::string substage_;
  double begin_ = 0;
  double now_ = 0;
  std::int64_t sweep_ = 0;
  std::int64_t all_ = 0;
  std::int64_t done_ = 0;
  std::int64_t visited_ = 0;           ///< in the current sweep
  std::int64_t visited_in_last_ = -1;  ///< in the one before; -1: there was none
  std::int64_t visited_before_ = 0;    ///< in all sweeps before
  std::optional<double> share_;
  std::optional<double> left_;
};

}  // namespace coordreq
