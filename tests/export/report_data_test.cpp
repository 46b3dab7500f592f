#include "export/report_data.hpp"
#include "answers/step_codes.hpp"

#include <gtest/gtest.h>
#include <libdeflate.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "answers/paths.hpp"
#include "cell/analyzed_file.hpp"
#include "results/scratch_folder.hpp"

namespace coordreq {
namespace {

using SortedJson = nlohmann::json;

// Some cells are not safe, some cannot be kept safe, some never need contact.
constexpr char kSpec[] = R"json({
  "coordreq": 1, "name": "three",
  "states": [
    {"name": "x", "lower": 0, "upper": 11, "step": 1, "outside": {"above": "safe"}},
    {"name": "y", "lower": 0, "upper": 6, "step": 1},
    {"name": "v", "lower": 0, "upper": 4, "step": 1, "outside": "saturate"}],
  "inputs": [{"name": "a", "values": [-1, 0, 1]}, {"name": "b", "values": [-1, 1]}],
  "agents": [{"name": "first", "inputs": ["a"]}, {"name": "second", "inputs": ["b"]}],
  "dynamics": {"time": "discrete", "period": 0.5, "unit": "s",
               "equations": {"x": "x + v/2 - 0.25", "y": "y + a + b", "v": "v + b"}},
  "safe": "x + y >= 3 and not (x == 5 and v < 1)",
  "abstraction": {"cells": "half_open", "safe": "center"},
  "coordination": {"partitions": [{"name": "alone", "classes": [["first"], ["second"]]},
                                  {"name": "together", "classes": [["first", "second"]]}]}})json";

std::vector<std::byte> from_base64(const std::string& text) {
  std::vector<std::byte> bytes;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    const std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    group = group << 6U | static_cast<std::uint32_t>(letters.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<std::byte>(group >> static_cast<unsigned>(bits) & 0xffU));
  }
  return bytes;
}

/// The values of a map as the page reads them.
std::vector<std::int32_t> unpacked(const SortedJson& map, std::size_t cells) {
  const std::vector<std::byte> packed = from_base64(map["data"]);
  const auto size = map["bytes"].get<std::size_t>();
  std::vector<std::uint8_t> raw(cells * size);
  libdeflate_decompressor* const decompressor = libdeflate_alloc_decompressor();
  std::size_t found = 0;
  EXPECT_EQ(
      libdeflate_zlib_decompress(decompressor, packed.data(), packed.size(), raw.data(), raw.size(), &found),
      LIBDEFLATE_SUCCESS);
  libdeflate_free_decompressor(decompressor);
  EXPECT_EQ(found, raw.size());
  std::vector<std::int32_t> values;
  for (std::size_t x = 0; x < cells; ++x) {
    std::uint64_t code = 0;
    for (std::size_t i = size; i-- > 0;) code = code << 8U | raw[x * size + i];
    const bool infinite = code == (std::uint64_t{1} << 8 * size) - 1;
    values.push_back(infinite ? kUnbounded : static_cast<std::int32_t>(code) - 3);
  }
  return values;
}

/// Every value in the document is that of its cell in the file.
void expect_true_values(const ResultsReader& results, const SortedJson& json) {
  const UniformGrid& grid = results.grid();
  for (const SortedJson& set : json["sets"]) {
    const auto indices = set["indices"].get<std::vector<std::vector<std::int64_t>>>();
    std::size_t cells = 1;
    for (const auto& dimension : indices) cells *= dimension.size();
    for (std::size_t m = 0; m < json["maps"].size(); ++m) {
      const SortedJson& head = json["maps"][m];
      const std::vector<std::int32_t> values = unpacked(set["maps"][m], cells);
      for (std::size_t place = 0; place < cells; ++place) {
        std::int64_t cell = 0;
        std::size_t rest = place;
        for (std::size_t i = grid.size(); i-- > 0; rest /= indices[i].size())
          cell += indices[i][rest % indices[i].size()] * grid.stride(i);
        const CellBlock block = one_cell(grid, cell);
        const std::int32_t expected =
            head["kind"] == "delay"
                ? results.values("/delay", head["partition"].get<std::size_t>(), block).front()
                : results.values("/collision_time", block).front();
        ASSERT_EQ(values[place], expected) << head << " cell " << cell;
      }
    }
  }
}

class ReportDataOfThree : public testing::Test {
 protected:
  ReportDataOfThree() {
    ThreadTeam team(2);
    analyze_into(folder_ / "three.h5", kSpec, "", team);
    results_ = std::make_unique<ResultsReader>(folder_ / "three.h5");
  }

  sample::ScratchFolder folder_;
  std::unique_ptr<ResultsReader> results_;
};

TEST_F(ReportDataOfThree, HasEveryCellIfThereIsRoom) {
  const ReportData data = report_data(*results_, {0, 1});
  EXPECT_TRUE(data.is_whole);
  const SortedJson json = SortedJson::parse(data.json);
  EXPECT_EQ(json["sets"].size(), 1);
  EXPECT_EQ(json["maps"].size(), 3);
  EXPECT_EQ(json["maps"][0]["flags"], SortedJson::parse(R"([-2, -1, "infinite"])"));
  expect_true_values(*results_, json);
}

TEST_F(ReportDataOfThree, HasTrueValuesOfFewerCellsElse) {
  for (const std::int64_t values : {1, 30, 150, 400, 800}) {
    const ReportData data = report_data(*results_, {0}, {.values = values});
    EXPECT_FALSE(data.is_whole);
    const SortedJson json = SortedJson::parse(data.json);
    EXPECT_EQ(json["sets"].size(), 3);
    expect_true_values(*results_, json);
  }
}

std::size_t packed_bytes(const SortedJson& json) {
  std::size_t bytes = 0;
  for (const SortedJson& set : json["sets"]) {
    for (const SortedJson& map : set["maps"]) bytes += map["data"].get<std::string>().size();
  }
  return bytes;
}

TEST_F(ReportDataOfThree, TakesFewerCellsUntilTheTextIsShort) {
  const std::size_t all = packed_bytes(SortedJson::parse(report_data(*results_, {0}).json));
  EXPECT_TRUE(report_data(*results_, {0}, {.packed_bytes = all}).is_whole);
  const ReportData data = report_data(*results_, {0}, {.packed_bytes = all - 1});
  EXPECT_FALSE(data.is_whole);
  const SortedJson json = SortedJson::parse(data.json);
  EXPECT_LT(packed_bytes(json), all);
  expect_true_values(*results_, json);
}

TEST_F(ReportDataOfThree, TheBestCellIsTheFirstWithTheLongestFiniteDelay) {
  const ReportData data = report_data(*results_, {0, 1});
  const std::vector<std::int32_t> delay =
      results_->values(results_->field("/delay"), 0, all_cells(results_->grid()));
  std::int32_t longest = 0;
  for (const std::int32_t value : delay) {
    if (value != kUnbounded) longest = std::max(longest, value);
  }
  EXPECT_GT(longest, 0);
  EXPECT_EQ(data.best_cells[0], std::find(delay.begin(), delay.end(), longest) - delay.begin());
  // Together every delay is unbounded.
  const std::vector<std::uint8_t> invariant =
      results_->members(paths::kInvariant, all_cells(results_->grid()));
  EXPECT_EQ(data.best_cells[1], std::find(invariant.begin(), invariant.end(), 1) - invariant.begin());
}

TEST_F(ReportDataOfThree, HoldsNoTagThatEndsItsElement) {
  EXPECT_EQ(report_data(*results_, {0}).json.find('<'), std::string::npos);
}

}  // namespace
}  // namespace coordreq
