#include "support/plain_silence.hpp"

#include <algorithm>
#include <optional>

#include "expression/domains.hpp"
#include "expression/evaluate.hpp"
#include "model/input_class.hpp"
#include "spec/problem_spec.hpp"
#include "support/plain_posts.hpp"

namespace coordreq {
namespace {

using Set = std::vector<bool>;
using Pairs = std::vector<std::vector<bool>>;  ///< [cell][joint input]

std::size_t nth(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

class SilenceFinder {
 public:
  SilenceFinder(const ProblemSpec& spec, const Abstraction& abstraction, const Set& safe,
                const Set& safe_beyond, const PlainAnalysis& plain)
      : spec_(spec),
        a_(abstraction),
        safe_(safe),
        posts_{abstraction, safe, safe_beyond},
        plain_(plain),
        cells_(abstraction.grid.cells()),
        inputs_(abstraction.inputs.count()) {}

  PlainSilence run() {
    result_.terminal = plain_.terminal;
    result_.set = plain_.invariant;
    if (spec_.silence->has_then()) find_set();
    for (std::size_t p = 0; p < spec_.coordination.partitions.size(); ++p) find_layers(p);
    return std::move(result_);
  }

 private:
  /// Whether the condition of an agent holds at a centre under a joint input.
  Pairs truth_of(const Program& condition) const {
    Evaluator<RationalInterval> evaluator(condition);
    std::vector<RationalInterval> point(spec_.slot_count());
    Pairs result;
    for (std::int64_t x = 0; x < cells_; ++x) {
      Set& own = result.emplace_back(nth(inputs_), false);
      for (std::size_t i = 0; i < a_.grid.size(); ++i) {
        const Rational centre = a_.grid[i].point(a_.grid.index(x, i));
        point[i] = {.lower = centre, .upper = centre};
      }
      for (std::int64_t u = 0; u < inputs_; ++u) {
        for (std::size_t i = 0; i < a_.inputs.size(); ++i) {
          const Rational& value = a_.inputs[i].values[nth(a_.inputs.index(u, i))];
          point[spec_.input_slot(i)] = {.lower = value, .upper = value};
        }
        own[nth(u)] = evaluator.condition(point) == Truth::yes;
      }
    }
    return result;
  }

  Pairs everything() const { return Pairs(nth(cells_), Set(nth(inputs_), true)); }

  static void keep(const Pairs& other, Pairs& pairs) {
    for (std::size_t x = 0; x < pairs.size(); ++x) {
      for (std::size_t u = 0; u < pairs[x].size(); ++u) pairs[x][u] = pairs[x][u] && other[x][u];
    }
  }

  /// The choices are not empty, and all of them are permitted and lead into the set; or the task is over.
  bool leads_into(std::int64_t x, const Pairs& choices, const Set& target) const {
    bool some = plain_.terminal[nth(x)];
    if (some) return true;
    for (std::int64_t u = 0; u < inputs_; ++u) {
      if (!choices[nth(x)][nth(u)]) continue;
      some = true;
      if (!plain_.permitted[nth(x)][nth(u)] || !posts_.stays_in(x, u, target)) return false;
    }
    return some;
  }

  Set next(const Set& layer, const Pairs& choices) const {
    Set result(nth(cells_), false);
    for (std::int64_t x = 0; x < cells_; ++x) result[nth(x)] = layer[nth(x)] && leads_into(x, choices, layer);
    return result;
  }

  void find_set() {
    result_.then = everything();
    for (const std::optional<Program>& rule : spec_.silence->then) keep(truth_of(*rule), result_.then);
    Set set = safe_;
    for (Set smaller = next(set, result_.then); smaller != set; smaller = next(set, result_.then))
      set = smaller;
    result_.set = set;
  }

  /// A of a partition: of a class in which an agent has no rule what is part of C(x), too.
  Pairs actions_of(std::size_t p) const {
    Pairs actions = everything();
    for (const std::optional<Program>& rule : spec_.silence->actions) {
      if (rule) keep(truth_of(*rule), actions);
    }
    const PartitionSpec& partition = spec_.coordination.partitions[p];
    for (std::size_t c = 0; c < partition.classes.size(); ++c) {
      const bool have_rules =
          std::all_of(partition.classes[c].begin(), partition.classes[c].end(),
                      [&](std::int32_t i) { return spec_.silence->actions[nth(i)].has_value(); });
      if (have_rules) continue;
      const InputClass own = class_of(spec_, a_.inputs, partition.classes[c]);
      const auto& projection = plain_.partitions[p].projection[c];
      for (std::int64_t x = 0; x < cells_; ++x) {
        for (std::int64_t u = 0; u < inputs_; ++u) {
          if (!projection[nth(x)][nth(own.action(u))]) actions[nth(x)][nth(u)] = false;
        }
      }
    }
    return actions;
  }

  void find_layers(std::size_t p) {
    PlainSilence::Partition& own = result_.partitions.emplace_back();
    own.actions = actions_of(p);
    std::vector<Set> layers = {result_.set};
    const std::optional<std::int64_t>& most = spec_.coordination.max_delay;
    bool is_fixed = false;
    while (!is_fixed && (!most || std::ssize(layers) <= *most)) {
      Set smaller = next(layers.back(), own.actions);
      is_fixed = smaller == layers.back();
      if (!is_fixed) layers.push_back(std::move(smaller));
    }
    const auto count = [](const Set& set) { return std::count(set.begin(), set.end(), true); };
    for (const Set& layer : layers) own.sizes.push_back(count(layer));
    is_fixed = is_fixed || own.sizes.back() == 0;
    own.truncated = !is_fixed;
    own.fixed_point_index = is_fixed ? static_cast<std::int32_t>(layers.size()) - 1 : -1;
    for (std::int64_t x = 0; x < cells_; ++x) {
      std::int32_t silence = safe_[nth(x)] ? -1 : -2;
      for (const Set& layer : layers) silence += layer[nth(x)] ? 1 : 0;
      const bool is_last = layers.back()[nth(x)];
      own.silence.push_back(is_last && is_fixed ? INT32_MAX : silence);
    }
  }

  const ProblemSpec& spec_;
  const Abstraction& a_;
  const Set& safe_;
  PlainPosts posts_;
  const PlainAnalysis& plain_;
  std::int64_t cells_;
  std::int64_t inputs_;
  PlainSilence result_;
};

}  // namespace

PlainSilence told_silence_plainly(const ProblemSpec& spec, const Abstraction& abstraction,
                                  const std::vector<bool>& safe, const std::vector<bool>& safe_beyond,
                                  const PlainAnalysis& plain) {
  return SilenceFinder(spec, abstraction, safe, safe_beyond, plain).run();
}

}  // namespace coordreq
