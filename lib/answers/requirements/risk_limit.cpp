#include "answers/requirements/risk_limit.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

Rational added(const RequirementSpec& requirement, double rate) {
  return exact(rate) * static_cast<long>(requirement.steps);
}

}  // namespace

std::int32_t greatest_risk_bits(const RequirementSpec& requirement, double rate) {
  const Rational rest = std::min(Rational(requirement.risk - added(requirement, rate)), Rational(1));
  if (rest < 0) return -1;
  auto most = static_cast<float>(nearest_double(rest));
  if (exact(double{most}) > rest) most = std::nextafter(most, 0.0F);
  return std::bit_cast<std::int32_t>(most);
}

double compared_risk(const RequirementSpec& requirement, std::int32_t bits, double rate) {
  const Rational sum = exact(double{std::bit_cast<float>(bits)}) + added(requirement, rate);
  return std::min(1.0, upper_double(sum));
}

}  // namespace coordreq
