#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "numeric/rational.hpp"

namespace coordreq {

/// A state of a path that the system itself has followed so far.
struct FollowedState {
  std::int64_t cell = 0;
  std::size_t phase = 0;        ///< number of the phase of the next step
  std::vector<Rational> state;  ///< of the system itself
  std::size_t steps = 0;        ///< number of steps from the start
  std::int64_t number = 0;      ///< of the joint input to take next, among equal ones
};

/// Searches, of equally short paths, the one that the system itself follows longest, of these the one of
/// lowest numbers: depth first over the joint inputs of equal steps that the system can follow. A state that
/// was visited before is not visited again. When the allowed work is used up the longest path so far is
/// taken, which is never shorter than one found step by step.
class PathSearch {
 public:
  /// [step] Which of the equal joint inputs is taken; in steps after these, the first one.
  using Choices = std::vector<std::int64_t>;

  /// @param work number of looks at joint inputs that all searches of this object may take
  explicit PathSearch(std::int64_t work) : work_(work) {}

  /// @param walk a path from its present position, with these functions: position(), where the system itself
  /// is,
  ///   nothing if it is followed no longer; go_to(position); step(number), one more step: the looks it took;
  ///   has_more(), whether there are equal ones behind that number; is_whole(), whether it has been followed
  ///   to its end
  /// @pre unchecked: the system itself is followed.
  template <class Walk>
  [[nodiscard]] Choices find(Walk& walk) {
    Choices current, longest;
    std::vector<FollowedState> open;
    std::set<std::tuple<std::size_t, std::size_t, std::int64_t, std::vector<Rational>>> known;
    std::optional<FollowedState> here = walk.position();
    for (;;) {
      while (here && work_ > 0) {
        const std::int64_t number = here->number;
        work_ -= walk.step(number);
        if (walk.has_more()) {
          open.push_back(std::move(*here));
          ++open.back().number;
        }
        if (walk.is_whole()) return current.push_back(number), current;
        here = walk.position();
        if (here) current.push_back(number);
        if (here && !known.emplace(here->steps, here->phase, here->cell, here->state).second) here.reset();
      }
      if (current.size() > longest.size()) longest = current;
      if (open.empty() || work_ <= 0) return longest;
      here = std::move(open.back());
      open.pop_back();
      current.resize(here->steps);
      walk.go_to(*here);
    }
  }

 private:
  std::int64_t work_;
};

}  // namespace coordreq
