#include "expression/point_value.hpp"

namespace coordreq {

double PointValue::value(std::span<const Rational> slots) {
  points_.resize(slots.size());
  for (std::size_t i = 0; i < slots.size(); ++i) points_[i] = {.lower = slots[i], .upper = slots[i]};
  const RationalInterval& found = exact_.number(points_);
  if (found.is_point()) return nearest_double(found.lower);
  doubles_.resize(slots.size());
  for (std::size_t i = 0; i < slots.size(); ++i) doubles_[i] = nearest_double(slots[i]);
  return fast_.number(doubles_);
}

}  // namespace coordreq
