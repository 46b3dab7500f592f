// What do the paper's examples cost, whole command with results file, next to one naive sweep over all pairs
// of states and inputs of the intersection? Compare lines of one run: seconds differ between machines.

#include <benchmark/benchmark.h>

#include <array>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <vector>

#include "analysis/analyze.hpp"
#include "answers/answers.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/invariance/safe_set.hpp"
#include "answers/plan.hpp"
#include "answers/risk/risk.hpp"
#include "base/timer.hpp"
#include "choices/independent_actions.hpp"
#include "engine/row_engine.hpp"
#include "engine/row_operations.hpp"
#include "reach/build_abstraction.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

ProblemSpec config(const std::string& name) {
  return read_spec_file(std::string(COORDREQ_CONFIGS "/") + name + ".json", std::cin);
}

/// The sweep of a prototype: bits, no classes of inputs, nothing remembered. For every row of 201 cells and
/// every pair of inputs the AND of the box of rows, eroded along the row.
class NaiveSweep {
 public:
  NaiveSweep(const RowEngine& engine, const CellSet& set) : engine_(engine), set_(set) {}

  /// {x : some input pair keeps x inside}, counted.
  std::int64_t run(ThreadTeam& team) const {
    std::vector<std::int64_t> found(static_cast<std::size_t>(team.size()), 0);
    team.for_each(engine_.rows(), 64, [&](ThreadTeam::Range range, int worker) {
      RowPosition position(engine_.grid(), range.begin);
      for (; position.row < range.end; position.advance(engine_.grid())) {
        found[static_cast<std::size_t>(worker)] += row(position);
      }
    });
    std::int64_t total = 0;
    for (const std::int64_t count : found) total += count;
    return total;
  }

 private:
  static constexpr std::size_t kWords = 4;
  typedef std::uint64_t Bits __attribute__((vector_size(32), aligned(8)));

  [[nodiscard]] std::int64_t row(const RowPosition& position) const {
    std::array<std::int64_t, 4> base{};
    for (std::size_t t = 0; t < base.size(); ++t) base[t] = position.offset(engine_.slices()[t].state_stride);
    Bits some{};
    const InputSpace& inputs = engine_.abstraction().inputs;
    for (std::int64_t u = 0; u < inputs[0].count(); ++u) {
      for (std::int64_t v = 0; v < inputs[1].count(); ++v) some |= pair(base, u, v);
    }
    std::int64_t count = 0;
    for (std::size_t w = 0; w < kWords; ++w) count += std::popcount(some[w]);
    return count;
  }

  [[nodiscard]] const RowSegment& segment(const std::array<std::int64_t, 4>& base, std::size_t t,
                                          std::int64_t u, std::int64_t v) const {
    const RowSlices& slices = engine_.slices()[t];
    const std::int64_t entry = base[t] + u * slices.input_stride[0] + v * slices.input_stride[1];
    return slices.slices[slices.ids[static_cast<std::size_t>(entry)]].front();
  }

  [[nodiscard]] Bits pair(const std::array<std::int64_t, 4>& base, std::int64_t u, std::int64_t v) const {
    std::array<IndexRange, 3> box;
    for (std::size_t t = 0; t < 3; ++t) {
      const RowSegment& part = segment(base, t, u, v);
      if (part.kind != RowSegment::Kind::fixed) return Bits{};
      box[t] = part.range;
    }
    Bits all = ~Bits{};
    for (std::int64_t a = box[0].first; a <= box[0].last; ++a) {
      for (std::int64_t b = box[1].first; b <= box[1].last; ++b) {
        for (std::int64_t c = box[2].first; c <= box[2].last; ++c) {
          const std::int64_t number = a * engine_.grid().row_stride(0) + b * engine_.grid().row_stride(1) +
                                      c * engine_.grid().row_stride(2);
          all &= *reinterpret_cast<const Bits*>(set_.row(number).data());
        }
      }
    }
    const RowSegment& last = segment(base, 3, u, v);
    Bits result = ~Bits{};
    for (std::int64_t s = last.range.first; s <= last.range.last; ++s) result &= shifted(all, s);
    return result;
  }

  /// Towards bit 0 by less than a word, ones coming in: the last side is safe.
  static Bits shifted(const Bits& bits, std::int64_t s) {
    if (s <= 0) return bits;
    const Bits next = {bits[1], bits[2], bits[3], ~std::uint64_t{0}};
    return bits >> s | next << (64 - s);
  }

  const RowEngine& engine_;
  const CellSet& set_;
};

/// Question: how long is one sweep over the 1.7e10 pairs of the intersection?
void naive_sweep(benchmark::State& state) {
  const ProblemSpec spec = config("intersection");
  ThreadTeam team(static_cast<int>(state.range(0)));
  const Abstraction abstraction = build_abstraction(spec, team);
  const RowEngine engine(abstraction, nullptr, {});
  const CellSet safe = safe_set(spec, abstraction, team);
  const NaiveSweep sweep(engine, safe);
  for (auto _ : state) benchmark::DoNotOptimize(sweep.run(team));
}
BENCHMARK(naive_sweep)->ArgName("threads")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Question: what does a step of the risk in one mode cost, as a multiple of a sweep of the layers? Both ask
/// for the minimum over all of IND_C at every cell of K, of 8 bits and of 32, without looking at what has
/// changed; the step finds the expectation of two modes before.
template <class Level>
void sweep(benchmark::State& state, const std::string& name) {
  ProblemSpec spec = config(name);
  ThreadTeam team(2);
  const Model model = make_model(spec);
  Answers answers(model);
  std::vector<Stage> stages = answer_stages(spec);
  std::erase_if(stages, [](const Stage& stage) { return stage.name.starts_with("layers"); });
  run_stages(stages, answers, {.team = team});
  const RowEngine& engine = *answers.context.engine;
  const CellSet& invariant = answers.get<Invariance>().invariant;
  const std::vector<InputClass> classes = single_classes(engine.abstraction().inputs);
  const ActionGrouping grouping(engine, classes, team);
  const Projections projections(answers.get<Controller>(), grouping, team);
  IndependentActions<Level> actions(projections, invariant, team.size());
  auto levels = engine.make_levels<Level>(invariant, team);
  const ExpectedRisk expected({{0, Rational(9, 10), Rational(9, 10)}, {1, Rational(1, 10), Rational(1, 10)}});
  const std::vector<RiskRows> risks = first_risks(invariant, 2, nullptr);
  const auto n = static_cast<std::size_t>(engine.row_length());
  for (auto _ : state) {
    team.for_each(engine.rows(), 64, [&](ThreadTeam::Range range, int worker) {
      PostReader<Level> posts(engine, levels);
      std::vector<Level> next(posts.lanes());
      RowPosition position(engine.grid(), range.begin);
      for (; position.row < range.end; position.advance(engine.grid())) {
        posts.enter(position.row);
        if (any_set(invariant.row(position.row))) actions.find_minimum(position, posts, next.data(), worker);
      }
    });
    if constexpr (sizeof(Level) == sizeof(std::uint32_t)) {
      team.for_each(engine.rows(), 64, [&](ThreadTeam::Range range, int) {
        for (std::int64_t row = range.begin; row < range.end; ++row) {
          const std::vector<const std::uint32_t*> rows = {risks[0].row(row), risks[1].row(row)};
          levels.change_row(row, [&](Level* cells) { expected.find(rows, n, cells); });
        }
      });
    }
  }
}
void layers_sweep(benchmark::State& state, const std::string& name) {
  sweep<std::uint8_t>(state, name);
}
void risk_step(benchmark::State& state, const std::string& name) {
  sweep<std::uint32_t>(state, name);
}
BENCHMARK_CAPTURE(layers_sweep, intersection, "intersection")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(risk_step, intersection, "intersection")->Unit(benchmark::kMillisecond)->UseRealTime();

/// Question: what do 250 steps of the risk in two modes cost, with the rest of the analysis?
void risk_of(benchmark::State& state, const std::string& name) {
  ProblemSpec spec = config(name);
  const std::string text =
      spec.text.substr(0, spec.text.rfind('}')) +
      R"(, "network": {"loss": 0.1}, "risk": {"horizon": 250, "coordinated": "safest"}})";
  spec = read_spec(text, name);
  ThreadTeam team(2);
  const std::filesystem::path output =
      std::filesystem::temp_directory_path() / ("coordreq_bench_risk_" + name + ".h5");
  for (auto _ : state) {
    const Json summary = analyze(spec, {.output = output.string()}, team);
    state.counters["risk_seconds"] = summary["seconds"]["risk"].get<double>();
  }
  std::filesystem::remove(output);
}
BENCHMARK_CAPTURE(risk_of, intersection_coarse, "intersection_coarse")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(risk_of, intersection, "intersection")->Unit(benchmark::kMillisecond)->UseRealTime();

/// Question: what does a whole analysis cost, results file written?
void whole(benchmark::State& state, const std::string& name) {
  const ProblemSpec spec = config(name);
  ThreadTeam team(static_cast<int>(state.range(0)));
  const std::filesystem::path output =
      std::filesystem::temp_directory_path() / ("coordreq_bench_" + name + ".h5");
  for (auto _ : state) benchmark::DoNotOptimize(analyze(spec, {.output = output.string()}, team));
  std::filesystem::remove(output);
  state.counters["cells"] = 1;
  for (const StateSpec& s : spec.states)
    state.counters["cells"] = state.counters["cells"] * static_cast<double>(s.grid.count);
}
BENCHMARK_CAPTURE(whole, circle, "circle")
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(whole, gridworld, "gridworld")
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(whole, intersection, "intersection")
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(whole, platoon, "platoon")
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(whole, load, "load")
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace coordreq
