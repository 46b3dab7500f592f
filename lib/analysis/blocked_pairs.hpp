#pragma once

#include <cstdint>
#include <vector>

#include "answers/analysis_context.hpp"

namespace coordreq {

/// The number of pairs of a safe cell and a joint input that are blocked at a side of the domain.
struct BlockedPairs {
  std::int64_t pairs = 0;
  bool is_all = true;  ///< else there may be more: the search was broken off after some millions
};

/// @param dimension of the grid of the abstraction, and its side
/// @param may_leave by own index: false where no post goes beyond that side
/// @pre the context is set up
[[nodiscard]] BlockedPairs count_blocked(const AnalysisContext& context, std::size_t dimension, bool above,
                                         const std::vector<bool>& may_leave);

}  // namespace coordreq
