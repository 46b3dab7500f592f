#include "spec/guarantee.hpp"

namespace coordreq {

std::string guarantee_of(const ProblemSpec& spec) {
  if (spec.abstraction.safe == Membership::center) return "samples-center";
  return spec.abstraction.between_samples ? "continuous" : "samples";
}

}  // namespace coordreq
