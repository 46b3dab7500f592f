#include "app/render.hpp"
#include "base/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace coordreq {

std::int64_t number_of(const Json& json) {
  return json.get<std::int64_t>();
}

std::string text_of(const Json& json) {
  return json.get<std::string>();
}

std::string line_of(const Json& json) {
  return printable(text_of(json));
}

std::string grouped(const Json& count) {
  return grouped(count.get<std::uint64_t>());
}

std::string cells(const Json& count) {
  return cells(number_of(count));
}

std::string duration(const Json& steps, const Json& document) {
  return duration(number_of(steps), document["period"].get<double>(), text_of(document["period_unit"]));
}

std::string values_text(const Json& values) {
  std::string text;
  for (const auto& [name, value] : values.items())
    text += fmt::format("{}{} = {:.6g}", text.empty() ? "" : ", ", name, value.get<double>());
  return text;
}

std::string probability_text(const Json& probability) {
  const auto value = probability.get<double>();
  const auto text = [](double p) { return fmt::format("{:.3g}", p); };
  if (std::stod(text(value)) >= value) return text(value);
  const double unit = std::pow(10, std::floor(std::log10(value)) - 2);
  return text(value + unit / 2);
}

std::string sides_text(const Json& outside) {
  if (outside["below"] == outside["above"]) return text_of(outside["below"]);
  return fmt::format("{} below, {} above", text_of(outside["below"]), text_of(outside["above"]));
}

std::string label_of(std::string key) {
  std::replace(key.begin(), key.end(), '_', ' ');
  return key;
}

std::string table_text(const Json& rows, const std::vector<Column>& columns) {
  std::vector<Table::Align> aligned;
  std::vector<std::string> headings;
  for (const Column& column : columns) {
    aligned.push_back(column.align);
    headings.push_back(column.heading);
  }
  Table table(aligned);
  table.add(headings);
  for (const Json& row : rows) {
    std::vector<std::string> texts;
    for (const Column& column : columns) texts.push_back(column.text(row));
    table.add(std::move(texts));
  }
  return table.text();
}

std::string facts_text(const Facts& facts) {
  Table table({Table::Align::left, Table::Align::left});
  for (const auto& [name, fact] : facts) table.add({name, fact});
  return table.text();
}

std::string others_text(const Json& document, const std::vector<std::string>& known) {
  std::string text;
  for (const auto& [name, section] : document.items()) {
    if (!section.is_object() || std::find(known.begin(), known.end(), name) != known.end()) continue;
    Facts facts;
    for (const auto& [key, value] : section.items()) {
      if (value.is_primitive() && !value.is_null())
        facts.emplace_back("  " + label_of(key), value.is_string() ? line_of(value) : compact_json(value));
    }
    text += fmt::format("\n{}\n{}", label_of(name), facts_text(facts));
  }
  return text;
}

}  // namespace coordreq
