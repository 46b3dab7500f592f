#include "app/progress_display.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/standard_streams.hpp"
#include "app/text.hpp"

namespace coordreq {
namespace {

constexpr std::chrono::duration<double> kPauseOfBar{0.1};
/// Between two lines, in seconds.
constexpr double kPauseOfLog = 10, kPauseElsewhere = 60;
/// Columns of the bar with all around it.
constexpr std::size_t kShortestBar = 8;
constexpr std::size_t kLongestBar = 28;

std::string label(const Progress& progress) {
  return printable(progress.substage.empty() ? progress.stage : progress.stage + ", " + progress.substage);
}

/// "[########------------] " of so many columns, the blank included.
std::string bar(double share, std::size_t columns) {
  const std::size_t cells = columns - 3;
  const std::size_t full = std::min(static_cast<std::size_t>(share * static_cast<double>(cells)), cells);
  return "[" + std::string(full, '#') + std::string(cells - full, '-') + "] ";
}

/// "sweep 3, layer 17, 1,234 cells left, 12 s left".
std::string facts(const Progress& progress, const TimeLeft& time_left) {
  std::vector<std::string> facts;
  if (progress.sweep > 0) {
    facts.push_back("sweep " + grouped(progress.sweep));
    if (progress.layer >= 0) facts.push_back("layer " + grouped(progress.layer));
    facts.push_back(cells(progress.cells_left) + " left");
  } else if (time_left.share()) {
    facts.push_back(fmt::format("{:.0f} %", std::floor(100 * *time_left.share())));
  }
  if (time_left.seconds()) facts.push_back(time_span(*time_left.seconds()) + " left");
  return fmt::format("{}", fmt::join(facts, ", "));
}

std::string bar_text(const Progress& progress, const TimeLeft& time_left, std::size_t width) {
  const std::string known = facts(progress, time_left);
  const std::string name = label(progress);
  if (known.empty()) return name.substr(0, width);
  const std::size_t text = name.size() + 1 + known.size();
  if (time_left.share() && text + kShortestBar <= width)
    return name + " " + bar(*time_left.share(), std::min(width - text, kLongestBar)) + known;
  return (name + ", " + known).substr(0, width);
}

}  // namespace

// Work that ends within the first pause shows nothing of the bar at all.
ProgressDisplay::ProgressDisplay(const ProgressOptions& options, bool quiet)
    : mode_(options.mode), begin_(Clock::now()), stage_begin_(begin_) {
  if (mode_ == ProgressMode::automatic) mode_ = quiet ? ProgressMode::none : ProgressMode::bar;
  // Room for the ^C that a terminal shows.
  if (mode_ == ProgressMode::bar) width_ = std::max(diagnostics_terminal_width() - 3, 0);
  is_sparse_ = width_ == 0 && mode_ == ProgressMode::bar;
  if (is_sparse_) mode_ = ProgressMode::log;
  pause_ = mode_ == ProgressMode::log ? std::chrono::duration<double>(options.every_seconds.value_or(
                                            is_sparse_ ? kPauseElsewhere : kPauseOfLog))
                                      : kPauseOfBar;
  next_ = begin_ + std::chrono::duration_cast<Clock::duration>(pause_);
}

ProgressDisplay::~ProgressDisplay() {
  if (mode_ == ProgressMode::bar) rewrite_terminal_line("");
}

double ProgressDisplay::seconds_since(Clock::time_point time) const {
  return std::chrono::duration<double>(Clock::now() - time).count();
}

void ProgressDisplay::update(const Progress& progress) {
  if (mode_ == ProgressMode::none) return;
  if (progress.stage != stage_) {
    end_stage();
    stage_ = progress.stage;
    stage_begin_ = Clock::now();
    // A visible bar names each stage, also those that take less than a pause.
    if (mode_ == ProgressMode::bar && stage_begin_ - begin_ > kPauseOfBar) next_ = stage_begin_;
  }
  time_left_.update(progress, seconds_since(begin_));
  const Clock::time_point now = Clock::now();
  if (now < next_ || stage_.empty()) return;
  next_ = now + std::chrono::duration_cast<Clock::duration>(pause_);
  if (mode_ == ProgressMode::bar) {
    rewrite_terminal_line(bar_text(progress, time_left_, static_cast<std::size_t>(width_)));
    return;
  }
  const std::string known = facts(progress, time_left_);
  write_diagnostics(fmt::format("coordreq: {}: {}{} so far\n", label(progress),
                                known.empty() ? "" : known + ", ", time_span(seconds_since(stage_begin_))));
}

void ProgressDisplay::end_stage() {
  if (mode_ != ProgressMode::log || is_sparse_ || stage_.empty()) return;
  write_diagnostics(
      fmt::format("coordreq: {}: done in {}\n", printable(stage_), time_span(seconds_since(stage_begin_))));
  stage_.clear();
}

void ProgressDisplay::finish() {
  end_stage();
}

void ProgressDisplay::notice(const std::string& text) {
  if (mode_ == ProgressMode::bar) rewrite_terminal_line("");
  write_diagnostics("coordreq: " + printable(text) + "\n");
}

}  // namespace coordreq
