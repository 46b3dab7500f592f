#include "answers/checking/all_checks.hpp"

#include <algorithm>
#include <atomic>
#include <deque>
#include <mutex>
#include <optional>
#include <vector>

#include "answers/checking/cell_location.hpp"
#include "answers/checking/steps_check.hpp"
#include "base/index.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Each agent by itself: the actions that `then` leaves do not depend on classes.
ClassChoices choices_of_then(const CheckContext& context) {
  ClassChoices::Partition agents;
  for (std::size_t i = 0; i < context.spec->agents.size(); ++i)
    agents.push_back({static_cast<std::int32_t>(i)});
  return {context, agents, ClassChoices::Rules::then};
}

/// Data of one partition that all threads share.
struct PartitionOfSilence {
  static constexpr const CountdownKind& kKind = kSilenceKind;

  PartitionOfSilence(const CheckContext& context, std::size_t p)
      : claims(*context.spec, *context.claims, p, kKind), silence("silence " + claims.partition.name) {}

  [[nodiscard]] std::vector<Finding> findings() const { return {silence.finding()}; }

  PartitionClaims claims;
  Tally silence;
};

/// The check of K' that all threads share.
struct SetOfSilence {
  explicit SetOfSilence(const CheckContext& context)
      : has_then(context.spec->silence->has_then()),
        members(context.claims->members(has_then ? "/silence_set" : "/invariant")) {}

  bool has_then;
  const std::vector<std::uint8_t>& members;
  Tally tally{"silence set"};
  std::atomic<std::int64_t> looked_at{0};
};

/// Whether all actions of `then` keep a cell in a set, or the task ends in the cell. @param set [cell] 0 or 1
bool stays(CheckedCell& cell, ClassChoices& then, const std::vector<std::uint8_t>& set) {
  if (cell.is_terminal()) return true;
  then.go_to(cell.number(), cell.admitted());
  const std::vector<std::int64_t> choices = then.joint();
  return !choices.empty() && std::ranges::all_of(choices, [&](std::int64_t u) {
    return !cell.is_forbidden(u) && cell.least(u, set, 0) > 0;
  });
}

class SilenceChecker : public CellChecker {
 public:
  SilenceChecker(const CheckContext& context, SetOfSilence& set, std::deque<PartitionOfSilence>& partitions)
      : context_(context), set_(set), partitions_(partitions) {
    for (const PartitionOfSilence& partition : partitions)
      actions_.emplace_back(context, partition.claims.partition.classes, ClassChoices::Rules::actions);
    if (set.has_then) then_.emplace(choices_of_then(context));
  }

  void check(CheckedCell& cell) override {
    ++set_.looked_at;
    const bool is_member = cell.is_safe() && set_.members[cell.at()] != 0;
    if (then_) check_member(cell, is_member);
    for (std::size_t p = 0; p < partitions_.size(); ++p) {
      PartitionOfSilence& partition = partitions_[p];
      const PartitionClaims& claims = partition.claims;
      std::int32_t expected = steps_outside(cell);
      if (is_member) {
        actions_[p].go_to(cell.number(), cell.admitted());
        expected = steps_by_definition(cell, actions_[p], claims.delay, claims.most);
      }
      compare_steps(context_, partition.silence, cell, claims.delay[cell.at()], expected);
    }
  }

 private:
  void check_member(CheckedCell& cell, bool is_member) {
    set_.tally.add_checked(1);
    if (set_.members[cell.at()] == 0) return;
    if (is_member && stays(cell, *then_, set_.members)) return;
    set_.tally.add_wrong(cell.number(),
                         [&] { return cell.location() + ": the fallback rule does not keep it there"; });
  }

  const CheckContext& context_;
  SetOfSilence& set_;
  std::deque<PartitionOfSilence>& partitions_;
  std::deque<ClassChoices> actions_;  ///< [partition]
  std::optional<ClassChoices> then_;
};

class SilenceCheck : public StepsCheck<PartitionOfSilence> {
 public:
  explicit SilenceCheck(const CheckContext& context) : StepsCheck(context), set_(context) {}

  std::vector<Finding> compare_sizes(Comparison& sizes) override {
    std::vector<Finding> findings = StepsCheck::compare_sizes(sizes);
    if (set_.has_then) {
      const std::vector<std::uint64_t>& cells = context_.claims->at("/silence_set").cells;
      sizes.expect("cells of /silence_set", cells.empty() ? UINT64_MAX : cells.front(),
                   count_members(set_.members));
    }
    return findings;
  }
  std::unique_ptr<CellChecker> cell_checker() override {
    return std::make_unique<SilenceChecker>(context_, set_, partitions_);
  }
  void check_all(ThreadTeam& team) override {
    if (set_.has_then && set_.looked_at >= context_.grid->cells()) check_greatest(team);
  }
  [[nodiscard]] std::vector<Finding> findings() const override {
    std::vector<Finding> result;
    if (set_.has_then) result.push_back(set_.tally.finding());
    std::ranges::move(StepsCheck::findings(), std::back_inserter(result));
    return result;
  }

 private:
  /// Checks that no cell of S outside K' is in the limit: removes cells from which `then` leads out of the
  /// rest until there are none.
  void check_greatest(ThreadTeam& team) {
    const std::vector<std::uint8_t>& safe = context_.claims->members("/safe");
    std::vector<std::uint8_t> left(safe.size());
    std::vector<std::int64_t> open;
    for (std::size_t x = 0; x < left.size(); ++x) {
      left[x] = safe[x] != 0 || set_.members[x] != 0 ? 1 : 0;
      if (left[x] != 0 && set_.members[x] == 0) open.push_back(static_cast<std::int64_t>(x));
    }
    for (std::size_t before = open.size() + 1; open.size() < before;) {
      before = open.size();
      for (const std::int64_t x : leaving(open, left, team)) left[at(x)] = 0;
      std::erase_if(open, [&](std::int64_t x) { return left[at(x)] == 0; });
    }
    for (const std::int64_t x : open) {
      if (context_.sound_only()) {
        set_.tally.add_unproven();
      } else {
        set_.tally.add_wrong(x, [&] {
          return location_of(*context_.grid, x) + ": expected in the set, the fallback rule keeps it";
        });
      }
    }
  }

  /// The cells of `cells` from which `then` may lead out of a set.
  [[nodiscard]] std::vector<std::int64_t> leaving(const std::vector<std::int64_t>& cells,
                                                  const std::vector<std::uint8_t>& set,
                                                  ThreadTeam& team) const {
    std::vector<std::int64_t> result;
    std::mutex mutex;
    team.for_each(std::ssize(cells), 512, [&](ThreadTeam::Range range, int) {
      CheckedCell cell(context_);
      ClassChoices then = choices_of_then(context_);
      std::vector<std::int64_t> found;
      for (std::int64_t i = range.begin; i < range.end; ++i) {
        cell.go_to(cells[at(i)]);
        if (!stays(cell, then, set)) found.push_back(cell.number());
      }
      const std::lock_guard lock(mutex);
      result.insert(result.end(), found.begin(), found.end());
    });
    return result;
  }

  SetOfSilence set_;
};

}  // namespace

/// Checks how long silence is safe, straight from the definitions:
/// - for x in K': silence(x) = 1 + min over u in A(x), y in f(x, u) of silence(y), where cells outside K' and
///   pairs without post, or that `allow` forbids, are worth -1; 0 where A(x) is empty. By induction this is
///   membership in every layer;
/// - from each cell of K' `then` leaves some action, and all its actions stay in K'; and K' is the greatest
///   such subset of S, if all posts are known;
/// - F, whether max_delay stopped the iteration, and sizes of layers against the silence of the cells.
/// Null if the spec does not say what silent agents do.
std::unique_ptr<AnswerCheck> check_silence(const CheckContext& context) {
  if (!context.spec->silence) return nullptr;
  return std::make_unique<SilenceCheck>(context);
}

/// Bytes a cell that the check keeps.
double silence_check_memory(const ProblemSpec& spec) {
  if (!spec.silence || !spec.silence->has_then()) return 0;
  return sizeof(std::uint8_t) + 2 * sizeof(std::int64_t);  // the cells of S left, and those still open
}

}  // namespace coordreq
