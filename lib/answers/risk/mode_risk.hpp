#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "answers/layers/projections.hpp"
#include "engine/post_reader.hpp"
#include "model/input_class.hpp"

namespace coordreq {

/// OPT over u of max over y in f(x,u), for the cells of K, of risks whose levels a reader has: of the agents
/// of one partition. A post that is blocked is certain to leave, and so is what `allow` forbids. What is said
/// of other cells has no meaning.
template <class Level>
class ModeRisk {
 public:
  virtual ~ModeRisk() = default;
  /// @param next levels, whole blocks
  virtual void find(const RowPlace& place, PostReader<Level>& posts, Level* next, int worker) = 0;
};

/// What the agents of each partition of a network choose from: u in IND_C(x), or in A(x) of those who do what
/// they are told, the greatest risk counts; or, where they are one class and agree on what is safest, the
/// least risk of u in C(x).
class ModeChoices {
 public:
  /// @param partitions the classes of each
  /// @param silent [partition] A(x) in K; null: they choose from IND_C(x)
  /// @pre unchecked: the controller, the hull and A(x) outlive this object.
  ModeChoices(const Controller& controller, const RowHull& hull,
              const std::vector<std::vector<InputClass>>& partitions,
              const std::vector<const Projections*>& silent, bool is_safest, ThreadTeam& team);

  /// One operator a partition. @pre unchecked: this object outlives them.
  template <class Level>
  [[nodiscard]] std::vector<std::unique_ptr<ModeRisk<Level>>> operators(int workers) const;

 private:
  struct Partition {
    bool is_safest = false;
    const ActionGrouping* grouping = nullptr;
    const Projections* projections = nullptr;  ///< null: not asked for
  };

  const Controller& controller_;
  const RowHull& hull_;
  std::deque<ActionGrouping> groupings_;
  std::deque<Projections> projections_;
  std::vector<Partition> partitions_;
};

}  // namespace coordreq
