#include "app/progress_line.hpp"

#include <algorithm>

#include "app/standard_streams.hpp"
#include "app/text.hpp"

namespace coordreq {
namespace {

constexpr std::chrono::milliseconds kPause{100};

std::string describe(const Progress& progress) {
  std::string text = printable(progress.stage);
  if (progress.sweep > 0) {
    text += ", sweep " + grouped(progress.sweep) + ", " + grouped(progress.rows) + " rows";
  }
  return text;
}

}  // namespace

// Work that is over within the first pause shows no line at all.
ProgressLine::ProgressLine(bool shown)
    : width_(shown ? std::max(diagnostics_terminal_width() - 1, 0) : 0), next_(Clock::now() + kPause) {}

ProgressLine::~ProgressLine() {
  if (length_ > 0) rewrite("");
}

void ProgressLine::update(const Progress& progress) {
  update(describe(progress));
}

void ProgressLine::update(const std::string& text) {
  if (width_ == 0) return;
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + kPause;
  rewrite(text.substr(0, static_cast<std::size_t>(width_)));
}

void ProgressLine::rewrite(const std::string& text) {
  const std::size_t padding = length_ > text.size() ? length_ - text.size() : 0;
  write_diagnostics("\r" + text + std::string(padding, ' ') + (text.empty() ? "\r" : ""));
  length_ = text.size();
}

}  // namespace coordreq
