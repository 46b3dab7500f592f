#include "reach/box_division.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "expression/dual.hpp"

namespace coordreq {
namespace {

/// An end that lies beyond the known solutions by less than this fraction of a step is close enough, in
/// whichever cell.
constexpr double kCloseSteps = 0.05;
/// The same where something is added to it before cells are counted, for as many sums meet a cell more for
/// it, and the subboxes are parts of a line, of which few come so close.
constexpr double kCloseSummand = 0.02;
/// Where one half after another has no enclosure, the smallest is as good as a point after so many.
constexpr int kDeepestFailure = 40;
/// What a subbox counts for, and what it may take besides without counting for more, in sub-steps along a
/// solution: chosen so that van der Pol's equation keeps its subboxes where it is stiff, while those random
/// systems that took longest get a third of them.
constexpr std::int64_t kUsualSteps = 800;
constexpr std::int64_t kDearSteps = 1600;
/// Twice as many subboxes have to leave less than this share of what was missing.
constexpr double kWorthwhile = 0.95;
/// Before so many subboxes, and before this share of the effort, it is not asked whether the effort can be
/// enough: the way to the first subbox with an enclosure may be long.
constexpr std::int64_t kFirstSubboxes = 25;
constexpr std::int64_t kFirstShare = 8;
/// So many times the effort may be in sight: subboxes differ.
constexpr double kHopefulEfforts = 2.0;

bool is_upper_side(std::size_t side) {
  return side % 2 == 1;
}

}  // namespace

double EndCells::more_cells(const Interval& a, const Interval& b) const {
  const Interval both = hull(a, b);
  if (!placed) return (both.width() - b.width()) / step;
  const auto last = [&](double x) { return std::floor((x + reach - first) / step + 0.5); };
  const auto begin = [&](double x) { return std::ceil((x - reach - first) / step - 0.5); };
  return last(both.upper) - last(b.upper) + (begin(b.lower) - begin(both.lower));
}

BoxDivision::BoxDivision(std::vector<EndCells> targets, std::vector<double> steps, std::int64_t effort)
    : targets_(std::move(targets)),
      steps_(std::move(steps)),
      effort_(effort),
      given_up_(2 * targets_.size()) {}

bool BoxDivision::is_loose(const FlowEnclosure& whole, double limit) const {
  if (whole.status != FlowEnclosure::Status::ok) return true;
  return std::any_of(targets_.begin(), targets_.end(), [&](const EndCells& target) {
    const Interval& end = whole.end[target.state];
    if (!whole.reached.empty()) return target.more_cells(end, whole.reached[target.state]) > limit;
    return end.width() / target.step > limit;
  });
}

void BoxDivision::begin(std::vector<Interval> reached) {
  subboxes_.clear();
  reached_ = std::move(reached);
  work_ = 0;
  next_check_ = 0;
  missed_ = outward::kInfinity;
  std::fill(given_up_.begin(), given_up_.end(), false);
}

void BoxDivision::charge(std::int64_t steps) {
  work_ += std::max<std::int64_t>(steps - kDearSteps, 0);
}

/// The number of usual subboxes that count for as much as those so far.
std::int64_t BoxDivision::subboxes_worth() const {
  return work_ / kUsualSteps;
}

void BoxDivision::add(std::vector<Interval> box, const FlowEnclosure& found, int depth) {
  work_ += kUsualSteps;
  ++enclosed_;
  subboxes_.push_back({std::move(box), found, depth});
  if (found.reached.empty()) return;
  if (reached_.empty()) reached_ = found.reached;
  for (std::size_t i = 0; i < reached_.size(); ++i) reached_[i] = hull(reached_[i], found.reached[i]);
}

/// Whether nothing is left for another two halves.
bool BoxDivision::is_spent() const {
  return subboxes_worth() + 2 > effort_;
}

bool BoxDivision::is_lost() const {
  return is_spent() && deepest_failure() < subboxes_.size();
}

bool BoxDivision::may_gain_by_short_steps() const {
  const auto is_long = [](const Subbox& subbox) { return subbox.found.in_long_steps; };
  if (std::none_of(subboxes_.begin(), subboxes_.end(), is_long)) return false;
  bool close = deepest_failure() == subboxes_.size();
  for (std::size_t side = 0; side < given_up_.size(); ++side) close = close && missing(side) == 0.0;
  return !close;
}

bool BoxDivision::refine(const Enclose& enclose) {
  const std::size_t first_subboxes = subboxes_.size();
  for (;;) {
    const std::size_t failed = deepest_failure();
    const bool enough = is_spent();
    if (failed < subboxes_.size()) {
      const bool smallest = subboxes_[failed].depth >= kDeepestFailure;
      if (enough || smallest || !has_hope(first_subboxes) || !halve(failed, enclose)) return false;
      continue;
    }
    if (enough || !still_pays()) return true;
    const std::size_t side = farthest();
    if (side == given_up_.size()) return true;
    if (!halve(owner(side), enclose)) given_up_[side] = true;
  }
}

/// Whether a number of subboxes twice as large as the last time has made a difference.
bool BoxDivision::still_pays() {
  if (next_check_ == 0) next_check_ = 2 * subboxes_.size();
  if (subboxes_.size() < next_check_) return true;
  double now = 0.0;
  for (std::size_t side = 0; side < given_up_.size(); ++side) now += missing(side);
  const bool pays = now <= kWorthwhile * missed_;
  missed_ = now;
  next_check_ = 2 * subboxes_.size();
  return pays;
}

/// Whether the effort could be enough for an enclosure of each subbox, by the share of the box that those
/// found so far cover. @param first_subboxes so many were equal shares of it
bool BoxDivision::has_hope(std::size_t first_subboxes) const {
  if (subboxes_worth() < std::max(kFirstSubboxes, effort_ / kFirstShare)) return true;
  double covered = 0.0;
  for (const Subbox& subbox : subboxes_) {
    if (subbox.found.status == FlowEnclosure::Status::ok) covered += std::ldexp(1.0, -subbox.depth);
  }
  const double share = covered / static_cast<double>(first_subboxes);
  return static_cast<double>(subboxes_worth()) <= kHopefulEfforts * static_cast<double>(effort_) * share;
}

/// @returns false if it is too small to be halved
bool BoxDivision::halve(std::size_t subbox, const Enclose& enclose) {
  const std::size_t i = direction(subboxes_[subbox]);
  const double middle = midpoint(subboxes_[subbox].box[i]);
  std::vector<Interval> lower = subboxes_[subbox].box;
  std::vector<Interval> upper = lower;
  if (middle <= lower[i].lower || middle >= lower[i].upper) return false;
  lower[i].upper = middle;
  upper[i].lower = middle;
  const int depth = subboxes_[subbox].depth + 1;
  std::swap(subboxes_[subbox], subboxes_.back());
  subboxes_.pop_back();
  add(lower, enclose(lower), depth);
  add(upper, enclose(upper), depth);
  return true;
}

std::size_t BoxDivision::direction(const Subbox& subbox) const {
  const std::size_t known = subbox.found.loosest;
  if (subbox.found.status == FlowEnclosure::Status::ok && known < subbox.box.size() &&
      !subbox.box[known].is_point())
    return known;
  std::size_t result = 0;
  for (std::size_t i = 1; i < subbox.box.size(); ++i) {
    if (subbox.box[i].width() / steps_[i] > subbox.box[result].width() / steps_[result]) result = i;
  }
  return result;
}

/// One after another, so that it is soon seen whether the smallest subboxes have enclosures.
std::size_t BoxDivision::deepest_failure() const {
  std::size_t result = subboxes_.size();
  for (std::size_t p = 0; p < subboxes_.size(); ++p) {
    if (subboxes_[p].found.status == FlowEnclosure::Status::ok) continue;
    if (result == subboxes_.size() || subboxes_[p].depth > subboxes_[result].depth) result = p;
  }
  return result;
}

/// The subbox that decides over an end.
std::size_t BoxDivision::owner(std::size_t side) const {
  const std::size_t i = targets_[side / 2].state;
  const auto nearer = [&](const Subbox& a, const Subbox& b) {
    return outward_end(a.found.end[i], is_upper_side(side)) <
           outward_end(b.found.end[i], is_upper_side(side));
  };
  return static_cast<std::size_t>(std::max_element(subboxes_.begin(), subboxes_.end(), nearer) -
                                  subboxes_.begin());
}

/// How far an end lies beyond what was reached, in steps; 0 if that makes no difference worth its price.
double BoxDivision::missing(std::size_t side) const {
  const EndCells& target = targets_[side / 2];
  const Interval& end = subboxes_[owner(side)].found.end[target.state];
  if (reached_.empty()) return end.width() / target.step;
  const Interval& reached = reached_[target.state];
  const double gap =
      (outward_end(end, is_upper_side(side)) - outward_end(reached, is_upper_side(side))) / target.step;
  const bool is_summand_of_line = !target.placed && is_line(subboxes_.front().box);
  if (gap <= (is_summand_of_line ? kCloseSummand : kCloseSteps)) return 0.0;
  const Interval farthest(is_upper_side(side) ? end.upper : end.lower);
  return !target.placed || target.more_cells(farthest, reached) > 0.0 ? gap : 0.0;
}

/// The side that misses most; as many as there are sides if none misses anything.
std::size_t BoxDivision::farthest() const {
  std::size_t result = given_up_.size();
  double most = 0.0;
  for (std::size_t side = 0; side < given_up_.size(); ++side) {
    const double gap = given_up_[side] ? 0.0 : missing(side);
    if (gap <= most) continue;
    most = gap;
    result = side;
  }
  return result;
}

}  // namespace coordreq
