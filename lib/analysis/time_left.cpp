#include "analysis/time_left.hpp"

#include <algorithm>

#include "base/requires.hpp"

namespace coordreq {
namespace {

/// Sooner, or with less done, nothing can be said.
constexpr double kFirstSeconds = 1;
constexpr double kFirstShare = 0.02;
/// Sweeps that shrink more slowly may go on for any time.
constexpr double kSlowestDecay = 0.9;
/// More than so many times what has passed is no estimate.
constexpr double kFarthest = 60;

}  // namespace

void TimeLeft::begin(const Progress& progress, double now) {
  *this = {};
  stage_ = progress.stage;
  substage_ = progress.substage;
  all_ = progress.all;
  begin_ = now;
}

void TimeLeft::update(const Progress& progress, double now) {
  REQUIRES(stage_.empty() || now >= now_);
  const bool is_sweep = progress.sweep > 0;
  const bool same_pass = is_sweep || (progress.all == all_ && progress.done >= done_);
  if (progress.stage != stage_ || progress.substage != substage_ || progress.sweep < sweep_ || !same_pass ||
      (is_sweep && sweep_ == 0)) {
    begin(progress, now);
  }
  now_ = now;
  done_ = progress.done;
  share_.reset();
  left_.reset();
  if (is_sweep) update_sweep(progress);
  if (!is_sweep && progress.all > 0)
    share_ = std::clamp(static_cast<double>(progress.done) / static_cast<double>(progress.all), 0.0, 1.0);
  if (elapsed() < kFirstSeconds) return;
  if (is_sweep) {
    const std::optional<double> rows = rows_to_come(progress);
    const auto done = static_cast<double>(visited_before_ + visited_);
    if (rows && done > 0) left_ = *rows * elapsed() / done;
  } else if (share_ && *share_ >= kFirstShare) {
    left_ = elapsed() * (1 - *share_) / *share_;
  }
  if (left_ && *left_ > kFarthest * elapsed()) left_.reset();
}

void TimeLeft::update_sweep(const Progress& progress) {
  if (progress.sweep != sweep_) {
    if (progress.sweep == sweep_ + 1 && sweep_ > 0) visited_in_last_ = visited_;
    visited_before_ += visited_;
    sweep_ = progress.sweep;
  }
  visited_ = progress.visited;
  if (progress.cells > 0) {
    share_ = std::clamp(1 - static_cast<double>(progress.cells_left) / static_cast<double>(progress.cells),
                        0.0, 1.0);
  }
}

/// The rest of this sweep at the rate of its beginning, and then a geometric series.
std::optional<double> TimeLeft::rows_to_come(const Progress& progress) const {
  if (visited_in_last_ <= 0 || !share_ || *share_ < 0.1) return std::nullopt;
  const double whole = static_cast<double>(progress.visited) / *share_;
  const double ratio = whole / static_cast<double>(visited_in_last_);
  if (ratio > kSlowestDecay) return std::nullopt;
  return whole * (1 - *share_) + whole * ratio / (1 - ratio);
}

}  // namespace coordreq
