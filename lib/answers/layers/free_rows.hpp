#pragma once

#include <vector>

#include "answers/invariance/controller.hpp"
#include "base/fast_paths.hpp"
#include "engine/post_reader.hpp"
#include "engine/row_hull.hpp"

namespace coordreq {

/// Finds the rows in which every joint input is admissible in all cells of K, by the box around all posts of
/// a row: one read instead of projections. The switch is FastPaths::free_rows.
///
/// One object a thread.
template <class Level>
class FreeRows {
 public:
  /// @pre unchecked: all outlive this object; `posts` reads the levels of controller.levels.
  FreeRows(const Controller& controller, const RowHull& hull, PostReader<Level>& posts)
      : controller_(controller), hull_(hull), posts_(posts), lanes_(posts.lanes(), 0) {}

  /// False also where the box does not show it.
  [[nodiscard]] bool is_free(const RowPlace& place) {
    if (controller_.engine->allow() != nullptr) return false;
    if (controller_.synthesis == Synthesis::given) return true;
    if (!looks_ || controller_.approaches) return false;
    hull_.box(place, box_);
    if (!box_.covers) return false;
    const auto n = static_cast<std::size_t>(controller_.engine->row_length());
    posts_.kernels().spread(controller_.invariant->row(place.row).data(), lanes_.data(), n);
    return posts_.kernels().is_top(posts_.minimum(box_), lanes_.data(), n);
  }

 private:
  const Controller& controller_;
  const RowHull& hull_;
  PostReader<Level>& posts_;
  bool looks_ = fast_paths().free_rows;
  RowBox box_;
  std::vector<Level> lanes_;
};

}  // namespace coordreq
