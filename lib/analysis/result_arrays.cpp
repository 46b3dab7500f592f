#include "analysis/result_arrays.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "trigger/trigger_table.hpp"

namespace coordreq {
namespace {

template <class Integer, class Convert>
FillArray fill_with(const std::vector<std::int32_t>& values, std::int32_t infinite, const Convert& convert) {
  return [&values, infinite, convert](std::uint64_t begin, std::uint64_t count, void* out) {
    auto* target = static_cast<Integer*>(out);
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::int32_t value = convert(values[begin + i]);
      target[i] = value == infinite ? std::numeric_limits<Integer>::max() : static_cast<Integer>(value);
    }
  };
}

template <class Convert>
ResultArray converted(const std::vector<std::int32_t>& values, std::int32_t infinite, ElementType type,
                      const Convert& convert) {
  if (type == ElementType::int16) return {type, fill_with<std::int16_t>(values, infinite, convert)};
  return {type, fill_with<std::int32_t>(values, infinite, convert)};
}

template <class Index>
ResultLayers lists_of(const DelayLayers& layers, ElementType type) {
  const std::size_t count = layers.sizes.size();
  const auto layer_of = [&](std::int32_t delay) {
    return delay == DelayLayers::kUnbounded ? count - 1 : static_cast<std::size_t>(delay);
  };
  ResultLayers result;
  result.start.assign(count + 1, 0);
  for (const std::int32_t delay : layers.delay) {
    if (delay >= 0) ++result.start[layer_of(delay) + 1];
  }
  for (std::size_t k = 0; k < count; ++k) result.start[k + 1] += result.start[k];

  auto cells = std::make_shared<std::vector<Index>>(result.start.back());
  std::vector<std::uint64_t> next(result.start.begin(), result.start.end() - 1);
  for (std::size_t x = 0; x < layers.delay.size(); ++x) {
    if (layers.delay[x] >= 0) (*cells)[next[layer_of(layers.delay[x])]++] = static_cast<Index>(x);
  }
  result.cell = {type, [cells](std::uint64_t begin, std::uint64_t n, void* out) {
                   std::copy_n(cells->begin() + static_cast<std::ptrdiff_t>(begin), n,
                               static_cast<Index*>(out));
                 }};
  return result;
}

}  // namespace

ResultArray membership_array(const CellSet& set) {
  return {ElementType::uint8, [&set](std::uint64_t begin, std::uint64_t count, void* out) {
            auto* target = static_cast<std::uint8_t*>(out);
            for (std::uint64_t i = 0; i < count; ++i)
              target[i] = set.test(static_cast<std::int64_t>(begin + i)) ? 1 : 0;
          }};
}

ElementType level_type(const std::vector<std::int32_t>& values, std::int32_t infinite) {
  const auto too_large = [&](std::int32_t v) {
    return v != infinite && v >= std::numeric_limits<std::int16_t>::max();
  };
  return std::any_of(values.begin(), values.end(), too_large) ? ElementType::int32 : ElementType::int16;
}

ResultArray level_array(const std::vector<std::int32_t>& values, std::int32_t infinite, ElementType type) {
  return converted(values, infinite, type, [](std::int32_t value) { return value; });
}

ResultArray trigger_array(const std::vector<std::int32_t>& delays, std::int64_t connection_delay,
                          ElementType type) {
  return converted(delays, TriggerTable::kNever, type,
                   [connection_delay](std::int32_t delay) { return trigger_of(delay, connection_delay); });
}

ResultLayers layer_lists(const DelayLayers& layers) {
  if (layers.delay.size() <= std::numeric_limits<std::uint32_t>::max()) {
    return lists_of<std::uint32_t>(layers, ElementType::uint32);
  }
  return lists_of<std::uint64_t>(layers, ElementType::uint64);
}

}  // namespace coordreq
