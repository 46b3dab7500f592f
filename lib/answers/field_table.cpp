#include "answers/field_table.hpp"

#include <algorithm>

#include "answers/coalition/fields.hpp"
#include "answers/common/fields.hpp"
#include "answers/convention/fields.hpp"
#include "answers/invariance/fields.hpp"
#include "answers/layers/fields.hpp"
#include "answers/network/fields.hpp"
#include "answers/requirements/fields.hpp"

namespace coordreq {
namespace {

using Declare = Fields (*)(const ProblemSpec&);

/// An answer has one line here.
constexpr Declare kAnswers[] = {common_fields,  invariance_fields, layer_fields,      convention_fields,
                                network_fields, coalition_fields,  requirement_fields};

}  // namespace

Fields result_fields(const ProblemSpec& spec) {
  Fields table;
  for (const Declare declare : kAnswers) {
    Fields fields = declare(spec);
    std::move(fields.begin(), fields.end(), std::back_inserter(table));
  }
  std::stable_sort(table.begin(), table.end(),
                   [](const Field& a, const Field& b) { return a.section < b.section; });
  return table;
}

std::optional<std::vector<std::uint64_t>> shape_of(const Field& field,
                                                   const std::map<std::string, std::uint64_t>& scales) {
  std::vector<std::uint64_t> shape;
  for (const std::string& axis : field.axes) {
    const auto scale = scales.find(axis);
    if (scale == scales.end()) return std::nullopt;
    shape.push_back(scale->second);
  }
  return shape;
}

}  // namespace coordreq
