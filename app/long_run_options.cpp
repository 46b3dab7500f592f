#include "app/long_run_options.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "app/command_values.hpp"
#include "base/error.hpp"

namespace coordreq {
namespace {

double parse_seconds(const std::string& text, const std::string& option) {
  constexpr double kMost = 1e9;
  double seconds = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  const bool is_whole = error == std::errc() && end == text.data() + text.size();
  if (!is_whole || !(seconds >= 0 && seconds <= kMost))
    throw UsageError(fmt::format("expected a number of seconds from 0, found '{}'", text), option);
  return std::abs(seconds);  // of -0
}

ProgressMode parse_mode(const std::string& text) {
  if (text == "auto") return ProgressMode::automatic;
  if (text == "bar") return ProgressMode::bar;
  if (text == "log") return ProgressMode::log;
  if (text == "none") return ProgressMode::none;
  throw UsageError(fmt::format("expected auto, bar, log or none, found '{}'", text), "--progress");
}

}  // namespace

ProgressOptions progress_options(const LongRunArguments& arguments) {
  ProgressOptions options;
  if (arguments.progress) options.mode = parse_mode(*arguments.progress);
  if (!arguments.progress_every) return options;
  if (options.mode != ProgressMode::log)
    throw UsageError("only a log has lines every so often, expected --progress log", "--progress-every");
  options.every_seconds = parse_seconds(*arguments.progress_every, "--progress-every");
  return options;
}

std::optional<CheckpointOptions> checkpoint_options(const LongRunArguments& arguments) {
  if (!arguments.checkpoint) {
    if (arguments.resume) throw UsageError("resume from what? expected --checkpoint FILE", "--resume");
    if (arguments.checkpoint_every)
      throw UsageError("save where? expected --checkpoint FILE", "--checkpoint-every");
    return std::nullopt;
  }
  CheckpointOptions options{.file = file_name(*arguments.checkpoint, "--checkpoint"),
                            .resume = arguments.resume};
  if (arguments.checkpoint_every)
    options.every_seconds = parse_seconds(*arguments.checkpoint_every, "--checkpoint-every");
  return options;
}

}  // namespace coordreq
