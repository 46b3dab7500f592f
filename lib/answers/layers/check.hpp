#pragma once

#include <memory>

#include "answers/checking/answer_check.hpp"

namespace coordreq {

/// Checks the claims about each partition, straight from the definitions:
/// - for x in K: delay(x) = 1 + min over u in IND_C(x), y in f(x, u) of delay(y), where cells outside K and
///   pairs without post, or that `allow` forbids, are worth -1. By induction on the delay this proves
///   membership in every layer, and that a cell is not in the next;
/// - triggers from delays, and stored actions from C(x);
/// - F, whether max_delay stopped the iteration, layer sizes and layer lists against the delays.
[[nodiscard]] std::unique_ptr<AnswerCheck> check_layers(const CheckContext& context);

}  // namespace coordreq
