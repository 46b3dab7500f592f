#include "support/plain_engine.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "answers/countdown/delay_layers.hpp"
#include "answers/invariance/invariance.hpp"
#include "answers/invariance/safe_tubes.hpp"
#include "answers/step_codes.hpp"
#include "expression/domains.hpp"
#include "expression/evaluate.hpp"
#include "model/odometer.hpp"
#include "model/pieces.hpp"
#include "spec/problem_spec.hpp"
#include "support/plain_posts.hpp"

namespace coordreq {
namespace {

using Set = std::vector<bool>;

class PlainEngine {
 public:
  PlainEngine(const ProblemSpec& spec, const Abstraction& abstraction, const Set& safe,
              const Set& safe_beyond, const PackedPairs* listed, const Set& terminal)
      : spec_(spec),
        a_(abstraction),
        safe_(safe),
        posts_{abstraction, safe, safe_beyond},
        listed_(listed),
        cells_(abstraction.grid.cells()),
        inputs_(abstraction.inputs.count()) {
    result_.terminal = terminal.empty() ? Set(at(cells_), false) : terminal;
  }

  PlainAnalysis run() {
    find_allowed();
    find_invariant();
    find_controller();
    for (const PartitionSpec& partition : spec_.coordination.partitions) layers(partition);
    if (spec_.network) network(*spec_.network);
    result_.permitted = permitted_;
    return result_;
  }

 private:
  static std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

  void find_allowed() {
    for (std::int64_t x = 0; x < cells_; ++x) {
      allowed_.emplace_back(at(inputs_), true);
      permitted_.emplace_back(at(inputs_), true);
      for (std::int64_t u = 0; listed_ != nullptr && u < inputs_; ++u)
        allowed_.back()[at(u)] = listed_->test(x, u);
      if (!spec_.controller.allow) continue;
      Evaluator<RationalInterval> allow(*spec_.controller.allow);
      std::vector<RationalInterval> point(spec_.slot_count());
      for (std::size_t i = 0; i < a_.grid.size(); ++i) {
        const Rational centre = a_.grid[i].point(a_.grid.index(x, i));
        point[i] = {.lower = centre, .upper = centre};
      }
      for (std::int64_t u = 0; u < inputs_; ++u) {
        for (std::size_t i = 0; i < a_.inputs.size(); ++i) {
          const Rational& value = a_.inputs[i].values[at(a_.inputs.index(u, i))];
          point[a_.grid.size() + i] = {.lower = value, .upper = value};
        }
        if (allow.condition(point) == Truth::yes) continue;
        allowed_.back()[at(u)] = permitted_.back()[at(u)] = false;
      }
    }
  }

  bool stays_in(std::int64_t x, std::int64_t u, const Set& target) const {
    return posts_.stays_in(x, u, target);
  }

  bool keeps(std::int64_t x, const Set& target) const {
    bool some = false;
    bool every = true;
    bool any_allowed = false;
    for (std::int64_t u = 0; u < inputs_; ++u) {
      if (!allowed_[at(x)][at(u)]) continue;
      any_allowed = true;
      const bool stays = stays_in(x, u, target);
      some = some || stays;
      every = every && stays;
    }
    return spec_.controller.synthesis == Synthesis::maximal ? some : any_allowed && every;
  }

  void find_invariant() {
    result_.invariant = safe_;
    for (const bool safe : safe_) result_.collision_time.push_back(safe ? INT32_MAX : 0);
    for (bool changed = true; changed;) {
      changed = false;
      ++result_.iterations;
      const Set before = result_.invariant;
      for (std::int64_t x = 0; x < cells_; ++x) {
        if (!before[at(x)] || result_.terminal[at(x)] || keeps(x, before)) continue;
        result_.invariant[at(x)] = false;
        result_.collision_time[at(x)] = static_cast<std::int32_t>(result_.iterations);
        changed = true;
      }
    }
  }

  void find_controller() {
    for (std::int64_t x = 0; x < cells_; ++x) {
      std::vector<bool>& c = result_.controller.emplace_back(at(inputs_), false);
      for (std::int64_t u = 0; u < inputs_ && result_.invariant[at(x)]; ++u) {
        c[at(u)] = allowed_[at(x)][at(u)] &&
                   (spec_.controller.synthesis == Synthesis::given || stays_in(x, u, result_.invariant));
      }
    }
  }

  std::vector<std::size_t> class_inputs(const std::vector<std::int32_t>& agents) const {
    std::vector<std::size_t> inputs;
    for (const std::int32_t agent : agents) {
      for (const std::int32_t input : spec_.agents[at(agent)].inputs) inputs.push_back(at(input));
    }
    std::sort(inputs.begin(), inputs.end());
    return inputs;
  }

  /// Number of the joint action that joint input u gives to a class: row-major over its inputs.
  std::int64_t action_of(std::int64_t u, const std::vector<std::size_t>& inputs) const {
    std::int64_t action = 0;
    for (const std::size_t i : inputs) action = action * a_.inputs[i].count() + a_.inputs.index(u, i);
    return action;
  }

  void layers(const PartitionSpec& partition) {
    PlainAnalysis::Partition& result = result_.partitions.emplace_back();
    std::vector<std::vector<std::size_t>> classes;
    for (const auto& agents : partition.classes) {
      classes.push_back(class_inputs(agents));
      std::int64_t actions = 1;
      for (const std::size_t i : classes.back()) actions *= a_.inputs[i].count();
      result.projection.emplace_back(at(cells_), std::vector<bool>(at(actions), false));
    }
    for (std::int64_t x = 0; x < cells_; ++x) {
      for (std::int64_t u = 0; u < inputs_; ++u) {
        if (!result_.controller[at(x)][at(u)]) continue;
        for (std::size_t c = 0; c < classes.size(); ++c)
          result.projection[c][at(x)][at(action_of(u, classes[c]))] = true;
      }
    }
    const auto reasonable = [&](std::int64_t x, std::int64_t u) {
      for (std::size_t c = 0; c < classes.size(); ++c) {
        if (!result.projection[c][at(x)][at(action_of(u, classes[c]))]) return false;
      }
      return true;
    };
    iterate(result, reasonable);
  }

  /// IND of the joint inputs given, for one cell.
  std::vector<bool> independent(const std::vector<bool>& joint, const PartitionSpec& partition) const {
    std::vector<bool> result(at(inputs_), true);
    for (const auto& agents : partition.classes) {
      const std::vector<std::size_t> own = class_inputs(agents);
      std::set<std::int64_t> actions;
      for (std::int64_t u = 0; u < inputs_; ++u) {
        if (joint[at(u)]) actions.insert(action_of(u, own));
      }
      for (std::int64_t u = 0; u < inputs_; ++u) {
        if (!actions.contains(action_of(u, own))) result[at(u)] = false;
      }
    }
    return result;
  }

  /// Straight from the definition of W(q); the synchronous iteration in both cases.
  void network(const NetworkSpec& network) {
    std::vector<Set>& sets = result_.network;
    sets.assign(network.modes.size(), result_.invariant);
    for (bool changed = true; changed;) {
      const std::vector<Set> before = sets;
      for (std::size_t q = 0; q < sets.size(); ++q) {
        Set target(at(cells_), true);
        for (const auto& [from, to] : network.transitions) {
          if (at(from) != q) continue;
          for (std::size_t x = 0; x < target.size(); ++x) target[x] = target[x] && before[at(to)][x];
        }
        for (std::int64_t x = 0; x < cells_; ++x) {
          const PartitionSpec& partition = network.modes[q].partition;
          if (before[q][at(x)] && !result_.terminal[at(x)] &&
              !stays_in_mode(x, partition, network.resynthesise, target))
            sets[q][at(x)] = false;
        }
      }
      changed = sets != before;
    }
  }

  bool stays_in_mode(std::int64_t x, const PartitionSpec& partition, bool resynthesise,
                     const Set& target) const {
    std::vector<bool> leads_there;
    for (std::int64_t u = 0; u < inputs_; ++u)
      leads_there.push_back(permitted_[at(x)][at(u)] && stays_in(x, u, target));
    std::vector<bool> controller = result_.controller[at(x)];
    std::vector<bool> good = leads_there;
    if (resynthesise) {
      for (std::size_t u = 0; u < good.size(); ++u) good[u] = good[u] && allowed_[at(x)][u];
      controller = good;
    }
    const std::vector<bool> choices = independent(controller, partition);
    bool some = false;
    for (std::size_t u = 0; u < choices.size(); ++u) {
      some = some || controller[u];
      if (choices[u] && !good[u]) return false;
    }
    return some;
  }

  template <class Reasonable>
  void iterate(PlainAnalysis::Partition& result, const Reasonable& reasonable) {
    Set layer = result_.invariant;
    for (std::int64_t x = 0; x < cells_; ++x) {
      result.delay.push_back(safe_[at(x)] ? (layer[at(x)] ? kUnbounded : -1) : -2);
    }
    result.sizes.push_back(std::count(layer.begin(), layer.end(), true));
    for (std::int64_t k = 0;; ++k) {
      const bool stop =
          spec_.coordination.max_delay && k == *spec_.coordination.max_delay && result.sizes.back() > 0;
      if (stop) break;
      Set next = layer;
      for (std::int64_t x = 0; x < cells_; ++x) {
        if (!layer[at(x)] || result_.terminal[at(x)]) continue;
        bool some = false;
        bool every = true;
        for (std::int64_t u = 0; u < inputs_ && every; ++u) {
          if (!reasonable(x, u)) continue;
          some = true;
          every = permitted_[at(x)][at(u)] && stays_in(x, u, layer);
        }
        if (some && every) continue;
        next[at(x)] = false;
        result.delay[at(x)] = static_cast<std::int32_t>(k);
      }
      if (next == layer) {
        result.fixed_point_index = static_cast<std::int32_t>(k);
        return;
      }
      layer = next;
      result.sizes.push_back(std::count(layer.begin(), layer.end(), true));
    }
    result.truncated = true;
    for (std::int32_t& delay : result.delay) {
      if (delay == kUnbounded) delay = static_cast<std::int32_t>(*spec_.coordination.max_delay);
    }
  }

  const ProblemSpec& spec_;
  const Abstraction& a_;
  const Set& safe_;
  PlainPosts posts_;
  const PackedPairs* listed_;
  std::int64_t cells_;
  std::int64_t inputs_;
  std::vector<std::vector<bool>> allowed_;    ///< by `allow`, and listed
  std::vector<std::vector<bool>> permitted_;  ///< by `allow`, whatever is listed
  PlainAnalysis result_;
};

RationalInterval between(const Rational& lower, const Rational& upper) {
  return {.lower = lower, .upper = upper};
}

/// Calls `visit` for every choice of one interval a state.
template <class Visit>
void for_each_choice(const std::vector<std::vector<RationalInterval>>& choices, const Visit& visit) {
  std::vector<std::int64_t> counts;
  for (const auto& one : choices) counts.push_back(static_cast<std::int64_t>(one.size()));
  Odometer choice(counts);
  do {
    std::vector<RationalInterval> box;
    for (std::size_t i = 0; i < choices.size(); ++i) {
      box.push_back(choices[i][static_cast<std::size_t>(choice.indices()[i])]);
    }
    visit(box);
  } while (choice.advance());
}

/// What state i can be in cell k: as whole pieces, and as samples of them.
struct Choices {
  std::vector<RationalInterval> whole;
  std::vector<RationalInterval> samples;

  Choices(const ProblemSpec& spec, const GridDimension& dimension, std::int64_t k) {
    if (spec.abstraction.safe == Membership::center) {
      whole.push_back(between(dimension.point(k), dimension.point(k)));
    } else {
      for (const Piece& piece : pieces(dimension, k)) whole.push_back(between(piece.lower, piece.upper));
    }
    for (const RationalInterval& range : whole) {
      const int steps = range.lower == range.upper ? 1 : 4;
      for (int s = 0; s <= steps; ++s) {
        const Rational point = range.lower + (range.upper - range.lower) * s / steps;
        samples.push_back(between(point, point));
      }
    }
  }
};

}  // namespace

PlainAnalysis analyze_plainly(const ProblemSpec& spec, const Abstraction& abstraction,
                              const std::vector<bool>& safe, const std::vector<bool>& safe_beyond,
                              const PackedPairs* listed, const std::vector<bool>& terminal) {
  return PlainEngine(spec, abstraction, safe, safe_beyond, listed, terminal).run();
}

SafeBounds bound_safe_plainly(const ProblemSpec& spec, const UniformGrid& grid) {
  SafeBounds bounds;
  Evaluator<RationalInterval> condition(spec.safe);
  for (std::int64_t x = 0; x < grid.cells(); ++x) {
    std::vector<std::vector<RationalInterval>> whole;
    std::vector<std::vector<RationalInterval>> samples;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      Choices choices(spec, grid[i], grid.index(x, i));
      whole.push_back(std::move(choices.whole));
      samples.push_back(std::move(choices.samples));
    }
    bool proven = true;
    bool possible = true;
    for_each_choice(whole,
                    [&](const auto& box) { proven = proven && condition.condition(box) == Truth::yes; });
    for_each_choice(
        samples, [&](const auto& point) { possible = possible && condition.condition(point) == Truth::yes; });
    bounds.natural.push_back(proven);
    bounds.sampled.push_back(possible);
  }
  return bounds;
}

}  // namespace coordreq
