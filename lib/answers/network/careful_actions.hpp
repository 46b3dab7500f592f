#pragma once

#include <vector>

#include "engine/tuple_walk.hpp"
#include "engine/wave.hpp"

namespace coordreq {

/// kTop where agents can restrict themselves, without further contact, to actions that lead into the target:
/// C_q(x) = {u allowed : empty != f(x,u) subset of the target} is not empty, and every element of the product
/// of its projections, IND(C_q)(x), is in C_q(x). Else 0. The target is the set of cells of level kTop.
///
/// Not monotone in the target: with a smaller target fewer actions are left, which may fit together where
/// more do not. So not for run_wave().
class CarefulActions final : public RowOperator<std::uint8_t> {
 public:
  /// @param grouping by the classes that coordinate
  /// @pre unchecked: it outlives this object.
  CarefulActions(const ActionGrouping& grouping, int workers);

  /// @returns false if the level is kTop for all cells x with old[x] != 0
  bool next_levels(const RowPosition& position, PostReader<std::uint8_t>& posts, const std::uint8_t* old,
                   std::uint8_t* next, int worker) override;

 private:
  struct Workspace {
    RowGroups groups;
    TupleWalk::Candidates candidates;
    TupleWalk tuple;
    std::vector<Word> wanted;                   ///< cells with old != 0
    std::vector<Word> good;                     ///< cells where a choice of groups is in C_q
    std::vector<Word> known;                    ///< `good` of the first choices, in the order of the walk
    std::vector<Word> mixed;                    ///< cells where the choice is in IND(C_q)
    std::vector<Word> stays;                    ///< the result
    std::vector<std::vector<Word>> projection;  ///< [class] one row for each group
  };

  void find_projections(const RowPosition& position, PostReader<std::uint8_t>& posts, Workspace& work) const;
  void remove_bad_mixtures(const RowPosition& position, PostReader<std::uint8_t>& posts,
                           Workspace& work) const;
  static void find_good(PostReader<std::uint8_t>& posts, std::size_t length, Workspace& work);

  const ActionGrouping& grouping_;
  std::vector<Workspace> work_;
};

}  // namespace coordreq
