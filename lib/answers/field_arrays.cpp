#include "answers/field_arrays.hpp"

#include <limits>
#include <memory>

#include "answers/countdown/delay_layers.hpp"
#include "answers/step_codes.hpp"
#include "engine/convert_cells.hpp"

namespace coordreq {
namespace {

ResultArray membership_array(const LevelMap& map, const CellOrder& order, bool only_top) {
  return {ElementType::uint8, [&map, &order, only_top](std::uint64_t begin, std::uint64_t count, void* out) {
            map.visit([&]<class Level>(const LevelRows<Level>& levels) {
              const Level least = only_top ? LevelRows<Level>::kTop : Level{1};
              convert_cells(
                  levels, order, begin, count, static_cast<std::uint8_t*>(out),
                  [least](Level level) { return static_cast<std::uint8_t>(level >= least ? 1 : 0); });
            });
          }};
}

template <class Integer>
FillArray fill_collision(const LevelMap& map, const CellOrder& order) {
  return [&map, &order](std::uint64_t begin, std::uint64_t count, void* out) {
    map.visit([&]<class Level>(const LevelRows<Level>& levels) {
      convert_cells(levels, order, begin, count, static_cast<Integer*>(out), [](Level level) {
        return level == LevelRows<Level>::kTop ? std::numeric_limits<Integer>::max()
                                               : static_cast<Integer>(level);
      });
    });
  };
}

/// Triggers, by trigger_of(); delays if `connection_delay` is negative.
template <class Integer>
FillArray fill_delays(const DelayLayers& layers, const LevelMap& collision_time,
                      std::int64_t connection_delay, const CellOrder& order) {
  return [&layers, &collision_time, connection_delay, &order](std::uint64_t begin, std::uint64_t count,
                                                              void* out) {
    const auto entry = [connection_delay](std::int64_t delay) {
      const auto value = static_cast<std::int32_t>(delay);
      const std::int32_t displayed = connection_delay < 0 ? value : trigger_of(value, connection_delay);
      return displayed == kUnbounded ? std::numeric_limits<Integer>::max() : static_cast<Integer>(displayed);
    };
    const Integer top = entry(layers.top_delay());
    layers.layers_of.visit([&]<class Level>(const LevelRows<Level>& levels) {
      convert_cells(levels, order, begin, count, static_cast<Integer*>(out), [&](Level level) {
        return level == LevelRows<Level>::kTop ? top : entry(std::int64_t{level} - 1);
      });
    });
    mark_unsafe(collision_time, order, begin, count, static_cast<Integer*>(out));
  };
}

ResultArray delays_or_triggers(const DelayLayers& layers, const LevelMap& collision_time,
                               std::int64_t connection_delay, const CellOrder& order, ElementType type) {
  if (type == ElementType::int16) {
    return {type, fill_delays<std::int16_t>(layers, collision_time, connection_delay, order)};
  }
  return {type, fill_delays<std::int32_t>(layers, collision_time, connection_delay, order)};
}

/// The layer T(k) that each cell of K is in.
FillArray fill_layers(const DelayLayers& layers, const CellOrder& order) {
  return [&layers, &order](std::uint64_t begin, std::uint64_t count, void* out) {
    const auto last = static_cast<std::uint32_t>(layers.sizes.size() - 1);
    layers.layers_of.visit([&]<class Level>(const LevelRows<Level>& levels) {
      convert_cells(levels, order, begin, count, static_cast<std::uint32_t*>(out), [last](Level level) {
        if (level == 0) return CellLists::kNone;
        return level == LevelRows<Level>::kTop ? last : std::uint32_t{level} - 1;
      });
    });
  };
}

template <class Index>
FillArray cells_by_list(const CellLists& lists, std::vector<std::uint64_t> next, std::uint64_t cells) {
  constexpr std::uint64_t kAtATime = 1 << 16U;
  std::vector<Index> sorted(next.back());
  std::vector<std::uint32_t> list_of(std::min(cells, kAtATime));
  for (std::uint64_t begin = 0; begin < cells; begin += kAtATime) {
    const std::uint64_t count = std::min(kAtATime, cells - begin);
    lists.of_cell(begin, count, list_of.data());
    for (std::uint64_t i = 0; i < count; ++i) {
      if (list_of[i] != CellLists::kNone) sorted[next[list_of[i]]++] = static_cast<Index>(begin + i);
    }
  }
  return owned_array({}, std::move(sorted)).fill;
}

template <class Index>
ResultArray cells_of(ElementType type, const DelayLayers& layers, const CellOrder& order,
                     const std::shared_ptr<CellsCache>& cache) {
  const auto lists = std::make_shared<CellLists>(
      CellLists{.count = layers.sizes.size(), .of_cell = fill_layers(layers, order)});
  const auto cells = static_cast<std::uint64_t>(order.cells());
  return {.type = type,
          .fill =
              [&layers, cache, lists, cells](std::uint64_t begin, std::uint64_t count, void* out) {
                const auto fill = cache->get(
                    &layers, [&] { return cells_by_list<Index>(*lists, layer_starts(layers), cells); });
                (*fill)(begin, count, out);
              },
          .lists = lists};
}

/// Fills a segment of one set.
void fill_members(const CellSet& set, const CellOrder& order, std::uint64_t begin, std::uint64_t count,
                  std::uint8_t* out) {
  order.for_each_run(
      static_cast<std::int64_t>(begin), static_cast<std::int64_t>(count), [&](const CellOrder::Run& run) {
        for (std::int64_t i = 0; i < run.count; ++i) {
          const ConstRow row = set.row(run.row + i * run.row_step);
          const std::int64_t column = run.column + i * run.column_step;
          out[run.offset + i] = static_cast<std::uint8_t>(
              row[static_cast<std::size_t>(column / CellSet::kWordBits)] >> (column % CellSet::kWordBits) &
              1U);
        }
      });
}

}  // namespace

template <class Integer>
void mark_unsafe(const LevelMap& collision_time, const CellOrder& order, std::uint64_t begin,
                 std::uint64_t count, Integer* out) {
  std::vector<std::uint8_t> is_safe(count);
  membership_array(collision_time, order, false).fill(begin, count, is_safe.data());
  for (std::uint64_t i = 0; i < count; ++i) {
    out[i] = static_cast<Integer>(is_safe[i] == 0 ? kOutsideSafe : out[i]);
  }
}

template void mark_unsafe(const LevelMap&, const CellOrder&, std::uint64_t, std::uint64_t, std::int16_t*);
template void mark_unsafe(const LevelMap&, const CellOrder&, std::uint64_t, std::uint64_t, std::int32_t*);

ResultArray sets_array(const std::vector<CellSet>& sets, const CellOrder& order) {
  return {ElementType::uint8, [&sets, &order](std::uint64_t begin, std::uint64_t count, void* out) {
            const auto cells = static_cast<std::uint64_t>(order.cells());
            auto* target = static_cast<std::uint8_t*>(out);
            while (count > 0) {
              const std::uint64_t first = begin % cells;
              const std::uint64_t here = std::min(count, cells - first);
              fill_members(sets[begin / cells], order, first, here, target);
              begin += here;
              count -= here;
              target += here;
            }
          }};
}

ResultArray safe_array(const LevelMap& collision_time, const CellOrder& order) {
  return membership_array(collision_time, order, false);
}

ResultArray invariant_array(const LevelMap& collision_time, const CellOrder& order) {
  return membership_array(collision_time, order, true);
}

ElementType level_type(std::int64_t greatest_finite) {
  return greatest_finite >= std::numeric_limits<std::int16_t>::max() ? ElementType::int32
                                                                     : ElementType::int16;
}

ResultArray collision_array(const LevelMap& collision_time, const CellOrder& order, ElementType type) {
  if (type == ElementType::int16) return {type, fill_collision<std::int16_t>(collision_time, order)};
  return {type, fill_collision<std::int32_t>(collision_time, order)};
}

ResultArray delay_array(const DelayLayers& layers, const LevelMap& collision_time, const CellOrder& order,
                        ElementType type) {
  return delays_or_triggers(layers, collision_time, -1, order, type);
}

ResultArray trigger_array(const DelayLayers& layers, const LevelMap& collision_time,
                          std::int64_t connection_delay, const CellOrder& order, ElementType type) {
  return delays_or_triggers(layers, collision_time, connection_delay, order, type);
}

ResultArray freedom_array(const ConventionFreedom& convention, const CellOrder& order) {
  return {ElementType::float32, [&](std::uint64_t begin, std::uint64_t count, void* out) {
            auto* target = static_cast<float*>(out);
            while (count > 0) {
              const std::uint64_t cells = convention.agents.front().freedom.size();
              const ZeroedArray<float>& freedom = convention.agents[begin / cells].freedom;
              const std::uint64_t here = std::min(count, cells - begin % cells);
              order.for_each_run(static_cast<std::int64_t>(begin % cells), static_cast<std::int64_t>(here),
                                 [&](const CellOrder::Run& run) {
                                   const float* source = freedom.data() + order.position(run);
                                   const std::int64_t step = order.step(run);
                                   for (std::int64_t i = 0; i < run.count; ++i)
                                     target[run.offset + i] = source[i * step];
                                 });
              begin += here;
              count -= here;
              target += here;
            }
          }};
}

std::vector<std::uint64_t> layer_starts(const DelayLayers& layers) {
  const std::size_t count = layers.sizes.size();
  std::vector<std::uint64_t> start(count + 1, 0);
  for (std::size_t k = 0; k < count; ++k) {
    const std::int64_t next = k + 1 < count ? layers.sizes[k + 1] : 0;
    start[k + 1] = start[k] + static_cast<std::uint64_t>(layers.sizes[k] - next);
  }
  return start;
}

ResultArray layer_cells(const DelayLayers& layers, const CellOrder& order,
                        const std::shared_ptr<CellsCache>& cache) {
  if (order.cells() <= std::numeric_limits<std::uint32_t>::max()) {
    return cells_of<std::uint32_t>(ElementType::uint32, layers, order, cache);
  }
  return cells_of<std::uint64_t>(ElementType::uint64, layers, order, cache);
}

}  // namespace coordreq
