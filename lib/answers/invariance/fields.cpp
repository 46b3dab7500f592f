#include "answers/invariance/fields.hpp"

#include "answers/field_parts.hpp"

namespace coordreq {
namespace {

Field set_of_cells(const std::string& name, const ProblemSpec& spec, const std::string& long_name) {
  return {.path = "/" + name,
          .section = FieldSection::sets,
          .types = {ElementType::uint8},
          .axes = cell_axes(spec),
          .most = 1,
          .attributes = described(long_name) +
                        std::vector<FieldAttribute>{flags({{0, "not_" + name}, {1, name}}), counted_cells()},
          .column = {name}};
}

}  // namespace

Fields invariance_fields(const ProblemSpec& spec) {
  Fields fields = {set_of_cells("safe", spec, "cell is in the safe set S"),
                   set_of_cells("invariant", spec, "cell is in the invariance set K")};
  fields.push_back(
      {.path = "/collision_time",
       .section = FieldSection::sets,
       .types = {ElementType::int16, ElementType::int32},
       .axes = cell_axes(spec),
       .attributes =
           described("steps within which the worst case leaves the safe set, whatever is coordinated") +
           std::vector<FieldAttribute>{flags({{0, "not_safe"}, {kLargestValue, "never"}}),
                                       {"iterations", std::int64_t{0}, true}},
       .column = {"collision_time"}});
  if (spec.output.controller) {
    add_bits(fields, paths::kController, FieldSection::controller, spec, all_inputs(spec),
             "joint inputs that the controller admits, one bit each");
  }
  if (spec.controller.file) {
    add_bits(fields, paths::kListed, FieldSection::controller, spec, all_inputs(spec),
             "joint inputs that the controller file lists, one bit each");
    fields.back().attributes.push_back({"sha256", std::string(), true});
  }
  return fields;
}

}  // namespace coordreq
