#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "analysis/advice.hpp"
#include "analysis/coarse_copy.hpp"
#include "answers/context/answer.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/invariance/invariance.hpp"
#include "answers/layers/answer.hpp"
#include "answers/plan.hpp"
#include "base/error.hpp"
#include "base/grouped.hpp"
#include "base/requires.hpp"
#include "reach/build_abstraction.hpp"
#include "reach/table_shapes.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

constexpr std::int64_t kMostCells = 100'000;
// Work is counted in units of about a nanosecond: on one core the examples took 0.3 to 3 for each.
/// The work of all trials together.
constexpr double kMostWork = 4e9;
/// A visit of a cell costs so much, and for each joint input so much more: little where many inputs move a
/// row alike, more where what they do is added up cell by cell.
constexpr double kWorkOfVisit = 100, kWorkOfInput = 0.05, kWorkOfSummedInput = 4;
/// An entry of a table: of a map, and of a flow that is integrated.
constexpr double kWorkOfMap = 1000, kWorkOfFlow = 20'000;
/// Tables of a copy may cost so much that there is enough for some ten trials.
constexpr double kMostWorkOfTables = kMostWork / 10;

double work_of_entry(const ProblemSpec& spec) {
  return spec.dynamics.time == Time::discrete ? kWorkOfMap : kWorkOfFlow;
}

/// A rule, disturbance, error or step that is made milder.
struct Relaxation {
  std::string text;  ///< completes "it helps if ..."
  std::function<void(ProblemSpec&)> apply;
};

/// Several of one kind at once, where one alone may not be enough. @param begin of those in `all`
void relax_together(std::size_t begin, const std::string& text, std::vector<Relaxation>& all) {
  if (all.size() < begin + 2) return;
  const std::vector<Relaxation> relaxations(all.begin() + static_cast<std::ptrdiff_t>(begin), all.end());
  all.push_back({text, [relaxations](ProblemSpec& copy) {
                   for (const Relaxation& relaxation : relaxations) relaxation.apply(copy);
                 }});
}

void relax_sides(const ProblemSpec& spec, std::vector<Relaxation>& all) {
  const std::size_t begin = all.size();
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const StateSpec& state = spec.states[i];
    if (state.below == Outside::unsafe)
      all.push_back({state.name + " saturates below",
                     [i](ProblemSpec& copy) { copy.states[i].below = Outside::saturate; }});
    if (state.above == Outside::unsafe)
      all.push_back({state.name + " saturates above",
                     [i](ProblemSpec& copy) { copy.states[i].above = Outside::saturate; }});
  }
  relax_together(begin, "all sides saturate", all);
}

/// Cells with a face at a limit that stops a state, so that no cell holds both what stands and what moves.
void relax_limits(const ProblemSpec& spec, std::vector<Relaxation>& all) {
  const std::size_t begin = all.size();
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const StateSpec& state = spec.states[i];
    const bool above = state.below != Outside::stop;
    if (above && state.above != Outside::stop) continue;
    all.push_back({fmt::format("half-open cells of {} have a face at its {} limit", state.name,
                               above ? "upper" : "lower"),
                   [i, above](ProblemSpec& copy) {
                     copy.abstraction.cells = Cells::half_open;
                     GridSpec& grid = copy.states[i].grid;
                     const Rational half = grid.step / 2;
                     grid.first = above ? Rational(grid.first + half) : Rational(grid.first - half);
                   }});
  }
  relax_together(begin, "all limits are at faces of half-open cells", all);
}

void relax_disturbances(const ProblemSpec& spec, std::vector<Relaxation>& all) {
  const std::size_t begin = all.size();
  for (std::size_t i = 0; i < spec.disturbances.size(); ++i) {
    const DisturbanceSpec& disturbance = spec.disturbances[i];
    if (disturbance.lower == disturbance.upper) continue;
    const Rational value = disturbance.lower <= 0 && disturbance.upper >= 0
                               ? Rational(0)
                               : Rational((disturbance.lower + disturbance.upper) / 2);
    all.push_back(
        {fmt::format("{} is {:.6g}", disturbance.name, nearest_double(value)),
         [i, value](ProblemSpec& copy) { copy.disturbances[i].lower = copy.disturbances[i].upper = value; }});
  }
  std::vector<std::string> texts;
  for (std::size_t d = begin; d < all.size(); ++d) texts.push_back(all[d].text);
  relax_together(begin, fmt::format("{}", fmt::join(texts, " and ")), all);
  const std::size_t errors = all.size();
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    if (spec.states[i].measurement_error == 0) continue;
    all.push_back({spec.states[i].name + " is measured without an error",
                   [i](ProblemSpec& copy) { copy.states[i].measurement_error = 0; }});
  }
  relax_together(errors, "all states are measured without an error", all);
}

void relax_grid(const ProblemSpec& spec, std::vector<Relaxation>& all) {
  const Rational half(1, 2);
  std::size_t continuous = 0;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    if (spec.states[i].discrete) continue;
    ++continuous;
    all.push_back({fmt::format("the step of {} is half as long", spec.states[i].name),
                   [i, half](ProblemSpec& copy) { regrid(copy.states[i], half); }});
  }
  if (continuous > 1) {
    all.push_back({"all steps are half as long", [half](ProblemSpec& copy) {
                     for (StateSpec& state : copy.states) regrid(state, half);
                   }});
  }
  if (spec.abstraction.cells == Cells::closed)
    all.push_back(
        {"cells are half_open", [](ProblemSpec& copy) { copy.abstraction.cells = Cells::half_open; }});
  if (spec.abstraction.safe == Membership::inner)
    all.push_back({"only centres of cells must be safe",
                   [](ProblemSpec& copy) { copy.abstraction.safe = Membership::center; }});
}

void relax_rules(const ProblemSpec& spec, std::vector<Relaxation>& all) {
  if (spec.controller.allow)
    all.push_back({"everything is allowed", [](ProblemSpec& copy) { copy.controller.allow.reset(); }});
  if (spec.controller.synthesis == Synthesis::given)
    all.push_back({"the controller may choose",
                   [](ProblemSpec& copy) { copy.controller.synthesis = Synthesis::maximal; }});
}

std::vector<Relaxation> relaxations(const ProblemSpec& spec) {
  std::vector<Relaxation> all;
  relax_sides(spec, all);
  relax_limits(spec, all);
  relax_disturbances(spec, all);
  relax_rules(spec, all);
  relax_grid(spec, all);
  return all;
}

/// The fault of an answer, in the order in which faults must be mended.
enum class Fault : std::uint8_t { nothing, no_silence, empty };

Fault fault_of(const Answers& answers, std::size_t partition) {
  if (answers.get<Invariance>().cells == 0) return Fault::empty;
  const std::vector<std::int64_t>& sizes = answers.get<PartitionLayers>().partitions[partition].sizes;
  return sizes.size() > 1 && sizes[1] == answers.context.terminal_cells ? Fault::no_silence : Fault::nothing;
}

struct OutOfWork {};

/// The work that trials may take: counted, so that no clock decides which are tried.
struct WorkLimit {
  double spent = 0;

  /// @throws OutOfWork
  void spend(double work) {
    spent += work;
    if (spent > kMostWork) throw OutOfWork();
  }
};

double work_of_tables(const Model& model) {
  return entries_of(model.shapes()) * work_of_entry(model.spec());
}

double work_of_visit(const Model& model) {
  const auto inputs = static_cast<double>(model.inputs().count());
  const bool is_summed = std::any_of(model.shapes().begin(), model.shapes().end(),
                                     [](const TableShape& shape) { return shape.sum; });
  return kWorkOfVisit + inputs * (is_summed ? kWorkOfSummedInput : kWorkOfInput);
}

/// Told of the steps of fixed points, spends what their sweeps do.
class SweepMeter {
 public:
  /// @param work of a visit of a cell
  SweepMeter(double work, WorkLimit& limit) : work_(work), limit_(limit) {}

  void step(const WaveStep& step, std::int64_t row_length) {
    if (step.sweep != sweep_ || step.visited < visited_) visited_ = 0;  // it counts the rows of a sweep
    limit_.spend(static_cast<double>(step.visited - visited_) * static_cast<double>(row_length) * work_);
    sweep_ = step.sweep;
    visited_ = step.visited;
  }

 private:
  double work_;
  WorkLimit& limit_;
  std::int64_t sweep_ = 0;
  std::int64_t visited_ = 0;
};

/// @throws OutOfWork
Fault fault_of(const ProblemSpec& spec, WorkLimit& limit, ThreadTeam& team) {
  const Model model = make_model(spec);
  limit.spend(work_of_tables(model) + static_cast<double>(spec.cells()) * work_of_visit(model));
  SweepMeter meter(work_of_visit(model), limit);
  Answers answers(model);
  std::vector<Stage> stages = context_answer.stages(spec);
  for (const auto& more : {invariance_answer.stages(spec), layers_answer.stages(spec)})
    stages.insert(stages.end(), more.begin(), more.end());
  run_stages(stages, answers, {.team = team, .step = [&meter](const WaveStep& step, std::int64_t row_length) {
                                 meter.step(step, row_length);
                               }});
  return fault_of(answers, 0);
}

/// The relaxations that helped, of those tried one by one.
struct Trials {
  std::vector<std::string> helped;
  std::size_t tried = 0;
  WorkLimit limit;
};

Trials try_all(const ProblemSpec& spec, Fault fault, ThreadTeam& team) {
  Trials trials;
  try {
    for (const Relaxation& relaxation : relaxations(spec)) {
      ProblemSpec relaxed = spec;
      relaxation.apply(relaxed);
      const std::optional<Fault> found = if_possible([&] { return fault_of(relaxed, trials.limit, team); });
      if (!found) continue;
      ++trials.tried;
      if (*found < fault) trials.helped.push_back(relaxation.text);
    }
  } catch (const OutOfWork&) {  // what was tried counts
  }
  return trials;
}

std::string grid_of_trials(const CoarseCopy& copy) {
  if (copy.factor == 1) return "";
  return fmt::format(" on a copy with {} cells (steps up to {} times as long)", grouped(copy.spec.cells()),
                     copy.factor);
}

/// What to do where nothing helped. @param creeps as of advise_on_answers()
std::string_view hint(bool creeps) {
  return creeps ? "; 'coordreq explain' shows what goes wrong at a state"
                : "; a finer grid may (--refine 4), and 'coordreq explain' shows what goes wrong at a state";
}

/// The changes that would help, as the end of a sentence. @param otherwise is added if there are none
std::string remedies(const ProblemSpec& spec, std::size_t partition, Fault fault, std::string_view otherwise,
                     ThreadTeam& team, Json& work) {
  const double most_entries = kMostWorkOfTables / work_of_entry(spec);
  const auto coarser = [&] { return coarse_copy(spec, partition, kMostCells, most_entries); };
  std::optional<CoarseCopy> copy = if_possible(coarser).value_or(std::nullopt);
  if (!copy) return "";
  // Subboxes of a cell may cost a thousand times what its entry is reckoned to; without them posts are wider.
  if (spec.dynamics.time == Time::continuous) copy->spec.abstraction.effort = 0;
  const Trials trials = try_all(copy->spec, fault, team);
  work["helpers"]["advice"] = {{"trials", trials.tried}, {"work", trials.limit.spent}};
  if (trials.tried == 0) return "";
  const std::string count =
      fmt::format("of {} changes tried one by one{}", trials.tried, grid_of_trials(*copy));
  if (trials.helped.empty()) return fmt::format("; {}, none helps{}", count, otherwise);
  return fmt::format("; {}, it helps if {}", count, fmt::join(trials.helped, ", or if "));
}

}  // namespace

Warnings advise_on_answers(const Answers& answers, bool creeps, ThreadTeam& team, Json& work) {
  REQUIRES(answers.find<Invariance>() != nullptr && answers.find<PartitionLayers>() != nullptr);
  const ProblemSpec& spec = answers.context.spec;
  const std::vector<PartitionSpec>& partitions = spec.coordination.partitions;
  std::vector<std::size_t> silent;  // without any silence
  for (std::size_t p = 0; p < partitions.size(); ++p) {
    const Fault fault = fault_of(answers, p);
    if (fault == Fault::empty) {
      const bool is_unsafe = answers.context.safe_cells == 0;
      return {{"empty", is_unsafe ? "/safe" : "",
               fmt::format("the {} set is empty on this grid{}", is_unsafe ? "safe" : "invariance",
                           remedies(spec, p, fault, is_unsafe ? "" : hint(creeps), team, work))}};
    }
    if (fault == Fault::no_silence) silent.push_back(p);
  }
  if (silent.empty()) return {};
  const std::string others =
      silent.size() == 1 ? "" : fmt::format(" (nor with {} others)", silent.size() - 1);
  return {
      {"no_silence", "/coordination",
       fmt::format("with the partition {}{} no state tolerates even one step without coordination on this "
                   "grid{}",
                   partitions[silent.front()].name, others,
                   remedies(spec, silent.front(), Fault::no_silence, hint(creeps), team, work))}};
}

}  // namespace coordreq
