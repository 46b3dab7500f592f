#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "answers/one_cell/cell_posts.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The progress controller P at single cells, straight from the definition (contract, sections 5 and 11). One
/// object a thread.
class ProgressInputs {
 public:
  /// Steps to the goal from a cell; INT32_MAX if the goal cannot be forced, below 0 outside K.
  using Arrival = std::function<std::int32_t(std::int64_t cell)>;

  /// @pre unchecked: both outlive this object.
  ProgressInputs(const ProblemSpec& spec, CellPosts& posts, Arrival arrival)
      : spec_(spec), posts_(posts), arrival_(std::move(arrival)) {}

  [[nodiscard]] std::int32_t arrival(std::int64_t x) const { return arrival_(x); }
  /// The greatest arrival in f(x,u); INT32_MAX if a cell outside K is in it, or T by way of a `safe` side.
  /// @pre unchecked: f(x,u) is not empty
  [[nodiscard]] std::int32_t worst(std::int64_t x, std::int64_t u);
  /// P(x) of C(x), ascending, x in W \ G; of a lasting goal x in W.
  [[nodiscard]] std::vector<std::int64_t> of(std::int64_t x, const std::vector<std::int64_t>& admissible);
  /// The greatest arrival after a step that makes progress. @pre unchecked: as of()
  [[nodiscard]] std::int32_t limit(std::int64_t x, const std::vector<std::int64_t>& admissible);
  /// Whether f(x,u) may be T by way of a `safe` side. @pre unchecked: worst() was called for x last
  [[nodiscard]] bool leaves_through_safe_side(std::int64_t u) const;

 private:
  [[nodiscard]] std::int32_t worst_in(const std::vector<IndexRange>& box);

  const ProblemSpec& spec_;
  CellPosts& posts_;
  Arrival arrival_;
  std::int64_t cell_ = -1;  ///< the cell of known_
  std::map<std::vector<IndexRange>, std::int32_t> known_;
};

}  // namespace coordreq
