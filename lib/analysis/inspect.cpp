#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/analyze.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/network/network_problem.hpp"
#include "base/error.hpp"
#include "engine/join_rows.hpp"
#include "model/model.hpp"
#include "model/row_sample.hpp"
#include "reach/build_abstraction.hpp"
#include "results/controller_file.hpp"

namespace coordreq {
namespace {

/// Bytes that the program takes before any problem: code, libraries, stacks, buffers of the writer.
constexpr double kFixedBytes = 21.5 * 1024 * 1024;

double count_product(const ProblemSpec& spec) {
  double cells = 1;
  for (const StateSpec& state : spec.states) cells *= static_cast<double>(state.grid.count);
  return cells;
}

/// Rows of the engine, and lanes of each.
struct Rows {
  double count = 1;
  double lanes = 1;
  bool joined = false;     ///< they run along several dimensions
  std::size_t across = 0;  ///< dimensions that they do not run along

  [[nodiscard]] double set_bytes() const { return count * 8 * std::ceil(lanes / 64); }
};

/// As join_rows() will choose, with gaps that are usual.
Rows rows_of(const Model& model) {
  constexpr double kGap = 4;
  const std::vector<TableShape>& shapes = model.arranged_shapes();
  const auto count = [&](std::size_t i) { return static_cast<double>(model.grid()[i].count); };
  const auto is_alone = [&](std::size_t i) {
    return are_alone_from(i, shapes) && shapes[i].shift && !shapes[i].sum && model.grid()[i].count > 1;
  };
  std::size_t i = shapes.size() - 1;
  Rows rows{.lanes = count(i)};
  while (shapes.size() - i < model.most_along() && i > 1 && is_alone(i) && is_alone(i - 1) &&
         (rows.lanes + kGap) * count(i - 1) <= static_cast<double>(kMostJoinedLanes)) {
    rows.lanes = (rows.lanes + kGap) * count(--i);
    rows.joined = true;
  }
  for (std::size_t t = 0; t < i; ++t) rows.count *= count(t);
  rows.across = i;
  return rows;
}

/// Bytes of one bit row a choice of the states and inputs that a condition uses.
double condition_bytes(const Program& condition, const Model& model) {
  const UniformGrid& grid = model.grid();
  double rows = 1;
  for (const std::uint32_t slot : condition.variables()) {
    if (slot < grid.size() && slot != grid.state(grid.size() - 1))
      rows *= static_cast<double>(grid[grid.dimension_of(slot)].count);
    if (slot >= grid.size() && slot < grid.size() + model.inputs().size())
      rows *= static_cast<double>(model.inputs()[slot - grid.size()].count());
  }
  return rows * 8 * std::ceil(static_cast<double>(grid.row_length()) / 64);
}

/// True if no state is moved by two classes, so that projections are kept as boxes of posts.
bool is_product(const PartitionSpec& partition, const ProblemSpec& spec,
                const std::vector<TableShape>& shapes) {
  std::vector<std::size_t> class_of_input(spec.inputs.size(), 0);
  for (std::size_t c = 0; c < partition.classes.size(); ++c) {
    for (const std::int32_t agent : partition.classes[c]) {
      for (const std::int32_t input : spec.agents[static_cast<std::size_t>(agent)].inputs)
        class_of_input[static_cast<std::size_t>(input)] = c;
    }
  }
  return std::all_of(shapes.begin(), shapes.end(), [&](const TableShape& shape) {
    return std::all_of(shape.inputs.begin(), shape.inputs.end(), [&](std::int32_t input) {
      return class_of_input[static_cast<std::size_t>(input)] ==
             class_of_input[static_cast<std::size_t>(shape.inputs.front())];
    });
  });
}

/// Joint actions of all classes together: one projected bit a cell each, at the most (actions that move every
/// cell of a row alike share theirs). None where all agents are together.
double projected_actions(const ProblemSpec& spec, const PartitionSpec& partition) {
  if (partition.classes.size() == 1) return 0;
  double sum = 0;
  for (const auto& agents : partition.classes) {
    double actions = 1;
    for (const std::int32_t agent : agents) {
      for (const std::int32_t input : spec.agents[static_cast<std::size_t>(agent)].inputs) {
        actions *= static_cast<double>(spec.inputs[static_cast<std::size_t>(input)].values.size());
      }
    }
    sum += actions;
  }
  return sum;
}

/// The projections of one partition. As products they are a few boxes a row, and most rows need none; in rows
/// along several dimensions most cells have a label.
double projection_bytes(const ProblemSpec& spec, const PartitionSpec& partition,
                        const std::vector<TableShape>& shapes, const Rows& rows) {
  const auto classes = static_cast<double>(partition.classes.size());
  const double boxes_of_row = rows.joined ? 1.45 * rows.lanes : 220 + 100 * std::max(0.0, classes - 2);
  const bool boxes = is_product(partition, spec, shapes) && !spec.abstraction.between_samples &&
                     !spec.controller.allow && !spec.controller.file &&
                     spec.controller.synthesis == Synthesis::maximal;
  const double masks = rows.set_bytes() * projected_actions(spec, partition);
  if (!boxes || classes < 2) return masks;
  // The parts that two classes with few actions can have are few, too.
  return classes > 2 ? rows.count * boxes_of_row : std::min(masks, rows.count * boxes_of_row);
}

/// At a time: those of one partition for its layers, then those of all partitions of a network.
double projection_bytes(const ProblemSpec& spec, const std::vector<TableShape>& shapes, const Rows& rows) {
  double most = 0;
  for (const PartitionSpec& partition : spec.coordination.partitions)
    most = std::max(most, projection_bytes(spec, partition, shapes, rows));
  if (!spec.network || spec.network->resynthesise) return most;
  double together = 0;
  for (const PartitionSpec* partition : network_partitions(*spec.network))
    together += projection_bytes(spec, *partition, shapes, rows);
  return std::max(most, together);
}

/// The sets of all modes, the levels of one target, and which rows of it have changed.
double network_bytes(const Model& model, double cells, double set_bytes) {
  const ProblemSpec& spec = model.spec();
  if (!spec.network) return 0;
  const double rows = cells / static_cast<double>(model.grid().row_length());
  const auto modes = static_cast<double>(spec.network->modes.size());
  const double sets = spec.network->resynthesise ? 2 : 1;  // what is left of the rows that lose cells
  return modes * (sets * set_bytes + rows / 8) + cells;
}

/// Bytes of the segments of one row, with the list that holds them.
constexpr double kSegmentsOfSum = 12 * 20 + 40;

/// Choices of the dimensions but the last and of the inputs that a table ranges over: it is cut into so many
/// rows.

double row_choices(const TableShape& shape, const Model& model) {
  double choices = 1;
  for (const std::int32_t j : shape.states) {
    const auto dimension = static_cast<std::size_t>(j);
    if (dimension < model.grid().across()) choices *= static_cast<double>(model.grid()[dimension].count);
  }
  for (const std::int32_t j : shape.inputs)
    choices *= static_cast<double>(model.inputs()[static_cast<std::size_t>(j)].count());
  return choices;
}

/// Pairs of a controller file: packed as in the file; then a row of cells for each joint input, at the most,
/// with its number.
double listed_bytes(const Model& model, double cells, double set_bytes) {
  const auto inputs = static_cast<double>(model.inputs().count());
  const double rows = cells / static_cast<double>(model.grid().row_length());
  return cells * std::ceil(inputs / 8) + inputs * (set_bytes + rows * sizeof(std::uint32_t));
}

/// Blocks of a unit that SumReader keeps eroded, for two threads: some dozen, in about nine sizes.
double block_bytes(const Model& model) {
  constexpr double kMostBytes = 16.0 * 1024 * 1024;
  double cells = 1;
  for (std::size_t i = 0; i < model.grid().size(); ++i) {
    if (model.arranged_shapes()[i].sum) cells *= static_cast<double>(model.grid()[i].count) + 6;
  }
  return 2 * std::min(kMostBytes, 40 * 9 * cells);
}

double estimate_memory(const Model& model) {
  const ProblemSpec& spec = model.spec();
  const bool keeps_sums = model.keeps_sums();
  const std::vector<TableShape>& shapes = model.arranged_shapes();
  const double cells = count_product(spec);
  const Rows rows = rows_of(model);
  const double set_bytes = rows.set_bytes();
  double bytes = kFixedBytes;
  for (const TableShape& shape : shapes) {
    const bool is_kept = keeps_sums && shape.sum;
    bytes += is_kept ? 2 * shape.bytes : shape.bytes + row_choices(shape, model) * sizeof(std::uint32_t);
    // Cut, a row of a sum falls into a dozen segments, and hardly two rows are alike.
    if (shape.sum && !is_kept) bytes += row_choices(shape, model) * kSegmentsOfSum;
    // The tubes, as large as the tables, which are no sums then; cut into rows twice where states saturate.
    if (spec.abstraction.between_samples) {
      bytes += shape.bytes + 2 * row_choices(shape, model) * sizeof(std::uint32_t);
    }
  }
  if (keeps_sums) bytes += block_bytes(model);
  bytes += condition_bytes(spec.safe, model);
  if (spec.controller.allow) bytes += condition_bytes(*spec.controller.allow, model);
  if (spec.controller.file) bytes += listed_bytes(model, cells, set_bytes);
  if (!spec.requirements.empty()) bytes += set_bytes;  // a region
  bytes += 3 * set_bytes;                              // S, K and a layer
  if (spec.abstraction.between_samples) bytes += set_bytes;
  // Levels for collision times and delays: 8 bits are enough up to 254 steps.
  bytes += rows.count * rows.lanes * (1 + static_cast<double>(spec.coordination.partitions.size()));
  if (spec.coordination.horizon) {
    const auto agents = static_cast<double>(spec.agents.size());
    bytes += cells * (spec.coordination.partitions.size() < 255 ? 1 : 4);  // the coalition map
    bytes += set_bytes * agents * (agents - 1) / 2;                        // critical pairs
  }
  bytes += projection_bytes(spec, shapes, rows);
  bytes += network_bytes(model, cells, set_bytes);
  if (spec.coordination.convention)
    bytes += static_cast<double>(spec.agents.size()) * (cells * sizeof(float) + rows.count * 8);
  bytes += rows.count * 80;  // bookkeeping of rows
  return bytes;
}

std::string in_words(double bytes) {
  const char* const units[] = {"B", "KiB", "MiB", "GiB", "TiB", "PiB"};
  std::size_t unit = 0;
  while (bytes >= 1024 && unit + 1 < std::size(units)) {
    bytes /= 1024;
    ++unit;
  }
  return fmt::format("{:.1f} {}", bytes, units[unit]);
}

template <class Variable>
std::vector<std::string> names(const std::vector<Variable>& variables,
                               const std::vector<std::int32_t>& indices) {
  std::vector<std::string> result;
  for (const std::int32_t j : indices) result.push_back(variables[static_cast<std::size_t>(j)].name);
  return result;
}

SpecReport::Rows row_report(const Model& model) {
  SpecReport::Rows report;
  const std::size_t across = rows_of(model).across;
  std::vector<std::size_t> along;
  for (std::size_t i = 0; i < model.order().size(); ++i) {
    const std::size_t state = model.order()[i];
    if (i >= across) along.push_back(state);
    (i < across ? report.across : report.along).push_back(model.spec().states[state].name);
  }
  report.sample = sample_rows(model.spec(), model.shapes(), along);
  return report;
}

std::uint64_t to_bytes(double bytes) {
  return bytes < 1.8e19 ? static_cast<std::uint64_t>(bytes) : UINT64_MAX;
}

}  // namespace

void check_memory(const ProblemSpec& spec, std::optional<std::uint64_t> limit) {
  const double bytes = estimate_memory(Model(spec, table_shapes(spec)));
  if (!limit || bytes <= static_cast<double>(*limit)) return;
  throw LimitError(fmt::format("{:.3g} cells need about {} of memory, the limit is {}", count_product(spec),
                               in_words(bytes), in_words(static_cast<double>(*limit))),
                   "--max-memory");
}

SpecReport inspect(const ProblemSpec& spec) {
  if (spec.controller.file) check_controller_file(spec);
  SpecReport report{.name = spec.name, .cells = 1, .joint_inputs = 1};
  const Model model(spec, table_shapes(spec));
  const std::vector<TableShape>& shapes = model.shapes();
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const StateSpec& state = spec.states[i];
    report.states.push_back(
        SpecReport::State{.name = state.name,
                          .unit = state.unit,
                          .points = state.grid.count,
                          .states = names(spec.states, shapes[i].states),
                          .inputs = names(spec.inputs, shapes[i].inputs),
                          .disturbances = names(spec.disturbances, shapes[i].disturbances),
                          .shift = shapes[i].shift,
                          .sum = shapes[i].sum,
                          .table_entries = to_bytes(shapes[i].entries),
                          .table_bytes = to_bytes(shapes[i].bytes)});
    report.cells *= state.grid.count;
  }
  for (const InputSpec& input : spec.inputs) {
    const auto points = static_cast<std::int64_t>(input.values.size());
    report.inputs.push_back({.name = input.name, .unit = input.unit, .points = points});
    report.joint_inputs *= points;
  }
  for (const PartitionSpec& partition : spec.coordination.partitions)
    report.partitions.push_back(partition.name);
  for (std::size_t mode = 0; spec.network && mode < spec.network->modes.size(); ++mode)
    report.modes.push_back(spec.network->modes[mode].name);
  report.rows = row_report(model);
  report.exact = check_dynamics(spec);
  report.guarantee = guarantee_of(spec);
  report.memory_bytes = to_bytes(estimate_memory(model));
  return report;
}

}  // namespace coordreq
