#pragma once

#include "base/requires.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

class CellSet;
class LevelMap;
class RowEngine;

/// The controller C of an invariance set, contract "Controller": `maximal` C(x) = {u allowed : empty !=
/// f(x,u) subset of K}, `given` C(x) = {u allowed}; empty outside K. Never stored, computed row by row.
/// The paper's C, whose projections make IND_C (its Eq. (3) and (4)).
///
/// Or a part of it, C at some cells of K only. Or the progress controller P outside the goal (contract,
/// section 5): of `maximal` all u allowed after which every cell of the post is nearer to the goal, empty
/// outside W \ G.
struct Controller {
  const RowEngine* engine = nullptr;
  const CellSet* invariant = nullptr;  ///< where it is not empty
  /// Of C collision times, kTop in K and nowhere else; of P nearness.
  const LevelMap* levels = nullptr;
  Synthesis synthesis = Synthesis::maximal;
  bool approaches = false;         ///< it is P
  const CellSet* whole = nullptr;  ///< K, where C is asked of a part of it; null: that is `invariant`

  /// K. @pre it is C, and K has been told
  [[nodiscard]] const CellSet& target() const {
    REQUIRES(!approaches && (whole != nullptr || invariant != nullptr));
    return whole == nullptr ? *invariant : *whole;
  }
};

}  // namespace coordreq
