#include "analysis/advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "base/index.hpp"
#include "base/requires.hpp"
#include "expression/evaluate.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

constexpr std::int64_t kStandingCells = 1024, kStandingInputs = 64;

/// Whether states and inputs are at rest: every derivative is 0, or leads out through a side that stops it.
class Rest {
 public:
  explicit Rest(const ProblemSpec& spec) : spec_(spec) {
    for (std::size_t i = 0; i < spec.states.size(); ++i) {
      const UpdateSpec* const update = spec.dynamics.update(i);
      rates_.emplace_back(update != nullptr ? update->value : spec.dynamics.equations[i]);
    }
    if (spec.controller.allow) allow_.emplace(*spec.controller.allow);
  }

  /// @param slots of states, inputs and disturbances
  [[nodiscard]] bool holds(const std::vector<double>& slots) {
    for (std::size_t i = 0; i < rates_.size(); ++i) {
      const double rate = rates_[i].number(slots);
      const bool is_kept = spec_.dynamics.update(i) != nullptr ? rate == slots[i] : stays(i, slots[i], rate);
      if (!is_kept) return false;
    }
    return !allow_ || allow_->condition(slots) == Truth::yes;
  }

 private:
  [[nodiscard]] bool stays(std::size_t i, double value, double rate) const {
    const StateSpec& state = spec_.states[i];
    const double first = nearest_double(state.grid.first);
    const double last = nearest_double(state.grid.last());
    return rate == 0 || (state.below == Outside::stop && value == first && rate < 0) ||
           (state.above == Outside::stop && value == last && rate > 0);
  }

  const ProblemSpec& spec_;
  std::vector<Evaluator<double>> rates_;
  std::optional<Evaluator<double>> allow_;
};

/// A cell at rest that is lost, and how.
struct Found {
  std::int64_t cell = 0;
  std::int64_t input = 0;
};

class StandingSearch {
 public:
  StandingSearch(const AnalysisContext& context, const CellSet& invariant)
      : context_(context),
        grid_(context.abstraction->grid),
        invariant_(invariant),
        rest_(context.spec),
        slots_(context.spec.states.size() + context.spec.inputs.size() + context.spec.disturbances.size()) {}

  /// Where all states that stop there are at their lower (upper) limit.
  std::optional<Found> run(bool above) {
    std::vector<std::int64_t> counts, index(grid_.size());
    std::int64_t all = 1;
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      const bool is_at_limit = traits(above ? grid_[i].above : grid_[i].below).stops;
      index[i] = is_at_limit && above ? grid_[i].count - 1 : 0;
      counts.push_back(is_at_limit ? 1 : grid_[i].count);
      all *= counts.back();
    }
    const std::int64_t step = all / kStandingCells + 1;
    for (std::int64_t k = 0; k < all; k += step) {
      std::int64_t rest = k, cell = 0;
      for (std::size_t i = grid_.size(); i-- > 0; rest /= counts[i])
        cell += (index[i] + rest % counts[i]) * grid_.stride(i);
      if (!context_.safe.test(cell) || invariant_.test(cell)) continue;
      if (const std::optional<std::int64_t> u = input_at_rest(cell)) return Found{cell, *u};
    }
    return std::nullopt;
  }

 private:
  std::optional<std::int64_t> input_at_rest(std::int64_t cell) {
    for (std::size_t i = 0; i < grid_.size(); ++i)
      slots_[grid_.state(i)] = nearest_double(grid_[i].point(grid_.index(cell, i)));
    const InputSpace& inputs = context_.abstraction->inputs;
    const std::int64_t step = inputs.count() / kStandingInputs + 1;
    for (std::int64_t u = 0; u < inputs.count(); u += step) {
      for (std::size_t j = 0; j < inputs.size(); ++j)
        slots_[grid_.size() + j] = nearest_double(inputs[j].values[at(inputs.index(u, j))]);
      if (rest_.holds(slots_)) return u;
    }
    return std::nullopt;
  }

  const AnalysisContext& context_;
  const UniformGrid& grid_;
  const CellSet& invariant_;
  Rest rest_;
  std::vector<double> slots_;
};

/// Whether something that is said of standing states would be right.
bool may_ask(const ProblemSpec& spec) {
  const std::size_t known = spec.states.size() + spec.inputs.size();
  if (spec.dynamics.time == Time::discrete || spec.controller.synthesis == Synthesis::given ||
      spec.controller.file ||
      std::ranges::none_of(spec.states, [](const StateSpec& state) { return state.has(Outside::stop); }))
    return false;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    if (spec.dynamics.is_kept(i)) return false;
    const std::vector<std::uint32_t> slots = spec.dynamics.equations[i].variables();
    if (!slots.empty() && slots.back() >= known) return false;
  }
  if (!spec.controller.allow) return true;
  const std::vector<std::uint32_t> slots = spec.controller.allow->variables();
  return slots.empty() || slots.back() < known;
}

/// A state at its limit, and another that moves with it; nothing if nothing else does.
std::optional<std::pair<std::size_t, std::size_t>> mover(const ProblemSpec& spec, bool above) {
  for (std::size_t j = 0; j < spec.states.size(); ++j) {
    if ((above ? spec.states[j].above : spec.states[j].below) != Outside::stop) continue;
    for (std::size_t i = 0; i < spec.states.size(); ++i) {
      const std::vector<std::uint32_t> slots = spec.dynamics.equations[i].variables();
      if (i != j && std::ranges::binary_search(slots, static_cast<std::uint32_t>(j))) return {{j, i}};
    }
  }
  return std::nullopt;
}

std::string values_text(const UniformGrid& grid, std::int64_t cell) {
  std::string text;
  for (std::size_t state = 0; state < grid.size(); ++state) {
    const std::size_t i = grid.dimension_of(state);
    text += fmt::format("{}{} = {:.6g}", text.empty() ? "" : ", ", grid[i].name,
                        nearest_double(grid[i].point(grid.index(cell, i))));
  }
  return text;
}

std::string inputs_text(const ProblemSpec& spec, const InputSpace& inputs, std::int64_t u) {
  std::string text;
  for (std::size_t j = 0; j < inputs.size(); ++j)
    text += fmt::format("{}{} = {:.6g}", text.empty() ? "" : ", ", spec.inputs[j].name,
                        nearest_double(inputs[j].values[at(inputs.index(u, j))]));
  return text;
}

/// "\"lower\": -0.125, \"origin\": 0.125": with it a face of cells is at the limit.
std::string face_text(const StateSpec& state, bool above) {
  const Rational half = state.grid.step / 2;
  const Rational end = above ? Rational(state.grid.last() + half) : Rational(state.grid.first - half);
  const Rational origin = above ? end : Rational(state.grid.first + half);
  return fmt::format("\"{}\": {:.6g}, \"origin\": {:.6g}", above ? "upper" : "lower", nearest_double(end),
                     nearest_double(origin));
}

}  // namespace

Warnings advise_on_standing(const AnalysisContext& context, const CellSet& invariant) {
  REQUIRES(!context.share && invariant.rows() == context.abstraction->grid.rows());
  const ProblemSpec& spec = context.spec;
  if (!may_ask(spec)) return {};
  for (const bool above : {false, true}) {
    const auto moving = mover(spec, above);
    if (!moving) continue;
    const std::optional<Found> found = StandingSearch(context, invariant).run(above);
    if (!found) continue;
    const auto& [held, moved] = *moving;
    const StateSpec& state = spec.states[held];
    return {
        {"standing", fmt::format("/states/{}", held),
         fmt::format(
             "at {} nothing moves with {}, yet the cell is not in the invariance set: cells of {} at "
             "its limit {:.6g} hold small values too, so that {} creeps to the next cell at every step, "
             "on finer grids as well; what can help: a face of half-open cells at the limit ({}), {} as a "
             "discrete set point, or \"saturate\" where it does no harm that {} passes the limit "
             "between samples",
             values_text(context.abstraction->grid, found->cell),
             inputs_text(spec, context.abstraction->inputs, found->input), state.name,
             nearest_double(above ? state.grid.last() : state.grid.first), spec.states[moved].name,
             face_text(state, above), state.name, state.name)}};
  }
  return {};
}

}  // namespace coordreq
