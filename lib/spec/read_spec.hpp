#pragma once

#include <istream>
#include <string>
#include <string_view>

#include "spec/problem_spec.hpp"

namespace coordreq {

/// Reads and checks a problem spec, contract section 2, all of it.
/// @param source the file name for messages, "standard input" for "-"
/// @throws SpecError naming the line and column (syntax), the JSON pointer (everything else) and the place in
///   an expression, with what was found and what was expected; SpecErrors if several parts are wrong.
[[nodiscard]] ProblemSpec read_spec(std::string text, std::string_view source);

/// The text of a spec that is still to be read, and where it comes from.
struct SpecSource {
  std::string text;
  std::string name;    ///< for messages
  std::string folder;  ///< where relative paths in it start; empty: the current one
};

/// The whole file; "-" reads `standard_input`. Relative paths in a spec start in its folder, those in one
/// from standard input in the current folder.
/// A pipe is read to its end if somebody begins to
/// write to it within five seconds.
/// @throws IoError if it is not there, is a folder or a device, or cannot be read.
[[nodiscard]] SpecSource read_spec_source(const std::string& path, std::istream& standard_input);

/// read_spec() of its text, with the values of tables that stand in files. @throws SpecError as above.
[[nodiscard]] ProblemSpec read_spec(SpecSource source);

/// Both: @throws IoError, SpecError as above.
[[nodiscard]] ProblemSpec read_spec_file(const std::string& path, std::istream& standard_input);

/// The JSON Schema (draft 7) that specs are validated with, as text ending in a newline.
[[nodiscard]] std::string_view spec_schema();

}  // namespace coordreq
