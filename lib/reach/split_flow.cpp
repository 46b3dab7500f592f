#include "reach/split_flow.hpp"

#include <algorithm>
#include <deque>
#include <utility>

#include "expression/dual.hpp"

namespace coordreq {
namespace {

/// An enclosure that meets more cells than this beyond those of solutions that were followed is divided.
constexpr double kLooseFlow = 1.5;
/// One that meets more is divided by how solutions diverge, without a look at larger subboxes.
constexpr double kFarFlow = 16.0;
/// Solutions of a subbox are no farther from one another on their way, in steps of the grid: beyond that
/// hardly any subbox has an enclosure of use.
constexpr double kMostSpread = 8.0;
/// A share of the effort for such subboxes; the rest is for where it matters.
constexpr std::size_t kShareOfSubboxes = 2;
/// Sub-steps of solutions that tell such subboxes of one box: van der Pol's equation takes 3,000, 37,000
/// where it is stiff.
constexpr std::int64_t kMostSpreadTries = 40'000;

}  // namespace

SplitFlow::SplitFlow(PeriodicFlow flow, const FlowSystem& system, std::vector<EndCells> targets,
                     std::int64_t effort)
    : flow_(std::move(flow)),
      state_slots_(system.state_slots),
      division_(std::move(targets), system.steps, effort) {
  if (!system.steps.empty() && effort > 0) spread_.emplace(system, flow_.period());
}

const FlowEnclosure& SplitFlow::flow(std::span<const Interval> slots) {
  ++wholes_;
  const FlowEnclosure& whole = flow_.flow(slots);
  if (division_.effort() <= 0 || !division_.is_loose(whole, kLooseFlow)) return whole;
  is_far_ = division_.is_loose(whole, kFarFlow);
  result_ = whole;
  slots_.assign(slots.begin(), slots.end());
  box_.clear();
  for (const std::uint32_t slot : state_slots_) box_.push_back(slots[slot]);
  const bool by_faces = can_use_faces();
  const auto divide = [&] { return by_faces ? divide_faces() : divide_all(); };
  FlowEnclosure first = result_;
  if (divide()) use_hull(by_faces);
  if (division_.may_gain_by_short_steps()) {
    // Anew from the whole, so that ends are as without long steps.
    takes_long_steps_ = false;
    std::swap(result_, first);
    const bool found = divide();
    std::swap(result_, first);
    if (found) use_hull(by_faces);
    takes_long_steps_ = true;
  }
  return result_;
}

const FlowEnclosure& SplitFlow::flow_of_subbox(std::span<const Interval> box) {
  for (std::size_t i = 0; i < box.size(); ++i) slots_[state_slots_[i]] = box[i];
  const std::int64_t before = flow_.extra_steps();
  const FlowEnclosure& found = flow_.flow_of_subbox(slots_, takes_long_steps_);
  division_.charge(flow_.extra_steps() - before);
  return found;
}

bool SplitFlow::can_use_faces() {
  const bool is_full = std::none_of(box_.begin(), box_.end(), [](const Interval& a) { return a.is_point(); });
  return is_full && static_cast<std::int64_t>(2 * box_.size()) <= division_.effort() &&
         flow_.keeps_apart(box_);
}

/// Halves boxes one after the other until solutions from each stay close, or there are many.
std::vector<std::vector<Interval>> SplitFlow::close_subboxes(std::vector<std::vector<Interval>> boxes) {
  if (!is_far_ || !spread_) return boxes;
  const auto most = static_cast<std::size_t>(division_.effort()) / kShareOfSubboxes;
  std::deque<std::vector<Interval>> open(boxes.begin(), boxes.end());
  std::vector<std::vector<Interval>> close;
  const std::int64_t tried = spread_->tries();
  while (!open.empty() && open.size() + close.size() < most && spread_->tries() - tried < kMostSpreadTries) {
    std::vector<Interval> lower = std::move(open.front());
    open.pop_front();
    const std::optional<std::size_t> direction = spread_->widest(slots_, lower, kMostSpread);
    if (!direction) {
      close.push_back(std::move(lower));
      continue;
    }
    std::vector<Interval> upper = lower;
    lower[*direction].upper = upper[*direction].lower = midpoint(lower[*direction]);
    open.push_back(std::move(lower));
    open.push_back(std::move(upper));
  }
  close.insert(close.end(), open.begin(), open.end());
  return close;
}

/// Encloses the subboxes, and halves of them where that pays. @returns whether all have enclosures
bool SplitFlow::refine(std::vector<std::vector<Interval>> subboxes) {
  for (std::vector<Interval>& subbox : subboxes) {
    const FlowEnclosure& found = flow_of_subbox(subbox);
    division_.add(std::move(subbox), found);
    if (division_.is_lost()) return false;
  }
  return division_.refine(
      [this](std::span<const Interval> box) -> const FlowEnclosure& { return flow_of_subbox(box); });
}

/// @returns whether that gave an enclosure of the whole
bool SplitFlow::divide_faces() {
  division_.begin(result_.reached);
  std::vector<std::vector<Interval>> faces;
  for (std::size_t i = 0; i < box_.size(); ++i) {
    for (const double end : {box_[i].lower, box_[i].upper}) {
      faces.push_back(box_);
      faces.back()[i] = Interval(end);
    }
  }
  return refine(close_subboxes(std::move(faces))) && faces_are_enough();
}

/// @returns whether all subboxes have enclosures
bool SplitFlow::divide_all() {
  division_.begin(result_.reached);
  std::vector<std::vector<Interval>> subboxes = close_subboxes({box_});
  if (subboxes.size() == 1) {
    division_.add(box_, result_);
    subboxes.clear();
  }
  return refine(std::move(subboxes));
}

/// Whether nothing from inside the box can pass what its faces lead to.
bool SplitFlow::faces_are_enough() {
  std::vector<Interval> tube = division_.subboxes().front().found.tube;
  for (const BoxDivision::Subbox& subbox : division_.subboxes()) {
    for (std::size_t i = 0; i < tube.size(); ++i) tube[i] = hull(tube[i], subbox.found.tube[i]);
  }
  return flow_.keeps_apart(tube);
}

/// Puts the hull of all subboxes into the result.
void SplitFlow::use_hull(bool by_faces) {
  FlowEnclosure all = division_.subboxes().front().found;
  for (const BoxDivision::Subbox& subbox : division_.subboxes()) {
    for (std::size_t i = 0; i < box_.size(); ++i) {
      all.end[i] = hull(all.end[i], subbox.found.end[i]);
      all.tube[i] = hull(all.tube[i], subbox.found.tube[i]);
      all.drift[i] = hull(all.drift[i], subbox.found.drift[i]);
    }
  }
  all.reached = division_.reached();
  for (std::size_t i = 0; i < box_.size(); ++i) {
    // How far a state has moved need not be extreme where it started from the boundary.
    if (by_faces) all.drift[i] = hull(all.tube[i], box_[i]) - box_[i];
    if (result_.status != FlowEnclosure::Status::ok) continue;
    const auto both = [](Interval& a, const Interval& b) { a = intersect(a, b).value_or(a); };
    both(all.end[i], result_.end[i]);
    both(all.tube[i], result_.tube[i]);
    both(all.drift[i], result_.drift[i]);
  }
  result_ = std::move(all);
}

}  // namespace coordreq
