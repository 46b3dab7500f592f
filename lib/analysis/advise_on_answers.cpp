#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <functional>

#include "analysis/advice.hpp"
#include "analysis/coarse_copy.hpp"
#include "answers/ground/answer.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/invariance/invariance.hpp"
#include "answers/layers/answer.hpp"
#include "answers/plan.hpp"
#include "base/grouped.hpp"
#include "reach/make_model.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

constexpr std::int64_t kMostCells = 100'000;
constexpr double kMostEntries = 2e6;
constexpr std::chrono::seconds kMostTime{2};

/// A rule, disturbance, error or step that is made milder.
struct Relaxation {
  std::string text;  ///< completes "it helps if ..."
  std::function<void(ProblemSpec&)> apply;
};

void relax_sides(const ProblemSpec& spec, std::vector<Relaxation>& all) {
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const StateSpec& state = spec.states[i];
    if (state.below == Outside::unsafe)
      all.push_back({state.name + " saturates below",
                     [i](ProblemSpec& copy) { copy.states[i].below = Outside::saturate; }});
    if (state.above == Outside::unsafe)
      all.push_back({state.name + " saturates above",
                     [i](ProblemSpec& copy) { copy.states[i].above = Outside::saturate; }});
  }
}

void relax_disturbances(const ProblemSpec& spec, std::vector<Relaxation>& all) {
  for (std::size_t i = 0; i < spec.disturbances.size(); ++i) {
    const DisturbanceSpec& own = spec.disturbances[i];
    if (own.lower == own.upper) continue;
    const Rational value =
        own.lower <= 0 && own.upper >= 0 ? Rational(0) : Rational((own.lower + own.upper) / 2);
    all.push_back(
        {fmt::format("{} is {:.6g}", own.name, nearest_double(value)),
         [i, value](ProblemSpec& copy) { copy.disturbances[i].lower = copy.disturbances[i].upper = value; }});
  }
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    if (spec.states[i].measurement_error == 0) continue;
    all.push_back({spec.states[i].name + " is measured without an error",
                   [i](ProblemSpec& copy) { copy.states[i].measurement_error = 0; }});
  }
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
  relax_disturbances(spec, all);
  relax_rules(spec, all);
  relax_grid(spec, all);
  return all;
}

/// What is wrong with an answer. In the order of what must be mended first.
enum class Fault : std::uint8_t { nothing, no_silence, empty };

Fault fault_of(const Answers& answers, std::size_t partition) {
  if (answers.get<Invariance>().cells == 0) return Fault::empty;
  const std::vector<std::int64_t>& sizes = answers.get<PartitionLayers>().partitions[partition].sizes;
  return sizes.size() > 1 && sizes[1] == 0 ? Fault::no_silence : Fault::nothing;
}

Fault fault_of(const ProblemSpec& spec, ThreadTeam& team) {
  const Model model = make_model(spec);
  Answers answers(model);
  std::vector<Stage> stages = ground_stages(spec);
  for (const auto& more : {invariance_stages(spec), layers_stages(spec)})
    stages.insert(stages.end(), more.begin(), more.end());
  run_stages(stages, answers, {.team = team});
  return fault_of(answers, 0);
}

struct OutOfTime {};

/// Ends loops of the team when time is up.
class TimeLimit {
 public:
  explicit TimeLimit(ThreadTeam& team) : team_(team), end_(std::chrono::steady_clock::now() + kMostTime) {
    team_.set_watch([this](std::int64_t, std::int64_t) {
      if (std::chrono::steady_clock::now() > end_) throw OutOfTime();
    });
  }
  ~TimeLimit() { team_.set_watch({}); }
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;

 private:
  ThreadTeam& team_;
  std::chrono::steady_clock::time_point end_;
};

/// Of the relaxations, tried one by one, which helped.
struct Trials {
  std::vector<std::string> helped;
  std::size_t tried = 0;
  std::size_t all = 0;
};

/// A fault in building the copy, or no memory for it, leaves its relaxation untried.
Trials try_all(const CoarseCopy& copy, Fault fault, ThreadTeam& team) {
  const std::vector<Relaxation> all = relaxations(copy.spec);
  Trials trials{.all = all.size()};
  const TimeLimit limit(team);
  try {
    for (const Relaxation& relaxation : all) {
      ProblemSpec relaxed = copy.spec;
      relaxation.apply(relaxed);
      try {
        const bool helps = fault_of(relaxed, team) < fault;
        ++trials.tried;
        if (helps) trials.helped.push_back(relaxation.text);
      } catch (const std::exception&) {  // as a state off its grid
        continue;
      }
    }
  } catch (const OutOfTime&) {
    return trials;
  }
  return trials;
}

std::string place_of_trials(const CoarseCopy& copy) {
  if (copy.factor == 1) return "";
  return fmt::format(" on a copy with {} cells (steps up to {} times as long)", grouped(copy.cells),
                     copy.factor);
}

constexpr std::string_view kAskExplain = "; 'coordreq explain' shows what goes wrong at a state";

/// What would help, as the end of a sentence. @param otherwise is added if nothing does
std::string remedies(const ProblemSpec& spec, std::size_t partition, Fault fault, std::string_view otherwise,
                     ThreadTeam& team) {
  try {
    const std::optional<CoarseCopy> copy = coarse_copy(spec, partition, kMostCells, kMostEntries);
    if (!copy) return "";
    const Trials trials = try_all(*copy, fault, team);
    if (trials.tried == 0) return "";
    const std::string count =
        fmt::format("of {} changes tried one by one{}", trials.tried, place_of_trials(*copy));
    if (trials.helped.empty()) return fmt::format("; {}, none helps{}", count, otherwise);
    return fmt::format("; {}, it helps if {}", count, fmt::join(trials.helped, ", or if "));
  } catch (const std::exception&) {
    return "";
  }
}

}  // namespace

Warnings advise_on_answers(const Answers& answers, ThreadTeam& team) {
  const ProblemSpec& spec = answers.ground.spec;
  const std::vector<PartitionSpec>& partitions = spec.coordination.partitions;
  std::vector<std::size_t> silent;  // without any silence
  for (std::size_t p = 0; p < partitions.size(); ++p) {
    const Fault fault = fault_of(answers, p);
    if (fault == Fault::empty) {
      const bool is_unsafe = answers.ground.safe_cells == 0;
      return {{"empty", is_unsafe ? "/safe" : "",
               fmt::format("the {} set is empty on this grid{}", is_unsafe ? "safe" : "invariance",
                           remedies(spec, p, fault, is_unsafe ? "" : kAskExplain, team))}};
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
                   remedies(spec, silent.front(), Fault::no_silence, kAskExplain, team))}};
}

}  // namespace coordreq
