#include "app/compare_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "answers/requirements/answer.hpp"
#include "app/json_text.hpp"
#include "app/text.hpp"
#include "cell/state_query.hpp"
#include "numeric/rational.hpp"

namespace coordreq {
namespace {

using Align = Table::Align;

/// The two files that are compared, as their reports need them.
struct Files {
  const ResultsReader& before;
  const ResultsReader& after;
};

std::string sets_table(const ResultsComparison& comparison) {
  Table table({Align::left, Align::right, Align::right, Align::right, Align::right});
  table.add({"cells of the", "before", "after", "left", "joined"});
  for (const SetComparison& set : comparison.sets)
    table.add({set.words, grouped(set.before), grouped(set.after), grouped(set.left), grouped(set.joined)});
  return table.text();
}

/// "alone", or "alone (was: a|b)".
std::string partition_name(const PartitionComparison& partition, const Files& files) {
  const std::string& old = files.before.partitions()[partition.before].name;
  const std::string& now = files.after.partitions()[partition.after].name;
  return printable(now) + (old == now ? "" : " (was: " + printable(old) + ")");
}

std::string partitions_table(const ResultsComparison& comparison, const Files& files, bool tolerant) {
  std::vector<Align> columns(tolerant ? 6 : 5, Align::right);
  columns[0] = Align::left;
  Table table(columns);
  std::vector<std::string> heading = {"partition", "lost delay", "left the set", "now bounded",
                                      "gained delay"};
  if (tolerant) heading.emplace_back("tolerated");
  table.add(heading);
  for (const PartitionComparison& partition : comparison.partitions) {
    std::vector<std::string> row = {partition_name(partition, files), grouped(partition.lost),
                                    grouped(partition.left), grouped(partition.from_forever),
                                    grouped(partition.gained)};
    if (tolerant) row.push_back(grouped(partition.tolerated));
    table.add(std::move(row));
  }
  return table.text();
}

/// Whether a delay of the partition is only known to be at least this.
bool is_cut_off(std::int32_t delay, std::size_t partition, const ResultsReader& file) {
  return file.partitions()[partition].truncated() && file.spec().coordination.max_delay == delay;
}

std::string delay_text(std::int32_t delay, std::size_t partition, const ResultsReader& file) {
  if (delay == ResultsReader::kNever) return "unbounded";
  if (delay == -1) return "not in the invariance set";
  if (delay < 0) return "not safe";
  const ProblemSpec& spec = file.spec();
  const std::string steps = duration(delay, nearest_double(spec.dynamics.period), spec.dynamics.unit);
  return (is_cut_off(delay, partition, file) ? "at least " : "") + steps;
}

/// The cells that have lost most; empty if none has lost anything.
std::string worst_text(const PartitionComparison& partition, const Files& files) {
  if (partition.worst.empty()) return "";
  const std::vector<StateSpec>& states = files.before.spec().states;
  std::vector<Align> columns(states.size() + 3, Align::right);
  columns[states.size() + 1] = columns[states.size() + 2] = Align::left;
  Table table(columns);
  std::vector<std::string> heading = {"  cell"};
  for (const StateSpec& state : states) heading.push_back(column_heading(state.name, state.unit));
  heading.emplace_back("before");
  heading.emplace_back("after");
  table.add(heading);
  for (const DelayChange& change : partition.worst) {
    std::vector<std::string> row = {"  " + grouped(change.cell)};
    for (const Rational& value : box_of_cell(files.before.grid(), change.cell).centre)
      row.push_back(fmt::format("{:.6g}", nearest_double(value)));
    row.push_back(delay_text(change.before, partition.before, files.before));
    row.push_back(delay_text(change.after, partition.after, files.after));
    table.add(std::move(row));
  }
  const auto named = static_cast<std::int64_t>(partition.worst.size());
  const std::string which = named < partition.lost ? fmt::format("the worst {} of ", grouped(named)) : "";
  return fmt::format("\npartition {}: {}{} that lost delay\n{}", partition_name(partition, files), which,
                     cells(partition.lost), table.text());
}

/// Where analyses stopped at max_delay, what they found is less than the whole truth.
std::string cut_off_text(const PartitionComparison& partition) {
  if (partition.cut_off == 0) return "";
  return fmt::format(
      "  {} of these {} the delay at which max_delay stopped the later analysis: perhaps nothing is lost "
      "there.\n",
      cells(partition.cut_off), partition.cut_off == 1 ? "has" : "have");
}

std::string only_text(const ResultsComparison& comparison, const Files& files) {
  std::string text;
  const auto add = [&text](const char* kind, const std::string& name, const ResultsReader& file) {
    text += fmt::format("{} {}: only in {}\n", kind, printable(name), printable(file.path()));
  };
  for (const std::size_t p : comparison.only_before)
    add("partition", files.before.partitions()[p].name, files.before);
  for (const std::size_t p : comparison.only_after)
    add("partition", files.after.partitions()[p].name, files.after);
  for (const VerdictChange& verdict : comparison.verdicts) {
    text += fmt::format("requirement {}: {}\n", printable(verdict.name),
                        verdict.holds_after ? "failed, now holds" : "held, now FAILS");
  }
  for (const std::string& name : comparison.requirements_only_before) add("requirement", name, files.before);
  for (const std::string& name : comparison.requirements_only_after) add("requirement", name, files.after);
  return text.empty() ? "" : "\n" + text;
}

std::string verdict_text(const ResultsComparison& comparison, const CompareOptions& options) {
  if (!comparison.is_worse()) {
    return fmt::format("\nNot worse: no cell has lost {}.\n",
                       options.tolerance > 0 ? "more delay than is tolerated" : "delay");
  }
  const bool cells_lost =
      std::any_of(comparison.partitions.begin(), comparison.partitions.end(),
                  [](const PartitionComparison& partition) { return partition.lost > 0; });
  return cells_lost ? "\nWorse: cells have lost delay.\n" : "\nWorse: a requirement no longer holds.\n";
}

Json set_json(const SetComparison& set) {
  return {{"before", set.before}, {"after", set.after}, {"left", set.left}, {"joined", set.joined}};
}

Json change_json(const DelayChange& change, const Files& files) {
  Json json;
  json["cell"] = change.cell;
  json["state"] = Json::object();
  const CellBox box = box_of_cell(files.before.grid(), change.cell);
  for (std::size_t i = 0; i < box.centre.size(); ++i)
    json["state"][files.before.spec().states[i].name] = nearest_double(box.centre[i]);
  json["before"] = delay_json(change.before);
  json["before_status"] = delay_word(change.before);
  json["after"] = delay_json(change.after);
  json["after_status"] = delay_word(change.after);
  return json;
}

Json partition_json(const PartitionComparison& partition, const Files& files) {
  Json json;
  json["name"] = files.after.partitions()[partition.after].name;
  json["name_before"] = files.before.partitions()[partition.before].name;
  json["lost"] = partition.lost;
  json["left"] = partition.left;
  json["now_bounded"] = partition.from_forever;
  json["cut_off"] = partition.cut_off;
  json["tolerated"] = partition.tolerated;
  json["gained"] = partition.gained;
  json["worst"] = Json::array();
  for (const DelayChange& change : partition.worst) json["worst"].push_back(change_json(change, files));
  return json;
}

Json file_json(const ResultsReader& file, const std::vector<std::size_t>& partitions,
               const std::vector<std::string>& requirements) {
  Json json;
  json["file"] = file.path();
  json["name"] = file.spec().name;
  json["spec_sha256"] = file.attributes().spec_sha256;
  json["only_partitions"] = Json::array();
  for (const std::size_t p : partitions) json["only_partitions"].push_back(file.partitions()[p].name);
  json["only_requirements"] = requirements;
  return json;
}

}  // namespace

std::string comparison_text(const ResultsComparison& comparison, const ResultsReader& before,
                            const ResultsReader& after, const CompareOptions& options) {
  const Files files{before, after};
  std::string text = fmt::format("{} -> {}: {}\n\n{}\n{}", printable(before.path()), printable(after.path()),
                                 cells(before.grid().cells()), sets_table(comparison),
                                 partitions_table(comparison, files, options.tolerance > 0));
  for (const PartitionComparison& partition : comparison.partitions)
    text += worst_text(partition, files) + cut_off_text(partition);
  text += only_text(comparison, files);
  return text + verdict_text(comparison, options);
}

std::string comparison_json(const ResultsComparison& comparison, const ResultsReader& before,
                            const ResultsReader& after, const CompareOptions& options) {
  const Files files{before, after};
  Json json;
  json["before"] = file_json(before, comparison.only_before, comparison.requirements_only_before);
  json["after"] = file_json(after, comparison.only_after, comparison.requirements_only_after);
  json["cells"] = before.grid().cells();
  json["tolerance"] = options.tolerance;
  for (const SetComparison& set : comparison.sets) json[set.name] = set_json(set);
  json["partitions"] = Json::array();
  for (const PartitionComparison& partition : comparison.partitions)
    json["partitions"].push_back(partition_json(partition, files));
  json["verdicts"] = Json::array();
  for (const VerdictChange& verdict : comparison.verdicts)
    json["verdicts"].push_back(
        Json{{"name", verdict.name}, {"before", !verdict.holds_after}, {"after", verdict.holds_after}});
  json["worse"] = comparison.is_worse();
  return json_text(json);
}

}  // namespace coordreq
