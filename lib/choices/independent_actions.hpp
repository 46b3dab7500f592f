#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "choices/projections.hpp"
#include "engine/tuple_walk.hpp"
#include "engine/wave.hpp"

namespace coordreq {

/// level(x) = 1 + min over u in IND_C(x) of min over f(x,u), f(x,u) being empty where u is forbidden; the
/// greatest level if IND_C(x) is empty, which does not occur in K. This is the coordination-free predecessor
/// IPRE of the paper, Eq. (5), for all layers Z_0, Z_1, ... at once: x is in IPRE(Z_k) if its level is above
/// k + 1.
template <class Level>
class IndependentActions final : public RowOperator<Level> {
 public:
  /// What the levels of lost cells say.
  enum class LostLevels : std::uint8_t {
    steps,  ///< as above
    /// Whether a cell is lost: 1 for each that is, so that a row is done as soon as all of its cells are.
    /// Levels begin with 0 for lost cells and kTop for all others.
    flag,
  };
  /// @pre unchecked: all outlive this object.
  IndependentActions(const Projections& projections, const CellSet& invariant, int workers,
                     LostLevels lost_levels = LostLevels::steps);

  bool next_levels(const RowPosition& position, PostReader<Level>& posts, const Level* old, Level* next,
                   int worker) override;
  [[nodiscard]] bool is_minimum() const override { return true; }
  /// Finds the least level of all posts under IND_C, for every cell of the row.
  void find_minimum(const RowPosition& position, PostReader<Level>& posts, Level* next, int worker);

 private:
  struct Workspace {
    RowGroups groups;
    std::vector<std::vector<std::uint32_t>> worst;
    TupleWalk::Candidates candidates;
    TupleWalk tuple;
    RowBox box;
    IndependentPosts::Row row;
    bool is_moved = false;  ///< packed boxes are moved, by the shift below
    std::vector<std::int32_t> shift;
    std::vector<Level> labels;  ///< of the page being read
    Level label = 0;
    std::vector<Word> reasonable;
    std::vector<Word>
        reasonable_for_others;  ///< cells where the choice of all classes but the fastest is reasonable
    std::vector<Level> lanes;   ///< the same as levels
    std::vector<Level> lanes_of_others;
  };
  /// The row whose levels are lowered.
  struct Row {
    std::int64_t number;
    bool is_full;  ///< every action is reasonable in all cells that count
    PostReader<Level>& posts;
    Level* next;
  };

  /// Lowers `next`, which is nowhere below it, to the minimum.
  void lower(const RowPosition& position, PostReader<Level>& posts, Level* next, Workspace& work) const;
  void lower_by_boxes(const RowPosition& position, PostReader<Level>& posts, Level* next,
                      Workspace& work) const;
  /// Whether some of these lanes can still be lowered to a level that makes a difference.
  [[nodiscard]] bool is_open(const Level* next, std::size_t lanes) const {
    return lost_levels_ == LostLevels::steps ||
           std::find(next, next + lanes, PostReader<Level>::kTop) != next + lanes;
  }
  void lower_by_class(const IndependentPosts::Subset& subset, std::size_t c, PostReader<Level>& posts,
                      Level* next, Workspace& work) const;
  void lower_by_box(const IndependentPosts::Subset& subset, PostReader<Level>& posts, Level* next,
                    Workspace& work) const;
  void lower_by_all(const RowPosition& position, PostReader<Level>& posts, Level* next,
                    Workspace& work) const;
  void lower_by_projections(const RowPosition& position, PostReader<Level>& posts, Level* next,
                            Workspace& work) const;
  void lower_by_tuples(const RowPosition& position, const Row& row, Workspace& work) const;
  [[nodiscard]] bool is_some_reasonable(const Row& row, Workspace& work) const;
  void lower_by_several(const Row& row, std::size_t begin, std::size_t end, LaneRange lanes,
                        Workspace& work) const;
  void lower_by_one(const Row& row, std::size_t position, LaneRange lanes, Workspace& work) const;
  void find_worst(std::int64_t row, const RowGroups& groups, std::size_t c,
                  std::vector<std::uint32_t>& result) const;

  const Projections& projections_;
  const ActionGrouping& grouping_;
  RowBoxes boxes_;
  const CellSet& invariant_;
  LostLevels lost_levels_;
  std::size_t fastest_;  ///< class
  std::vector<Workspace> work_;
};

extern template class IndependentActions<std::uint8_t>;
extern template class IndependentActions<std::uint16_t>;
extern template class IndependentActions<std::uint32_t>;
extern template class IndependentActions<std::uint64_t>;

}  // namespace coordreq
