#pragma once

#include <memory>

#include "answers/checking/answer_check.hpp"

namespace coordreq {

/// Checks S, K, collision times and C(x), straight from the definitions, one cell after the other and for
/// each every joint input. A pair without post is worth 0; a pair that has left safely, and every cell of K,
/// are worth infinity:
/// - S by its definition;
/// - each cell of K keeps an allowed input whose post lies in K (`given`: every allowed input, and there is
///   one);
/// - for x in S but not in K: collision_time(x) = 1 + max (`given`: min) over allowed u of min over y in f(x,
///   u) of collision_time(y), 1 without allowed inputs. By induction on the time, no cell outside K could be
///   in a larger K;
/// - a stored controller has the inputs of C(x);
/// - |S|, |K| and the number of sweeps against the cells.
[[nodiscard]] std::unique_ptr<AnswerCheck> check_invariance(const CheckContext& context);

}  // namespace coordreq
