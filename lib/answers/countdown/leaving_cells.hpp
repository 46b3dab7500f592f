#pragma once

#include <cstdint>

#include "answers/answers.hpp"
#include "answers/countdown/delay_layers.hpp"
#include "choices/projections.hpp"

namespace coordreq {

/// Whether some side of the domain is `safe`, so that states which leave there are in the absorbing cell T.
[[nodiscard]] bool has_safe_side(const ProblemSpec& spec);

/// |Z_F \ Y|, Y the greatest subset of Z_F in which no joint input of IND_C(x) leads out through a `safe`
/// side, and all lead into Y. From these cells some run of silent classes leaves through such a side; they
/// would not be unbounded if the side were not safe and the classes chose from the same sets. Cells of a goal
/// that ends the task are in Y.
///
/// In Z_F IND_C(x) = C(x): each of its joint inputs leads into Z_F, a part of K, so that it is in C(x).
/// Mostly the tables of such sides alone show that all cells leave, since each goes on outward, whatever is
/// chosen. Else: where every joint input is in C(x) all cells near such a side leave; in other rows the joint
/// inputs that leave are read, a row at a time. Then a wave that finds no more than whether a cell leaves
/// finds Y.
/// @param projections of the partition, which has two classes or more
/// @param layers of the partition, with F; @pre unchecked: no controller file, which makes IND_C(x) larger
///   than C(x). Cost: at most about a sweep of the layers over the rows of Z_F. Together.
[[nodiscard]] LeavingCounts count_leaving_cells(const Answers& answers, const Projections& projections,
                                                const DelayLayers& layers, const WaveWatch& watch,
                                                ThreadTeam& team);

}  // namespace coordreq
