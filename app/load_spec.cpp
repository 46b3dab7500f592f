#include "app/load_spec.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <system_error>
#include <utility>

#include "app/option_values.hpp"
#include "app/sweep.hpp"
#include "app/text.hpp"
#include "base/error.hpp"
#include "base/timer.hpp"
#include "results/controller_file.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Instead of a path in the spec: the last setting that is carried out.
constexpr const char* kRefine = "refine";
constexpr WholeNumber<std::int64_t> kFactors{1, 1'000'000};

/// A text takes so many times its length while it is read, as one long string; short values take more.
constexpr double kBytesOfByte = 4.75;

/// @param held bytes of it that are in memory already
void check_length(std::uintmax_t bytes, std::uintmax_t held, const std::string& name,
                  std::optional<std::uint64_t> memory) {
  constexpr std::uintmax_t kShort = std::uintmax_t{1} << 20U;  // no matter
  if (!memory || bytes < kShort) return;
  const std::uint64_t need =
      resident_bytes() + static_cast<std::uint64_t>(kBytesOfByte * static_cast<double>(bytes)) - held;
  if (need <= *memory) return;
  throw LimitError(fmt::format("reading {} of spec needs about {} of memory, the limit of --max-memory is {}",
                               byte_size(bytes), byte_size(need), byte_size(*memory)),
                   name);
}

}  // namespace

void declare_settings(Options& options, std::vector<SpecSetting>& settings) {
  options.repeatable(
      settings, "--set", "PATH=VALUE",
      "Replace a value of the spec, e.g. constants.R=0.7 or states.0.step=0.02; may be repeated",
      parse_setting);
  options.option("--refine", "N", "Divide the steps of all states that are not discrete by N, after --set",
                 [&settings](const auto& text, const auto& option) {
                   settings.push_back({kRefine, std::to_string(kFactors(text, option))});
                 });
}

SpecSource with_settings(SpecSource source, const std::vector<SpecSetting>& settings) {
  std::optional<std::int64_t> factor;
  for (const SpecSetting& setting : settings) {
    if (setting.path != kRefine) {
      source.text = with_setting(source.text, source.name, setting);
    } else if (factor) {
      throw UsageError("expected one refinement, found --refine and --sweep refine");
    } else {
      factor = kFactors(setting.value, kRefine);
    }
  }
  if (factor) source.text = with_refinement(source.text, source.name, *factor);
  return source;
}

void add_read_files(const std::string& path, const ProblemSpec* spec, FilesInUse& files) {
  files.reads(path, "the spec");
  if (spec == nullptr) return;
  if (spec->controller.file) files.reads(controller_path(*spec), "the controller");
  for (const std::string& file : written_spec(*spec).tables) files.reads(file, "a table of the spec");
}

SpecSource load_source(const std::string& path, std::optional<std::uint64_t> memory) {
  std::error_code not_a_file;
  const std::uintmax_t size = path == "-" ? 0 : std::filesystem::file_size(path, not_a_file);
  if (!not_a_file) check_length(size, 0, path, memory);
  SpecSource source = read_spec_source(path, std::cin);
  check_length(source.text.size(), source.text.size(), source.name, memory);
  return source;
}

ProblemSpec read_with_settings(const SpecSource& source, const std::vector<SpecSetting>& settings) {
  WrittenSpec written{source.text, settings, {}};
  ProblemSpec spec = with_locations(written, [&] { return read_spec(with_settings(source, settings)); });
  if (settings.empty()) return spec;
  written.tables = written_spec(spec).tables;
  spec.written = std::make_shared<const WrittenSpec>(std::move(written));
  return spec;
}

ProblemSpec load_spec(const std::string& path, const std::vector<SpecSetting>& settings,
                      std::optional<std::uint64_t> memory) {
  return read_with_settings(load_source(path, memory), settings);
}

}  // namespace coordreq
