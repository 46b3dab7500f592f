#pragma once

#include <string>
#include <vector>

#include "app/files_in_use.hpp"
#include "app/options.hpp"
#include "spec/problem_spec.hpp"
#include "spec/read_spec.hpp"
#include "spec/set_value.hpp"

namespace coordreq {

inline constexpr const char* kSpecDescription = "The problem spec, a JSON file; - reads standard input";

/// --set.
void declare_settings(Options& options, std::vector<SpecSetting>& settings);

/// The spec at `path` ("-": standard input), as the settings make it, checked.
/// @throws IoError, SpecError; UsageError for a setting that leads nowhere
[[nodiscard]] ProblemSpec load_spec(const std::string& path, const std::vector<SpecSetting>& settings);

/// The files that the spec at `path` is made of. @param spec nothing where it could not be read
void add_read_files(const std::string& path, const ProblemSpec* spec, FilesInUse& files);

/// `source` with the settings carried out, one after the other. @throws SpecError, UsageError
[[nodiscard]] SpecSource with_settings(SpecSource source, const std::vector<SpecSetting>& settings);

}  // namespace coordreq
