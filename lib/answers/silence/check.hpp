#pragma once

#include <memory>

#include "answers/checking/answer_check.hpp"

namespace coordreq {

/// Checks how long silence is safe, straight from the definitions:
/// - for x in K': silence(x) = 1 + min over u in A(x), y in f(x, u) of silence(y), where cells outside K' and
///   pairs without post, or that `allow` forbids, are worth -1; 0 where A(x) is empty. By induction this is
///   membership in every layer;
/// - from each cell of K' `then` leaves some action, and all its actions stay in K'; and K' is the greatest
///   such subset of S, if all posts are known;
/// - F, whether max_delay stopped the iteration, and sizes of layers against the silence of the cells.
/// Null if the spec does not say what silent agents do.
[[nodiscard]] std::unique_ptr<AnswerCheck> check_silence(const CheckContext& context);
/// Bytes a cell that the check keeps.
[[nodiscard]] double silence_check_memory(const ProblemSpec& spec);

}  // namespace coordreq
