#include "results/version.hpp"

#include "base/error.hpp"
#include "results/child_trial.hpp"
#include "results/reading.hpp"
#include "results/results_file.hpp"

namespace coordreq {

std::optional<std::string> spec_digest_of(const std::string& path) {
  constexpr std::size_t kCache = std::size_t{1} << 20U;
  const auto read = [&path] {
    return reading(path, [&] { return ResultsFile(path, kCache).text("/", "spec_sha256"); });
  };
  try {
    try_in_child(path, [&] { static_cast<void>(read()); });
    return read();
  } catch (const ResultsError&) {
    return std::nullopt;
  } catch (const Error& error) {
    // From the child only the code of an error comes back.
    if (error.exit_code() == ExitCode::invalid_input) return std::nullopt;
    throw;
  }
}

}  // namespace coordreq
