#include "cell/log_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "spec/system_spec.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

constexpr const char* kTime = "t";
constexpr const char* kConnected = "connected";

}  // namespace

LogReader::LogReader(std::istream& stream, const SystemSpec& spec, std::string source)
    : states_(stream, state_names(spec), std::move(source)) {
  for (const InputSpec& input : spec.inputs) inputs_.push_back(input.name);
  check_names();
}

std::optional<std::size_t> LogReader::input_of(const std::string& name) const {
  const auto found = std::find(inputs_.begin(), inputs_.end(), name);
  if (found == inputs_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - inputs_.begin());
}

/// Refuses two columns of one name.
void LogReader::check_names() const {
  const std::vector<std::string>& names = states_.extra_names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool is_known = input_of(names[i]) || names[i] == kTime || names[i] == kConnected;
    if (is_known && std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
                        names.begin() + static_cast<std::ptrdiff_t>(i))
      throw UsageError(fmt::format("'{}' is given twice", names[i]), states_.location());
  }
}

std::vector<std::string> LogReader::unknown_names() const {
  std::vector<std::string> names = states_.extra_names();
  std::erase_if(names, [this](const std::string& name) {
    return input_of(name) || name == kTime || name == kConnected;
  });
  return names;
}

std::optional<LogRow> LogReader::next() {
  std::optional<std::vector<Rational>> state = states_.next();
  if (!state) return std::nullopt;
  LogRow row{.location = states_.location(), .state = std::move(*state)};
  for (std::size_t i = 0; i < row.state.size(); ++i) row.is_given.push_back(states_.is_given(i));
  row.inputs.resize(inputs_.size());
  for (const StateReader::Extra& extra : states_.extra()) take(extra, row);
  return row;
}

void LogReader::take(const StateReader::Extra& extra, LogRow& row) const {
  const std::optional<std::size_t> input = input_of(extra.name);
  if (!input && extra.name != kTime && extra.name != kConnected) return;
  const std::string text = extra.text();
  if (text.empty()) return;
  const std::string location = row.location + ", " + extra.name;
  if (input) {
    row.inputs[*input] = parse_value(text, location);
  } else if (extra.name == kTime) {
    row.time = parse_value(text, location);
  } else if (text == "0" || text == "1") {
    row.connected = text == "1";
  } else {
    throw UsageError(fmt::format("expected 0 or 1, found {}", quote_text(text)), location);
  }
}

}  // namespace coordreq
