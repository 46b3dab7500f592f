#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "answers/checking/claims.hpp"
#include "answers/checking/tally.hpp"
#include "base/thread_team.hpp"
#include "spec/spec_types.hpp"
#include "verify/budget.hpp"

namespace coordreq {

/// The work under way; reported on the calling thread only.
struct VerifyProgress {
  std::string stage;      ///< "reading", "posts", "tubes", "cells"
  std::int64_t done = 0;  ///< of `all`; both 0 where that is not known
  std::int64_t all = 0;
};

struct VerifyOptions {
  std::optional<std::int64_t> sample;  ///< check so many cells, evenly drawn; all if none
  /// Of work, see work_of_seconds(): for reachable sets that are hard to confirm, and as much again, or that
  /// of a second, for posts that have to be found, and for cells. None: kDefaultBudget for the former,
  /// and no bound for the rest.
  std::optional<double> budget_seconds;

  static constexpr double kDefaultBudget = 60;
  /// Risks within the horizon are computed again too. @pre then neither of the above is given.
  bool full = false;
  std::function<void(const VerifyProgress&)> progress;  ///< may be empty
};

/// The posts that the checks of cells rest on.
enum class PostBasis : std::uint8_t {
  exact,     ///< the verifier's own posts, which are those of the contract: a complete certificate
  stored,    ///< the abstraction in the file, which holds the verifier's own enclosures
  computed,  ///< the abstraction that the analysis makes of the spec, which holds the verifier's own
             ///< enclosures
};

enum class Verdict : std::uint8_t {
  holds,          ///< everything that was checked
  wrong,          ///< some definition is violated, or some state leaves where it is said to be
  not_confirmed,  ///< nothing is wrong, but something could not be proven
};

struct Verification {
  std::string name;        ///< of the spec
  std::int64_t cells = 0;  ///< of the grid
  std::int64_t cells_checked = 0;
  PostBasis basis = PostBasis::exact;
  /// The basis for the ways between the samples, if they have to be safe: `exact` where the cells that cover
  /// them could not be fewer, else `computed`.
  std::optional<PostBasis> tubes;
  /// States whose reachable sets, or ways between the samples, are only those of the analysis, computed anew:
  /// the verifier's own integrator does not do for them.
  std::vector<std::string> borrowed;
  std::vector<std::string> given;   ///< paths of what was taken as it is
  std::int64_t enclosed = 0;        ///< reachable sets that are not exact and were looked at
  std::int64_t confirmed = 0;       ///< how many of them the verifier's own enclosures confirm
  std::int64_t posts_computed = 0;  ///< how many posts of the analysis, a state each, were computed anew
  /// Of enclosures, in units of work.
  struct {
    Work spent = 0;
    Work budget = 0;
    std::int64_t left_open = 0;  ///< reachable sets that are not confirmed for want of work
  } work;
  std::vector<Finding> findings;

  [[nodiscard]] Verdict verdict() const;
  /// Whether nothing is wrong.
  [[nodiscard]] bool holds() const { return verdict() != Verdict::wrong; }
};

/// Checks the claims of a results file against its spec by another route than the analysis took: by the
/// definitions that the checks of all answers tell, on posts from corners of cells in rational arithmetic
/// where that is exact. Else the abstraction in the file, or one that is computed anew, after enclosures of
/// its own have shown it to be sound. The ways between the samples are always those of the analysis, after
/// the same.
/// @throws SpecError if the spec is beyond what it can check
[[nodiscard]] Verification verify_claims(const ProblemSpec& spec, const Claims& claims,
                                         const VerifyOptions& options, ThreadTeam& team);

}  // namespace coordreq
