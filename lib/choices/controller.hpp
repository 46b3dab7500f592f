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
/// Or a part of C, at some cells of K only. Or the progress controller P outside the goal (contract, section
/// 5): of `maximal` all u allowed after which every cell of the post is nearer to the goal; empty outside
/// W \ G. That of a lasting goal (section 11) is empty outside W.
struct Controller {
  const RowEngine* engine = nullptr;
  const CellSet* invariant = nullptr;  ///< the cells where the controller is not empty
  /// For C collision times, kTop exactly in K; for P nearness.
  const LevelMap* levels = nullptr;
  Synthesis synthesis = Synthesis::maximal;
  bool approaches = false;  ///< the controller is P
  /// Of P: the levels that those of posts must be above; null: the own ones.
  const LevelMap* bounds = nullptr;
  const CellSet* whole = nullptr;  ///< K, if this is C at a part of K; null: `invariant` is K

  /// K. @pre this is C, and K was given
  [[nodiscard]] const CellSet& target() const {
    REQUIRES(!approaches && (whole != nullptr || invariant != nullptr));
    return whole == nullptr ? *invariant : *whole;
  }
};

}  // namespace coordreq
