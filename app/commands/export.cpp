#include <fmt/format.h>

#include <memory>

#include "app/atomic_file.hpp"
#include "app/commands/all.hpp"
#include "app/files_in_use.hpp"
#include "app/option_values.hpp"
#include "app/standard_streams.hpp"
#include "export/cell_table.hpp"
#include "export/formats.hpp"
#include "results/results_reader.hpp"
#include "spec/problem_spec.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

enum class Format : std::uint8_t { csv, scs, c_header, vtk };

struct ExportOptions : CommonOptions {
  std::string results;
  std::optional<Format> format;
  std::optional<std::string> output, partition;
  std::optional<ControllerKind> controller;
  std::vector<std::string> slices, projections;
};

/// Hands on text in blocks; the last one with flush().
class Blocks {
 public:
  explicit Blocks(TextSink sink) : sink_(std::move(sink)) {}

  void add(std::string_view text) {
    text_ += text;
    if (text_.size() >= kBlockBytes) flush();
  }
  void flush() {
    sink_(text_);
    text_.clear();
  }

 private:
  static constexpr std::size_t kBlockBytes = 1 << 16;
  TextSink sink_;
  std::string text_;
};

/// What an export takes, and how it is done.
struct Exporter {
  MemoryDemand demand;
  std::function<void(const TextSink&, ThreadTeam&)> write;
};

std::vector<std::string> partition_names(const ResultsReader& results) {
  std::vector<std::string> names;
  for (const StoredPartition& partition : results.partitions()) names.push_back(partition.name);
  return names;
}

std::optional<std::size_t> chosen_partition(const ExportOptions& options, const ResultsReader& results) {
  if (!options.partition) return std::nullopt;
  const std::vector<std::string> names = partition_names(results);
  const auto found = std::find(names.begin(), names.end(), *options.partition);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  throw UsageError(
      fmt::format("no partition {}, expected {}", quote_text(*options.partition), quote_list(names, "or")),
      "--partition");
}

std::size_t one_partition(const ExportOptions& options, const ResultsReader& results) {
  if (const std::optional<std::size_t> chosen = chosen_partition(options, results)) return *chosen;
  if (results.partitions().size() == 1) return 0;
  throw UsageError(
      fmt::format("which partition? expected --partition {}", quote_list(partition_names(results), "or")));
}

void refuse_selection(const ExportOptions& options) {
  if (options.slices.empty() && options.projections.empty()) return;
  throw UsageError(fmt::format("only csv and vtk can be cut, found it with {}",
                               options.format == Format::scs ? "scs" : "c-header"),
                   options.slices.empty() ? "--project" : "--slice");
}

TableSelection selection_of(const ExportOptions& options, const ResultsReader& results) {
  TableSelection selection = parse_selection(options.slices, options.projections, results.grid());
  selection.partition = chosen_partition(options, results);
  return selection;
}

Exporter exporter(const ExportOptions& options, const ResultsReader& results) {
  if (options.controller && options.format != Format::scs)
    throw UsageError("only scs is of one controller", "--controller");
  if (options.format == Format::csv) {
    const TableSelection selection = selection_of(options, results);
    return {
        {.once = CellTable::bytes(results, selection)},
        [&results, selection](const TextSink& sink, ThreadTeam&) { export_csv(results, selection, sink); }};
  }
  if (options.format == Format::vtk) {
    if (!options.output || !options.output->ends_with(".vti")) {
      throw UsageError(fmt::format("expected a name that ends in .vti, found {}",
                                   options.output ? quote_text(*options.output) : "none"),
                       "-o");
    }
    const TableSelection selection = selection_of(options, results);
    return {{.once = image_bytes(results, selection)},
            [&results, selection](const TextSink& sink, ThreadTeam&) {
              export_vti(cell_image(results, selection), sink);
            }};
  }
  refuse_selection(options);
  if (options.format == Format::scs) {
    if (options.partition)
      throw UsageError("scs holds the controller, which no partition changes", "--partition");
    const ControllerKind kind = options.controller.value_or(ControllerKind::safety);
    if (kind == ControllerKind::progress && !results.spec().goal)
      throw UsageError("the spec has no goal, expected safety, found progress", "--controller");
    return {scots_demand(results), [&results, kind](const TextSink& sink, ThreadTeam& team) {
              export_scots(results, kind, team, sink);
            }};
  }
  const std::size_t partition = one_partition(options, results);
  return {c_header_demand(results), [&results, partition](const TextSink& sink, ThreadTeam& team) {
            export_c_header(results, partition, team, sink);
          }};
}

ExitCode run(const ExportOptions& options) {
  if (!options.format) throw UsageError("no --format, expected csv, scs, c-header or vtk");
  if (options.output) check_output(options.results, *options.output, "the export");
  options.keep_to_memory();
  const ResultsReader results(options.results, options.max_memory);
  const Exporter wanted = exporter(options, results);
  ThreadTeam team(options.threads_for("exporting needs", wanted.demand));
  std::optional<AtomicFile> file;
  if (options.output) file.emplace(*options.output, "the export");
  Blocks blocks([&file](std::string_view text) { file ? file->write(text) : write_output(text); });
  wanted.write([&blocks](std::string_view text) { blocks.add(text); }, team);
  blocks.flush();
  if (file) file->commit();
  return ExitCode::success;
}

}  // namespace

Run declare_export(Options& options) {
  const auto args = std::make_shared<ExportOptions>();
  declare_results(options, args->results);
  options.option(args->format, "--format", "csv|scs|c-header|vtk",
                 "The format to write; scs is that of SCOTS, vtk that of ParaView",
                 OneOf<Format>{{{"csv", Format::csv},
                                {"scs", Format::scs},
                                {"c-header", Format::c_header},
                                {"vtk", Format::vtk}}});
  options.option(args->output, "-o,--output", "FILE",
                 "File to write (default: standard output; vtk: a name that ends in .vti)", file_name);
  options.option(args->partition, "--partition", "NAME", "The partition to export (csv, vtk: default all)",
                 as_typed);
  options.option(
      args->controller, "--controller", "safety|progress",
      "scs: the controller that keeps the system in K (default), or the one that approaches the goal",
      OneOf<ControllerKind>{{{"safety", ControllerKind::safety}, {"progress", ControllerKind::progress}}});
  options.repeatable(args->slices, "--slice", "STATE=VALUE",
                     "csv, vtk: only the cells where a state has this value; may be repeated", as_typed);
  options.repeatable(args->projections, "--project", "STATE:KIND",
                     "csv, vtk: the minimum or maximum along a state, min or max; may be repeated", as_typed);
  declare_common(options, *args, {.answer = false});
  return [args] { return run(*args); };
}

}  // namespace coordreq
