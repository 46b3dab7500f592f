#include "answers/checking/all_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "answers/checking/cell_location.hpp"
#include "answers/checking/steps_check.hpp"
#include "base/index.hpp"
#include "model/input_class.hpp"
#include "spec/partition_names.hpp"
#include "spec/problem_spec.hpp"
#include "spec/sight.hpp"

namespace coordreq {
namespace {

/// A class of a partition: the states that it sees, its table in the file, and its actions at each cell.
struct BlindClass {
  BlindClass(const CheckContext& context, const PartitionSpec& partition, std::size_t c)
      : name(class_name(context.spec->agents, partition.classes[c])),
        inputs(class_of(*context.spec, *context.inputs, partition.classes[c])),
        seen(seen_states(*context.spec, partition.classes[c])),
        grid(*context.grid) {
    inputs.tabulate();
    for (const std::size_t i : seen) fibres *= grid[i].count;
    if (seen.size() < grid.size())
      table = &context.claims->at("/silent/" + partition.name + "/" + name).integers;
    admitted.assign(at(grid.cells() * inputs.bytes()), 0);
  }

  [[nodiscard]] std::int64_t fibre(std::int64_t cell) const {
    std::int64_t number = 0;
    for (const std::size_t i : seen) number = number * grid[i].count + grid.index(cell, i);
    return number;
  }
  [[nodiscard]] bool has(std::int64_t cell, std::int64_t a) const {
    return (admitted[at(cell * inputs.bytes() + a / 8)] >> (a % 8) & 1U) != 0;
  }
  /// Where the row of k steps and a fibre begins in the bytes of the table.
  [[nodiscard]] std::size_t position(std::int64_t k, std::int64_t fibre) const {
    return at(((k - 1) * fibres + fibre) * inputs.bytes());
  }
  [[nodiscard]] std::int64_t rows() const { return std::ssize(*table) / (fibres * inputs.bytes()); }
  /// "first: p1 = 1, v1 = 0, 3 steps left".
  [[nodiscard]] std::string label(std::int64_t k, std::int64_t fibre) const {
    std::string text;
    for (std::size_t n = seen.size(); n-- > 0;) {
      const GridDimension& dimension = grid[seen[n]];
      const double value = nearest_double(dimension.point(fibre % dimension.count));
      text = fmt::format("{} = {}, {}", dimension.name, value, text);
      fibre /= dimension.count;
    }
    return fmt::format("{}: {}{} steps left", name, text, k);
  }

  std::string name;
  InputClass inputs;
  std::vector<std::size_t> seen;
  const UniformGrid& grid;
  std::int64_t fibres = 1;
  const std::vector<std::int64_t>* table = nullptr;  ///< of the file; null: the class sees all states
  std::vector<std::uint8_t> admitted;                ///< [cell * bytes] A_c, of the cells checked
};

/// Data of one partition that all threads share.
struct BlindPartitionCheck {
  static constexpr const CountdownKind& kKind = kBlindKind;

  BlindPartitionCheck(const CheckContext& context, std::size_t p)
      : claims(*context.spec, *context.claims, p, kKind),
        delays(context.claims->values("/blind_delay", p)),
        of_sight(context.claims->values("/delay", p)),
        delay("blind delay " + claims.partition.name),
        countdown("blind countdown " + claims.partition.name),
        first("first blind layer " + claims.partition.name),
        tables("silent tables " + claims.partition.name) {
    longest = claims.most;
    if (claims.fixed_point_index == context.spec->coordination.max_delay)
      longest = static_cast<std::int32_t>(claims.fixed_point_index);
    if (claims.partition.classes.size() == 1) return;
    for (std::size_t c = 0; c < claims.partition.classes.size(); ++c)
      classes.emplace_back(context, claims.partition, c);
  }

  [[nodiscard]] std::vector<Finding> findings() const {
    if (classes.empty()) return {delay.finding(), countdown.finding()};
    return {delay.finding(), countdown.finding(), first.finding(), tables.finding()};
  }
  /// The greatest k with x in B_k, as claimed; kUnbounded if there is no greatest.
  [[nodiscard]] std::int32_t depth(std::int64_t cell) const {
    const std::int32_t steps = claims.delay[at(cell)];
    return steps > 0 && steps == claims.most ? kUnbounded : steps;
  }

  PartitionClaims claims;  ///< with countdowns for delays
  const std::vector<std::int32_t>& delays;
  const std::vector<std::int32_t>& of_sight;
  std::optional<std::int32_t> longest;  ///< max_delay, if the iteration ended with it: no delay is longer
  Tally delay, countdown, first, tables;
  std::deque<BlindClass> classes;  ///< empty if the partition has one class
  std::atomic<std::int64_t> looked_at{0};
};

class BlindChecker : public CellChecker {
 public:
  BlindChecker(const CheckContext& context, std::deque<BlindPartitionCheck>& partitions)
      : context_(context), partitions_(partitions) {
    for (const BlindPartitionCheck& one : partitions)
      choices_.emplace_back(context, one.claims.partition.classes);
  }

  void check(CheckedCell& cell) override {
    for (std::size_t p = 0; p < partitions_.size(); ++p) {
      BlindPartitionCheck& partition = partitions_[p];
      choices_[p].go_to(cell.number(), cell.admitted());
      keep_actions(cell, choices_[p], partition);
      std::int32_t expected = steps_outside(cell);
      if (cell.is_invariant()) {
        expected = partition.classes.empty()
                       ? partition.of_sight[cell.at()]
                       : steps_by_definition(cell, choices_[p], partition.claims.delay, partition.longest);
      }
      compare_steps(context_, partition.delay, cell, partition.delays[cell.at()], expected);
      // In B_1 blind delay and countdown agree; which cells are in B_1 is checked later.
      const std::int32_t claimed = partition.claims.delay[cell.at()];
      const bool is_out = claimed == 0 && expected >= 0 && !partition.classes.empty() && !cell.is_terminal();
      compare_steps(context_, partition.countdown, cell, claimed, is_out ? 0 : expected);
      if (cell.is_invariant() && !cell.is_terminal()) check_rows(cell, partition);
    }
  }

 private:
  static void keep_actions(const CheckedCell& cell, const ClassChoices& choices,
                           BlindPartitionCheck& partition) {
    ++partition.looked_at;
    for (std::size_t c = 0; c < partition.classes.size(); ++c) {
      BlindClass& one = partition.classes[c];
      const std::vector<std::uint8_t>& actions = choices.actions()[c];
      for (std::size_t a = 0; a < actions.size(); ++a) {
        std::uint8_t& byte = one.admitted[cell.at() * at(one.inputs.bytes()) + a / 8];
        byte = static_cast<std::uint8_t>(byte | actions[a] << (a % 8));
      }
    }
  }

  /// No row may hold an action that is not admissible in a cell in which the system may be.
  void check_rows(const CheckedCell& cell, BlindPartitionCheck& partition) const {
    const std::int32_t depth = partition.depth(cell.number());
    for (const BlindClass& one : partition.classes) {
      if (one.table == nullptr || depth < 1) continue;
      const std::int64_t fibre = one.fibre(cell.number());
      for (std::int64_t k = 1; k <= std::min<std::int64_t>(depth, one.rows()); ++k) {
        partition.tables.add_checked(1);
        if (!has_more(one, one.position(k, fibre), cell.number())) continue;
        if (context_.sound_only()) {
          partition.tables.add_unproven();
          continue;
        }
        partition.tables.add_wrong(cell.number(), [&] {
          return fmt::format("{}: an action that is not admissible at {}", one.label(k, fibre),
                             cell.location());
        });
      }
    }
  }

  static bool has_more(const BlindClass& one, std::size_t position, std::int64_t cell) {
    for (std::int64_t b = 0; b < one.inputs.bytes(); ++b) {
      const auto row = static_cast<unsigned>((*one.table)[position + at(b)]);
      if ((row & ~unsigned{one.admitted[at(cell * one.inputs.bytes() + b)]}) != 0) return true;
    }
    return false;
  }

  const CheckContext& context_;
  std::deque<BlindPartitionCheck>& partitions_;
  std::deque<ClassChoices> choices_;  ///< [partition]
};

class BlindCheck : public StepsCheck<BlindPartitionCheck> {
 public:
  using StepsCheck::StepsCheck;

  std::unique_ptr<CellChecker> cell_checker() override {
    return std::make_unique<BlindChecker>(context_, partitions_);
  }
  void check_all(ThreadTeam& /*team*/) override {
    for (BlindPartitionCheck& partition : partitions_) {
      if (partition.classes.empty() || partition.looked_at < context_.grid->cells()) continue;
      if (partition.claims.most != 0) check_first(partition);
      for (const BlindClass& one : partition.classes) {
        if (one.table != nullptr) check_table(partition, one);
      }
    }
  }

 private:
  void note(Tally& tally, std::int64_t number, const std::string& text) const {
    if (context_.sound_only()) return tally.add_unproven();
    tally.add_wrong(number, [&] { return text; });
  }

  /// Whether the file claims that the cell is in a goal that ends the task. It is in every B_k, and removes
  /// no action from its fibres.
  [[nodiscard]] bool is_terminal(std::int64_t cell) const {
    return context_.spec->ends_at_goal() && context_.claims->values("/arrival")[at(cell)] == 0;
  }

  /// B_1 by its definition, from Z_1 as claimed.
  void check_first(BlindPartitionCheck& partition) const {
    const std::int64_t cells = context_.grid->cells();
    std::vector<std::uint8_t> left(at(cells), 0);
    for (std::int64_t x = 0; x < cells; ++x)
      left[at(x)] = partition.of_sight[at(x)] >= 1 && !is_terminal(x) ? 1 : 0;
    for (const BlindClass& one : partition.classes) leave_common(one, left);
    partition.first.add_checked(cells);
    for (std::int64_t x = 0; x < cells; ++x) {
      if (is_terminal(x) || (left[at(x)] != 0) == (partition.claims.delay[at(x)] >= 1)) continue;
      const char* const expected = left[at(x)] != 0 ? "" : "not ";
      note(partition.first, x,
           fmt::format("{}: expected {}in B_1", location_of(*context_.grid, x), expected));
    }
  }

  static void leave_common(const BlindClass& one, std::vector<std::uint8_t>& left) {
    const std::int64_t actions = one.inputs.actions();
    std::vector<std::int64_t> counts(at(one.fibres * actions), 0);
    for (std::int64_t x = 0; x < std::ssize(left); ++x) {
      for (std::int64_t a = 0; left[at(x)] != 0 && a < actions; ++a)
        counts[at(one.fibre(x) * actions + a)] += one.has(x, a) ? 1 : 0;
    }
    for (std::int64_t x = 0; x < std::ssize(left); ++x) {
      if (left[at(x)] == 0) continue;
      const auto first = counts.begin() + static_cast<std::ptrdiff_t>(one.fibre(x) * actions);
      const auto most = std::max_element(first, first + static_cast<std::ptrdiff_t>(actions)) - first;
      if (!one.has(x, most)) left[at(x)] = 0;
    }
  }

  /// The common actions of the cells of one depth in each fibre; and whether there are such cells.
  struct CommonActions {
    std::vector<std::uint8_t> bytes;        ///< as in the table
    std::vector<std::uint8_t> is_occupied;  ///< [(k - 1) * fibres + fibre]
  };

  /// Each row must be the common actions of all cells of B_k in the fibre: those of this depth, and all
  /// deeper ones.
  void check_table(BlindPartitionCheck& partition, const BlindClass& one) const {
    const std::int64_t rows = one.rows(), bytes = one.inputs.bytes();
    CommonActions common{std::vector<std::uint8_t>(one.table->size(), 0xFF),
                         std::vector<std::uint8_t>(at(rows * one.fibres), 0)};
    for (std::int64_t x = 0; x < context_.grid->cells(); ++x) {
      const std::int64_t k = std::min<std::int64_t>(partition.depth(x), rows);
      if (k < 1 || is_terminal(x)) continue;
      const std::int64_t fibre = one.fibre(x);
      common.is_occupied[at((k - 1) * one.fibres + fibre)] = 1;
      for (std::int64_t b = 0; b < bytes; ++b)
        common.bytes[one.position(k, fibre) + at(b)] &= one.admitted[at(x * bytes + b)];
    }
    for (std::int64_t k = rows; k >= 1; --k) {
      for (std::int64_t fibre = 0; fibre < one.fibres; ++fibre) {
        partition.tables.add_checked(1);
        if (is_row(one, k, fibre, common)) continue;
        note(partition.tables, context_.grid->cells() + k * one.fibres + fibre,
             one.label(k, fibre) + ": other actions than all of its cells have");
      }
    }
  }

  /// Whether a row of the table is right, given the row of one step more, whose common actions are added.
  static bool is_row(const BlindClass& one, std::int64_t k, std::int64_t fibre, CommonActions& common) {
    const std::size_t position = one.position(k, fibre), step = at(one.fibres * one.inputs.bytes());
    std::uint8_t& is_occupied = common.is_occupied[at((k - 1) * one.fibres + fibre)];
    const bool has_deeper = k < one.rows() && common.is_occupied[at(k * one.fibres + fibre)] != 0;
    if (has_deeper) is_occupied = 1;
    bool is_same = true;
    for (std::size_t b = position; b < position + at(one.inputs.bytes()); ++b) {
      if (has_deeper) common.bytes[b] &= common.bytes[b + step];
      is_same = is_same && (*one.table)[b] == (is_occupied != 0 ? common.bytes[b] : 0);
    }
    return is_same;
  }
};

}  // namespace

/// Checks blind delays and countdowns by the countdowns of the cells that can follow, B_1 by its definition,
/// and each row of a silent table as an intersection (contract, section 8). If only a sample of cells is
/// checked, rows are looked at for actions too many alone, and B_1 is not checked. Null if all agents see
/// everything.
std::unique_ptr<AnswerCheck> check_blind(const CheckContext& context) {
  if (!has_limited_sight(*context.spec)) return nullptr;
  return std::make_unique<BlindCheck>(context);
}

/// Bytes a cell: the actions of each class there.
double blind_check_memory(const ProblemSpec& spec) {
  if (!has_limited_sight(spec)) return 0;
  double bytes = 1;
  for (const PartitionSpec& partition : spec.coordination.partitions) {
    for (const auto& agents : partition.classes) {
      double actions = 1;
      for (const std::int32_t agent : agents) {
        for (const std::int32_t input : spec.agents[at(agent)].inputs)
          actions *= static_cast<double>(spec.inputs[at(input)].values.size());
      }
      bytes += actions / 8 + 1;
    }
  }
  return bytes;
}

}  // namespace coordreq
