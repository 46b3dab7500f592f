#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "spec/set_value.hpp"
#include "spec/spec_errors.hpp"
#include "spec/spec_types.hpp"

// Where in the text of a spec the value stands that an error is about. Nothing is kept for it while a spec is
// read: the text is gone through once more where there is an error.
namespace coordreq {

/// A spec as its author has written it, and what has been set in it since.
struct WrittenSpec {
  std::string text;                      ///< empty: not known
  std::vector<SpecSetting> settings;     ///< carried out one after the other
  std::vector<std::string> tables = {};  ///< paths of the files that tables were read from
};

/// The text and the settings that `spec` was read from.
[[nodiscard]] WrittenSpec written_spec(const ProblemSpec& spec);

/// Where in a text the value at a JSON pointer starts; nothing if there is no such value.
/// @pre unchecked: JsonDocument::parse() has accepted the text, without its byte order mark.
[[nodiscard]] std::optional<std::size_t> offset_of_value(std::string_view text, std::string_view pointer);

/// An error "WHAT (WHERE)" with the line and column in WHERE: "expected ... (/states/0/step; line 7, column
/// 42)", or what has set the value: "(/states/0/step; set by states.0.step=0)". As it is where WHERE is no
/// JSON pointer, or that of no value in the text.
[[nodiscard]] std::string with_location(const std::string& error, const WrittenSpec& written);

/// Runs `work` and returns its result. @throws SpecError, SpecErrors with places instead of those without
template <class Work>
auto with_locations(const WrittenSpec& written, const Work& work) {
  try {
    return work();
  } catch (const SpecErrors& errors) {
    std::vector<std::string> lines;
    for (const std::string& line : errors.lines()) lines.push_back(with_location(line, written));
    throw SpecErrors(std::move(lines));
  } catch (const SpecError& error) {
    throw SpecError(with_location(error.what(), written));
  }
}

}  // namespace coordreq
