#include "expression/point_value.hpp"

namespace coordreq {

double PointValue::value(std::span<const Rational> slots) {
  points_.resize(slots.size());
  for (const std::uint32_t slot : variables_) {
    points_[slot].lower = slots[slot];
    points_[slot].upper = slots[slot];
  }
  const RationalInterval& found = exact_.number(points_);
  if (found.is_point()) return nearest_double(found.lower);
  doubles_.resize(slots.size());
  for (const std::uint32_t slot : variables_) doubles_[slot] = nearest_double(slots[slot]);
  return fast_.number(doubles_);
}

}  // namespace coordreq
