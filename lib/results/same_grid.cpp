#include "results/controller_file.hpp"

#include <algorithm>
#include <cmath>

namespace coordreq {

std::optional<double> spacing(const std::vector<Rational>& points) {
  if (points.size() < 2) return std::nullopt;
  std::vector<Rational> sorted = points;
  std::sort(sorted.begin(), sorted.end());
  Rational least = sorted[1] - sorted[0];
  for (std::size_t k = 2; k < sorted.size(); ++k)
    least = std::min(least, Rational(sorted[k] - sorted[k - 1]));
  return nearest_double(least);
}

bool same_point(double found, double expected, std::optional<double> distance) {
  const double allowed = distance ? kGridTolerance * *distance : 1e-9 * std::max(1.0, std::fabs(expected));
  return found == expected || std::fabs(found - expected) <= allowed;
}

}  // namespace coordreq
