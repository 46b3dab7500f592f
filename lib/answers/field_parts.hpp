#pragma once

#include <string>
#include <vector>

#include "answers/field.hpp"
#include "spec/spec_types.hpp"

// Parts from which declarations of fields are made.
namespace coordreq {

/// `long_name` and `units` of a plain number: steps must not have a unit that looks like time, or xarray
/// would take them for a time.
[[nodiscard]] std::vector<FieldAttribute> described(std::string long_name);
[[nodiscard]] FieldAttribute flags(std::vector<FieldFlag> values);
/// The attribute `cells`: the number of cells.
[[nodiscard]] FieldAttribute counted_cells();
/// The attribute `cells` as a list of `count` numbers; nothing if the attribute would be too large.
[[nodiscard]] std::vector<FieldAttribute> counted_cells(std::size_t count);
/// One list of attributes behind the other.
[[nodiscard]] std::vector<FieldAttribute> operator+(std::vector<FieldAttribute> first,
                                                    std::vector<FieldAttribute> second);

/// An axis with names. @param long_name of the things named
[[nodiscard]] Field name_scale(std::string path, FieldSection section, std::vector<std::string> names,
                               const std::string& long_name);
/// The numbers first, first + 1, ...; least and most are the lengths that the spec allows.
[[nodiscard]] Field number_scale(std::string path, FieldSection section, std::uint64_t least,
                                 std::uint64_t most, const std::string& long_name, std::int32_t first = 0);
/// An axis without coordinates.
[[nodiscard]] Field bare_scale(std::string path, FieldSection section, std::uint64_t least,
                               std::uint64_t most);

/// "/x1", "/x2", ...: the axes of an array over cells.
[[nodiscard]] std::vector<std::string> cell_axes(const SystemSpec& spec);
[[nodiscard]] std::vector<std::string> cell_axes(const std::string& leading, const SystemSpec& spec);
[[nodiscard]] std::uint64_t cell_count(const SystemSpec& spec);

/// Sets of joint actions over cells, a bit each, and their axis of bytes, under the path with ":byte", which
/// no agent and no state can be called.
/// @param inputs indices of the inputs that the actions range over, in the order of the spec
void add_bits(Fields& fields, const std::string& path, FieldSection section, const SystemSpec& spec,
              const std::vector<std::int32_t>& inputs, const std::string& long_name);
/// The inputs of some agents, in the order of the spec.
[[nodiscard]] std::vector<std::int32_t> inputs_of(const SystemSpec& spec,
                                                  const std::vector<std::int32_t>& agents);
[[nodiscard]] std::vector<std::int32_t> all_inputs(const SystemSpec& spec);
/// Joint actions over these inputs.
[[nodiscard]] std::int64_t joint_actions(const SystemSpec& spec, const std::vector<std::int32_t>& inputs);

}  // namespace coordreq
