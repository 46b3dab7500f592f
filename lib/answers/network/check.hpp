#pragma once

#include <memory>

#include "answers/checking/answer_check.hpp"

namespace coordreq {

/// Checks the claims about single cells in each mode of the network, with values as in check_invariance().
/// With T(q) the intersection of the claimed W(q') over the modes q' that follow q, for every cell x and mode
/// q:
/// - x in W(q) exactly if x in K and every u in IND_C(x) (by rules: A(x), which is not empty) has a post,
/// inside T(q): W is a fixed point. Whether
///   it is the largest is not checked;
/// - `resynthesise`: x in W(q) only if x in K, some allowed u has a post inside T(q), and so has every
///   mixture of such u, which is allowed too. Whether the iteration of the contract ends there is not
///   checked. Either way agents are safe from all claimed cells. Also checks the number of cells of each
///   W(q).
/// @returns null: the spec has no network
[[nodiscard]] std::unique_ptr<AnswerCheck> check_network(const CheckContext& context);

/// Bytes a cell: the target T(q) of each mode.
[[nodiscard]] double network_check_memory(const ProblemSpec& spec);

}  // namespace coordreq
