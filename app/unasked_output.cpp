#include "app/files_in_use.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>

#include "base/error.hpp"
#include "results/sha256.hpp"
#include "results/version.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Anything else is not replaced at all, as whoever writes will say.
bool is_regular_file_at(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

[[noreturn]] void refuse(const std::string& what, const std::string& path) {
  throw UsageError(fmt::format("{}, expected --force to replace it, or another name by --output", what),
                   path);
}

bool file_contains(const std::string& path, std::string_view wanted) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 65'536> block{};
  std::string text;
  while (file.read(block.data(), block.size()), file.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
    if (text.find(wanted) != std::string::npos) return true;
    text.erase(0, text.size() - std::min(text.size(), wanted.size()));
  }
  return false;
}

}  // namespace

void check_replaces_own_results(const std::string& path, const ProblemSpec& spec) {
  if (!is_regular_file_at(path)) return;
  const std::optional<std::string> digest = spec_digest_of(path);
  if (!digest) refuse("the file is there already and no results file", path);
  if (*digest != sha256_hex(spec.text)) refuse("the file holds the results of another spec", path);
}

void check_replaces_own_report(const std::string& path, const std::string& spec_sha256) {
  if (is_regular_file_at(path) && !file_contains(path, "SHA-256 of the spec: <code>" + spec_sha256))
    refuse("the file is there already and no report on these results", path);
}

}  // namespace coordreq
