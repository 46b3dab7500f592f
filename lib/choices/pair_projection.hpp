#pragma once

#include <cstdint>
#include <vector>

#include "choices/controller.hpp"
#include "engine/bit_kernels.hpp"
#include "engine/row_boxes.hpp"

namespace coordreq {

/// The projections of C onto two classes, each with states of its own: two vehicles. The *follower* moves the
/// last dimension, the *leader* is the other one.
///
/// The projection on one class has an action if some action of the other class fits it; the smallest boxes
/// are enough to try. Only membership in K matters, so this is done on bits, 64 cells a word. Without it a
/// whole run takes 1.03 times the instructions on the gridworld, 1.17 times at steps of 5 mm
/// (FastPaths::pair_projections). Where the leader moves the leading dimensions and the follower all others,
/// what K leaves to the follower under an action of the leader is one *plane* of bits, the same for all rows
/// of a unit, and the follower's boxes are eroded from its rows. Else boxes of both are taken from the rows
/// of K.
///
/// One object a thread.
class PairProjection {
 public:
  /// @pre unchecked: the arguments outlive this object.
  PairProjection(const Controller& controller, const RowBoxes& boxes, std::size_t classes);

  /// False if the classes are not of this form; then find_masks() must not be called.
  [[nodiscard]] bool applies() const { return applies_; }

  /// Sets masks[class][group * words, ...] to {x in the row : group is in the projection of C(x)}.
  /// @pre applies(), `boxes` has none that are gone, everything is allowed, and C is maximal.
  /// @pre unchecked: `boxes` has been filled for this row
  void find_masks(const RowPosition& position, const RowGroups& groups,
                  std::vector<std::vector<Word>>& masks);

 private:
  /// {y : the leader's box x {y} in K} for the rows of a unit, continued beyond the ends as levels are.
  struct Plane {
    bool is_known = false;
    std::vector<Word> rows;  ///< [row of the unit * plane_words_]
  };
  /// One group of a class in the row at hand.
  struct Candidate {
    std::uint32_t group = 0;
    bool is_minimal = false;
    bool is_full = false;     ///< the group was found in all cells of `reach`
    std::size_t rows = 0;     ///< follower: index into row_boxes_
    IndexRange window;        ///< follower: along the fastest dimension
    std::vector<Word> reach;  ///< the cells in which the group may be found
  };

  /// A lane beyond the ends of a row (counted from its margin on), and the lane whose bit it repeats.
  struct Beyond {
    std::size_t lane;
    std::int64_t source;  ///< lane of the row; negative: a member of every set
  };

  /// A row of the unit, and a lane of it (counted from its margin on) at which to begin.
  struct Position {
    std::int64_t row;
    std::size_t lane;
  };

  void find_beyond();
  void enter_unit(const RowPosition& position, const ActionGroups& groups);
  [[nodiscard]] const Plane& plane(std::uint32_t group);
  [[nodiscard]] const std::vector<Word>& continued(std::int64_t row);
  void continue_row(ConstRow row, Word* out) const;
  void list(const RowGroups& groups, std::size_t c, ConstRow invariant, std::vector<Candidate>& candidates);
  void locate_follower(Candidate& candidate);
  void list_lanes(std::span<const IndexRange> windows);
  void list_positions(std::span<const IndexRange> box, std::vector<Position>& positions);
  void erode(const Candidate& leader, const Candidate& follower, ConstRow invariant);
  void gather(const Plane& plane, const std::vector<Position>& list, Word* rows) const;
  void gather(const Candidate& leader, const Candidate& follower, Word* rows);
  void add(Candidate& candidate, std::vector<Word>& masks) const;

  const Controller& controller_;
  const RowBoxes& boxes_;
  const RowEngine& engine_;
  const BitKernels* kernels_;
  bool applies_ = false;
  std::size_t leader_ = 0;
  std::size_t follower_ = 1;
  std::size_t leading_ = 0;  ///< dimensions that the leader moves, if these are the leading ones; else 0
  std::int64_t unit_rows_ = 1;
  std::size_t words_ = 0;
  std::size_t plane_words_ = 0;     ///< of a row of a plane
  std::size_t gathered_words_ = 0;  ///< of the rows taken from a plane
  RowShape shape_;
  RowMargins margins_;          ///< in lanes
  std::vector<Beyond> beyond_;  ///< but for lanes that are never a member
  std::int64_t unit_ = -1;
  std::vector<Plane> planes_;  ///< [group of the leader]
  struct Continued {
    std::int64_t row = -1;
    std::vector<Word> bits;
  };
  std::vector<Continued> continued_;  ///< rows of K, some of them
  RowBox box_;
  std::vector<Word> all_;
  std::vector<Candidate> leaders_, followers_;
  std::vector<std::vector<IndexRange>> row_boxes_;  ///< different boxes of the followers, without `window`
  std::vector<std::vector<Position>> row_lists_;    ///< [box of rows] the rows and lanes that it reads
  std::vector<Word>
      gathered_;  ///< [box of rows * gathered_words_] the AND of its rows in the plane being read
  std::vector<std::uint8_t> is_gathered_;
  std::vector<Word> result_;
  std::vector<std::int64_t> lanes_;
  std::vector<std::int64_t> counter_;
};

}  // namespace coordreq
