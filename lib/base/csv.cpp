#include "base/csv.hpp"

#include <utility>

namespace coordreq {
namespace {

std::vector<std::string> fields_of(std::string_view line, const RefuseLine& refuse) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += line[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  if (quoted) refuse("a quotation mark is not closed");
  return fields;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

std::vector<std::string> csv_columns(std::string_view line, const RefuseLine& refuse) {
  line = trimmed(line);
  if (line.find(',') == std::string_view::npos) {
    for (const auto& [sign, sign_name] : {std::pair(';', "semicolons"), std::pair('\t', "tabs")}) {
      if (line.find(sign) == std::string_view::npos) continue;
      refuse(std::string("expected commas between columns and points in numbers, found ") + sign_name);
    }
  }
  std::vector<std::string> names = fields_of(line, refuse);
  for (std::string& name : names) name = trimmed(name);
  return names;
}

std::vector<std::string> csv_values(std::string_view line, std::size_t columns, const RefuseLine& refuse) {
  std::vector<std::string> values = fields_of(line, refuse);
  if (values.size() != columns) {
    const char* const hint = values.size() > columns ? "; numbers need a decimal point, not a comma" : "";
    refuse("expected " + std::to_string(columns) + " values, found " + std::to_string(values.size()) + hint);
  }
  return values;
}

}  // namespace coordreq
