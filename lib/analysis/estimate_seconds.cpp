#include "analysis/estimate_seconds.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numeric>
#include <vector>

#include "analysis/analysis_stages.hpp"
#include "analysis/coarse_copy.hpp"
#include "answers/answers.hpp"
#include "answers/plan.hpp"
#include "reach/build_abstraction.hpp"
#include "reach/enclosure_sample.hpp"
#include "reach/table_shapes.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

constexpr std::int64_t kFirstCells = 1000;
constexpr std::int64_t kGrowth = 4;
/// A copy that takes longer is the last one, but that the problem itself is measured if it is next and the
/// copy takes no longer than the other.
constexpr double kLongEnough = 0.3, kShortEnough = 0.5;
/// One that takes longer is given up.
constexpr double kPatience = 2;
/// Boxes that are enclosed to see what all of them take: no fewer, and more within this time.
constexpr std::int64_t kFewBoxes = 12, kManyBoxes = 200;
constexpr double kBoxSeconds = 0.5;
/// An entry of a table beside them, in seconds, about.
constexpr double kOfExactEntry = 5e-7;
/// By which powers of the number of cells work grows: equal work is done once, so that it may be few.
constexpr double kLeastPower = 0.3, kMostPower = 1.1;

/// The size of a copy, and the seconds that it took.
struct Measured {
  double cells = 0, entries = 0;
  double tables = 0, rest = 0;  ///< seconds
  bool is_given_up = false;     ///< then `tables` is what they were about to take, `rest` unknown
  [[nodiscard]] double all() const { return tables + rest; }
};

/// Processor time of all threads of this process, in seconds.
double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Thrown out of a loop that takes too long, of which about this fraction is done.
struct GivenUp {
  double fraction;
};

/// Loops of the team are given up at that time, as long as this object lives.
class Deadline {
 public:
  Deadline(ThreadTeam& team, double seconds) : team_(team) {
    team.set_watch([seconds](std::int64_t done, std::int64_t count) {
      if (processor_seconds() > seconds)
        throw GivenUp{static_cast<double>(done) / static_cast<double>(count)};
    });
  }
  ~Deadline() { team_.set_watch({}); }
  Deadline(const Deadline&) = delete;
  Deadline& operator=(const Deadline&) = delete;

 private:
  ThreadTeam& team_;
};

/// In processor time, of which each thread is taken to have its share.
Measured measure(const ProblemSpec& spec, ThreadTeam& team) {
  const double begin = processor_seconds();
  const Deadline deadline(team, begin + kPatience * team.size());
  double since = begin, tables = 0;
  bool is_tables = false;
  const auto enter = [&](const std::string& stage) {
    const double now = processor_seconds();
    if (is_tables) tables += now - since;
    is_tables = stage == "abstraction";
    since = now;
  };
  const Model model = make_model(spec);
  Answers answers(model);
  Measured result{.cells = static_cast<double>(spec.cells()), .entries = entries_of(model.shapes())};
  try {
    run_stages(analysis_stages(spec), answers, {.team = team}, {.enter = enter});
    result.tables = tables / team.size();
    result.rest = (processor_seconds() - begin - tables) / team.size();
  } catch (const GivenUp& loop) {
    result.is_given_up = true;
    if (is_tables)
      result.tables = (processor_seconds() - since) / std::max(loop.fraction, 1e-6) / team.size();
  }
  return result;
}

/// Seconds that one thread takes for tables of which posts are enclosures; nothing if there are none.
std::optional<double> measured_enclosures(const Model& model) {
  const std::vector<EnclosedGroup> groups = enclosed_groups(model.spec(), model.shapes());
  if (groups.empty()) return std::nullopt;
  double seconds = entries_of(model.shapes()) * kOfExactEntry;
  for (const EnclosedGroup& group : groups) {
    EnclosureSample sample(model.spec(), group);
    const double begin = processor_seconds();
    const double most = kBoxSeconds / static_cast<double>(groups.size());
    std::int64_t boxes = 0;
    for (; boxes < kFewBoxes || (boxes < kManyBoxes && processor_seconds() - begin < most); ++boxes)
      sample.enclose_next();
    seconds += (processor_seconds() - begin) / static_cast<double>(boxes) * sample.choices();
  }
  return seconds;
}

/// The problem with steps `factor` times as long; 1: on its own grid. Boxes are not divided: what that takes
/// is seen by a sample, and copies show the rest.
ProblemSpec coarser(const ProblemSpec& spec, std::int64_t factor) {
  ProblemSpec copy = spec;
  copy.abstraction.effort = 0;
  if (factor == 1) return copy;
  copy.controller.file.reset();  // that is of one grid
  copy.requirements.clear();     // their regions may be none on another
  coarsen(copy, factor);
  return copy;
}

/// The least coarse one of at most so many cells, or the problem itself.
std::optional<ProblemSpec> copy_within(const ProblemSpec& spec, double most_cells) {
  for (std::int64_t factor = 1; factor <= 4096; factor = factor < 8 ? factor + 1 : factor * 5 / 4) {
    ProblemSpec copy = coarser(spec, factor);
    if (static_cast<double>(copy.cells()) <= most_cells) return copy;
  }
  return std::nullopt;
}

/// @param enclosures seconds of tables, if a sample of them has been measured
double extrapolated(const Model& model, const std::vector<Measured>& copies,
                    std::optional<double> enclosures) {
  const Measured& last = copies.back();
  const double cells = static_cast<double>(model.spec().cells());
  double power = 1;
  if (copies.size() > 1) {
    const Measured& before = copies[copies.size() - 2];
    power = std::log(std::max(last.rest, 1e-6) / std::max(before.rest, 1e-6)) /
            std::log(last.cells / before.cells);
  }
  return enclosures.value_or(last.tables * entries_of(model.shapes()) / last.entries) +
         last.rest * std::pow(cells / last.cells, std::clamp(power, kLeastPower, kMostPower));
}

/// @param enclosures as in extrapolated()
std::optional<double> estimated(const Model& model, ThreadTeam& team, std::optional<double> enclosures) {
  const ProblemSpec& spec = model.spec();
  const double cells = static_cast<double>(spec.cells());
  std::vector<Measured> copies;
  for (auto most = static_cast<double>(kFirstCells);; most *= kGrowth) {
    const std::optional<ProblemSpec> copy = copy_within(spec, most);
    if (copy && (copies.empty() || static_cast<double>(copy->cells()) > copies.back().cells))
      copies.push_back(measure(*copy, team));
    if (copies.empty()) {
      if (most > cells) return std::nullopt;
      continue;
    }
    const Measured& last = copies.back();
    if (last.is_given_up) {
      if (copies.size() > 1) copies.pop_back();
      const double seconds = extrapolated(model, copies, enclosures);
      return seconds > 0 ? std::optional(seconds) : std::nullopt;
    }
    const bool is_last = last.all() > (last.cells * kGrowth >= cells ? kShortEnough : kLongEnough);
    if ((is_last && copies.size() > 1) || last.cells == cells || most > cells)
      return extrapolated(model, copies, enclosures);
  }
}

}  // namespace

std::optional<double> estimate_seconds(const Model& model, ThreadTeam& team) {
  std::optional<double> enclosures =
      if_possible([&] { return measured_enclosures(model); }).value_or(std::nullopt);
  if (enclosures) *enclosures /= team.size();
  return if_possible([&] { return estimated(model, team, enclosures); }).value_or(enclosures);
}

bool may_take_hours(const Model& model) {
  constexpr double kManyVisits = 2e8, kManyEntries = 2e6;
  const ProblemSpec& spec = model.spec();
  const double horizon = spec.risk ? static_cast<double>(spec.risk->horizon) : 0;
  const auto partitions = static_cast<double>(spec.coordination.partitions.size());
  return static_cast<double>(spec.cells()) * (partitions + horizon) > kManyVisits ||
         entries_of(model.shapes()) > kManyEntries;
}

}  // namespace coordreq
