#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/files_in_use.hpp"
#include "app/options.hpp"
#include "spec/read_spec.hpp"
#include "spec/set_value.hpp"
#include "spec/spec_location.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

inline constexpr const char* kSpecDescription = "The problem spec, a JSON file; - reads standard input";

/// --set and --refine.
void declare_settings(Options& options, std::vector<SpecSetting>& settings);

/// The text at `path` ("-": standard input).
/// @param memory that this program may take. @throws LimitError if reading a text so long would take more;
/// IoError
[[nodiscard]] SpecSource load_source(const std::string& path, std::optional<std::uint64_t> memory);

/// The spec that a text is with the settings carried out, checked; it knows what was written.
/// @throws SpecError with the location in the text; UsageError
[[nodiscard]] ProblemSpec read_with_settings(const SpecSource& source,
                                             const std::vector<SpecSetting>& settings);

/// Runs `work` on a spec and returns its result. @throws SpecError with the location in the text as written
template <class Work>
auto with_places_in(const ProblemSpec& spec, const Work& work) {
  return with_locations(written_spec(spec), work);
}

/// The spec at `path`, as the settings make it, checked.
/// @throws as load_source(); SpecError; UsageError for a setting that leads nowhere
[[nodiscard]] ProblemSpec load_spec(const std::string& path, const std::vector<SpecSetting>& settings,
                                    std::optional<std::uint64_t> memory);

/// The files that the spec at `path` is made of. @param spec nothing where it could not be read
void add_read_files(const std::string& path, const ProblemSpec* spec, FilesInUse& files);

/// `source` with the settings carried out, one after the other, and one of "refine" at last. @throws
/// SpecError, UsageError
[[nodiscard]] SpecSource with_settings(SpecSource source, const std::vector<SpecSetting>& settings);

}  // namespace coordreq
