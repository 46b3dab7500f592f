#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/json.hpp"

namespace coordreq {

/// The document of a text in its order, numbers as typed; one that a double cannot hold becomes a text, for a
/// spec may have that instead. @param source the file name for messages
/// @throws SpecError as JsonDocument::parse()
[[nodiscard]] Json spec_json(const std::string& text, const std::string& source);

/// A value of a spec that shall be another.
struct SpecSetting {
  /// Keys, places in lists (from 0), or in lists of things that have names, their names, with dots between:
  /// "constants.R", "states.0.step", "states.p1.step". Or a JSON pointer: "/states/0/step".
  std::string path;
  /// JSON, or else a text as it is: 0.02, true, ["a"], 2*pi.
  std::string value;
};

/// The text of a spec with the value at the path replaced, without its comments. A number that a double
/// cannot hold becomes a text. A key that is not there is added, with the objects on the way to it; whether
/// there may be such a key is for read_spec() to say. Constants, definitions and tables are not added:
/// nothing would refer to them.
/// @param source the file name for messages
/// @throws SpecError if `text` or a value in JSON is none, or nested too deep; UsageError with the path as
///   the place if the path leads nowhere, the value starts like JSON and is none, or one of them is not UTF-8
[[nodiscard]] std::string with_setting(const std::string& text, const std::string& source,
                                       const SpecSetting& setting);

/// The JSON pointer of what a setting sets in a text; nothing if it leads nowhere.
/// @pre unchecked: JsonDocument::parse() has accepted the text.
[[nodiscard]] std::optional<std::string> pointer_of_setting(const std::string& text,
                                                            const SpecSetting& setting);

/// The text of a spec without its comments, its numbers as with_setting() has them.
/// @pre unchecked: JsonDocument::parse() has accepted it.
[[nodiscard]] std::string without_comments(const std::string& text);

/// The text of a spec with a finer grid: every step of a state that is not discrete is divided by `factor`,
/// so that all grid points stay and others lie between them. @pre 1 <= factor < 2^31
/// @param source as for with_setting(). @throws SpecError likewise
[[nodiscard]] std::string with_refinement(const std::string& text, const std::string& source,
                                          std::int64_t factor);

}  // namespace coordreq
