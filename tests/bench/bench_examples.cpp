// What do the paper's examples cost, whole command with results file, next to one naive sweep over all pairs
// of states and inputs of the intersection? Compare lines of one run: seconds differ between machines.

#include <benchmark/benchmark.h>

#include <array>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <vector>

#include "analysis/analyze.hpp"
#include "answers/invariance/safe_set.hpp"
#include "base/timer.hpp"
#include "engine/row_engine.hpp"
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
      RowPlace place(engine_.grid(), range.begin);
      for (; place.row < range.end; place.advance(engine_.grid())) {
        found[static_cast<std::size_t>(worker)] += row(place);
      }
    });
    std::int64_t total = 0;
    for (const std::int64_t count : found) total += count;
    return total;
  }

 private:
  static constexpr std::size_t kWords = 4;
  typedef std::uint64_t Bits __attribute__((vector_size(32), aligned(8)));

  [[nodiscard]] std::int64_t row(const RowPlace& place) const {
    std::array<std::int64_t, 4> base{};
    for (std::size_t t = 0; t < base.size(); ++t) base[t] = place.offset(engine_.slices()[t].state_stride);
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
