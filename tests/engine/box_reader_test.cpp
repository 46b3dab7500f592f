#include "engine/box_reader.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <vector>

#include "engine/row_shape.hpp"
#include "model/odometer.hpp"
#include "spec/problem_spec.hpp"
#include "support/draw.hpp"

namespace coordreq {
namespace {

using Kind = RowSegment::Kind;

/// States that stay where they are: slices are given by hand. The engine shares no minima.
Abstraction stillness(const std::vector<GridDimension>& dimensions) {
  Abstraction abstraction{.grid = UniformGrid(dimensions), .inputs = InputSpace({})};
  for (std::size_t i = 0; i < dimensions.size(); ++i) {
    TransitionTable& table = abstraction.tables.emplace_back();
    table.states = {static_cast<std::int32_t>(i)};
    table.shift = true;
    table.entries.resize(static_cast<std::size_t>(lay_out(table, i, abstraction.grid, abstraction.inputs)));
  }
  return abstraction;
}

GridDimension dimension(std::int64_t count, Outside below, Outside above) {
  return {.name = "x",
          .first = 0,
          .step = 1,
          .count = count,
          .below = below,
          .above = above,
          .lower = 0,
          .upper = Rational(static_cast<long>(count))};
}

GridDimension random_dimension(int most) {
  constexpr std::array kRules{Outside::unsafe, Outside::safe, Outside::saturate};
  const int count = draw(1, most);
  if (draw(0, 2) == 0) return dimension(count, Outside::periodic, Outside::periodic);
  return dimension(count, kRules[static_cast<std::size_t>(draw(0, 2))],
                   kRules[static_cast<std::size_t>(draw(0, 2))]);
}

/// A box in a row family's own terms: ranges inside the domain, on a ring from [0, count) on.
IndexRange random_range(const GridDimension& dimension) {
  const auto n = static_cast<int>(dimension.count);
  const int first = draw(0, n - 1);
  if (dimension.periodic())
    return first == 0 ? IndexRange{0, draw(0, n - 1)}
                      : IndexRange{first, first + draw(0, std::max(0, n - 2))};
  return {first, draw(first, n - 1)};
}

struct Problem {
  std::vector<GridDimension> dimensions;
  Abstraction abstraction;
  RowEngine engine;
  std::vector<RowSlices> slices;
  RowFamily family;

  explicit Problem(std::vector<GridDimension> given, int slices_a_table)
      : dimensions(std::move(given)),
        abstraction(stillness(dimensions)),
        engine(abstraction, nullptr, {}),
        slices(dimensions.size()) {
    family.shape.dimensions = {
        {dimensions.back().count, 1, {}, {dimensions.back().below, dimensions.back().above}}};
    for (std::size_t t = 0; t < dimensions.size(); ++t) {
      for (int k = 0; k < slices_a_table; ++k) slices[t].slices.push_back(random_slice(t));
    }
    family.slices = slices;
  }
  Problem(const Problem&) = delete;
  Problem& operator=(const Problem&) = delete;

 private:
  std::vector<RowSegment> random_slice(std::size_t t) {
    const auto n = static_cast<std::int32_t>(dimensions.back().count);
    std::vector<RowSegment> slice;
    for (std::int32_t begin = 0; begin < n;) {
      const std::int32_t end = draw(0, 1) == 0 ? n : draw(begin + 1, n);
      slice.push_back(random_segment(t, begin, end));
      begin = end;
    }
    return slice;
  }
  RowSegment random_segment(std::size_t t, std::int32_t begin, std::int32_t end) {
    const int kind = draw(0, 11);
    if (kind == 0) return {begin, end, Kind::blocked, {}};
    if (kind == 1) return {begin, end, Kind::gone, {}};
    if (t + 1 < dimensions.size() || kind <= 3) return {begin, end, Kind::fixed, random_range(dimensions[t])};
    return {begin, end, Kind::shifted, random_window()};
  }

 public:
  [[nodiscard]] RowEnds ends() const { return family.shape.dimensions[0].ends; }
  IndexRange random_window() {
    const auto n = static_cast<int>(dimensions.back().count);
    const int first = draw(-n - 2, n + 2);
    const int width = draw(0, 3) == 0 ? draw(0, 2 * n) : draw(0, 3);
    const IndexRange window = fit_window({first, first + width}, n, ends());
    RowMargins& margins = family.shape.dimensions[0].margins;
    margins.before = std::max<std::int64_t>(margins.before, -window.first);
    margins.after = std::max<std::int64_t>(margins.after, window.last);
    return window;
  }
};

/// One number a cell.
template <class Level>
struct Levels {
  static constexpr Level kTop = LevelRows<Level>::kTop;
  const Problem& problem;
  std::vector<Level> cells;

  explicit Levels(const Problem& of) : problem(of) {
    for (std::int64_t x = 0; x < of.abstraction.grid.cells(); ++x)
      cells.push_back(*rc::gen::resize(
          rc::kNominalSize, rc::gen::element<Level>(0, 1, 2, 200, kTop - 1, kTop, kTop, kTop, kTop)));
  }
  void fill(LevelRows<Level>& rows) const {
    for (std::int64_t r = 0; r < rows.rows(); ++r) {
      rows.change_row(
          r, [&](Level* row) { std::copy_n(cells.begin() + r * rows.row_length(), rows.row_length(), row); });
    }
  }

  /// The level at an index of the last dimension, which may be outside, in a row.
  [[nodiscard]] Level at(std::int64_t row, std::int64_t k) const {
    const std::int64_t n = problem.dimensions.back().count;
    const RowEnds ends = problem.ends();
    const Level* row_cells = cells.data() + row * n;
    if (ends.below == Outside::periodic) return row_cells[(k % n + n) % n];
    if (k >= 0 && k < n) return row_cells[k];
    const Outside rule = k < 0 ? ends.below : ends.above;
    if (rule == Outside::unsafe) return 0;
    return rule == Outside::safe ? kTop : row_cells[k < 0 ? 0 : n - 1];
  }

  /// Calls visit(row) for the rows of a box, in the plainest way.
  template <class Visit>
  void for_each(const std::vector<IndexRange>& box, const Visit& visit) const {
    std::vector<std::int64_t> counts;
    for (const IndexRange& range : box) counts.push_back(range.last - range.first + 1);
    Odometer counter(counts);
    do {
      std::int64_t row = 0;
      for (std::size_t i = 0; i < box.size(); ++i) {
        const std::int64_t k = (box[i].first + counter.indices()[i]) % problem.dimensions[i].count;
        row = row * problem.dimensions[i].count + k;
      }
      visit(row);
    } while (counter.advance());
  }

  [[nodiscard]] Level least(const RowBox& box, std::int64_t c) const {
    Level result = kTop;
    for_each(box.ranges, [&](std::int64_t row) {
      for (std::int64_t k = c + box.windows[0].first; k <= c + box.windows[0].last; ++k)
        result = std::min(result, at(row, k));
    });
    return result;
  }

  [[nodiscard]] Level least(const std::vector<std::uint32_t>& ids, std::int64_t c) const {
    RowBox box;
    bool gone = false;
    RowSegment last;
    for (std::size_t t = 0; t < ids.size(); ++t) {
      for (const RowSegment& segment : problem.slices[t].slices[ids[t]]) {
        if (c < segment.begin || c >= segment.end) continue;
        if (segment.kind == Kind::blocked) return 0;
        gone = gone || segment.kind == Kind::gone;
        last = segment;
        if (t + 1 < ids.size()) box.ranges.push_back(segment.range);
      }
    }
    if (last.kind == Kind::gone) return kTop;
    // An unsafe end of the row blocks, even if the post has left in another dimension.
    if (last.kind == Kind::shifted && gone) {
      const std::int64_t n = problem.dimensions.back().count;
      const bool blocks = (c + last.range.first < 0 && problem.ends().below == Outside::unsafe) ||
                          (c + last.range.last >= n && problem.ends().above == Outside::unsafe);
      return blocks ? 0 : kTop;
    }
    if (gone) return kTop;
    const auto at_c = static_cast<std::int32_t>(last.kind == Kind::shifted ? 0 : c);
    box.windows = {{last.range.first - at_c, last.range.last - at_c}};
    return least(box, c);
  }
};

template <class Level>
class BoxReaderTest : public testing::Test {};
using ReadTypes = testing::Types<std::uint8_t, std::uint16_t, std::uint32_t, std::uint64_t>;
TYPED_TEST_SUITE(BoxReaderTest, ReadTypes);

template <class Level>
void expect_minimum(BoxReader<Level>& reader, const Problem& problem, const Levels<Level>& levels) {
  std::vector<std::uint32_t> ids;
  for (const RowSlices& table : problem.slices)
    ids.push_back(static_cast<std::uint32_t>(draw(0, static_cast<int>(table.slices.size()) - 1)));
  const Level* row = reader.minimum(ids);
  for (std::int64_t c = 0; c < problem.engine.row_length(); ++c) RC_ASSERT(row[c] == levels.least(ids, c));
}

TYPED_TEST(BoxReaderTest, SlicesAreReadAsCellByCell) {
  EXPECT_TRUE(rc::check("least levels by slices", [] {
    std::vector<GridDimension> dimensions;
    for (int i = draw(0, 3); i > 0; --i) dimensions.push_back(random_dimension(4));
    dimensions.push_back(random_dimension(draw(0, 3) == 0 ? 80 : 9));
    const Problem problem(dimensions, 4);
    RC_ASSERT(problem.engine.outer() == 0);  // so that any number of dimensions can be shared
    LevelRows<TypeParam> rows = problem.engine.template make_levels<TypeParam>(problem.family);
    const auto outer = static_cast<std::size_t>(draw(0, static_cast<int>(dimensions.size()) - 1));
    BoxReader<TypeParam> reader(problem.engine, problem.family, outer, rows);
    for (int unit = 0; unit < 3; ++unit) {
      const Levels<TypeParam> levels(problem);
      levels.fill(rows);
      reader.enter(rows);
      for (int k = 0; k < 6; ++k) expect_minimum(reader, problem, levels);
    }
  }));
}

TYPED_TEST(BoxReaderTest, BoxesAreReadAsCellByCell) {
  EXPECT_TRUE(rc::check("least levels by boxes", [] {
    std::vector<GridDimension> dimensions;
    for (int i = draw(0, 2); i > 0; --i) dimensions.push_back(random_dimension(4));
    dimensions.push_back(random_dimension(draw(0, 3) == 0 ? 80 : 9));
    Problem problem(dimensions, 1);
    std::vector<RowBox> boxes(5);
    for (RowBox& box : boxes) {
      for (std::size_t i = 0; i + 1 < dimensions.size(); ++i)
        box.ranges.push_back(random_range(dimensions[i]));
      box.windows = {problem.random_window()};
    }
    LevelRows<TypeParam> rows = problem.engine.template make_levels<TypeParam>(problem.family);
    const Levels<TypeParam> levels(problem);
    levels.fill(rows);
    const auto outer = static_cast<std::size_t>(draw(0, static_cast<int>(dimensions.size()) - 1));
    BoxReader<TypeParam> reader(problem.engine, problem.family, outer, rows);
    for (const RowBox& box : boxes) {
      const TypeParam* row = reader.minimum(box, 0, problem.engine.row_length());
      for (std::int64_t c = 0; c < problem.engine.row_length(); ++c)
        RC_ASSERT(row[c] == levels.least(box, c));
    }
  }));
}

/// Rows so long that only two sets of shared minima are kept, which replace one another.
TYPED_TEST(BoxReaderTest, SharedMinimaGiveWay) {
  Problem problem({dimension(8, Outside::saturate, Outside::saturate),
                   dimension(1024 / sizeof(TypeParam), Outside::saturate, Outside::saturate),
                   dimension(80, Outside::saturate, Outside::saturate)},
                  0);
  LevelRows<TypeParam> rows = problem.engine.template make_levels<TypeParam>(problem.family);
  for (std::int64_t r = 0; r < rows.rows(); ++r) {
    rows.change_row(r, [&](TypeParam* row) {
      for (std::int64_t c = 0; c < rows.row_length(); ++c)
        row[c] = static_cast<TypeParam>((r * 31 + c * 7) % 251);
    });
  }
  EXPECT_TRUE(rc::check("least levels with few slots", [&] {
    const std::int64_t second = problem.dimensions[1].count;
    BoxReader<TypeParam> reader(problem.engine, problem.family, 1, rows);
    std::vector<RowBox> boxes(5);
    for (RowBox& box : boxes)
      box = {{random_range(problem.dimensions[0]), random_range(problem.dimensions[1])}, {{0, 0}}};
    for (int k = 0; k < 20; ++k) {
      const RowBox& box = boxes[static_cast<std::size_t>(draw(0, 4))];
      const TypeParam* row = reader.minimum(box, 0, problem.engine.row_length());
      for (std::int64_t c = 0; c < 80; c += 13) {
        TypeParam least = LevelRows<TypeParam>::kTop;
        for (std::int64_t i = box.ranges[0].first; i <= box.ranges[0].last; ++i) {
          for (std::int64_t j = box.ranges[1].first; j <= box.ranges[1].last; ++j)
            least = std::min(least, rows.row(i * second + j)[c]);
        }
        RC_ASSERT(row[c] == least);
      }
    }
  }));
}

/// A shared row that fills its last block, read from its second lane on (for the address sanitiser).
TEST(BoxReader, TheLastSharedRowIsReadToTheEndOfABlock) {
  const auto line = [](std::int64_t count) { return dimension(count, Outside::saturate, Outside::saturate); };
  Abstraction abstraction{.grid = UniformGrid({line(4), line(3), line(62)}),
                          .inputs = InputSpace({{"u", {0, 1}}, {"v", {0, 1, 2}}})};
  for (std::int32_t i = 0; i < 3; ++i) {
    TransitionTable& table = abstraction.tables.emplace_back();
    table.states = {i};
    if (i < 2) table.inputs = {i};
    table.shift = true;
    const auto entries = static_cast<std::int32_t>(
        lay_out(table, static_cast<std::size_t>(i), abstraction.grid, abstraction.inputs));
    for (std::int32_t k = 0; k < entries; ++k)
      table.entries.push_back(i == 0   ? IndexRange{k - 1, k}
                              : i == 1 ? IndexRange{k - 1, k - 1}
                                       : IndexRange{-1, 1});
  }
  const RowEngine engine(abstraction, nullptr, {});
  ASSERT_EQ(engine.outer(), 1U);
  auto levels = engine.make_levels<std::uint8_t>(engine.posts());
  for (std::int64_t r = 0; r < levels.rows(); ++r) {
    levels.change_row(r, [&](std::uint8_t* row) {
      for (std::int64_t c = 0; c < 62; ++c) row[c] = static_cast<std::uint8_t>(200 - c - r);
    });
  }
  BoxReader<std::uint8_t> reader(engine, engine.posts(), engine.outer(), levels);
  const std::uint8_t* row = reader.minimum(RowBox{{{0, 1}, {2, 2}}, {{0, 1}}}, 0, 62);
  for (std::int64_t c = 0; c < 62; ++c) EXPECT_EQ(row[c], 200 - std::min<std::int64_t>(c + 1, 61) - 5);
}

}  // namespace
}  // namespace coordreq
