#pragma once

#include <functional>
#include <span>
#include <string>

#include "app/analyze_batch.hpp"
#include "base/error.hpp"
#include "ranks/ranks.hpp"

// Texts as messages between ranks.
namespace coordreq {

[[nodiscard]] inline Bytes bytes_of(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

[[nodiscard]] inline std::string text_of(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Several analyses on ranks, each by one of them: whoever has done one gets the next. The first rank plans,
/// tells and works too. Together.
/// @throws as run_analyze_batch()
[[nodiscard]] ExitCode run_batch_on_ranks(const AnalyzeOptions& args);

/// `coordreq-mpi`: what is typed, done by all ranks together. Only the first reads the spec, writes, and
/// prints. @param watch is called again and again while the work goes on; what it throws ends it
/// @throws UsageError and as analyze_with_progress()
[[nodiscard]] ExitCode analyze_on_ranks(int argc, const char* const* argv, Ranks& ranks,
                                        const std::function<void()>& watch);

}  // namespace coordreq
