#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "model/table_shape.hpp"
#include "numeric/interval.hpp"
#include "reach/point_flow.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {

/// Where solutions get to from a box of states, followed from its corners, the middles of its faces and its
/// centre, under constant disturbances at their lower ends, in the middle and at their upper ends: what an
/// enclosure cannot be smaller than. In double arithmetic, with no guarantee.
///
/// Scratch memory for one thread.
class SampledEnds {
 public:
  /// @pre unchecked: `spec` outlives this object.
  explicit SampledEnds(const SystemSpec& spec);

  /// Hull of the next values of a state, before the rules of the sample; nothing if it has an update, or if
  /// some are not known, or solutions take very many sub-steps together.
  /// Solutions that were followed for one state serve the next one that depends on the same, from the same
  /// box.
  /// @param slots boxes of all states, and inputs; what is not a point of them is sampled
  [[nodiscard]] std::optional<Interval> next(std::size_t state, std::span<const Interval> slots);

 private:
  [[nodiscard]] bool is_followed(std::size_t state, std::span<const Interval> slots) const;
  void follow(std::size_t state, std::span<const Interval> slots);
  void add();
  PointFlow& flow();

  const SystemSpec* spec_;
  std::vector<Dependencies> dependencies_;
  std::vector<std::unique_ptr<PointFlow>> flows_;  ///< one a state, made when needed
  std::vector<double> slots_;
  std::int64_t most_tried_ = 0;        ///< sub-steps of the flow that is asked, from its beginning
  std::size_t state_ = SIZE_MAX;       ///< that solutions were followed for
  std::vector<Interval> boxes_;        ///< from where
  std::vector<std::int32_t> ends_of_;  ///< the states whose ends are known
  std::vector<Interval> ends_;         ///< of each of these; not finite: not known
};

}  // namespace coordreq
