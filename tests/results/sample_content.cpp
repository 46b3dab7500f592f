#include "results/sample_content.hpp"

#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

#include "answers/field_table.hpp"
#include "results/scratch_folder.hpp"
#include "results/write_results.hpp"
#include "spec/read_spec.hpp"

namespace coordreq::sample {
namespace {

using Formula = std::function<std::int64_t(std::uint64_t)>;

template <typename Value>
FillArray fill_with(Formula formula) {
  return [formula = std::move(formula)](std::uint64_t begin, std::uint64_t count, void* out) {
    auto* values = static_cast<Value*>(out);
    for (std::uint64_t i = 0; i < count; ++i) values[i] = static_cast<Value>(formula(begin + i));
  };
}

ResultArray array(ElementType type, Formula formula) {
  switch (type) {
    case ElementType::uint8:
      return {type, fill_with<std::uint8_t>(std::move(formula))};
    case ElementType::int16:
      return {type, fill_with<std::int16_t>(std::move(formula))};
    case ElementType::int32:
      return {type, fill_with<std::int32_t>(std::move(formula))};
    case ElementType::uint32:
      return {type, fill_with<std::uint32_t>(std::move(formula))};
    case ElementType::int64:
      return {type, fill_with<std::int64_t>(std::move(formula))};
    case ElementType::uint64:
      return {type, fill_with<std::uint64_t>(std::move(formula))};
    case ElementType::float32:
      return {type, fill_with<float>(std::move(formula))};
    case ElementType::float64:
      break;
  }
  return {type, fill_with<double>(std::move(formula))};
}

constexpr std::uint64_t kLayers = 4;

/// |Z_k| of the first partition stands still after two steps, that of the second after three.
std::int64_t layer_size(std::uint64_t i, std::uint64_t cells) {
  const std::uint64_t last = i < kLayers ? 2 : 3;
  return static_cast<std::int64_t>(cells >> (1 + std::min(i % kLayers, last)));
}

/// All cells of the list are in the first layer but one, which is in the last.
std::int64_t layer_start(std::uint64_t i, std::uint64_t last, std::uint64_t cells) {
  return static_cast<std::int64_t>(i == 0 ? 0 : i == last ? cells / 2 : cells / 2 - 1);
}

std::int64_t transition(const std::string& path, std::uint64_t i) {
  const auto number = static_cast<std::int64_t>(i);
  const bool first = path.ends_with("first");
  if (path.find("/x1/") != std::string::npos) return first ? number - 3 : number + 3;
  if (path.find("/x2/") != std::string::npos) return first ? 7 : 9;
  return first ? number - 9 : number;
}

/// What stands at place i of a field.
std::int64_t element(const Field& field, const Options& options, std::uint64_t i) {
  const std::string& path = field.path;
  const std::uint64_t cells = cell_count(options);
  if (path == "/safe") return is_safe(i) ? 1 : 0;
  if (path == "/invariant") return is_invariant(i) ? 1 : 0;
  if (path == "/collision_time") return collision_time(i, options.steps);
  if (path == "/delay") return delay(i / cells, i % cells, options.steps);
  if (path == "/trigger") return trigger(i / cells, i % cells, options.steps);
  if (path == "/layer_size") return layer_size(i, cells);
  if (path == "/fixed_point_index") return options.truncated ? -1 : static_cast<std::int64_t>(i + 2);
  if (path.ends_with("/start")) {
    const std::uint64_t last = options.truncated || path.find("alone") == std::string::npos ? 4 : 3;
    return layer_start(i, last, cells);
  }
  if (path.starts_with("/layers/")) return static_cast<std::int64_t>(2 * i);
  if (field.section == FieldSection::abstraction) return transition(path, i);
  // The first requirement fails, with a counterexample; the second one holds.
  if (path == "/counterexample/holds") return static_cast<std::int64_t>(i);
  if (path == "/counterexample/end") return i == 0 ? 1 : 0;
  if (path == "/counterexample/left_side" || path == "/counterexample/seen") return 0;
  if (path.ends_with(":byte") || field.types.front() == ElementType::uint8)
    return field.most == 1 ? static_cast<std::int64_t>(i % 2) : action_byte(i);
  return static_cast<std::int64_t>(i % 3);
}

void add_lengths(const Options& options, FieldValues& values) {
  values.lengths = {{"/layer", kLayers}};
  for (const char* name : {"alone", "a|b+c"}) {
    const std::string group = std::string("/layers/") + name;
    values.lengths[group + "/bound"] = options.truncated || name[1] == '|' ? 5 : 4;
    values.lengths[group + "/position"] = cell_count(options) / 2;
  }
  if (!options.with_everything) return;
  values.lengths["/counterexample/0/sample"] = 3;
  values.lengths["/counterexample/0/step"] = 2;
}

void add_found(const Field& field, const Options& options, FieldValues::Entry& entry) {
  for (const FieldAttribute& attribute : field.attributes) {
    if (!attribute.is_computed) continue;
    AttributeValue& value = entry.attributes[attribute.name] = attribute.value;
    if (auto* list = std::get_if<std::vector<std::uint64_t>>(&value))
      std::iota(list->begin(), list->end(), 1U);
    if (attribute.name == "iterations") value = std::int64_t{12};
    if (attribute.name == "sha256") value = std::string("0123");
    if (field.path == "/safe") value = count_cells(options, is_safe);
    if (field.path == "/invariant") value = count_cells(options, is_invariant);
  }
}

constexpr char kEverything[] = R"json(,
  "controller": { "file": "other.h5" },
  "network": { "delay": 1 },
  "requirements": [ { "name": "fails", "where": "x1 <= 0", "partition": "alone", "min_delay": 3 },
                    { "name": "holds", "where": "x1 <= 0", "invariant": true } ])json";

}  // namespace

std::int64_t maximum(ElementType steps) {
  return steps == ElementType::int16 ? std::numeric_limits<std::int16_t>::max()
                                     : std::numeric_limits<std::int32_t>::max();
}

bool is_safe(std::uint64_t cell) {
  return cell % 7 != 0;
}

bool is_invariant(std::uint64_t cell) {
  return is_safe(cell) && cell % 3 != 0;
}

std::int64_t collision_time(std::uint64_t cell, ElementType steps) {
  if (!is_safe(cell)) return 0;
  return is_invariant(cell) ? maximum(steps) : static_cast<std::int64_t>(cell % 100) + 1;
}

std::int64_t delay(std::uint64_t partition, std::uint64_t cell, ElementType steps) {
  if (!is_safe(cell)) return -2;
  if (!is_invariant(cell)) return -1;
  return cell % 11 == 0 ? maximum(steps) : static_cast<std::int64_t>((cell + partition) % 50);
}

std::int64_t trigger(std::uint64_t partition, std::uint64_t cell, ElementType steps) {
  const std::int64_t steps_left = delay(partition, cell, steps);
  if (steps_left < 0 || steps_left == maximum(steps)) return steps_left;
  return steps_left < kConnectionDelay ? -3 : steps_left - kConnectionDelay;
}

std::uint8_t action_byte(std::uint64_t i) {
  return static_cast<std::uint8_t>(i * 37 % 251);
}

std::uint64_t cell_count(const Options& options) {
  return std::accumulate(options.points.begin(), options.points.end(), std::uint64_t{1}, std::multiplies<>());
}

std::uint64_t count_cells(const Options& options, bool (*is_member)(std::uint64_t cell)) {
  std::uint64_t count = 0;
  for (std::uint64_t cell = 0; cell < cell_count(options); ++cell) count += is_member(cell) ? 1U : 0U;
  return count;
}

std::string spec_text(const Options& options) {
  const auto upper = [&options](std::size_t i, double first, double step) {
    return std::to_string(first + step * static_cast<double>(options.points[i] - 1));
  };
  const std::string output = options.with_extras ? "true" : "false";
  return R"json({
  "coordreq": 1,
  "name": "sample",
  "description": "sample )json"
         "\xC3\xA9"
         R"json(",
  "states": [
    { "name": "x1", "lower": -1, "upper": )json" +
         upper(0, -1, 0.125) + R"json(, "step": 0.125, "unit": "m" },
    { "name": "x2", "lower": 0, "upper": )json" +
         upper(1, 0, 0.5) + R"json(, "step": 0.5, "unit": "seconds" },
    { "name": "heading", "lower": 0, "upper": )json" +
         upper(2, 0, 1) + R"json(, "step": 1 } ],
  "inputs": [
    { "name": "u1", "lower": -2, "upper": 2, "step": 1, "unit": "m/second" },
    { "name": "u2", "values": [-1, 0, 3], "unit": "rad" },
    { "name": "u3", "values": [0, 1, 2, 3, 4] } ],
  "agents": [ { "name": "a", "inputs": ["u1"] }, { "name": "b", "inputs": ["u2"] },
              { "name": "c", "inputs": ["u3"] } ],
  "dynamics": { "time": "discrete", "period": 0.25, "unit": "seconds",
                "equations": { "x1": "x1 + u1", "x2": "4", "heading": "heading + u2 + u3" } },
  "safe": "x1 <= 1",
  "coordination": { "connection_delay": 2,)json" +
         (options.with_everything ? R"json( "horizon": 2, "convention": true,)json" : "") + R"json(
                    "partitions": [ { "name": "alone", "classes": [] }, { "classes": [["b", "c"]] } ] },
  "output": { "controller": )json" +
         output + ", \"actions\": " + output + ", \"layers\": " + output + ", \"abstraction\": " + output +
         " }" + (options.with_everything ? kEverything : "") + "\n}\n";
}

Sample make_sample(const Options& options) {
  Sample sample{.spec = read_spec(spec_text(options), "sample"), .values = {}};
  add_lengths(options, sample.values);
  for (const Field& field : result_fields(sample.spec)) {
    if (field.scale) continue;
    FieldValues::Entry& entry = sample.values.entries[field.path];
    const bool is_steps = field.types.size() == 2 && field.types.front() == ElementType::int16;
    entry.array = array(is_steps ? options.steps : field.types.front(),
                        [field, options](std::uint64_t i) { return element(field, options, i); });
    add_found(field, options, entry);
  }
  return sample;
}

void write_sample(const std::string& path, const Options& options) {
  using Key = std::tuple<std::vector<std::uint64_t>, ElementType, bool, bool, bool>;
  static std::map<Key, std::string> written;
  const Key key(options.points, options.steps, options.truncated, options.with_extras,
                options.with_everything);
  const auto known = written.find(key);
  if (known != written.end()) return write_bytes(path, known->second);
  ThreadTeam team(2);
  const Sample content = make_sample(options);
  write_results(path, content.spec, content.values, team);
  written.emplace(key, bytes_of(path));
}

}  // namespace coordreq::sample
