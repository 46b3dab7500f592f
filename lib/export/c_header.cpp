#include "export/formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "answers/blind/answer.hpp"
#include "answers/field_parts.hpp"
#include "answers/paths.hpp"
#include "base/error.hpp"
#include "base/requires.hpp"
#include "cell/cell_controller.hpp"
#include "export/c_header_tables.hpp"
#include "export/c_header_text.hpp"
#include "reach/tables.hpp"
#include "spec/problem_spec.hpp"
#include "spec/sight.hpp"

namespace coordreq {
namespace {

constexpr std::size_t kLineWidth = 100;

std::string identifier(std::string name) {
  const auto is_plain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  std::replace_if(
      name.begin(), name.end(), [&](char c) { return !is_plain(c); }, '_');
  return name;
}

/// A text of the file, without characters that could end a comment.
std::string plain_text(std::string text) {
  std::erase_if(text, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-'; });
  return text;
}

std::string upper_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// The text with every $P as the prefix of functions and every $M as that of macros.
std::string with_prefix(std::string text, const std::string& prefix) {
  for (const auto& [mark, value] :
       {std::pair<std::string, std::string>{"$P", prefix}, {"$M", upper_case(prefix)}}) {
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at)) {
      text.replace(at, mark.size(), value);
      at += value.size();
    }
  }
  return text;
}

class HeaderWriter {
 public:
  HeaderWriter(const ResultsReader& results, std::size_t partition, ThreadTeam& team, const TextSink& sink)
      : results_(results),
        team_(team),
        partition_(results.partitions()[partition]),
        spec_(results.spec().coordination.partitions[partition]),
        runs_(find_action_runs(results, partition, team)),
        sink_(sink),
        prefix_("coordreq_" + identifier(results.spec().name)) {}

  void write() {
    put(c_header::kOpening, fmt::arg("name", results_.spec().name), fmt::arg("partition", partition_.name),
        fmt::arg("classes", class_list()), fmt::arg("states", state_list()),
        fmt::arg("sha", results_.attributes().spec_sha256),
        fmt::arg("guarantee", plain_text(results_.attributes().guarantee)));
    const bool has_tables = has_limited_sight(results_.spec(), spec_);
    put(c_header::kNumbers, fmt::arg("dimensions", results_.grid().size()),
        fmt::arg("cells", results_.grid().cells()), fmt::arg("class_count", partition_.classes.size()));
    write_inputs();
    write_dimensions();
    put(c_header::kCells);
    if (results_.spec().dynamics.is_kept(results_.grid().size() - 1)) write_memory();
    if (has_tables) put(c_header::kSilentOnly);
    write_runs();
    write_sets();
    put(c_header::kFunctions);
    if (results_.spec().ends_at_goal()) put(c_header::kTerminal);
    for (std::size_t k = 1; k < runs_.policies.size(); ++k) write_functions(runs_.policies[k]);
    if (has_tables) write_silent();
    sink_(c_header::kClosing);
  }

 private:
  template <class... Arguments>
  void put(const char* text, const Arguments&... arguments) const {
    sink_(with_prefix(fmt::format(fmt::runtime(text), arguments...), prefix_));
  }

  [[nodiscard]] std::string class_list() const {
    std::string list;
    for (std::size_t c = 0; c < partition_.classes.size(); ++c) {
      std::vector<std::string> names;
      for (const std::int32_t i : inputs_of(results_.spec(), spec_.classes[c])) {
        names.push_back(results_.spec().inputs[static_cast<std::size_t>(i)].name);
      }
      list += fmt::format("     class {}: {}, inputs {}, {} joint actions\n", c, partition_.classes[c],
                          fmt::join(names, ", "), partition_.actions[c]);
    }
    return list;
  }

  [[nodiscard]] std::string state_list() const {
    std::vector<std::string> names;
    for (const GridDimension& dimension : results_.grid().dimensions()) names.push_back(dimension.name);
    return fmt::format("{}", fmt::join(names, ", "));
  }

  /// static const TYPE $P_NAME[n] = {...}, wrapped.
  template <class Range, class Show>
  void array(const char* type, const std::string& name, const Range& values, const Show& show) const {
    put("static const {} $P_{}[{}] = {{\n", type, name, std::max<std::size_t>(values.size(), 1));
    std::string line = " ";
    for (const auto& value : values) {
      const std::string text = std::string(" ") + show(value) + ",";
      if (line.size() + text.size() > kLineWidth) {
        sink_(line + "\n");
        line = " ";
      }
      line += text;
    }
    sink_(line + (values.empty() ? " 0" : "") + "\n};\n");
  }

  template <class Integers>
  void integers(const char* type, const std::string& name, const Integers& values) const {
    array(type, name, values, [](auto value) { return fmt::format("{}", value); });
  }

  static const char* unsigned_type(std::size_t largest) {
    if (largest <= std::numeric_limits<std::uint8_t>::max()) return "uint8_t";
    return largest <= std::numeric_limits<std::uint16_t>::max() ? "uint16_t" : "uint32_t";
  }

  void write_runs() const {
    sink_("\n/* Run r: the cells from start[r] on have entry[r]. */\n");
    put("#define $M_RUNS {}\n", runs_.start.size());
    integers(unsigned_type(runs_.start.back()), "start", runs_.start);
    integers(unsigned_type(runs_.entries.size()), "entry", runs_.entry_of);
    sink_("/* By entry; sets: one a class. */\n");
    for (std::size_t k = 0; k < runs_.policies.size(); ++k) write_entries(k);
    if (!results_.spec().ends_at_goal()) return;
    sink_("/* Whether the task is over. */\n");
    array("uint8_t", "entry_over", runs_.entries,
          [](const ActionRuns::Entry& entry) { return entry.is_terminal ? "1" : "0"; });
  }

  void write_entries(std::size_t k) const {
    std::vector<std::int32_t> countdowns;
    std::vector<std::uint32_t> sets;
    for (const ActionRuns::Entry& entry : runs_.entries) {
      countdowns.push_back(entry.countdowns[k]);
      sets.insert(sets.end(), entry.sets[k].begin(), entry.sets[k].end());
    }
    const AnswerPolicy& policy = runs_.policies[k];
    if (k > 0) sink_("/* The same " + policy.header.where + ". */\n");
    // INT32_MAX is an int wherever int32_t is one, and -2147483648 does not occur.
    const std::string prefix = k == 0 ? "entry_" : "entry_" + policy.name + "_";
    integers("int32_t", prefix + "countdown", countdowns);
    integers("uint32_t", prefix + "set", sets);
  }

  /// The meanings of numbers of countdowns that the countdown of the first policy does not have.
  [[nodiscard]] std::string more_codes(const AnswerPolicy& policy) const {
    const std::vector<FieldFlag> known = flags_of(results_.field(runs_.policies.front().trigger));
    std::string text;
    for (const FieldFlag& flag : flags_of(results_.field(policy.countdown()))) {
      const bool is_known = std::any_of(known.begin(), known.end(), [&flag](const FieldFlag& candidate) {
        return candidate.value == flag.value;
      });
      if (!is_known) text += fmt::format("#define $M_{} ({})\n", upper_case(flag.meaning), flag.value);
    }
    return text;
  }

  void write_functions(const AnswerPolicy& policy) const {
    put(c_header::kPolicy, fmt::arg("policy", policy.name), fmt::arg("purpose", policy.header.purpose),
        fmt::arg("codes", more_codes(policy)), fmt::arg("countdown", policy.header.countdown),
        fmt::arg("allowed", policy.header.allowed));
  }

  void write_sets() const {
    sink_(
        "\n/* Sets of joint actions: action a is bit a % 8 of byte a / 8; the sets of a class one after the\n"
        "   other, classes from set_first on. */\n");
    std::vector<std::uint8_t> bytes;
    std::vector<std::size_t> first, width;
    for (std::size_t c = 0; c < runs_.sets.size(); ++c) {
      first.push_back(bytes.size());
      width.push_back(static_cast<std::size_t>((partition_.actions[c] + 7) / 8));
      for (const std::vector<bool>& set : runs_.sets[c]) {
        const std::size_t begin = bytes.size();
        bytes.resize(begin + width.back());
        for (std::size_t a = 0; a < set.size(); ++a) {
          if (set[a]) bytes[begin + a / 8] = static_cast<std::uint8_t>(bytes[begin + a / 8] | 1U << a % 8);
        }
      }
    }
    integers("uint32_t", "set_first", first);
    integers("uint32_t", "set_width", width);
    integers("uint8_t", "set_bits", bytes);
  }

  void write_inputs() const {
    sink_("\n/* Inputs of the classes, and their values; joint actions. */\n");
    std::vector<std::size_t> class_first{0}, value_first, value_count;
    std::vector<double> values;
    for (const auto& agents : spec_.classes) {
      for (const std::int32_t i : inputs_of(results_.spec(), agents)) {
        value_first.push_back(values.size());
        for (const Rational& value : results_.spec().inputs[static_cast<std::size_t>(i)].values) {
          values.push_back(nearest_double(value));
        }
        value_count.push_back(values.size() - value_first.back());
      }
      class_first.push_back(value_first.size());
    }
    integers("uint32_t", "set_actions", partition_.actions);
    integers("uint32_t", "class_first", class_first);
    integers("uint32_t", "value_first", value_first);
    integers("uint32_t", "value_count", value_count);
    array("double", "value", values, [](double value) { return fmt::format("{:a}", value); });
  }

  void write_dimensions() const {
    sink_(
        "\n/* Dimension i: bound[bound_first[i] + k] <= x < the next one in cell k; x == it if discrete. "
        "*/\n");
    std::vector<std::size_t> first, count;
    std::vector<std::int64_t> points;
    std::vector<int> discrete, wraps, safe_below, safe_above;
    std::vector<double> bounds;
    for (const GridDimension& dimension : results_.grid().dimensions()) {
      const DimensionBounds one = dimension_bounds(dimension);
      first.push_back(bounds.size());
      count.push_back(one.bounds.size());
      points.push_back(dimension.count);
      discrete.push_back(one.discrete ? 1 : 0);
      wraps.push_back(one.wraps ? 1 : 0);
      safe_below.push_back(traits(dimension.below).arrives ? 1 : 0);
      safe_above.push_back(traits(dimension.above).arrives ? 1 : 0);
      bounds.insert(bounds.end(), one.bounds.begin(), one.bounds.end());
    }
    integers("uint32_t", "points", points);
    integers("uint32_t", "bound_first", first);
    integers("uint32_t", "bound_count", count);
    integers("uint8_t", "discrete", discrete);
    integers("uint8_t", "wraps", wraps);
    integers("uint8_t", "safe_below", safe_below);
    integers("uint8_t", "safe_above", safe_above);
    array("double", "bound", bounds, [](double value) { return fmt::format("{:a}", value); });
  }

  /// The silent tables. Row k - 1 of class c, for fibre f: bits[first[c] + (min(k, rows[c]) - 1) * ...].
  void write_silent() const {
    const ProblemSpec& spec = results_.spec();
    std::vector<std::uint8_t> bits;
    std::vector<std::size_t> first, rows, strides;
    for (std::size_t c = 0; c < spec_.classes.size(); ++c) {
      first.push_back(bits.size());
      std::vector<std::size_t> stride(spec.states.size(), 0);
      rows.push_back(0);
      if (has_silent_table(spec, spec_, c)) {
        std::size_t size = static_cast<std::size_t>((partition_.actions[c] + 7) / 8);
        const std::vector<std::size_t> seen = seen_states(spec, spec_.classes[c]);
        for (std::size_t k = seen.size(); k-- > 0;) {
          stride[seen[k]] = size;
          size *= static_cast<std::size_t>(results_.grid()[seen[k]].count);
        }
        const auto table = results_.bytes(results_.field(paths::silent(spec, spec_, c)));
        rows.back() = different_rows(table, size);
        bits.insert(bits.end(), table.begin(),
                    table.begin() + static_cast<std::ptrdiff_t>(rows.back() * size));
        stride.push_back(size);
      } else {
        stride.push_back(0);
      }
      strides.insert(strides.end(), stride.begin(), stride.end());
    }
    sink_(
        "\n#endif\n"
        "\n/* Silent tables, of classes that do not see all states: the byte of action a with k steps left "
        "is\n"
        "   bits[first[c] + (k - 1) * stride[c][states] + sum of index[i] * stride[c][i] + a / 8]; the last\n"
        "   row serves all greater k. */\n");
    integers("uint32_t", "silent_first", first);
    integers("uint32_t", "silent_rows", rows);
    integers("uint32_t", "silent_stride", strides);
    integers("uint8_t", "silent_bits", bits);
    put(c_header::kSilent);
  }

  /// Rows but those at the end that are like the one before.
  static std::size_t different_rows(const std::vector<std::uint8_t>& table, std::size_t size) {
    std::size_t rows = table.size() / size;
    const auto row = [&](std::size_t k) { return table.begin() + static_cast<std::ptrdiff_t>(k * size); };
    while (rows > 1 && std::equal(row(rows - 1), row(rows), row(rows - 2))) --rows;
    return rows;
  }

  /// A table for each state that a memory keeps, by the states that its next value depends on.
  void write_memory() const {
    const ProblemSpec& spec = results_.spec();
    Abstraction tables{.grid = results_.grid(), .inputs = results_.inputs()};
    tables.tables.resize(spec.states.size());
    std::vector<std::int64_t> strides;
    std::vector<std::size_t> first;
    std::vector<std::int32_t> next;
    for (std::size_t i = 0; i < spec.states.size(); ++i) {
      if (!spec.dynamics.is_kept(i)) continue;
      build_update_table(spec, tables, i, team_);
      const TransitionTable& table = tables.tables[i];
      strides.insert(strides.end(), table.state_stride.begin(), table.state_stride.end());
      first.push_back(next.size());
      for (const IndexRange& entry : table.entries) next.push_back(entry.first);
    }
    sink_("\n/* Kept state k: next[first[k] + sum of index[i] * stride[k * states + i]]. */\n");
    put("#define $M_KEPT {}\n", first.size());
    integers("uint32_t", "next_first", first);
    integers("uint32_t", "next_stride", strides);
    const auto most = std::max_element(next.begin(), next.end());
    integers(unsigned_type(static_cast<std::size_t>(*most)), "next", next);
    put(c_header::kMemory);
  }

  const ResultsReader& results_;
  ThreadTeam& team_;
  const StoredPartition& partition_;
  const PartitionSpec& spec_;
  ActionRuns runs_;
  const TextSink& sink_;
  std::string prefix_;
};

}  // namespace

MemoryDemand c_header_demand(const ResultsReader& results) {
  constexpr double kUsualRuns = 0.5;  // a cell
  MemoryDemand demand = controller_demand(results, true);
  demand.once += 2 * kUsualRuns * sizeof(std::uint32_t) * static_cast<double>(results.grid().cells());
  return demand;
}

void export_c_header(const ResultsReader& results, std::size_t partition, ThreadTeam& team,
                     const TextSink& sink) {
  REQUIRES(partition < results.partitions().size());
  if (results.grid().cells() > std::numeric_limits<std::int32_t>::max()) {
    throw LimitError(fmt::format("{} cells, a C header can have at most {}", results.grid().cells(),
                                 std::numeric_limits<std::int32_t>::max()),
                     results.path());
  }
  HeaderWriter(results, partition, team, sink).write();
}

}  // namespace coordreq
