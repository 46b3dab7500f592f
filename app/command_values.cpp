#include "app/command_values.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <string_view>

#include "app/commands.hpp"
#include "app/named_values.hpp"
#include "numeric/rational.hpp"

namespace coordreq {
namespace {

constexpr int kMaxThreads = 1024;

int parse_threads(const std::string& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 1 || value > kMaxThreads) {
    throw UsageError(fmt::format("expected a whole number from 1 to {}, found '{}'", kMaxThreads, text),
                     "--threads");
  }
  return value;
}

std::int64_t parse_sample(const std::string& text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 1) {
    throw UsageError(fmt::format("expected a whole number from 1, found '{}'", text), "--sample");
  }
  return value;
}

double parse_budget(const std::string& text) {
  const std::optional<Rational> seconds = parse_decimal(text);
  if (!seconds || *seconds < 0 || *seconds > 1e9)
    throw UsageError(fmt::format("expected a number of seconds from 0 to 1e9, found '{}'", text), "--budget");
  return seconds->get_d();
}

void add_export_values(const RawArguments& raw, const CLI::App& command, CommandLine& line) {
  if (command.count("--format") == 0) throw UsageError("no --format, expected csv, scs, c-header or vtk");
  line.format = raw.format;
  if (command.count("--partition") > 0) line.partition = raw.partition;
  line.slices = raw.slices;
  line.projections = raw.projections;
}

void add_compare_values(const RawArguments& raw, const CLI::App& command, CommandLine& line) {
  constexpr std::uint64_t kMostSteps = 2'147'483'646;
  constexpr std::uint64_t kMostCells = 1'000'000;
  if (command.count("--tolerance") > 0) {
    line.tolerance =
        static_cast<std::int64_t>(parse_whole_number(raw.tolerance, 0, kMostSteps, "--tolerance"));
  }
  if (command.count("--limit") > 0) line.limit = parse_whole_number(raw.limit, 0, kMostCells, "--limit");
}

bool writes_a_file(const CommandInfo& info) {
  return info.run == run_analyze || info.run == run_export || info.run == run_report ||
         info.run == run_simulate;
}

}  // namespace

std::string file_name(const std::string& text, const std::string& option) {
  if (!text.empty() && text != "-") return text;
  throw UsageError(fmt::format("expected the name of a file, found '{}'", text), option);
}

std::uint64_t parse_memory_size(const std::string& text) {
  const auto fail = [&text] {
    return UsageError(
        fmt::format("expected a size such as 500M, 1.5GiB or a number of bytes, found '{}'", text),
        "--max-memory");
  };
  const std::size_t digits = std::min(text.find_first_not_of("0123456789."), text.size());
  const std::optional<Rational> number = parse_decimal(std::string_view(text).substr(0, digits));
  std::string unit = text.substr(digits);
  for (char& c : unit) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  constexpr std::string_view kPrefixes = "KMGT";
  std::int64_t factor = 1;
  if (!unit.empty() && unit != "B") {
    const std::size_t power = kPrefixes.find(unit.front());
    const std::string rest = unit.substr(1);
    if (power == std::string_view::npos || !(rest.empty() || rest == "B" || rest == "IB")) throw fail();
    for (std::size_t i = 0; i <= power; ++i) factor *= 1024;
  }
  if (!number || *number * factor < 1) throw fail();
  return static_cast<std::uint64_t>(floor_to_int(*number * factor));
}

CommandLine checked_values(const RawArguments& raw, const CommandInfo& info, const CLI::App& command) {
  CommandLine line;
  line.paths = raw.paths;
  if (!info.many)
    line.paths.assign(raw.places.begin(), raw.places.begin() + std::ptrdiff_t(info.arguments.size()));
  if (!line.paths.empty()) line.path = line.paths.front();
  line.json = raw.json;
  line.quiet = raw.quiet;
  line.command = info.run;
  if (command.count("--threads") > 0) line.threads = parse_threads(raw.threads);
  if (command.count("--max-memory") > 0) line.max_memory = parse_memory_size(raw.max_memory);
  if (info.run == run_query && command.count("--at") > 0) line.at = raw.at;
  if (info.run == run_verify && command.count("--sample") > 0) line.sample = parse_sample(raw.sample);
  if (info.run == run_verify && command.count("--budget") > 0) line.budget = parse_budget(raw.budget);
  line.strict = raw.strict;
  if (info.run == run_export) add_export_values(raw, command, line);
  if (info.run == run_compare) add_compare_values(raw, command, line);
  line.simulate = raw.simulate;
  line.progress = progress_options(raw.long_run);
  line.checkpoint = checkpoint_options(raw.long_run);
  for (const std::string& text : raw.settings) line.settings.push_back(parse_setting(text));
  for (const std::string& text : raw.sweeps) line.sweeps.push_back(parse_sweep(text));
  if (info.run == run_analyze && command.count("--junit") > 0) line.junit = file_name(raw.junit, "--junit");
  if (writes_a_file(info) && command.count("--output") > 0) line.output = file_name(raw.output, "--output");
  return line;
}

}  // namespace coordreq
