#include "cell/log_judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "answers/paths.hpp"
#include "base/error.hpp"
#include "base/index.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using Index = std::optional<std::int64_t>;

/// The index of a value among those of an input; -1: it is none of them.
std::int64_t value_index(const std::vector<Rational>& values, const Rational& value) {
  const auto distance = [&value](const Rational& candidate) { return Rational(abs(candidate - value)); };
  const auto nearest = std::min_element(
      values.begin(), values.end(), [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  // Inputs have no step, and one at 0 may be as small as it likes beside the others.
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const Rational spacing = values.size() < 2 ? Rational(0) : Rational((*most - *least) / (4 * values.size()));
  const Rational slack = LogLocator::slack(value, spacing);
  return distance(*nearest) <= slack ? nearest - values.begin() : -1;
}

bool is_in(const IndexRange& range, std::int64_t k) {
  return range.first <= k && k <= range.last;
}

/// Whether an index that a state was found at is among those that its post may have. Beyond a side that holds
/// it back it never is.
bool is_reached(const GridDimension& dimension, const IndexRange& raw, const ResolvedRange& resolved,
                std::int64_t k) {
  if (k < 0 || k >= dimension.count)
    return traits(k < 0 ? dimension.below : dimension.above).is_open() && is_in(raw, saturate_index(k));
  return is_in(resolved.inside, k) || (dimension.periodic() && is_in(resolved.inside, k + dimension.count));
}

}  // namespace

const char* finding_name(LogFinding finding) {
  constexpr std::array<const char*, kLogFindings> kNames = {
      "outside", "unsafe", "not_invariant", "off_model", "reckless", "not_coordinated", "breach"};
  return kNames[static_cast<std::size_t>(finding)];
}

std::optional<bool> JudgedRow::found(LogFinding finding) const {
  const bool has_cell = !position.cells.empty();
  const auto judged_if = [](bool is_judged, bool is_found) {
    return is_judged ? std::optional(is_found) : std::nullopt;
  };
  switch (finding) {
    case LogFinding::outside:
      return position.is_outside();
    case LogFinding::unsafe:
      return judged_if(has_cell, delay == -2);
    case LogFinding::not_invariant:
      return judged_if(has_cell && delay != -2, delay == -1);
    case LogFinding::off_model:
      return judged_if(fits_model.has_value(), !fits_model.value_or(true));
    case LogFinding::reckless:
      return judged_if(
          std::any_of(is_reckless.begin(), is_reckless.end(), [](auto verdict) { return !!verdict; }),
          std::find(is_reckless.begin(), is_reckless.end(), true) != is_reckless.end());
    case LogFinding::not_coordinated:
      return judged_if(in_controller && log.connected.value_or(false), !in_controller.value_or(true));
    case LogFinding::breach:
      return judged_if(tolerates_less || (countdown && contact != Contact::possible),
                       tolerates_less || is_silent_too_long);
  }
  return std::nullopt;
}

LogJudge::LogJudge(const ResultsReader& results, std::size_t partition, LogReader& log, ThreadTeam& team)
    : results_(results),
      partition_(partition),
      log_(log),
      controller_(results, team),
      locator_(results.spec(), controller_.posts()),
      watch_(results, partition, controller_),
      classes_(input_classes(results.spec(), results.inputs(),
                             results.spec().coordination.partitions[partition])) {}

std::optional<JudgedRow> LogJudge::next() {
  if (!std::exchange(has_begun_, true)) {
    ahead_ = read(nullptr);
    if (ahead_) watch_.begin(ahead_->position);
  }
  if (!ahead_) return std::nullopt;
  JudgedRow row = std::move(*ahead_);
  row.countdown = watch_.countdown();
  judge_actions(row);
  row.is_silent_too_long = watch_.leave(row.position, row.contact, actions_);
  ahead_ = read(&row);
  if (!ahead_) return row;
  if (!ahead_->is_after_gap) {
    judge_model(row, *ahead_);
    ahead_->tolerates_less = watch_.arrive(ahead_->position, row.contact);
  } else {
    watch_.begin(ahead_->position);
  }
  return row;
}

std::optional<JudgedRow> LogJudge::read(const JudgedRow* before) {
  std::optional<LogRow> log = log_.next();
  if (!log) return std::nullopt;
  JudgedRow row{.number = before == nullptr ? 1 : before->number + 1, .log = std::move(*log)};
  const bool follows = before != nullptr && is_next(row, *before);
  row.is_after_gap = before != nullptr && !follows;
  row.position = locator_.position(row.log, follows ? before->position.cells : std::vector<std::int64_t>());
  for (const std::int64_t cell : row.position.cells) row.delay = std::max(row.delay, watch_.delay(cell));
  return row;
}

/// Whether no sample is missing between the two; clocks may be a quarter of a period off.
bool LogJudge::is_next(const JudgedRow& row, const JudgedRow& before) const {
  if (!row.log.time || !before.log.time) return true;
  const DynamicsSpec& dynamics = results_.spec().dynamics;
  const Rational periods = (*row.log.time - *before.log.time) / dynamics.period;
  const std::int64_t whole = floor_to_int(periods + Rational(1, 2));
  if (whole >= 1 && abs(periods - Rational(static_cast<long>(whole))) <= Rational(1, 4)) return whole == 1;
  const std::string unit = dynamics.unit.empty() ? "" : " " + dynamics.unit;
  throw UsageError(fmt::format("found {} after {}, expected one period more, {}{}, or several",
                               nearest_double(*row.log.time), nearest_double(*before.log.time),
                               nearest_double(dynamics.period), unit),
                   row.log.location + ", t");
}

/// The joint input of the row; nothing if some input is not logged or has no value of the spec.
std::optional<std::int64_t> LogJudge::joint_input() const {
  std::int64_t u = 0;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (!values_[i] || *values_[i] < 0) return std::nullopt;
    u += *values_[i] * results_.inputs().stride(i);
  }
  return u;
}

/// Takes the logged inputs as numbers of the spec's values and of joint actions.
void LogJudge::take_actions(JudgedRow& row) {
  const InputSpace& inputs = results_.inputs();
  values_.assign(inputs.size(), std::nullopt);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (row.log.inputs[i]) values_[i] = value_index(inputs[i].values, *row.log.inputs[i]);
    if (values_[i] == -1) row.unknown_inputs.push_back(i);
  }
  actions_.assign(classes_.size(), std::nullopt);
  for (std::size_t c = 0; c < classes_.size(); ++c) {
    const std::vector<std::int32_t>& inputs_of_class = classes_[c].inputs();
    const auto value = [this](std::int32_t input) { return values_[at(input)]; };
    if (!std::all_of(inputs_of_class.begin(), inputs_of_class.end(), value)) continue;
    const std::vector<std::int64_t> strides = classes_[c].strides();
    const bool is_any = std::all_of(inputs_of_class.begin(), inputs_of_class.end(),
                                    [&](std::int32_t j) { return *value(j) >= 0; });
    actions_[c] = is_any ? 0 : -1;
    for (std::size_t j = 0; is_any && j < inputs_of_class.size(); ++j)
      *actions_[c] += *value(inputs_of_class[j]) * strides[at(inputs_of_class[j])];
  }
}

/// A goal that ends the task is reached there: what follows does not matter.
bool LogJudge::is_terminal(std::int64_t cell) {
  return results_.spec().ends_at_goal() && controller_.values(paths::kArrival, partition_)(cell) == 0;
}

/// Judges the actions by the cells of K that the state may be in; outside K there is no promise.
void LogJudge::judge_actions(JudgedRow& row) {
  take_actions(row);
  const bool is_complete = std::all_of(values_.begin(), values_.end(), [](Index index) { return !!index; });
  const Index u = joint_input();
  row.is_reckless.assign(classes_.size(), std::nullopt);
  for (const std::int64_t cell : row.position.cells) {
    if (watch_.delay(cell) < 0 || is_terminal(cell)) continue;
    const ActionSets sets = controller_.actions(partition_, cell);
    for (std::size_t c = 0; c < classes_.size(); ++c) {
      if (!actions_[c]) continue;
      const bool is_left = *actions_[c] >= 0 && sets[c][at(*actions_[c])];
      row.is_reckless[c] = row.is_reckless[c].value_or(true) && !is_left;
    }
    if (!is_complete) continue;
    const bool is_member = u && controller_.joint_inputs(cell)[at(*u)];
    row.in_controller = row.in_controller.value_or(false) || is_member;
  }
  const bool may_be_agreed = row.in_controller.value_or(true);
  row.contact = may_be_agreed ? Contact::possible : Contact::no;
  if (row.log.connected) row.contact = *row.log.connected ? Contact::yes : Contact::no;
}

void LogJudge::judge_model(JudgedRow& row, const JudgedRow& next) {
  const std::optional<std::int64_t> u = joint_input();
  if (!u || row.position.cells.empty()) return;
  std::optional<std::size_t> first;
  for (const std::int64_t cell : row.position.cells) {
    const std::optional<std::size_t> misfit = misfit_in(cell, *u, next);
    row.fits_model = row.fits_model.value_or(false) || !misfit;
    if (*row.fits_model) return;
    if (cell == row.position.cells.front()) first = misfit;
  }
  controller_.posts().move_to(row.position.cells.front());
  const UniformGrid& grid = results_.grid();
  const GridDimension& dimension = grid[*first];
  const IndexRange raw = controller_.posts().raw(*first, *u);
  row.misfit = {.state = *first,
                .found = next.position.state[*first],
                .lower = dimension.point(raw.first) - dimension.radius(),
                .upper = dimension.point(raw.last) + dimension.radius()};
}

/// The first state that cannot be there after a step from the cell.
std::optional<std::size_t> LogJudge::misfit_in(std::int64_t cell, std::int64_t u, const JudgedRow& next) {
  CellPosts& posts = controller_.posts();
  posts.move_to(cell);
  for (std::size_t i = 0; i < results_.grid().size(); ++i) {
    if (!next.log.is_given[i]) continue;  // it follows from the cell
    const IndexRange raw = posts.raw(i, u);
    const ResolvedRange resolved = posts.resolved(i, u);
    const std::vector<std::int64_t>& found = next.position.indices[i];
    const bool fits = std::any_of(found.begin(), found.end(), [&](std::int64_t k) {
      return is_reached(results_.grid()[i], raw, resolved, k);
    });
    if (!fits) return i;
  }
  return std::nullopt;
}

}  // namespace coordreq
