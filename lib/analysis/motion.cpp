#include "analysis/motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <utility>

#include "base/index.hpp"
#include "cell/random_stream.hpp"
#include "expression/evaluate.hpp"
#include "numeric/interval.hpp"
#include "reach/point_flow.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

constexpr std::size_t kMostCorners = 128;
constexpr std::size_t kBetween = 16;
constexpr double kMotionTolerance = 1e-7;  // six digits are displayed
/// Sub-steps of all solutions: some hundred each, two thousand where they are stiff.
constexpr std::int64_t kMostTried = 300'000;

/// Ends of what each slot can be.
struct Ends {
  double lower = 0, upper = 0;
};

std::vector<Ends> ends_of(const SystemSpec& spec) {
  std::vector<Ends> all;
  for (const StateSpec& state : spec.states) {
    const Rational last = state.grid.last();
    const Rational half = state.discrete ? Rational(0) : Rational(state.grid.step / 2);
    const Rational below = state.below == Outside::stop ? Rational(0) : half;
    const Rational above = state.above == Outside::stop ? Rational(0) : half;
    all.push_back({nearest_double(state.grid.first - below), nearest_double(last + above)});
  }
  for (const InputSpec& input : spec.inputs) {
    const auto [least, most] = std::minmax_element(input.values.begin(), input.values.end());
    all.push_back({nearest_double(*least), nearest_double(*most)});
  }
  for (const DisturbanceSpec& disturbance : spec.disturbances)
    all.push_back({nearest_double(disturbance.lower), nearest_double(disturbance.upper)});
  return all;
}

/// Points to begin at, one value a slot.
class Starts {
 public:
  explicit Starts(const SystemSpec& spec)
      : spec_(spec), ends_(ends_of(spec)), draw_(0, 0, RandomStream::Purpose::start) {
    const std::size_t slots = ends_.size();
    corners_ = slots < 8 ? std::size_t{1} << slots : kMostCorners;
    is_every_corner_ = slots < 8;
  }

  [[nodiscard]] std::size_t count() const { return corners_ + kBetween; }

  std::vector<double> next() {
    std::vector<double> slots(ends_.size());
    const std::uint64_t bits = is_every_corner_ ? at_ : draw_.next();
    for (std::size_t s = 0; s < slots.size(); ++s) {
      const bool is_upper = (bits >> (s % 64) & 1U) != 0;
      slots[s] = at_ >= corners_ ? between(s) : is_upper ? ends_[s].upper : ends_[s].lower;
    }
    ++at_;
    return slots;
  }

 private:
  double between(std::size_t slot) {
    const double share = nearest_double(draw_.fraction());
    const double value = ends_[slot].lower + share * (ends_[slot].upper - ends_[slot].lower);
    const std::size_t states = spec_.states.size();
    if (slot < states && spec_.states[slot].discrete) {
      const double first = nearest_double(spec_.states[slot].grid.first);
      const double step = nearest_double(spec_.states[slot].grid.step);
      return first + std::round((value - first) / step) * step;
    }
    if (slot < states || slot >= states + spec_.inputs.size()) return value;
    const std::vector<Rational>& values = spec_.inputs[slot - states].values;
    return nearest_double(values[static_cast<std::size_t>(draw_.below(values.size()))]);
  }

  const SystemSpec& spec_;
  std::vector<Ends> ends_;
  RandomStream draw_;
  std::size_t corners_;
  bool is_every_corner_;
  std::size_t at_ = 0;
};

/// Ends of solutions after a period, of all states.
class Solutions {
 public:
  explicit Solutions(const SystemSpec& spec) {
    if (spec.dynamics.time == Time::discrete) {
      for (const Program& equation : spec.dynamics.equations) maps_.emplace_back(equation);
      return;
    }
    std::vector<std::int32_t> all(spec.states.size());
    std::iota(all.begin(), all.end(), 0);
    flow_.emplace(spec, all, kMotionTolerance, PointFlow::kFewSteps);
  }

  /// Whether so much was done that no more solutions are followed.
  [[nodiscard]] bool is_exhausted() const { return flow_ && flow_->tried() > kMostTried; }

  std::optional<std::vector<double>> end(const std::vector<double>& slots) {
    if (flow_) return flow_->after_period(slots);
    std::vector<double> result;
    for (Evaluator<double>& map : maps_) result.push_back(map.number(slots));
    return result;
  }

 private:
  std::optional<PointFlow> flow_;
  std::vector<Evaluator<double>> maps_;
};

/// Next values of the states that jump at samples, as their updates say.
class Jumps {
 public:
  explicit Jumps(const SystemSpec& spec) {
    for (std::size_t i = 0; i < spec.states.size(); ++i) {
      const UpdateSpec* const update = spec.dynamics.update(i);
      if (update != nullptr && !update->past) updates_.emplace_back(i, Evaluator<double>(update->value));
    }
  }

  /// Calls `add(i, next)` for each of them.
  template <class Add>
  void for_each(const std::vector<double>& slots, const Add& add) {
    for (auto& [i, update] : updates_) add(i, update.number(slots));
  }

 private:
  std::vector<std::pair<std::size_t, Evaluator<double>>> updates_;
};

double six_digits(double value) {
  return std::stod(fmt::format("{:.6g}", value));
}

}  // namespace

Motion sample_motion(const SystemSpec& spec) {
  Starts starts(spec);
  Solutions solutions(spec);
  Jumps jumps(spec);
  Motion result;
  std::vector<StateMotion>& all = result.states;
  all.resize(spec.states.size());
  for (std::size_t k = 0; k < starts.count(); ++k) {
    const std::vector<double> begin = starts.next();
    ++(solutions.is_exhausted() ? result.left_out : result.solutions);
    const auto end = solutions.is_exhausted() ? std::nullopt : solutions.end(begin);
    const auto add = [&](std::size_t i, double next) {
      const double moved = std::fabs(next - begin[i]);
      if (std::isfinite(moved)) all[i].amount = std::max(all[i].amount, moved);
    };
    for (std::size_t i = 0; end && i < all.size(); ++i) add(i, (*end)[i]);
    jumps.for_each(begin, add);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].cells = all[i].amount / nearest_double(spec.states[i].grid.step);
    all[i].share = all[i].cells / static_cast<double>(spec.states[i].grid.count);
  }
  return result;
}

Json motion_json(const SystemSpec& spec, const std::vector<StateMotion>& motion) {
  Json json = Json::array();
  for (std::size_t i = 0; i < motion.size(); ++i) {
    json.push_back({{"state", spec.states[i].name},
                    {"amount", six_digits(motion[i].amount)},
                    {"cells", six_digits(motion[i].cells)},
                    {"share", six_digits(motion[i].share)}});
  }
  return json;
}

}  // namespace coordreq
