#pragma once

#include "numeric/rational_interval.hpp"

namespace coordreq {

[[nodiscard]] inline RationalInterval point(const Rational& q) {
  return {.lower = q, .upper = q};
}

}  // namespace coordreq
