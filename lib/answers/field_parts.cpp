#include "answers/field_parts.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>

#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

/// HDF5 attributes take 64 KiB.
constexpr std::size_t kMostCounted = 4096;

}  // namespace

std::vector<FieldAttribute> described(std::string long_name) {
  return {{"long_name", std::move(long_name)}, {"units", std::string("1")}};
}

FieldAttribute flags(std::vector<FieldFlag> values) {
  return {"flags", std::move(values)};
}

FieldAttribute counted_cells() {
  return {"cells", std::uint64_t{0}, true};
}

std::vector<FieldAttribute> counted_cells(std::size_t count) {
  if (count > kMostCounted) return {};
  return {{"cells", std::vector<std::uint64_t>(count), true}};
}

std::vector<FieldAttribute> operator+(std::vector<FieldAttribute> first, std::vector<FieldAttribute> second) {
  std::move(second.begin(), second.end(), std::back_inserter(first));
  return first;
}

Field name_scale(std::string path, FieldSection section, std::vector<std::string> names,
                 const std::string& long_name) {
  const std::uint64_t length = names.size();
  return {.path = std::move(path),
          .section = section,
          .types = {},
          .axes = {},
          .scale = FieldScale{.coordinates = std::move(names), .least = length, .most = length},
          .attributes = {{"long_name", long_name}}};
}

Field number_scale(std::string path, FieldSection section, std::uint64_t least, std::uint64_t most,
                   const std::string& long_name, std::int32_t first) {
  return {.path = std::move(path),
          .section = section,
          .types = {ElementType::int32},
          .axes = {},
          .scale = FieldScale{.coordinates = Numbers{first}, .least = least, .most = most},
          .attributes = described(long_name)};
}

Field bare_scale(std::string path, FieldSection section, std::uint64_t least, std::uint64_t most) {
  return {.path = std::move(path),
          .section = section,
          .types = {ElementType::float32},
          .axes = {},
          .scale = FieldScale{.coordinates = NoCoordinates{}, .least = least, .most = most}};
}

std::vector<std::string> cell_axes(const SystemSpec& spec) {
  std::vector<std::string> axes;
  for (const StateSpec& state : spec.states) axes.push_back("/" + state.name);
  return axes;
}

std::vector<std::string> cell_axes(const std::string& leading, const SystemSpec& spec) {
  std::vector<std::string> axes = cell_axes(spec);
  axes.insert(axes.begin(), leading);
  return axes;
}

std::uint64_t cell_count(const SystemSpec& spec) {
  return static_cast<std::uint64_t>(spec.cells());
}

void add_bits(Fields& fields, const std::string& path, FieldSection section, const SystemSpec& spec,
              const std::vector<std::int32_t>& inputs, const std::string& long_name) {
  const auto actions = static_cast<std::uint64_t>(joint_actions(spec, inputs));
  const std::string bytes = path + ":byte";
  fields.push_back(bare_scale(bytes, section, (actions + 7) / 8, (actions + 7) / 8));
  std::string names;
  for (const std::int32_t i : inputs)
    names += (names.empty() ? "" : " ") + spec.inputs[static_cast<std::size_t>(i)].name;
  std::vector<std::string> axes = cell_axes(spec);
  axes.push_back(bytes);
  fields.push_back(
      {.path = path,
       .kind = FieldKind::actions,
       .section = section,
       .types = {ElementType::uint8},
       .axes = std::move(axes),
       .attributes = described(long_name) +
                     std::vector<FieldAttribute>{
                         {"inputs", names}, {"actions", actions}, {"bitorder", std::string("little")}}});
}

std::vector<std::int32_t> inputs_of(const SystemSpec& spec, const std::vector<std::int32_t>& agents) {
  std::vector<std::int32_t> inputs;
  for (const std::int32_t agent : agents) {
    const std::vector<std::int32_t>& agent_inputs = spec.agents[static_cast<std::size_t>(agent)].inputs;
    inputs.insert(inputs.end(), agent_inputs.begin(), agent_inputs.end());
  }
  std::sort(inputs.begin(), inputs.end());
  return inputs;
}

std::vector<std::int32_t> all_inputs(const SystemSpec& spec) {
  std::vector<std::int32_t> inputs(spec.inputs.size());
  std::iota(inputs.begin(), inputs.end(), 0);
  return inputs;
}

std::int64_t joint_actions(const SystemSpec& spec, const std::vector<std::int32_t>& inputs) {
  std::int64_t actions = 1;
  for (const std::int32_t i : inputs)
    actions *= static_cast<std::int64_t>(spec.inputs[static_cast<std::size_t>(i)].values.size());
  return actions;
}

std::vector<FieldFlag> flags_of(const Field& field) {
  for (const FieldAttribute& attribute : field.attributes) {
    if (const auto* flags = std::get_if<std::vector<FieldFlag>>(&attribute.value)) return *flags;
  }
  return {};
}

std::string status_of(const Field& field, std::int64_t value) {
  for (const FieldFlag& flag : flags_of(field)) {
    const bool is_largest = flag.value == kLargestValue && value == std::numeric_limits<std::int32_t>::max();
    if (flag.value == value || is_largest) return flag.meaning;
  }
  return field.kind == FieldKind::steps ? "steps" : "number";
}

double probability_of(std::int32_t bits) {
  return std::bit_cast<float>(bits);
}

Json value_json(const Field& field, std::int64_t value) {
  if (field.kind == FieldKind::probability) return probability_of(static_cast<std::int32_t>(value));
  const std::string status = status_of(field, value);
  return status == "steps" || status == "number" ? Json(value) : Json();
}

ResultArray stacked_array(std::uint64_t length, std::vector<ResultArray> arrays) {
  const ElementType type = arrays.empty() ? ElementType::int16 : arrays.front().type;
  for (const ResultArray& array : arrays) {
    if (array.type != type) throw std::invalid_argument("arrays of one field with different element types");
  }
  return {type,
          [length, arrays = std::move(arrays), type](std::uint64_t begin, std::uint64_t count, void* out) {
            auto* target = static_cast<std::byte*>(out);
            while (count > 0) {
              const std::uint64_t first = begin % length;
              const std::uint64_t here = std::min(count, length - first);
              arrays[begin / length].fill(first, here, target);
              begin += here;
              count -= here;
              target += here * element_size(type);
            }
          }};
}

}  // namespace coordreq
