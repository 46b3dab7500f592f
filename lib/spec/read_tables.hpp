#pragma once

#include <functional>
#include <string>
#include <vector>

#include "expression/table_function.hpp"
#include "spec/json_document.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {

/// One of the `tables`. @param number reads a number of it
/// @throws SpecError naming what is wrong with its axes or values
[[nodiscard]] TableFunction read_table(const JsonDocument::Node& table,
                                       const std::function<Rational(const JsonDocument::Node&)>& number);

struct SpecWithTables {
  std::string text;
  std::vector<std::string> files;  ///< that were read
};

/// The text of a spec with what its tables have in files put in place of these, so that it needs none of
/// them again. The text itself if there are none.
/// @throws SpecError if a file cannot be read or is no table, with its line; what else is wrong with the spec
///   is for read_spec() to say
[[nodiscard]] SpecWithTables with_table_files(const SpecSource& source);

}  // namespace coordreq
