#include "reach/usual_slices.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <vector>

#include "base/index.hpp"
#include "expression/evaluate.hpp"
#include "reach/table_shapes.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

constexpr int kDrawnRows = 384;
constexpr std::int64_t kDrawnCells = 32;

/// Ends of a post, of one cell after the other.
using Row = std::vector<std::int32_t>;

class RowDraw {
 public:
  RowDraw(const SystemSpec& spec, std::size_t state, const TableShape& shape, std::size_t along)
      : spec_(spec),
        shape_(shape),
        state_(state),
        along_(along),
        evaluator_(spec.dynamics.equations[state]),
        slots_(spec.slot_count()),
        period_(nearest_double(spec.dynamics.period)) {
    for (const StateSpec& one : spec.states)
      scales_.push_back({nearest_double(one.grid.first), nearest_double(one.grid.step)});
    begin_ = below(spec.states[along].grid.count - cells() + 1);
    for (std::size_t i = 0; i < spec.states.size(); ++i) set_state(i, spec.states[i].grid.count / 2);
    for (std::size_t i = 0; i < spec.inputs.size(); ++i)
      slots_[spec.input_slot(i)] = Interval(0, 0);  // the table does not depend on it, or it is drawn
    for (std::size_t i = 0; i < spec.disturbances.size(); ++i)
      slots_[spec.disturbance_slot(i)] = enclose(spec.disturbances[i].lower, spec.disturbances[i].upper);
  }

  /// A segment of another row.
  Row next() {
    for (const std::int32_t j : shape_.states) set_state(at(j), below(spec_.states[at(j)].grid.count));
    for (const std::int32_t j : shape_.inputs) {
      const std::vector<Rational>& values = spec_.inputs[at(j)].values;
      const Rational& value = values[at(below(std::ssize(values)))];
      slots_[spec_.input_slot(at(j))] = enclose(value, value);
    }
    Row row;
    for (std::int64_t c = begin_; c < begin_ + cells(); ++c) {
      set_state(along_, c);
      add_post(state_ == along_ ? c : 0, row);
    }
    return row;
  }
  [[nodiscard]] std::int64_t cells() const { return std::min(spec_.states[along_].grid.count, kDrawnCells); }

 private:
  std::int64_t below(std::int64_t count) {
    return static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(count));
  }

  void set_state(std::size_t i, std::int64_t index) {
    const Scale& scale = scales_[i];
    const double centre = scale.first + scale.step * static_cast<double>(index);
    const double radius = spec_.states[i].discrete ? 0 : scale.step / 2;
    slots_[spec_.state_slot(i)] = Interval(centre - radius, centre + radius);
  }

  /// @param from index that the ends are relative to
  void add_post(std::int64_t from, Row& row) {
    Interval next = evaluator_.number(slots_);
    if (spec_.dynamics.time == Time::continuous) {
      const Interval& present = slots_[spec_.state_slot(state_)];
      next = Interval(present.lower + period_ * next.lower, present.upper + period_ * next.upper);
    }
    const Scale& scale = scales_[state_];
    const auto count = static_cast<double>(spec_.states[state_].grid.count);
    for (const double end : {next.lower, next.upper}) {
      const double index = std::floor((end - scale.first) / scale.step + 0.5);
      const double inside = std::isnan(index) ? -1 : std::clamp(index, -1.0, count);
      row.push_back(static_cast<std::int32_t>(static_cast<std::int64_t>(inside) - from));
    }
  }

  /// Of a grid: its first point and its step, which are computed from exact numbers only once.
  struct Scale {
    double first;
    double step;
  };

  const SystemSpec& spec_;
  const TableShape& shape_;
  std::size_t state_;
  std::size_t along_;
  Evaluator<Interval> evaluator_;
  std::vector<Interval> slots_;
  double period_;
  std::vector<Scale> scales_;  ///< [state]
  std::mt19937_64 random_{20180410};
  std::int64_t begin_ = 0;  ///< of the segment, the same in all rows
};

double segments_of(const Row& row) {
  double segments = 1;
  for (std::size_t i = 2; i < row.size(); i += 2)
    segments += row[i] != row[i - 2] || row[i + 1] != row[i - 1] ? 1 : 0;
  return segments;
}

/// The number of kinds, from the numbers of times that the drawn ones came (Chao's estimator), on the high
/// side.
double kinds(const std::map<Row, int>& drawn, double all) {
  constexpr double kFew = 3, kMore = 1.5;
  double once = 0, twice = 0;
  for (const auto& [row, times] : drawn) {
    once += times == 1 ? 1 : 0;
    twice += times == 2 ? 1 : 0;
  }
  if (2 * once > kDrawnRows && twice < kFew) return all;
  const double unseen = once * std::max(once - 1, 0.0) / (2 * (twice + 1));
  return std::min(all, kMore * (static_cast<double>(drawn.size()) + unseen));
}

}  // namespace

UsualSlices usual_slices(const SystemSpec& spec, std::size_t state, const TableShape& shape,
                         std::size_t along) {
  std::vector<std::int32_t> across = shape.states;
  std::erase(across, static_cast<std::int32_t>(along));
  RowDraw draw(spec, state, shape, along);
  std::map<Row, int> drawn;
  double segments = 0;
  for (int k = 0; k < kDrawnRows; ++k) {
    const Row row = draw.next();
    segments += segments_of(row) / kDrawnRows;
    ++drawn[row];
  }
  const auto length = static_cast<double>(spec.states[along].grid.count);
  return {.segments = 1 + (segments - 1) * length / static_cast<double>(draw.cells()),
          .different = kinds(drawn, choices_of(spec, across, shape.inputs))};
}

}  // namespace coordreq
