#pragma once

#include <memory>

#include "answers/checking/answer_check.hpp"

namespace coordreq {

/// Checks what is said about single cells in each mode of the network, with the conventions of
/// check_invariance(). With T(q) the intersection of the claimed W(q') over the modes q' that follow q, for
/// every cell x and mode q:
/// - x in W(q) exactly if x in K and every u in IND_C(x) has a post, inside T(q): W is a fixed point. That no
///   other one is larger is not asked;
/// - `resynthesise`: x in W(q) only if x in K, some allowed u has a post inside T(q), and so has every
/// mixture
///   of such u, which is allowed too. That the iteration of the contract ends there is not asked.
/// Either way agents are safe from all that is claimed. Also how many cells each W(q) has.
/// @returns null: the spec has no network
[[nodiscard]] std::unique_ptr<AnswerCheck> check_network(const CheckGround& ground);

/// The set that the choices in each mode must lead into.
[[nodiscard]] double network_check_memory(const ProblemSpec& spec);

}  // namespace coordreq
