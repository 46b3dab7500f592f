// How long do the parts of an analysis take, and the whole? Compare the ratios of lines of one run, not runs.

#include <benchmark/benchmark.h>

#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "analysis/analyze.hpp"
#include "answers/countdown/delay_layers.hpp"
#include "answers/invariance/invariance.hpp"
#include "answers/invariance/safe_set.hpp"
#include "choices/projections.hpp"
#include "engine/join_rows.hpp"
#include "engine/tiles.hpp"
#include "model/model.hpp"
#include "reach/build_abstraction.hpp"
#include "reach/table_shapes.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

ProblemSpec circle() {
  return read_spec_file(COORDREQ_CONFIGS "/circle.json", std::cin);
}

/// Question: what does building the tables cost next to using them?
void abstraction(benchmark::State& state) {
  const ProblemSpec spec = circle();
  ThreadTeam team(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(build_abstraction(spec, team));
}
BENCHMARK(abstraction)->ArgName("threads")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Question: how many state-input pairs a second does one full sweep settle?
void sweep(benchmark::State& state) {
  const ProblemSpec spec = circle();
  ThreadTeam team(static_cast<int>(state.range(0)));
  const Abstraction built = build_abstraction(spec, team);
  const CellSet safe = safe_set(spec, built, team);
  const RowEngine engine(built, nullptr, {});
  const RowHull hull(engine);
  const Invariance invariance = find_invariance(engine, hull, safe, Synthesis::maximal, {}, team);
  const ActionGrouping grouping(engine, single_classes(built.inputs), team);
  const Controller controller{&engine, &invariance.invariant, &invariance.collision_time, Synthesis::maximal};
  for (auto _ : state) benchmark::DoNotOptimize(Projections(controller, grouping, team));
  state.counters["pairs/s"] =
      benchmark::Counter(static_cast<double>(built.grid.cells()) * static_cast<double>(built.inputs.count()),
                         benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(sweep)->ArgName("threads")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Question: what does looking for equal work save where there is much (the gridworld), and what does it cost
/// where there is none (the circle)? K with tiles of single rows, or without.
void equal_work(benchmark::State& state, const std::string& name) {
  const ProblemSpec spec = read_spec_file(std::string(COORDREQ_CONFIGS "/") + name + ".json", std::cin);
  ThreadTeam team(1);
  const Model model(spec, table_shapes(spec));
  Abstraction built = arranged(build_abstraction(spec, team), model.order());
  built.grid = join_rows(built, model.most_along());
  const CellSet safe = safe_set(spec, built, team);
  const RowEngine engine(built, nullptr, {});
  const RowHull hull(engine);
  for (auto _ : state) {
    const std::optional<Tiles> tiles =
        state.range(0) == 0 ? std::nullopt : Tiles::make(engine, hull, engine.across());
    benchmark::DoNotOptimize(find_invariance(engine, hull, safe, Synthesis::maximal, {}, team,
                                             {.tiles = tiles ? &*tiles : nullptr}));
  }
}
BENCHMARK_CAPTURE(equal_work, gridworld, "gridworld")
    ->ArgName("tiles")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(equal_work, circle, "circle")
    ->ArgName("tiles")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond);

/// Question: what does the whole circle cost, results file written?
void whole_circle(benchmark::State& state) {
  const ProblemSpec spec = circle();
  ThreadTeam team(static_cast<int>(state.range(0)));
  const std::filesystem::path output = std::filesystem::temp_directory_path() / "coordreq_bench_circle.h5";
  for (auto _ : state) {
    benchmark::DoNotOptimize(analyze(spec, {.output = output.string()}, team));
  }
  std::filesystem::remove(output);
}
BENCHMARK(whole_circle)->ArgName("threads")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace coordreq
