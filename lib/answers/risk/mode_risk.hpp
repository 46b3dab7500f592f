#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "choices/projections.hpp"
#include "engine/post_reader.hpp"
#include "model/input_class.hpp"

namespace coordreq {

/// OPT over u of max over y in f(x,u) of a risk whose levels a reader has, for the cells of K, by the agents
/// of one partition. A post that is blocked, or forbidden by `allow`, has risk 1. Results for other cells
/// have no meaning.
template <class Level>
class ModeRisk {
 public:
  virtual ~ModeRisk() = default;
  /// @param next levels, whole blocks
  virtual void find(const RowPlace& place, PostReader<Level>& posts, Level* next, int worker) = 0;
};

/// How the agents of each partition of a network choose: any u in IND_C(x), or in A(x) if they act by rules,
/// so that the greatest risk counts; or, if they are one class and agree on the safest, the u of least risk
/// in C(x).
class ModeChoices {
 public:
  /// @param partitions the classes of each
  /// @param rules [partition] A(x) in K; null: its agents choose from IND_C(x)
  /// @pre unchecked: the controller and A(x) outlive this object.
  ModeChoices(const Controller& controller, const std::vector<std::vector<InputClass>>& partitions,
              const std::vector<const Projections*>& rules, bool is_safest, ThreadTeam& team);

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
  std::deque<ActionGrouping> groupings_;
  std::deque<Projections> projections_;
  std::vector<Partition> partitions_;
};

}  // namespace coordreq
