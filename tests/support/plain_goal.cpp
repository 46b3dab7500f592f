#include "support/plain_goal.hpp"

#include <algorithm>
#include <set>

#include "model/outside.hpp"
#include "spec/problem_spec.hpp"
#include "support/plain_posts.hpp"

namespace coordreq {
namespace {

using Set = std::vector<bool>;

std::size_t at(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

class GoalFinder {
 public:
  GoalFinder(const ProblemSpec& spec, const Abstraction& abstraction, const Set& safe, const Set& safe_beyond,
             const PlainAnalysis& plain, const Set& satisfying)
      : spec_(spec),
        a_(abstraction),
        safe_(safe),
        posts_{abstraction, safe, safe_beyond},
        plain_(plain),
        cells_(abstraction.grid.cells()),
        inputs_(abstraction.inputs.count()) {
    for (std::int64_t x = 0; x < cells_; ++x) goal_.push_back(plain.invariant[at(x)] && satisfying[at(x)]);
  }

  PlainGoal run() {
    if (spec_.goal_then == GoalThen::stay) find_stay();
    if (spec_.goal_then == GoalThen::come_back) keep_lasting_visits();
    if (spec_.goal_then != GoalThen::stay) find_arrival();
    find_progress();
    if (spec_.goal_then == GoalThen::come_back) find_longest();
    for (std::size_t p = 0; p < spec_.coordination.partitions.size(); ++p) find_approach(p);
    return result_;
  }

 private:
  /// f(x, u) lies in the set, nothing of it being T through a `safe` side.
  bool comes_to(std::int64_t x, std::int64_t u, const Set& target) const {
    for (std::size_t i = 0; i < a_.grid.size(); ++i) {
      const IndexRange raw = a_.raw(i, x, u);
      const GridDimension& dimension = a_.grid[i];
      if (raw.first < 0 && dimension.below == Outside::safe) return false;
      if (raw.last >= dimension.count && dimension.above == Outside::safe) return false;
    }
    return posts_.stays_in(x, u, target);
  }

  Set cells_below(std::int32_t arrival) const {
    Set set;
    for (const std::int32_t own : result_.arrival) set.push_back(own >= 0 && own < arrival);
    return set;
  }

  /// {v <= 0}, {v <= 1}, ...: each the greatest of its kind.
  void find_stay() {
    for (std::int64_t x = 0; x < cells_; ++x)
      result_.arrival.push_back(plain_.invariant[at(x)] ? INT32_MAX : safe_[at(x)] ? -1 : -2);
    Set before(at(cells_), false);
    for (std::int32_t n = 0;; ++n) {
      Set own = plain_.invariant;
      for (bool changed = true; changed;) {
        const Set old = own;
        for (std::int64_t x = 0; x < cells_; ++x)
          own[at(x)] = old[at(x)] && (goal_[at(x)] ? forces(x, old) : n > 0 && forces(x, before));
        changed = own != old;
      }
      if (n > 0 && own == before) return;
      for (std::int64_t x = 0; x < cells_; ++x) {
        if (own[at(x)] && !before[at(x)]) result_.arrival[at(x)] = n;
      }
      before = own;
    }
  }

  /// Leaves in G the cells of W: those of the greatest Y from each cell of which a cell of G that can keep
  /// within Y can be forced, within Y.
  void keep_lasting_visits() {
    Set whole = plain_.invariant;
    while (true) {
      Set reached(at(cells_), false);
      for (bool changed = true; changed;) {
        changed = false;
        for (std::int64_t x = 0; x < cells_; ++x) {
          if (!whole[at(x)] || reached[at(x)]) continue;
          if (!(goal_[at(x)] && forces(x, whole)) && !forces(x, reached)) continue;
          reached[at(x)] = changed = true;
        }
      }
      if (reached == whole) break;
      whole = reached;
    }
    for (std::int64_t x = 0; x < cells_; ++x) visits_.push_back(goal_[at(x)] && whole[at(x)]);
  }

  void find_longest() {
    for (std::int64_t x = 0; x < cells_; ++x) {
      if (result_.arrival[at(x)] != 0) continue;
      std::int32_t least = INT32_MAX, greatest = 0;
      for (std::int64_t u = 0; u < inputs_; ++u) {
        if (!result_.progress[at(x)][at(u)]) continue;
        std::int32_t steps = 1;
        while (!comes_to(x, u, cells_below(steps))) ++steps;
        least = std::min(least, steps);
        greatest = std::max(greatest, steps);
      }
      if (spec_.controller.synthesis == Synthesis::given) least = greatest;
      result_.longest_return = std::max(result_.longest_return.value_or(0), least);
      result_.longest_gap = std::max(result_.longest_gap.value_or(0), greatest);
    }
  }

  /// The cells in which every post of a step of progress at x, in W, lies.
  Set nearer_than(std::int64_t x) const {
    const std::int32_t arrival = result_.arrival[at(x)];
    if (spec_.goal_then == GoalThen::stay) return cells_below(arrival + (goal_[at(x)] ? 1 : 0));
    if (spec_.goal_then == GoalThen::come_back && arrival == 0) return cells_below(INT32_MAX);
    return cells_below(arrival);
  }

  /// Those that can be forced within 0, 1, 2, ... steps.
  void find_arrival() {
    for (std::int64_t x = 0; x < cells_; ++x) {
      const std::int32_t outside = safe_[at(x)] ? -1 : -2;
      const Set& target = spec_.is_goal_lasting() ? visits_ : goal_;
      result_.arrival.push_back(target[at(x)] ? 0 : plain_.invariant[at(x)] ? INT32_MAX : outside);
    }
    bool changed = true;
    for (std::int32_t k = 1; changed; ++k) {
      changed = false;
      const Set reached = cells_below(k);
      for (std::int64_t x = 0; x < cells_; ++x) {
        if (result_.arrival[at(x)] != INT32_MAX || !forces(x, reached)) continue;
        result_.arrival[at(x)] = k;
        changed = true;
      }
    }
  }

  bool forces(std::int64_t x, const Set& target) const {
    bool some = false;
    bool every = true;
    for (std::int64_t u = 0; u < inputs_; ++u) {
      if (!plain_.controller[at(x)][at(u)]) continue;
      const bool comes = comes_to(x, u, target);
      some = some || comes;
      every = every && comes;
    }
    return some && (every || spec_.controller.synthesis == Synthesis::maximal);
  }

  void find_progress() {
    for (std::int64_t x = 0; x < cells_; ++x) {
      Set& own = result_.progress.emplace_back(at(inputs_), false);
      const std::int32_t arrival = result_.arrival[at(x)];
      if (arrival < 0 || arrival == INT32_MAX) continue;
      own = plain_.controller[at(x)];
      if ((arrival == 0 && !spec_.is_goal_lasting()) || spec_.controller.synthesis == Synthesis::given)
        continue;
      const Set nearer = nearer_than(x);
      for (std::int64_t u = 0; u < inputs_; ++u) own[at(u)] = own[at(u)] && comes_to(x, u, nearer);
    }
  }

  /// IND_P(x).
  Set choices(std::int64_t x, const PartitionSpec& partition) const {
    Set result(at(inputs_), true);
    for (const auto& agents : partition.classes) {
      std::vector<std::size_t> inputs;
      for (const std::int32_t agent : agents) {
        for (const std::int32_t i : spec_.agents[at(agent)].inputs) inputs.push_back(at(i));
      }
      const auto action = [&](std::int64_t u) {
        std::vector<std::int64_t> values;
        for (const std::size_t i : inputs) values.push_back(a_.inputs.index(u, i));
        return values;
      };
      std::set<std::vector<std::int64_t>> actions;
      for (std::int64_t u = 0; u < inputs_; ++u) {
        if (result_.progress[at(x)][at(u)]) actions.insert(action(u));
      }
      for (std::int64_t u = 0; u < inputs_; ++u) result[at(u)] = result[at(u)] && actions.contains(action(u));
    }
    return result;
  }

  void find_approach(std::size_t p) {
    const PartitionSpec& partition = spec_.coordination.partitions[p];
    const PlainAnalysis::Partition& safety = plain_.partitions[p];
    const std::optional<std::int64_t>& most = spec_.coordination.max_delay;
    PlainGoal::Approach& result = result_.partitions.emplace_back();
    std::vector<Set> independent;
    for (std::int64_t x = 0; x < cells_; ++x) independent.push_back(choices(x, partition));
    const auto in_layer = [&](std::int64_t x, std::int32_t k) {  // x in Z_k
      return safety.delay[at(x)] >= k;
    };
    std::vector<Set> layers = {cells_below(INT32_MAX)};  // A_0 = W
    const auto still = [&](std::int32_t k) {             // Z_k = Z_{k+1}
      if (spec_.is_goal_lasting()) return true;
      for (std::int64_t x = 0; x < cells_; ++x) {
        if (in_layer(x, k) != in_layer(x, k + 1)) return false;
      }
      return true;
    };
    bool is_known = false;
    for (std::int32_t k = 0; !is_known && !(most && k == *most); ++k) {
      const Set& layer = layers.back();
      if (std::count(layer.begin(), layer.end(), true) == 0) break;
      Set next(at(cells_), false);
      for (std::int64_t x = 0; x < cells_; ++x) {
        if (!layer[at(x)]) continue;
        if (goal_[at(x)] && !spec_.is_goal_lasting()) {
          next[at(x)] = in_layer(x, k + 1);
          continue;
        }
        Set nearer = nearer_than(x);
        for (std::size_t y = 0; y < nearer.size(); ++y) nearer[y] = nearer[y] && layer[y];
        bool every = true;
        for (std::int64_t u = 0; u < inputs_; ++u)
          every = every &&
                  (!independent[at(x)][at(u)] || (plain_.permitted[at(x)][at(u)] && comes_to(x, u, nearer)));
        next[at(x)] = every;
      }
      is_known = next == layer && still(k);
      layers.push_back(std::move(next));
    }
    const Set last = layers.back();
    is_known = is_known || std::count(last.begin(), last.end(), true) == 0;
    result.truncated = !is_known;
    if (is_known) {
      while (layers.size() > 1 && layers[layers.size() - 2] == last) layers.pop_back();
      result.fixed_point_index = static_cast<std::int32_t>(layers.size()) - 1;
    }
    for (const Set& layer : layers) result.sizes.push_back(std::count(layer.begin(), layer.end(), true));
    for (std::int64_t x = 0; x < cells_; ++x) {
      std::int32_t delay = result_.arrival[at(x)] < 0 ? result_.arrival[at(x)] : -4;
      for (std::size_t k = 0; k < layers.size(); ++k) {
        if (layers[k][at(x)]) delay = static_cast<std::int32_t>(k);
      }
      if (is_known && last[at(x)]) delay = INT32_MAX;
      result.delay.push_back(delay);
    }
  }

  const ProblemSpec& spec_;
  const Abstraction& a_;
  const Set& safe_;
  PlainPosts posts_;
  const PlainAnalysis& plain_;
  std::int64_t cells_;
  std::int64_t inputs_;
  Set goal_;
  Set visits_;  ///< of a goal to return to: G and W
  PlainGoal result_;
};

}  // namespace

PlainGoal reach_goal_plainly(const ProblemSpec& spec, const Abstraction& abstraction, const Set& safe,
                             const Set& safe_beyond, const PlainAnalysis& plain, const Set& satisfying) {
  return GoalFinder(spec, abstraction, safe, safe_beyond, plain, satisfying).run();
}

}  // namespace coordreq
