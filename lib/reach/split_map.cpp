#include "reach/split_map.hpp"

#include <utility>

namespace coordreq {
namespace {

/// Subboxes cost little: any cell more than points need is worth it.
constexpr double kLooseMap = 0.5;

std::vector<double> at_slots(const std::vector<double>& values, const std::vector<std::uint32_t>& slots) {
  std::vector<double> result;
  for (const std::uint32_t slot : slots) result.push_back(values[slot]);
  return result;
}

}  // namespace

SplitMap::SplitMap(const Program& equation, std::span<const std::uint32_t> box_slots,
                   const std::vector<double>& steps, const EndCells& target, std::int64_t effort)
    : map_(equation, box_slots), division_({target}, at_slots(steps, map_.directions()), effort) {}

Interval SplitMap::enclose(std::span<const Interval> slots) {
  slots_.assign(slots.begin(), slots.end());
  ++wholes_;
  enclose_slots();
  const Interval whole = found_.end.front();
  if (division_.effort() <= 0 || map_.directions().empty() || !division_.is_loose(found_, kLooseMap))
    return whole;
  std::vector<Interval> box;
  for (const std::uint32_t slot : map_.directions()) box.push_back(slots[slot]);
  division_.begin({});
  division_.add(std::move(box), found_);
  const auto enclose = [this](std::span<const Interval> some) -> const FlowEnclosure& {
    return enclose_subbox(some);
  };
  if (!division_.refine(enclose)) return whole;
  Interval all = division_.subboxes().front().found.end.front();
  for (const BoxDivision::Subbox& each : division_.subboxes()) all = hull(all, each.found.end.front());
  return whole.total ? intersect(all, whole).value_or(all) : all;
}

const FlowEnclosure& SplitMap::enclose_subbox(std::span<const Interval> box) {
  for (std::size_t j = 0; j < box.size(); ++j) slots_[map_.directions()[j]] = box[j];
  enclose_slots();
  return found_;
}

void SplitMap::enclose_slots() {
  using Status = FlowEnclosure::Status;
  const Interval range = map_.enclose(slots_);
  found_.status = !range.total ? Status::undefined : !range.is_finite() ? Status::blows_up : Status::ok;
  found_.end = {range};
  found_.reached.clear();
  if (map_.reached()) found_.reached = {*map_.reached()};
  found_.loosest = map_.loosest();
}

}  // namespace coordreq
