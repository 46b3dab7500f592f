// What does each fast path save? `scripts/scaling --switches` asks this program.
//
//   bench_switches                    the names of the switches, those first without which results are the
//   same bench_switches SPEC FILE [NAME]   analyses SPEC on one thread with this switch off, writes FILE and
//   prints the
//                                     seconds of processor time of the fastest of some runs, and the cells of
//                                     K

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/analyze.hpp"
#include "base/fast_paths.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

/// Short runs are repeated so long, in seconds, and so often at most.
constexpr double kLongEnough = 0.5;
constexpr int kMostRuns = 15;

double user_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

void list_switches() {
  for (const FastPath& path : kFastPaths)
    fmt::print("{} {}\n", path.name, path.keeps_results ? "same" : "wider");
}

void turn_off(const std::string& name) {
  const auto* const found = std::find_if(std::begin(kFastPaths), std::end(kFastPaths),
                                         [&](const FastPath& path) { return path.name == name; });
  if (found == std::end(kFastPaths)) throw std::invalid_argument("no switch is called " + name);
  fast_paths().*found->is_on = false;
}

void measure(const std::string& path, const std::string& output) {
  ThreadTeam team(1);
  AnalysisOptions options;
  options.output = output;
  double fastest = 0.0;
  double all = 0.0;
  Json summary;
  for (int run = 0; run == 0 || (run < kMostRuns && all < kLongEnough); ++run) {
    const double start = user_seconds();
    summary = analyze(read_spec_file(path, std::cin), options, team);
    const double own = user_seconds() - start;
    fastest = run == 0 ? own : std::min(fastest, own);
    all += own;
  }
  fmt::print("{:.6f} {}\n", fastest, summary.at("invariant").dump());
}

}  // namespace
}  // namespace coordreq

int main(int argc, char** argv) {
  try {
    if (argc < 3) {
      coordreq::list_switches();
      return 0;
    }
    if (argc > 3) coordreq::turn_off(argv[3]);
    coordreq::measure(argv[1], argv[2]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
