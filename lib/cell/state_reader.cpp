#include "cell/state_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/csv.hpp"
#include "base/error.hpp"
#include "base/json.hpp"
#include "cell/state_text.hpp"
#include "spec/json_document.hpp"
#include "spec/json_text.hpp"
#include "spec/wording.hpp"

namespace coordreq {
std::string StateReader::Extra::text() const {
  if (!is_json) return std::string(trimmed(value));
  const Json json = parse_json(value);
  if (json.is_null()) return {};
  return json.is_string() ? json.get<std::string>() : value;
}

StateReader::StateReader(std::istream& stream, StateNames states, std::string source)
    : stream_(stream), names_(std::move(states.names)), needed_(states.needed), source_(std::move(source)) {
  pending_ = read_line();
  line_ = std::string(without_byte_order_mark(line_));
  if (!pending_) return;
  if (trimmed(line_).front() == '{') {
    format_ = Format::json_lines;
  } else {
    read_header();
  }
}

RefuseLine StateReader::refusal() const {
  return [this](const std::string& what) { throw UsageError(what, location()); };
}

std::string StateReader::location() const {
  return fmt::format("{}, line {}", source_, line_number_);
}

bool StateReader::read_line() {
  while (std::getline(stream_, line_)) {
    ++line_number_;
    if (!trimmed(line_).empty()) return true;
  }
  if (stream_.bad()) throw IoError("cannot be read", source_);
  return false;
}

/// The state with this name; the number of states if there is none.
std::size_t StateReader::state_of(std::string_view name) const {
  return static_cast<std::size_t>(std::find(names_.begin(), names_.end(), name) - names_.begin());
}

/// An extra name may be the one that was meant.
std::string StateReader::missing(const char* what, const std::string& state) const {
  std::string text = fmt::format("no {} for the state {}", what, quote_text(state));
  for (const std::string& name : extra_names_)
    text += fmt::format("{} {}", &name == &extra_names_.front() ? "; no state is" : ",", quote_text(name));
  return text;
}

void StateReader::read_header() {
  for (const std::string& name : csv_columns(line_, refusal())) {
    const std::size_t state = state_of(name);
    if (state == names_.size()) {
      extra_names_.push_back(name);
    } else if (std::find(columns_.begin(), columns_.end(), state) != columns_.end()) {
      throw UsageError(fmt::format("'{}' is given twice", names_[state]), location());
    }
    columns_.push_back(state);
  }
  for (std::size_t i = 0; i < needed_; ++i) {
    if (std::find(columns_.begin(), columns_.end(), i) == columns_.end())
      throw UsageError(missing("column", names_[i]), location());
  }
  pending_ = false;
}

std::optional<std::vector<Rational>> StateReader::next() {
  if (!std::exchange(pending_, false) && !read_line()) return std::nullopt;
  return format_ == Format::csv ? csv_state() : json_state();
}

std::vector<Rational> StateReader::csv_state() {
  const std::vector<std::string> fields = csv_values(line_, columns_.size(), refusal());
  std::vector<Rational> state(names_.size());
  is_given_.assign(names_.size(), false);
  extra_.clear();
  for (std::size_t c = 0; c < fields.size(); ++c) {
    if (columns_[c] == names_.size()) {
      extra_.push_back({extra_names_[extra_.size()], fields[c]});
    } else {
      is_given_[columns_[c]] = true;
      state[columns_[c]] = parse_value(fields[c], location() + ", " + names_[columns_[c]]);
    }
  }
  return state;
}

std::vector<Rational> StateReader::json_state() {
  try {
    const JsonDocument document = JsonDocument::parse(line_, source_);
    const JsonDocument::Node root = document.root();
    if (!root.is_object()) throw UsageError("expected a JSON object a line", location());
    extra_names_.clear();
    extra_.clear();
    for (const std::string& key : root.keys()) {
      if (state_of(key) < names_.size()) continue;
      extra_names_.push_back(key);
      extra_.push_back({key, root[key].json(), true});
    }
    std::vector<Rational> state;
    is_given_.clear();
    for (const std::string& name : names_) {
      is_given_.push_back(root.has(name));
      if (!root.has(name) && state.size() >= needed_) {
        state.emplace_back(0);
        continue;
      }
      if (!root.has(name)) throw UsageError(missing("value", name), location());
      const JsonDocument::Node node = root[name];
      if (!node.is_number() && !node.is_text()) {
        throw UsageError("expected a number or a string", location() + ", " + name);
      }
      const std::string text = node.is_number() ? node.token() : node.text();
      state.push_back(parse_value(text, location() + ", " + name));
    }
    return state;
  } catch (const SpecError& error) {
    // Its location is one in this line alone, or none.
    const std::string what = error.what();
    const std::size_t cut = what.rfind(" (");
    const std::size_t column = what.find(", column ", cut);
    const std::string tail = column == std::string::npos ? "" : what.substr(column, what.size() - 1 - column);
    throw UsageError(what.substr(0, cut), location() + tail);
  }
}

}  // namespace coordreq
