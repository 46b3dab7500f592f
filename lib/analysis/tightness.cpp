#include "analysis/tightness.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "analysis/coarse_copy.hpp"
#include "base/grouped.hpp"
#include "base/index.hpp"
#include "base/requires.hpp"
#include "reach/cells_meeting.hpp"
#include "reach/sampled_ends.hpp"
#include "reach/state_enclosure.hpp"

namespace coordreq {
namespace {

constexpr std::int64_t kPairs = 12;
/// Fractions of whose multiples no two are near one another: the golden ratio and the root of 2.
constexpr double kCellStride = 0.6180339887498949;
constexpr double kInputStride = 0.4142135623730951;
/// The error of a solution by rounding, in steps.
constexpr double kSampleSlack = 1e-9;
/// Number of the widest posts on which remedies are tried.
constexpr std::size_t kTried = 6;
constexpr std::int64_t kMoreEffort = 8;

/// A number below `count`, far from those before.
std::int64_t spread_out(std::int64_t k, double stride, std::int64_t count) {
  const double share = std::fmod(0.5 + static_cast<double>(k) * stride, 1.0);
  return std::min(count - 1, static_cast<std::int64_t>(share * static_cast<double>(count)));
}

std::vector<GridDimension> dimensions_of(const ProblemSpec& spec) {
  std::vector<GridDimension> all;
  for (const StateSpec& state : spec.states) all.push_back(dimension_of(state));
  return all;
}

/// Where the true state can be in a cell; nothing on a seam, where these are two intervals.
std::optional<std::vector<Interval>> boxes_of(const std::vector<GridDimension>& grid,
                                              const std::vector<std::int64_t>& cell) {
  std::vector<Interval> result;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const std::vector<Piece> intervals = pieces(grid[i], cell[i]);
    if (intervals.size() > 1) return std::nullopt;
    result.push_back(enclose(intervals.front().lower, intervals.front().upper));
  }
  return result;
}

/// Number of cells that a hull of solutions meets.
std::int64_t cells_needed(const GridDimension& dimension, const Interval& ends) {
  const double step = nearest_double(dimension.step);
  const double first = nearest_double(dimension.first);
  const double error = nearest_double(dimension.measurement_error);
  const double begin = std::ceil((ends.lower - error - first) / step - 0.5 - kSampleSlack);
  const double end = std::floor((ends.upper + error - first) / step + 0.5 + kSampleSlack);
  return static_cast<std::int64_t>(std::max(end - begin, 0.0)) + 1;
}

std::int64_t length_of(IndexRange range) {
  return std::int64_t{range.last} - range.first + 1;
}

bool is_cut_off(IndexRange range) {
  return range.first == std::numeric_limits<std::int32_t>::min() ||
         range.last == std::numeric_limits<std::int32_t>::max();
}

/// The slots of a cell and a joint input; what the cell has no single box for stays a point.
std::vector<Interval> slots_of(const ProblemSpec& spec, const InputSpace& inputs,
                               const std::vector<Interval>& boxes, std::int64_t input) {
  std::vector<Interval> slots(spec.slot_count());
  for (std::size_t i = 0; i < boxes.size(); ++i) slots[spec.state_slot(i)] = boxes[i];
  for (std::size_t j = 0; j < inputs.size(); ++j) {
    slots[spec.input_slot(j)] = enclose(inputs[j].values[static_cast<std::size_t>(inputs.index(input, j))]);
  }
  return slots;
}

/// The excess of a post of another spec with the same states and inputs, from the box of a cell of this one;
/// nothing if it has none or cannot be compared.
std::optional<double> excess_of(const ProblemSpec& spec, const std::vector<Interval>& slots,
                                std::size_t state) {
  const std::vector<std::size_t> states{state};
  StateEnclosure enclosure(spec, find_dependencies(spec, state), states);
  for (std::size_t s = 0; s < spec.states.size() + spec.inputs.size(); ++s) {
    enclosure.set(static_cast<std::uint32_t>(s), slots[s]);
  }
  enclosure.enclose();
  const StateEnclosure::Result result = enclosure.result(state);
  SampledEnds samples(spec);
  const std::optional<Interval> needed = samples.next(state, slots);
  if (result.status != StateEnclosure::Status::ok || !needed || !result.value.is_finite())
    return std::nullopt;
  const GridDimension dimension = dimension_of(spec.states[state]);
  const Cells cells = spec.abstraction.cells;
  const IndexRange range = enclosure.shifts() ? cells_meeting_shifted(dimension, cells, result.value)
                                              : cells_meeting(dimension, cells, result.value);
  return static_cast<double>(std::max<std::int64_t>(length_of(range) - cells_needed(dimension, *needed), 0));
}

/// The boxes halved in every continuous dimension, each lower half and each upper half once.
std::vector<std::vector<Interval>> halves_of(const ProblemSpec& spec, const std::vector<Interval>& slots) {
  std::vector<std::vector<Interval>> result(2, slots);
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    Interval& lower = result[0][spec.state_slot(i)];
    Interval& upper = result[1][spec.state_slot(i)];
    lower.upper = upper.lower = lower.is_point() ? lower.lower : midpoint(lower);
  }
  return result;
}

struct Remedy {
  std::string text;  ///< "a period half as long"
  std::function<void(ProblemSpec&)> apply;
  bool halves_cells = false;
};

std::vector<Remedy> remedies(const ProblemSpec& spec) {
  std::vector<Remedy> all;
  if (spec.dynamics.time == Time::continuous) {
    all.push_back({"a period half as long", [](ProblemSpec& copy) { copy.dynamics.period /= 2; }});
  }
  all.push_back({"steps half as long",
                 [](ProblemSpec& copy) {
                   for (StateSpec& state : copy.states) regrid(state, Rational(1, 2));
                 },
                 true});
  const std::int64_t effort = std::max<std::int64_t>(spec.abstraction.effort, 25) * kMoreEffort;
  all.push_back({fmt::format("an \"effort\" of {}", grouped(effort)),
                 [effort](ProblemSpec& copy) { copy.abstraction.effort = effort; }});
  return all;
}

/// The mean excess of the widest posts of the sample with a remedy; nothing if it is unknown for one, or
/// the first, which is the widest, gets no better: more effort in vain costs more than all the rest.
std::optional<double> excess_with(const ProblemSpec& spec, const Remedy& remedy,
                                  std::span<const Tightness::Post> posts) {
  ProblemSpec copy = spec;
  remedy.apply(copy);
  const InputSpace inputs = make_input_space(spec);
  const std::vector<GridDimension> grid = dimensions_of(spec);
  double sum = 0.0;
  for (const Tightness::Post& post : posts) {
    const auto boxes = boxes_of(grid, post.cell);
    if (!boxes) return std::nullopt;
    const std::vector<Interval> slots = slots_of(copy, inputs, *boxes, post.input);
    double most = 0.0;
    for (const auto& box :
         remedy.halves_cells ? halves_of(copy, slots) : std::vector<std::vector<Interval>>{slots}) {
      const std::optional<double> excess = excess_of(copy, box, post.state);
      if (!excess) return std::nullopt;
      most = std::max(most, *excess);
    }
    if (&post == posts.data() && most >= static_cast<double>(post.excess)) return std::nullopt;
    sum += most;
  }
  return sum / static_cast<double>(posts.size());
}

}  // namespace

double Tightness::mean() const {
  const auto add = [](double sum, const Post& post) { return sum + static_cast<double>(post.excess); };
  return posts.empty()
             ? 0.0
             : std::accumulate(posts.begin(), posts.end(), 0.0, add) / static_cast<double>(posts.size());
}

std::int64_t Tightness::p99() const {
  if (posts.empty()) return 0;
  std::vector<std::int64_t> all;
  for (const Post& post : posts) all.push_back(post.excess);
  std::sort(all.begin(), all.end());
  return all[(all.size() * 99 + 99) / 100 - 1];
}

std::int64_t Tightness::most() const {
  std::int64_t result = 0;
  for (const Post& post : posts) result = std::max(result, post.excess);
  return result;
}

double Tightness::share() const {
  const auto loose =
      std::count_if(posts.begin(), posts.end(), [](const Post& post) { return post.excess > 1; });
  return posts.empty() ? 0.0 : static_cast<double>(loose) / static_cast<double>(posts.size());
}

std::optional<Tightness> find_tightness(const AnalysisContext& context) {
  REQUIRES(context.engine && context.hull);
  const Abstraction& abstraction = *context.abstraction;
  if (abstraction.exact) return std::nullopt;
  const ProblemSpec& spec = context.spec;
  const std::vector<GridDimension> grid = dimensions_of(spec);
  const std::int64_t pairs = std::min(kPairs, abstraction.grid.cells() * abstraction.inputs.count());
  std::vector<Tightness::Post> posts;
  std::vector<std::int64_t> excess;  // one more than it is; 0: not known here
  SampledEnds samples(spec);
  for (std::int64_t k = 0; k < pairs; ++k) {
    const std::int64_t x = spread_out(k, kCellStride, abstraction.grid.cells());
    const std::int64_t u = spread_out(k, kInputStride, abstraction.inputs.count());
    std::vector<std::int64_t> cell(grid.size());
    std::int64_t position = 0;
    for (std::int64_t rest = x, i = std::ssize(grid); i-- > 0;) {
      cell[at(i)] = rest % grid[at(i)].count;
      rest /= grid[at(i)].count;
      position += cell[at(i)] * abstraction.grid.stride(abstraction.grid.dimension_of(at(i)));
    }
    const auto boxes = boxes_of(grid, cell);
    if (!boxes) continue;
    const bool is_local = context.share == std::nullopt ||
                          (position / abstraction.grid.row_length() >= context.share->local().begin &&
                           position / abstraction.grid.row_length() < context.share->local().end);
    const std::vector<Interval> slots = slots_of(spec, abstraction.inputs, *boxes, u);
    for (std::size_t i = 0; i < grid.size(); ++i) {
      if (grid[i].discrete || spec.dynamics.update(i) != nullptr) continue;
      posts.push_back({.state = i, .cell = cell, .input = u});
      excess.push_back(0);
      if (!is_local) continue;
      const IndexRange range = abstraction.raw(abstraction.grid.dimension_of(i), position, u);
      const std::optional<Interval> needed = samples.next(i, slots);
      if (!needed || is_cut_off(range)) continue;
      excess.back() = 1 + std::max<std::int64_t>(length_of(range) - cells_needed(grid[i], *needed), 0);
    }
  }
  if (context.ranks != nullptr && context.share) context.ranks->add(excess);
  Tightness result;
  for (std::size_t p = 0; p < posts.size(); ++p) {
    if (excess[p] == 0) {
      ++result.left_out;
      continue;
    }
    posts[p].excess = excess[p] - 1;
    result.posts.push_back(std::move(posts[p]));
  }
  return result;
}

Json tightness_json(const std::optional<Tightness>& tightness) {
  if (!tightness) return {};
  return {{"posts", tightness->posts.size()},
          {"mean", tightness->mean()},
          {"p99", tightness->p99()},
          {"most", tightness->most()},
          {"share", tightness->share()}};
}

Warnings advise_on_tightness(const ProblemSpec& spec, const std::optional<Tightness>& tightness) {
  if (!tightness || tightness->p99() <= 1) return {};
  std::vector<Tightness::Post> widest = tightness->posts;
  const auto wider = [](const Tightness::Post& a, const Tightness::Post& b) { return a.excess > b.excess; };
  std::stable_sort(widest.begin(), widest.end(), wider);
  while (widest.size() > kTried || widest.back().excess <= 1) widest.pop_back();
  double before = 0.0;
  for (const Tightness::Post& post : widest) before += static_cast<double>(post.excess);
  before /= static_cast<double>(widest.size());
  std::vector<std::string> helps;
  for (const Remedy& remedy : remedies(spec)) {
    const std::optional<double> after = excess_with(spec, remedy, widest);
    if (after && *after < before) helps.push_back(fmt::format("{} (to {:.3g})", remedy.text, *after));
  }
  const std::string help = helps.empty()
                               ? "no single change (shorter period, smaller steps, more effort) helps"
                               : fmt::format("changes that help: {}", fmt::join(helps, ", "));
  return {
      {"tightness", "/abstraction",
       fmt::format(
           "successor sets are wider than simulated solutions: the widest of a sample by {:.3g} cells; {}",
           before, help)}};
}

}  // namespace coordreq
