#include "export/cell_table.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "cell/state_text.hpp"
#include "model/locate.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

class SelectionParser {
 public:
  explicit SelectionParser(const UniformGrid& grid) : grid_(grid), seen_(grid.size(), false) {
    for (const GridDimension& dimension : grid.dimensions()) names_.push_back(dimension.name);
  }

  void slice(std::string_view text, std::vector<TableSelection::Slice>& slices) {
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) {
      throw UsageError(fmt::format("expected STATE=VALUE, found {}", quote_text(text)), "--slice");
    }
    const std::size_t i = state(text.substr(0, equals), "--slice");
    const std::vector<Rational> value = {parse_value(text.substr(equals + 1), "--slice, " + names_[i])};
    const Location location = locate(UniformGrid({grid_[i]}), value);
    if (location.kind != Location::Kind::cell) {
      throw UsageError(fmt::format("{} = {} is outside of the domain", names_[i], to_text(value.front())),
                       "--slice");
    }
    slices.push_back({i, location.cell});
  }

  void projection(std::string_view text, std::vector<TableSelection::Projection>& projections) {
    const std::size_t colon = text.find(':');
    const std::string_view kind = colon == std::string_view::npos ? "" : trimmed(text.substr(colon + 1));
    if (kind != "min" && kind != "max") {
      throw UsageError(fmt::format("expected STATE:min or STATE:max, found {}", quote_text(text)),
                       "--project");
    }
    projections.push_back({state(text.substr(0, colon), "--project"), kind == "max"});
  }

 private:
  std::size_t state(std::string_view name, const std::string& where) {
    const std::size_t i = state_number(trimmed(name), names_, where);
    if (seen_[i]) throw UsageError(fmt::format("'{}' is sliced or projected twice", names_[i]), where);
    seen_[i] = true;
    return i;
  }

  const UniformGrid& grid_;
  std::vector<std::string> names_;
  std::vector<bool> seen_;
};

}  // namespace

TableSelection parse_selection(const std::vector<std::string>& slices,
                               const std::vector<std::string>& projections, const UniformGrid& grid) {
  SelectionParser parser(grid);
  TableSelection selection;
  for (const std::string& text : slices) {
    for (const std::string_view item : split_at_commas(text)) parser.slice(trimmed(item), selection.slices);
  }
  for (const std::string& text : projections) {
    for (const std::string_view item : split_at_commas(text))
      parser.projection(trimmed(item), selection.projections);
  }
  return selection;
}

}  // namespace coordreq
