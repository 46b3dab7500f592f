#include "export/formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "base/error.hpp"
#include "numeric/rational.hpp"
#include "results/chunk_codec.hpp"
#include "spec/problem_spec.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

constexpr std::size_t kAxes = 3;
using Steps = std::vector<std::int32_t>;

/// The states that are neither sliced nor projected.
std::vector<std::size_t> drawn_states(const UniformGrid& grid, const TableSelection& selection) {
  std::vector<std::size_t> drawn;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const auto is_this = [i](const auto& item) { return item.dimension == i; };
    if (std::any_of(selection.slices.begin(), selection.slices.end(), is_this)) continue;
    if (std::any_of(selection.projections.begin(), selection.projections.end(), is_this)) continue;
    drawn.push_back(i);
    names.push_back(grid[i].name);
  }
  if (drawn.size() > kAxes) {
    throw UsageError(fmt::format("an image has 3 axes, expected --slice or --project for {} of {}",
                                 drawn.size() - kAxes, quote_list(names, "or")));
  }
  return drawn;
}

std::string cut_text(const ResultsReader& results, const TableSelection& selection) {
  std::string text;
  const auto add = [&text](const std::string& item) { text += (text.empty() ? "" : ", ") + item; };
  for (const TableSelection::Slice& slice : selection.slices) {
    const GridDimension& dimension = results.grid()[slice.dimension];
    const std::string& unit = results.spec().states[slice.dimension].unit;
    add(fmt::format("{} = {}{}{}", dimension.name, nearest_double(dimension.point(slice.index)),
                    unit.empty() ? "" : " ", unit));
  }
  for (const TableSelection::Projection& projection : selection.projections) {
    add(results.grid()[projection.dimension].name + (projection.largest ? ": max" : ": min"));
  }
  return text;
}

ResultArray as_numbers(const CellColumn& column, std::shared_ptr<const Steps> steps) {
  const auto fill = [column, steps = std::move(steps)](std::uint64_t begin, std::uint64_t count, void* out) {
    auto* numbers = static_cast<double*>(out);
    for (std::uint64_t i = 0; i < count; ++i) numbers[i] = column.number((*steps)[begin + i]);
  };
  return {ElementType::float64, fill};
}

}  // namespace

double image_bytes(const ResultsReader& results, const TableSelection& selection) {
  double cells = 1;
  for (const std::size_t i : drawn_states(results.grid(), selection))
    cells *= static_cast<double>(results.grid()[i].count);
  const auto columns = static_cast<double>(cell_columns(results, selection.partition).size());
  constexpr double kUsualPacked = 2;  // of a number of eight bytes; all are kept until they are written
  return CellTable::bytes(results, selection) + columns * cells * (sizeof(std::int32_t) + kUsualPacked) +
         ChunkCodec::kBytes;
}

ImageContent cell_image(const ResultsReader& results, const TableSelection& selection) {
  const std::vector<std::size_t> drawn = drawn_states(results.grid(), selection);
  ImageContent image;
  image.title = results.spec().name;
  image.cut = cut_text(results, selection);
  for (std::size_t a = 0; a < drawn.size(); ++a) {
    const GridDimension& dimension = results.grid()[drawn[a]];
    const std::string& unit = results.spec().states[drawn[a]].unit;
    image.axes[a] = dimension.name + (unit.empty() ? "" : " [" + unit + "]");
    image.origin[a] = nearest_double(dimension.first - dimension.step / 2);
    image.spacing[a] = nearest_double(dimension.step);
    image.cells[a] = static_cast<std::uint64_t>(dimension.count);
  }

  const CellTable table(results, selection);
  const std::uint64_t cells = image.cells[0] * image.cells[1] * image.cells[2];
  std::vector<std::shared_ptr<Steps>> columns;
  for (const CellColumn& column : table.columns()) {
    columns.push_back(std::make_shared<Steps>(cells));
    image.arrays.push_back({column.name, as_numbers(column, columns.back())});
  }
  // How far apart neighbours are in the image, by dimension of the table; 0 for one that is sliced.
  std::vector<std::uint64_t> stride;
  for (const std::size_t i : table.dimensions()) {
    const auto axis = static_cast<std::size_t>(std::find(drawn.begin(), drawn.end(), i) - drawn.begin());
    stride.push_back(axis == drawn.size() ? 0
                     : axis == 0          ? 1
                     : axis == 1          ? image.cells[0]
                                          : image.cells[0] * image.cells[1]);
  }
  table.for_each_row([&](const std::vector<std::int64_t>& index, const std::vector<std::int32_t>& values) {
    std::uint64_t position = 0;
    for (std::size_t i = 0; i < index.size(); ++i)
      position += stride[i] * static_cast<std::uint64_t>(index[i]);
    for (std::size_t c = 0; c < values.size(); ++c) (*columns[c])[position] = values[c];
  });
  return image;
}

}  // namespace coordreq
