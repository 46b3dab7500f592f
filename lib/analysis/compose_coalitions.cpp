#include <algorithm>

#include "analysis/compose_results.hpp"
#include "analysis/convert_stretch.hpp"
#include "analysis/result_arrays.hpp"
#include "answers/invariance/answer.hpp"

namespace coordreq {
namespace {

constexpr std::int32_t kNoneIsEnough = -3;

/// [level of CoalitionMap::chosen] what stands in the file for it, kNoneIsEnough left out.
template <class Integer>
std::vector<Integer> codes(const CoalitionMap& map) {
  std::vector<Integer> result = {static_cast<Integer>(DelayLayers::kOutsideInvariant)};
  for (const CoalitionChoice& choice : map.choices) result.push_back(static_cast<Integer>(choice.partition));
  return result;
}

template <class Integer>
FillArray fill_coalition(const CoalitionMap& map, const Answers& answers) {
  return
      [&map, &answers, code_of = codes<Integer>(map)](std::uint64_t begin, std::uint64_t count, void* out) {
        auto* const values = static_cast<Integer*>(out);
        map.chosen.visit([&]<class Level>(const LevelRows<Level>& levels) {
          convert_stretch(levels, *answers.ground.order, begin, count, values, [&](Level level) {
            return level == LevelRows<Level>::kTop ? static_cast<Integer>(kNoneIsEnough)
                                                   : code_of[static_cast<std::size_t>(level)];
          });
        });
        mark_unsafe(answers.get<Invariance>().collision_time, *answers.ground.order, begin, count, values);
      };
}

ResultArray coalition_array(const CoalitionMap& map, const Answers& answers) {
  const ElementType type = level_type(static_cast<std::int64_t>(map.choices.size()) - 1);
  return {type, type == ElementType::int16 ? fill_coalition<std::int16_t>(map, answers)
                                           : fill_coalition<std::int32_t>(map, answers)};
}

void fill_members(const CellSet& set, const CellOrder& order, std::int64_t begin, std::int64_t count,
                  std::uint8_t* out) {
  order.for_each_run(begin, count, [&](const CellOrder::Run& run) {
    std::int64_t row = run.row;
    std::int64_t column = run.column;
    for (std::int64_t i = 0; i < run.count; ++i, row += run.row_step, column += run.column_step)
      out[run.offset + i] = set.test(row * set.row_length() + column) ? 1 : 0;
  });
}

/// [pair, cells]
ResultArray critical_array(const CoalitionMap& map, const Answers& answers) {
  return {ElementType::uint8, [&map, &answers](std::uint64_t begin, std::uint64_t count, void* out) {
            const auto cells = static_cast<std::uint64_t>(answers.ground.order->cells());
            auto* place = static_cast<std::uint8_t*>(out);
            while (count > 0) {
              const std::uint64_t first = begin % cells;
              const std::uint64_t here = std::min(count, cells - first);
              fill_members(map.critical[begin / cells], *answers.ground.order,
                           static_cast<std::int64_t>(first), static_cast<std::int64_t>(here), place);
              begin += here;
              count -= here;
              place += here;
            }
          }};
}

/// [partition] cells that are given it.
std::vector<std::int64_t> cells_by_partition(const CoalitionMap& map) {
  std::vector<std::int64_t> cells(map.choices.size());
  for (std::size_t i = 0; i < cells.size(); ++i) cells[map.choices[i].partition] = map.cells[i];
  return cells;
}

}  // namespace

void add_coalitions(const Answers& answers, const CoalitionMap& map, ResultContent& content) {
  content.maps.push_back({.name = "coalition",
                          .long_name =
                              "index into partition of the cheapest one that is safe without further "
                              "contact for the horizon",
                          .flags = {{kNoneIsEnough, "no_partition_suffices"},
                                    {DelayLayers::kOutsideSafe, "not_safe"},
                                    {DelayLayers::kOutsideInvariant, "not_invariant"}},
                          .integers = {{"horizon", map.horizon}},
                          .cells = cells_by_partition(map),
                          .values = coalition_array(map, answers)});
  if (map.pairs.empty()) return;
  ResultNames& pairs = content.names.emplace_back(ResultNames{.name = "pair", .long_name = "pair of agents"});
  for (const AgentPair& pair : map.pairs) pairs.names.push_back(pair_name(answers.ground.spec, pair));
  content.maps.push_back({.name = "critical_pair",
                          .long_name = "the two are together in every partition of least cost that suffices",
                          .leading = "pair",
                          .flags = {{0, "not_critical"}, {1, "critical"}},
                          .cells = map.critical_cells,
                          .values = critical_array(map, answers)});
}

}  // namespace coordreq
