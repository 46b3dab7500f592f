#include "app/render.hpp"

#include <algorithm>

#include "answers/step_codes.hpp"

namespace coordreq {

std::string csv_steps(std::int32_t steps) {
  return steps == kUnbounded ? "inf" : std::to_string(steps);
}

std::string answer_column(const std::string& name, const ResultsReader& results) {
  const auto& states = results.grid().dimensions();
  const bool is_state =
      std::ranges::any_of(states, [&](const GridDimension& state) { return state.name == name; });
  return (is_state ? "answer:" : "") + name;
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
  return field + "\"";
}

}  // namespace coordreq
