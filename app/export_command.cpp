#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/files_in_use.hpp"
#include "app/interrupt.hpp"
#include "app/late_file.hpp"
#include "app/standard_streams.hpp"
#include "export/c_header.hpp"
#include "export/cell_image.hpp"
#include "export/csv_table.hpp"
#include "export/parse_selection.hpp"
#include "export/scots_controller.hpp"
#include "export/vti_image.hpp"
#include "results/results_reader.hpp"
#include "results/write_results.hpp"
#include "results/write_vtkhdf.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

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

using Exporter = std::function<void(const TextSink&)>;

std::vector<std::string> partition_names(const ResultsReader& results) {
  std::vector<std::string> names;
  for (const StoredPartition& partition : results.partitions()) names.push_back(partition.name);
  return names;
}

std::optional<std::size_t> chosen_partition(const CommandLine& line, const ResultsReader& results) {
  if (!line.partition) return std::nullopt;
  const std::vector<std::string> names = partition_names(results);
  const auto found = std::find(names.begin(), names.end(), *line.partition);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  throw UsageError(
      fmt::format("no partition {}, expected {}", quote_text(*line.partition), quote_list(names, "or")),
      "--partition");
}

std::size_t one_partition(const CommandLine& line, const ResultsReader& results) {
  if (const std::optional<std::size_t> chosen = chosen_partition(line, results)) return *chosen;
  if (results.partitions().size() == 1) return 0;
  throw UsageError(
      fmt::format("which partition? expected --partition {}", quote_list(partition_names(results), "or")));
}

void refuse_selection(const CommandLine& line) {
  if (line.slices.empty() && line.projections.empty()) return;
  throw UsageError(fmt::format("only csv and vtk can be cut, found it with {}", line.format),
                   line.slices.empty() ? "--project" : "--slice");
}

TableSelection selection_of(const CommandLine& line, const ResultsReader& results) {
  TableSelection selection = parse_selection(line.slices, line.projections, results.grid());
  selection.partition = chosen_partition(line, results);
  return selection;
}

bool writes_vtkhdf(const CommandLine& line) {
  return line.format == "vtk" && line.output && line.output->ends_with(".vtkhdf");
}

/// HDF5 writes to files only.
void export_vtkhdf(const CommandLine& line, const ResultsReader& results, ThreadTeam& team) {
  check_writable(*line.output);
  const ImageContent image = cell_image(results, selection_of(line, results));
  const InterruptDelay delay;
  if (is_interrupted()) throw Error(ExitCode::interrupted, "interrupted", "");
  write_vtkhdf(*line.output, image, team);
  if (is_interrupted()) {
    throw Error(ExitCode::interrupted, "interrupted when the image was complete", *line.output);
  }
}

Exporter exporter(const CommandLine& line, const ResultsReader& results, ThreadTeam& team) {
  if (line.format == "csv") {
    const TableSelection selection = selection_of(line, results);
    return [&results, selection](const TextSink& sink) { export_csv(results, selection, sink); };
  }
  if (line.format == "vtk") {
    if (!line.output || !line.output->ends_with(".vti")) {
      throw UsageError(fmt::format("expected a name that ends in .vti or .vtkhdf, found {}",
                                   line.output ? quote_text(*line.output) : "none"),
                       "-o");
    }
    const TableSelection selection = selection_of(line, results);
    return [&results, selection](const TextSink& sink) { export_vti(cell_image(results, selection), sink); };
  }
  refuse_selection(line);
  if (line.format == "scs") {
    if (line.partition)
      throw UsageError("scs holds the controller, which no partition changes", "--partition");
    return [&](const TextSink& sink) { export_scots(results, team, sink); };
  }
  if (line.format == "c-header") {
    const std::size_t partition = one_partition(line, results);
    return [&results, &team, partition](const TextSink& sink) {
      export_c_header(results, partition, team, sink);
    };
  }
  throw UsageError(fmt::format("expected csv, scs, c-header or vtk, found {}", quote_text(line.format)),
                   "--format");
}

}  // namespace

ExitCode run_export(const CommandLine& line) {
  if (line.output) check_output(line.path, *line.output, "the export");
  const ResultsReader results(line.path);
  ThreadTeam team(line.threads);
  if (writes_vtkhdf(line)) {
    export_vtkhdf(line, results, team);
    return ExitCode::success;
  }
  const Exporter write = exporter(line, results, team);
  std::optional<LateFile> file;
  if (line.output) file.emplace(*line.output, "the export");
  Blocks blocks([&file](std::string_view text) { file ? file->write(text) : write_output(text); });
  write([&blocks](std::string_view text) { blocks.add(text); });
  blocks.flush();
  if (file) file->commit();
  return ExitCode::success;
}

}  // namespace coordreq
