#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "numeric/outward.hpp"

namespace coordreq {

/// The candidate with the smallest (score, number). Scores in double arithmetic sort out most of them, so
/// that few need the sharp one. @pre unchecked: there is a candidate
template <class Approximate, class Sharp>
std::int64_t smallest_score(const std::vector<std::int64_t>& candidates, const Approximate& approximate,
                            const Sharp& sharp) {
  std::vector<double> scores;
  scores.reserve(candidates.size());
  for (const std::int64_t u : candidates) scores.push_back(approximate(u));
  const double lowest = *std::min_element(scores.begin(), scores.end());
  const double slack = std::isfinite(lowest) ? 1e-9 * std::max(1.0, std::fabs(lowest)) : 0.0;
  std::pair<double, std::int64_t> best{outward::kInfinity, std::numeric_limits<std::int64_t>::max()};
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (scores[i] <= lowest + slack) best = std::min(best, std::pair(sharp(candidates[i]), candidates[i]));
  }
  return best.second;
}

}  // namespace coordreq
