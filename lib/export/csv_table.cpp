#include "export/formats.hpp"

#include <fmt/format.h>

#include "answers/step_codes.hpp"
#include "numeric/rational.hpp"

namespace coordreq {

void export_csv(const ResultsReader& results, const TableSelection& selection, const TextSink& sink) {
  const CellTable table(results, selection);
  std::string text;
  std::vector<std::vector<std::string>> points;  // by dimension that remains
  for (const std::size_t i : table.dimensions()) {
    const GridDimension& dimension = results.grid()[i];
    text += dimension.name + ",";
    std::vector<std::string>& texts = points.emplace_back();
    for (std::int64_t k = 0; k < dimension.count; ++k) {
      texts.push_back(fmt::format("{},", nearest_double(dimension.point(k))));
    }
  }
  for (std::size_t c = 0; c < table.columns().size(); ++c)
    text += (c == 0 ? "" : ",") + table.columns()[c].name;
  text += "\n";
  table.for_each_row([&](const std::vector<std::int64_t>& index, const std::vector<std::int32_t>& values) {
    for (std::size_t i = 0; i < index.size(); ++i) text += points[i][static_cast<std::size_t>(index[i])];
    for (std::size_t c = 0; c < values.size(); ++c) {
      if (c > 0) text += ',';
      if (table.columns()[c].field->kind == FieldKind::probability) {
        text += fmt::format("{}", probability_of(values[c]));
      } else if (values[c] == kUnbounded) {
        text += "inf";
      } else {
        text += std::to_string(values[c]);
      }
    }
    text += '\n';
    sink(text);
    text.clear();
  });
  sink(text);
}

}  // namespace coordreq
