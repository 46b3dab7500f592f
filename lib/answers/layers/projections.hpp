#pragma once

#include <cstdint>
#include <vector>

#include "answers/invariance/controller.hpp"
#include "answers/layers/independent_posts.hpp"
#include "base/thread_team.hpp"
#include "engine/cell_set.hpp"
#include "engine/row_hull.hpp"

namespace coordreq {

/// The projections of C onto the classes of one partition: IND_C(x) is their product (paper, Eq. (4); with
/// every agent by itself Eq. (3)). Held row by row, in the form that makes the least work of them.
class Projections {
 public:
  Projections(const Controller& controller, const ActionGrouping& grouping, const RowHull& hull,
              ThreadTeam& team);

  [[nodiscard]] const ActionGrouping& grouping() const { return *grouping_; }
  enum class Form : std::uint8_t {
    full,     ///< every action is in C(x) for all x of K in the row (or there are none)
    masks,    ///< a bit row for each group of actions of each class, see mask()
    product,  ///< boxes of posts for parts of the row, see IndependentPosts
  };
  [[nodiscard]] Form form(std::int64_t row) const {
    const auto r = static_cast<std::size_t>(row);
    if (rows_[r].empty()) return Form::full;
    return is_product_[r] != 0 ? Form::product : Form::masks;
  }
  /// [row] not 0 where every action is in C(x) for all x of K in the row, and K has any there: then IND_C is
  /// the same for all partitions.
  [[nodiscard]] const std::vector<std::uint8_t>& full_rows() const { return is_full_; }
  /// {x in the row : group g of class c is in the projection of C(x)}; groups as ActionGrouping::group
  /// numbers them. REQUIRES: form(row) is `masks`.
  [[nodiscard]] ConstRow mask(std::int64_t row, const RowGroups& groups, std::size_t c,
                              std::uint32_t g) const;
  /// For IndependentPosts::unpack(). REQUIRES: form(row) is `product`.
  [[nodiscard]] ConstRow packed(std::int64_t row) const { return rows_[static_cast<std::size_t>(row)]; }

 private:
  template <class Level>
  class Builder;

  const ActionGrouping* grouping_;
  std::size_t words_;
  std::vector<std::vector<Word>> rows_;  ///< masks: groups of class 0, then of class 1, ...
  std::vector<std::uint8_t> is_product_;
  std::vector<std::uint8_t> is_full_;
};

}  // namespace coordreq
