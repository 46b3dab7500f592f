#include "verify/verify_file.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "answers/checking/posts.hpp"
#include "answers/countdown/kinds.hpp"
#include "answers/field.hpp"
#include "answers/field_parts.hpp"
#include "answers/plan.hpp"
#include "reach/table_shapes.hpp"
#include "reach/thread_memory.hpp"
#include "spec/problem_spec.hpp"
#include "verify/outward_posts.hpp"

namespace coordreq {
namespace {

/// Bytes of an element in memory: numbers of steps are widened.
double bytes_in_claims(const Field& field) {
  const bool is_widened = std::ranges::find(field.types, ElementType::int16) != field.types.end();
  return is_widened ? sizeof(std::int32_t) : static_cast<double>(element_size(field.types.front()));
}

/// Elements of a field over cells for each of them; 0: it is not over cells. Layers list every cell once.
double elements_of_cell(const ResultsReader& results, const Field& field) {
  if (field.path.starts_with("/layers/") && field.path.ends_with("/cell")) return 1;
  const std::vector<std::string> cells = cell_axes(results.spec());
  const auto found = std::search(field.axes.begin(), field.axes.end(), cells.begin(), cells.end());
  if (field.types.empty() || found == field.axes.end()) return 0;
  return results.elements(field) / static_cast<double>(results.grid().cells());
}

double bytes_of_claims(const ResultsReader& results) {
  constexpr double kBytesOfTable = 2 * sizeof(std::int64_t) + 1;  // widened, and computed once more
  double bytes = 0, copied = 0, tables = 0;
  for (const Field& field : results.fields()) {
    const double elements = elements_of_cell(results, field);
    if (elements == 0 && !field.scale && !field.types.empty())
      tables += results.elements(field) * kBytesOfTable;
    if (elements == 0) continue;
    const bool is_list = field.path.starts_with("/layers/");
    bytes += elements * (is_list ? sizeof(std::uint64_t) : bytes_in_claims(field));
    copied = std::max(copied, 2 * bytes_in_claims(field));
  }
  return tables + (bytes + copied) * static_cast<double>(results.grid().cells());
}

double bytes_of_posts(const ResultsReader& results) {
  constexpr double kBytesOfOpenEntry = 4096;  // of the parts of its cell that are not proven yet
  const std::vector<TableShape> shapes = table_shapes(results.spec());
  const bool has_tubes = results.spec().abstraction.between_samples;
  double of_entry = sizeof(IndexRange) + sizeof(ResolvedRange);
  if (results.has_abstraction()) of_entry += sizeof(IndexRange);
  double bytes = 0, entries = 0;
  for (const TableShape& shape : shapes) {
    bytes += (has_tubes ? 2 : 1) * shape.bytes;  // of the analysis
    entries += choices_of(results.spec(), shape.states, shape.inputs);
  }
  if (has_tubes) of_entry += 2 * sizeof(IndexRange) + sizeof(ResolvedRange) + sizeof(std::uint8_t);
  bytes += of_entry * entries + std::min(2 * kMostBytesOfOpenSubboxes, kBytesOfOpenEntry * entries);
  const auto inputs = static_cast<double>(results.inputs().count());
  return bytes + 2 * inputs * sizeof(std::int32_t) * static_cast<double>(shapes.size());
}

/// Memory of the actions of all classes of all partitions in each joint input, for every answer about steps.
double bytes_of_classes(const ResultsReader& results) {
  constexpr double kBytesOfClass = 400;
  const ProblemSpec& spec = results.spec();
  const auto answers = static_cast<double>(std::ranges::count_if(
      kCountdownKinds, [&](const CountdownKind* kind) { return results.has(kind->layered); }));
  double classes = 0;
  for (const PartitionSpec& partition : spec.coordination.partitions)
    classes += answers * static_cast<double>(partition.classes.size());
  const double one = static_cast<double>(results.inputs().count()) * sizeof(std::int32_t) + kBytesOfClass;
  return classes * one;
}

/// Beside claims, what checks keep of each cell.
double kept_of_cell(const ResultsReader& results) {
  double bytes = 0;
  for (const Answer& answer : all_answers()) {
    if (answer.check_memory != nullptr) bytes += answer.check_memory(results.spec());
  }
  if (results.spec().abstraction.between_samples) bytes += 2 * sizeof(std::int32_t) + 1;
  return bytes;
}

double bytes_of_thread(const ResultsReader& results) {
  const ProblemSpec& spec = results.spec();
  const auto inputs = static_cast<double>(results.inputs().count());
  // Minima over boxes and over parts of them; and two sets for tubes.
  const double remembered = 2 * std::min(static_cast<double>(PostMinima::kMostMinima), 4 * inputs);
  double bytes = remembered * sizeof(std::int32_t) * (spec.abstraction.between_samples ? 3 : 1);
  constexpr double kBytesOfPartition = 100;
  double points = 0;
  // The data of an answer about a class of one partition.
  for (const PartitionSpec& partition : spec.coordination.partitions)
    bytes += kBytesOfPartition * static_cast<double>(partition.classes.size());
  constexpr double kBytesOfInput = 32, kBytesOfPoint = 250;  // flags and places; ends of cells as rationals
  for (const GridDimension& dimension : results.grid().dimensions())
    points += static_cast<double>(dimension.count);
  return kBytesOfPostThread + bytes + kBytesOfInput * inputs + kBytesOfPoint * points;
}

}  // namespace

VerifyMemory verify_memory(const ResultsReader& results) {
  return {.claims = bytes_of_claims(results),
          .work = {.once = bytes_of_posts(results) +
                           kept_of_cell(results) * static_cast<double>(results.grid().cells()),
                   .of_thread = bytes_of_thread(results) + bytes_of_classes(results)}};
}

}  // namespace coordreq
