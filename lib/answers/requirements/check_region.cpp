#include "answers/requirements/check_region.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "answers/checking/cell_pieces.hpp"
#include "answers/checking/corner_truth.hpp"
#include "base/requires.hpp"
#include "expression/condition.hpp"
#include "expression/evaluate.hpp"
#include "model/odometer.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using Box = std::vector<RationalInterval>;

Program negation_of(const Program& condition) {
  Program result = condition;
  const auto last = static_cast<std::uint32_t>(result.nodes.size() - 1);
  result.nodes.push_back({.op = Operator::logical_not, .a = last});
  return result;
}

/// Judges one box after the other. One object a thread.
class BoxJudge {
 public:
  BoxJudge(const Program& where, const Program& negation, const std::vector<std::size_t>& states,
           bool same_version)
      : decider_(where), nowhere_(negation, states), same_version_(same_version) {}

  [[nodiscard]] Meeting judge(const Box& box) {
    std::vector<Interval> rough;
    for (const RationalInterval& range : box) rough.push_back(enclose(range));
    const Truth truth = decider_.decide(std::span<const Interval>(rough),
                                        [&] { return std::span<const RationalInterval>(box); });
    if (truth == Truth::yes) return Meeting::counted;
    const Truth nowhere = nowhere_.everywhere(box);
    if (nowhere == Truth::no) return Meeting::counted;
    if (truth == Truth::undecided) return same_version_ ? Meeting::counted : Meeting::perhaps;
    return nowhere == Truth::yes ? Meeting::off : Meeting::doubted;
  }

 private:
  ConditionDecider decider_;
  CornerTruth nowhere_;
  bool same_version_;
};

/// The values of a state while another one is outside; an end is nothing if the state is unbounded there.
struct PlainExtent {
  std::optional<Rational> lower, upper;

  [[nodiscard]] Interval rough() const {
    return {lower ? lower_double(*lower) : -outward::kInfinity,
            upper ? upper_double(*upper) : outward::kInfinity};
  }
  [[nodiscard]] RationalInterval exact() const {
    if (!lower || !upper) return {.bounded = false};
    return {.lower = *lower, .upper = *upper};
  }
};

/// Halves a box in the coordinates t of x = t / (1 - |t|), which make the whole line finite. Boxes that
/// doubles leave open are judged again with the exact ends of the bounded states.
class CompactSearch {
 public:
  static constexpr int kMostBoxes = 4096;

  explicit CompactSearch(const Program& where)
      : rough_(where), exact_(where), variables_(where.variables()) {}

  [[nodiscard]] bool is_empty(const std::vector<PlainExtent>& box) {
    boxes_left_ = kMostBoxes;
    std::vector<Interval> compact;
    for (const PlainExtent& extent : box) {
      const Interval range = extent.rough();
      compact.push_back({to_compact(range.lower), to_compact(range.upper)});
    }
    return visit(box, compact, 0);
  }

 private:
  static double to_compact(double x) {
    if (x == outward::kInfinity) return 1.0;
    if (x == -outward::kInfinity) return -1.0;
    return x / (1.0 + std::abs(x));
  }
  static double from_compact(double t) { return t / (1.0 - std::abs(t)); }

  [[nodiscard]] Truth judge(const std::vector<PlainExtent>& box) {
    std::vector<Interval> rough;
    std::vector<RationalInterval> exact;
    for (const PlainExtent& extent : box) {
      rough.push_back(extent.rough());
      exact.push_back(extent.exact());
    }
    const Truth truth = rough_.condition(rough);
    return truth == Truth::undecided ? exact_.condition(exact) : truth;
  }

  bool visit(std::vector<PlainExtent> box, std::vector<Interval> compact, std::size_t depth) {
    const Truth truth = judge(box);
    if (truth != Truth::undecided) return truth == Truth::no;
    if (--boxes_left_ <= 0 || variables_.empty()) return false;
    const std::uint32_t slot = variables_[depth % variables_.size()];
    const double middle = (compact[slot].lower + compact[slot].upper) / 2;
    const double cut = from_compact(middle);
    const Interval range = box[slot].rough();
    const Interval compact_range = compact[slot];
    if (!(range.lower < cut && cut < range.upper))
      return range.is_point() && visit_others(box, compact, depth);
    const PlainExtent whole = box[slot];
    box[slot].upper = exact(cut);
    compact[slot].upper = middle;
    if (!visit(box, compact, depth + 1)) return false;
    box[slot] = {exact(cut), whole.upper};
    compact[slot] = {middle, compact_range.upper};
    return visit(box, compact, depth + 1);
  }

  /// Goes to the next variable if this one is a point, which cannot be halved.
  bool visit_others(const std::vector<PlainExtent>& box, const std::vector<Interval>& compact,
                    std::size_t depth) {
    const bool all_points = std::all_of(variables_.begin(), variables_.end(),
                                        [&box](std::uint32_t slot) { return box[slot].rough().is_point(); });
    return !all_points && visit(box, compact, depth + 1);
  }

  Evaluator<Interval> rough_;
  Evaluator<RationalInterval> exact_;
  std::vector<std::uint32_t> variables_;
  int boxes_left_ = 0;
};

bool ends_at_limit(Outside side) {
  return side == Outside::saturate || side == Outside::stop || side == Outside::periodic;
}

PlainExtent extent_of(const GridDimension& dimension) {
  if (dimension.periodic()) return {dimension.lower, dimension.upper};
  PlainExtent extent;
  if (ends_at_limit(dimension.below)) extent.lower = pieces_of(dimension, 0).front().lower;
  if (ends_at_limit(dimension.above)) extent.upper = pieces_of(dimension, dimension.count - 1).back().upper;
  return extent;
}

/// The values that may be measured beyond a side, its end included.
PlainExtent outside_of(const GridDimension& dimension, bool above) {
  const Rational last = dimension.point(above ? dimension.count - 1 : 0);
  Rational reach = dimension.radius() - dimension.measurement_error;
  if (dimension.discrete && dimension.measurement_error == 0) reach = dimension.step;
  if (above) return {last + reach, std::nullopt};
  return {std::nullopt, last - reach};
}

/// A few values of an extent: its ends, values next to them, and values far away.
std::vector<Rational> samples_of(const PlainExtent& extent, const GridDimension& dimension) {
  std::vector<Rational> samples;
  const Rational first = extent.lower ? *extent.lower : dimension.point(0);
  const Rational last = extent.upper ? *extent.upper : dimension.point(dimension.count - 1);
  for (int k = 0; k <= 4; ++k) samples.push_back(first + (last - first) * k / 4);
  for (const long far : {1L, 100L, 1000000L}) {
    if (!extent.upper) samples.push_back(last + dimension.step * far);
    if (!extent.lower) samples.push_back(first - dimension.step * far);
  }
  return samples;
}

/// Keeps the values inside an extent; of a discrete state only its multiples of the step.
void keep_inside(std::vector<Rational>& samples, const PlainExtent& extent) {
  std::erase_if(samples, [&extent](const Rational& value) {
    return (extent.lower && value < *extent.lower) || (extent.upper && value > *extent.upper);
  });
}

/// Whether the region holds one of some sample points outside; the end of a closed face is none of them.
bool reaches_a_sample(const Program& where, const UniformGrid& grid,
                      const std::vector<PlainExtent>& extents) {
  std::vector<std::vector<Rational>> samples;
  std::vector<std::int64_t> counts;
  const std::vector<std::uint32_t> variables = where.variables();
  for (const std::uint32_t slot : variables) {
    samples.push_back(samples_of(extents[slot], grid[slot]));
    keep_inside(samples.back(), extents[slot]);
    counts.push_back(static_cast<std::int64_t>(samples.back().size()));
  }
  constexpr int kMostPoints = 20000;
  Evaluator<RationalInterval> exact(where);
  std::vector<RationalInterval> point(grid.size());
  Odometer choice(counts);
  for (int looked_at = 0; looked_at < kMostPoints; ++looked_at) {
    for (std::size_t v = 0; v < variables.size(); ++v) {
      const Rational& value = samples[v][static_cast<std::size_t>(choice[v])];
      point[variables[v]] = {.lower = value, .upper = value};
    }
    if (exact.condition(point) == Truth::yes) return true;
    if (!choice.advance()) break;
  }
  return false;
}

}  // namespace

RegionJudge::RegionJudge(const ProblemSpec& spec, const Program& where, const UniformGrid& grid,
                         bool same_version, ThreadTeam& team)
    : grid_(&grid) {
  std::vector<std::vector<std::vector<RationalInterval>>> pieces;  // [state mentioned][index][piece]
  std::vector<std::int64_t> counts;
  std::int64_t choices = 1;
  for (const std::uint32_t slot : where.variables()) {
    states_.push_back(slot);
    counts.push_back(grid[slot].count);
    choices *= grid[slot].count;
    auto& indices = pieces.emplace_back();
    for (std::int64_t k = 0; k < grid[slot].count; ++k) {
      auto& ranges = indices.emplace_back();
      for (const RationalInterval& piece : pieces_of(grid[slot], k)) {
        const bool is_seam = !ranges.empty() && piece.lower == piece.upper;  // the lower end of the next cell
        if (!is_seam) ranges.push_back(piece);
      }
    }
  }
  meetings_.assign(static_cast<std::size_t>(choices), Meeting::off);
  const Program negation = negation_of(where);
  team.for_each(choices, 256, [&](ThreadTeam::Range range, int) {
    BoxJudge judge(where, negation, states_, same_version);
    Box box(spec.slot_count());
    Odometer choice(counts, range.begin);
    for (std::int64_t c = range.begin; c < range.end; ++c, choice.advance()) {
      std::vector<std::int64_t> piece_counts;
      for (std::size_t s = 0; s < states_.size(); ++s)
        piece_counts.push_back(
            static_cast<std::int64_t>(pieces[s][static_cast<std::size_t>(choice[s])].size()));
      Odometer piece(piece_counts);
      Meeting most = Meeting::off;
      do {
        for (std::size_t s = 0; s < states_.size(); ++s) {
          box[states_[s]] =
              pieces[s][static_cast<std::size_t>(choice[s])][static_cast<std::size_t>(piece[s])];
        }
        most = std::max(most, judge.judge(box));
      } while (most != Meeting::counted && piece.advance());
      meetings_[static_cast<std::size_t>(c)] = most;
    }
  });
}

Reach reach_beyond(const ProblemSpec& spec, const Program& where, const UniformGrid& grid,
                   const ResultSide& side) {
  REQUIRES((side.above ? grid[side.state].above : grid[side.state].below) == Outside::unsafe);
  std::vector<PlainExtent> extents;
  for (std::size_t i = 0; i < grid.size(); ++i)
    extents.push_back(i == side.state ? outside_of(grid[i], side.above) : extent_of(grid[i]));
  std::vector<Interval> box(spec.slot_count());
  for (std::size_t i = 0; i < grid.size(); ++i) box[i] = extents[i].rough();
  const Truth whole = Evaluator<Interval>(where).condition(box);
  if (whole != Truth::undecided) return whole == Truth::yes ? Reach::reached : Reach::never;
  if (reaches_a_sample(where, grid, extents)) return Reach::reached;
  return CompactSearch(where).is_empty(extents) ? Reach::not_far : Reach::open;
}

}  // namespace coordreq
