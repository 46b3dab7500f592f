#include "cell/state_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/error.hpp"
#include "expression/program.hpp"
#include "spec/system_spec.hpp"
#include "spec/wording.hpp"

namespace coordreq {

std::vector<std::string_view> split_at_commas(std::string_view text) {
  std::vector<std::string_view> items;
  std::size_t begin = 0;
  int depth = 0;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    if (i < text.size() && text[i] == '(') ++depth;
    if (i < text.size() && text[i] == ')') --depth;
    if (i < text.size() && (text[i] != ',' || depth > 0)) continue;
    items.push_back(text.substr(begin, i - begin));
    begin = i + 1;
  }
  return items;
}

namespace {

/// "1,5"
bool is_decimal_with_comma(std::string_view text) {
  std::string with_point(text);
  const std::size_t comma = with_point.find(',');
  if (comma == std::string::npos) return false;
  with_point[comma] = '.';
  return parse_decimal(with_point).has_value();
}

}  // namespace

Rational parse_value(std::string_view text, const std::string& where) {
  text = trimmed(text);
  if (text.empty()) throw UsageError("expected a number, found nothing", where);
  if (const std::optional<Rational> value = parse_decimal(text)) return *value;
  if (is_decimal_with_comma(text))
    throw UsageError("expected a decimal point, found " + quote_text(text), where);
  const auto nothing = [](std::string_view) { return Binding(); };
  try {
    return constant_value(link(text, nothing, ExpectedType::number, where), where);
  } catch (const SpecError& error) {
    throw UsageError(error.what());
  }
}

std::size_t state_number(std::string_view name, const std::vector<std::string>& names,
                         const std::string& where) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  throw UsageError(fmt::format("{} is no state{}, expected {}", quote_text(name), suggestion(name, names),
                               quote_list(names, "or")),
                   where);
}

namespace {

/// Whether one more NAME=VALUE follows without a comma: an '=' of no comparison.
bool has_assignment(std::string_view value) {
  for (std::size_t i = 0; i < value.size(); ++i) {
    const std::size_t end = value.find_first_not_of("<>=!", i);
    if (value.substr(i, end == std::string_view::npos ? end : end - i) == "=") return true;
    if (end == std::string_view::npos) break;
    i = end;
  }
  return false;
}

}  // namespace

StateNames state_names(const SystemSpec& spec) {
  std::vector<std::string> names;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    names.push_back(spec.states[i].name);
    if (spec.dynamics.is_kept(i)) ++kept;
  }
  StateNames result(std::move(names));
  result.needed -= kept;
  return result;
}

std::vector<Rational> parse_state(std::string_view text, const StateNames& states, const std::string& where) {
  const std::vector<std::string>& names = states.names;
  std::vector<std::optional<Rational>> values(names.size());
  for (const std::string_view item : split_at_commas(text)) {
    const std::size_t equals = item.find('=');
    if (equals == std::string_view::npos) {
      throw UsageError(fmt::format("expected NAME=VALUE, found {}", quote_text(trimmed(item))), where);
    }
    if (has_assignment(item.substr(equals + 1)))
      throw UsageError(fmt::format("expected a comma between states, found {}", quote_text(trimmed(item))),
                       where);
    const std::size_t i = state_number(trimmed(item.substr(0, equals)), names, where);
    if (values[i]) throw UsageError(fmt::format("'{}' is given twice", names[i]), where);
    values[i] = parse_value(item.substr(equals + 1), where + ", " + names[i]);
  }
  std::vector<Rational> state;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!values[i] && i < states.needed)
      throw UsageError(fmt::format("no value for the state '{}'", names[i]), where);
    state.push_back(values[i].value_or(0));
  }
  return state;
}

}  // namespace coordreq
