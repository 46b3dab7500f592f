#include "spec/read_tables.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "base/error.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

using Node = JsonDocument::Node;
using Numbers = std::vector<Rational>;
using ReadNumber = std::function<Rational(const Node&)>;

/// A minimum of lines for each of them: time and memory grow with the square.
constexpr std::size_t kMostPoints = 100;
constexpr std::size_t kMostTableValues = 1000;

Node member(const Node& table, const std::string& key) {
  if (table.has(key)) return table[key];
  throw SpecError(fmt::format("expected {} and 'value', or 'file'; found no {}",
                              table.has("y") ? "'x', 'y'" : "'x'", quote_text(key)),
                  table.pointer());
}

Numbers read_axis(const Node& list, const ReadNumber& number) {
  const std::vector<Node> elements = list.elements();
  if (elements.size() < 2 || elements.size() > kMostPoints) {
    throw SpecError(fmt::format("expected 2 to {} numbers, found {}", kMostPoints, elements.size()),
                    list.pointer());
  }
  Numbers axis;
  for (const Node& element : elements) {
    const Rational next = number(element);
    if (!axis.empty() && next <= axis.back()) {
      throw SpecError(fmt::format("expected a number > {}, found {}", to_text(axis.back()), to_text(next)),
                      element.pointer());
    }
    axis.push_back(next);
  }
  return axis;
}

void check_length(const Node& list, std::size_t length, std::string_view of_what) {
  if (list.size() == length) return;
  throw SpecError(fmt::format("expected {} {}, found {}", length, of_what, list.size()), list.pointer());
}

Numbers read_values(const Node& list, std::size_t length, const ReadNumber& number) {
  check_length(list, length, "numbers, one for each x");
  Numbers values;
  for (const Node& element : list.elements()) {
    if (!element.is_number() && !element.is_text())
      throw SpecError("expected a number, since there is no 'y', found a list", element.pointer());
    values.push_back(number(element));
  }
  return values;
}

std::vector<Numbers> read_rows(const Node& list, std::size_t width, std::size_t height,
                               const ReadNumber& number) {
  check_length(list, height, "lists, one for each y");
  if (width * height > kMostTableValues) {
    throw SpecError(fmt::format("expected at most {} values, found {}", kMostTableValues, width * height),
                    list.pointer());
  }
  std::vector<Numbers> rows;
  for (const Node& row : list.elements()) {
    if (row.is_number() || row.is_text())
      throw SpecError("expected a list of numbers, one for each x, found a number", row.pointer());
    rows.push_back(read_values(row, width, number));
  }
  return rows;
}

}  // namespace

TableFunction read_table(const Node& table, const ReadNumber& number) {
  if (table.has("file"))
    throw SpecError("a file can be read for a spec in a file only", table["file"].pointer());
  const Numbers x = read_axis(member(table, "x"), number);
  const Node value = member(table, "value");
  const BeyondAxis beyond =
      table.text_or("outside", "refuse") == "clamp" ? BeyondAxis::clamp : BeyondAxis::refuse;
  if (!table.has("y")) return linear_table(x, read_values(value, x.size(), number), beyond);
  const Numbers y = read_axis(table["y"], number);
  return bilinear_table(x, y, read_rows(value, x.size(), y.size(), number), beyond);
}

}  // namespace coordreq
