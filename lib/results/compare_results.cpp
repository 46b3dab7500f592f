#include "results/compare_results.hpp"

#include <algorithm>
#include <optional>

#include "answers/requirements/result_requirement.hpp"
#include "answers/step_codes.hpp"
#include "base/error.hpp"
#include "base/requires.hpp"

namespace coordreq {
namespace {

/// 2: the cell has left K, 1: it was unbounded and is no longer, 0: it has fewer steps.
int gravity(const ValueChange& change) {
  if (change.after < 0) return 2;
  return change.before == kUnbounded ? 1 : 0;
}

/// A code of what is no number of steps counts as it does in the file: kUnbounded is the largest number.
bool has_lost(const ValueChange& change) {
  return change.before >= 0 && change.after < change.before;
}
bool has_gained(const ValueChange& change) {
  return change.after >= 0 && change.after > change.before;
}

/// Between the two values. @pre has_lost(change)
std::int64_t difference(const ValueChange& change) {
  REQUIRES(has_lost(change));
  return std::int64_t{change.before} - change.after;
}

/// Whether `a` is to be named before `b`.
bool is_worse(const ValueChange& a, const ValueChange& b) {
  if (gravity(a) != gravity(b)) return gravity(a) > gravity(b);
  if (difference(a) != difference(b)) return difference(a) > difference(b);
  return a.cell < b.cell;
}

/// Calls `visit(first cell, values before, values after)` for one segment of the cells after the other.
template <class Read, class Visit>
void for_each_segment(const ResultsReader& before, const ResultsReader& after, const Read& read,
                      const Visit& visit) {
  const std::int64_t cells = before.grid().cells();
  for (std::int64_t begin = 0; begin < cells; begin += kBlockCells) {
    const std::int64_t end = std::min(begin + kBlockCells, cells);
    visit(begin, read(before, begin, end, true), read(after, begin, end, false));
  }
}

SetComparison compare_sets(const ResultsReader& before, const ResultsReader& after, const Field& field) {
  SetComparison result{.name = field.path.substr(1), .label = field.display.compared};
  const auto read = [&field](const ResultsReader& file, std::int64_t begin, std::int64_t end, bool) {
    return file.read_run(begin, end,
                         [&](const CellBlock& block) { return file.members(field, std::nullopt, block); });
  };
  for_each_segment(before, after, read, [&result](std::int64_t, const auto& old, const auto& now) {
    for (std::size_t i = 0; i < old.size(); ++i) {
      result.before += old[i];
      result.after += now[i];
      result.left += old[i] > now[i] ? 1 : 0;
      result.joined += old[i] < now[i] ? 1 : 0;
    }
  });
  return result;
}

/// A value of which less is better as one of which more is, and back again; no number of steps is infinite.
std::int32_t turned(std::int32_t value) {
  constexpr std::int32_t kMost = kUnbounded - 1;
  if (value < 0) return value;
  return value == kUnbounded ? 0 : kMost - value;
}
std::int32_t turned_back(std::int32_t value) {
  return value == 0 ? kUnbounded : turned(value);
}

/// Adds up the cells, and keeps the worst of them.
class ValueCounter {
 public:
  /// @param last delay of the later file that only says "at least"; none if it was not cut off
  ValueCounter(ValueComparison& result, const CompareOptions& options, std::optional<std::int64_t> last)
      : result_(result), options_(options), last_(last) {}

  void add(const ValueChange& change) {
    if (has_gained(change)) ++result_.gained;
    if (!has_lost(change)) return;
    if (gravity(change) == 0 && difference(change) <= options_.tolerance) {
      ++result_.tolerated;
      return;
    }
    ++result_.lost;
    if (gravity(change) == 2) ++result_.left;
    if (gravity(change) == 1) ++result_.from_forever;
    if (last_ == change.after) ++result_.cut_off;
    keep(change);
  }

  /// Puts the worst cells in order.
  void finish() { std::sort_heap(result_.worst.begin(), result_.worst.end(), is_worse); }

 private:
  /// A heap with the least bad one on top.
  void keep(const ValueChange& change) {
    std::vector<ValueChange>& worst = result_.worst;
    if (options_.worst == 0) return;
    if (worst.size() == options_.worst) {
      if (!is_worse(change, worst.front())) return;
      std::pop_heap(worst.begin(), worst.end(), is_worse);
      worst.pop_back();
    }
    worst.push_back(change);
    std::push_heap(worst.begin(), worst.end(), is_worse);
  }

  ValueComparison& result_;
  const CompareOptions& options_;
  std::optional<std::int64_t> last_;
};

/// @param result with what is compared
void compare_values(const ResultsReader& before, const ResultsReader& after, const CompareOptions& options,
                    const Field& field, ValueComparison& result) {
  using Leading = std::optional<std::size_t>;
  const auto& pair = result.entry;
  CompareOptions field_options = options;
  if (field.kind == FieldKind::probability) field_options.tolerance = 0;
  const bool is_by_partition = !field.fixed_points.empty();
  ValueCounter counter(result, field_options,
                       pair && is_by_partition ? after.lower_bound(field, pair->after) : std::nullopt);
  const std::string subject =
      pair ? field.axes.front().substr(1) + " " + before.leading_names(field)[pair->before] : result.label;
  const auto read = [&](const ResultsReader& file, std::int64_t begin, std::int64_t end, bool earlier) {
    const Leading leading = pair ? Leading(earlier ? pair->before : pair->after) : std::nullopt;
    return file.read_run(begin, end,
                         [&](const CellBlock& block) { return file.values(field, leading, block); });
  };
  for_each_segment(before, after, read, [&](std::int64_t begin, const auto& old, const auto& now) {
    if (options.progress) options.progress(subject);
    for (std::size_t i = 0; i < old.size(); ++i) {
      const std::int64_t cell = begin + static_cast<std::int64_t>(i);
      const bool turns = field.display.less_is_better;
      counter.add(turns ? ValueChange{cell, turned(old[i]), turned(now[i])}
                        : ValueChange{cell, old[i], now[i]});
    }
  });
  counter.finish();
  if (!field.display.less_is_better) return;
  for (ValueChange& change : result.worst)
    change = {change.cell, turned_back(change.before), turned_back(change.after)};
}

/// The entries of the leading axis that both files have: partitions as they are matched, others by name.
std::vector<EntryPair> common_entries(const ResultsReader& before, const ResultsReader& after,
                                      const Field& field, const ResultsComparison& result) {
  if (field.axes.front() == "/partition") return result.partitions;
  const std::vector<std::string>& old = before.leading_names(field);
  const std::vector<std::string>& now = after.leading_names(field);
  std::vector<EntryPair> pairs;
  for (std::size_t i = 0; i < old.size(); ++i) {
    const auto found = std::find(now.begin(), now.end(), old[i]);
    if (found != now.end()) pairs.push_back({i, static_cast<std::size_t>(found - now.begin())});
  }
  return pairs;
}

/// Compares a field: every common entry, where it has a leading axis.
void add_values(const ResultsReader& before, const ResultsReader& after, const CompareOptions& options,
                const Field& field, ResultsComparison& result) {
  const ValueComparison begun{.name = field.path.substr(1), .label = field.display.compared};
  std::vector<ValueComparison> all;
  if (after.leading_length(field) == 0) {
    all.push_back(begun);
  } else {
    for (const EntryPair& pair : common_entries(before, after, field, result))
      all.emplace_back(begun).entry = pair;
  }
  for (ValueComparison& comparison : all) {
    compare_values(before, after, options, field, comparison);
    result.values.push_back(std::move(comparison));
  }
}

using Requirements = std::vector<ResultRequirement>;

const ResultRequirement* find_requirement(const Requirements& all, const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(), [&name](const ResultRequirement& requirement) {
    return requirement.name == name;
  });
  return found == all.end() ? nullptr : &*found;
}

void compare_requirements(const Requirements& before, const Requirements& after, ResultsComparison& result) {
  for (const ResultRequirement& old : before) {
    const ResultRequirement* const now = find_requirement(after, old.name);
    if (now == nullptr) {
      result.requirements_only_before.push_back(old.name);
    } else if (now->holds != old.holds) {
      result.verdicts.push_back({old.name, now->holds});
    }
  }
  for (const ResultRequirement& now : after) {
    if (find_requirement(before, now.name) == nullptr) result.requirements_only_after.push_back(now.name);
  }
}

}  // namespace

bool ResultsComparison::is_worse() const {
  return std::any_of(sets.begin(), sets.end(),
                     [](const SetComparison& set) { return set.name == "invariant" && set.left > 0; }) ||
         std::any_of(values.begin(), values.end(),
                     [](const ValueComparison& comparison) { return comparison.lost > 0; }) ||
         std::any_of(verdicts.begin(), verdicts.end(),
                     [](const VerdictChange& verdict) { return !verdict.holds_after; });
}

ResultsComparison compare_results(const ResultsReader& before, const ResultsReader& after,
                                  const CompareOptions& options) {
  check_comparable(before, after);
  ResultsComparison result;
  match_partitions(before.spec(), after.spec(), result);
  if (result.partitions.empty()) {
    throw ResultsError("no partition of " + before.path() + " is in it", after.path());
  }
  if (options.progress) options.progress("sets");
  std::vector<const Field*> compared;
  for (const Field& field : after.fields()) {
    if (!field.display.compared.empty() && before.has(field.path)) compared.push_back(&field);
  }
  for (const Field* const field : compared) {
    if (field->kind == FieldKind::set) result.sets.push_back(compare_sets(before, after, *field));
  }
  for (const Field* const field : compared) {
    if (field->kind != FieldKind::set) add_values(before, after, options, *field, result);
  }
  compare_requirements(read_requirement_values(before.spec(), before),
                       read_requirement_values(after.spec(), after), result);
  return result;
}

}  // namespace coordreq
