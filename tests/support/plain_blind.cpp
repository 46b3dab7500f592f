#include "support/plain_blind.hpp"

#include <algorithm>
#include <optional>

#include "model/input_class.hpp"
#include "spec/problem_spec.hpp"
#include "support/plain_posts.hpp"

namespace coordreq {
namespace {

using Set = std::vector<bool>;

std::size_t index_of(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

std::int64_t size_of(const Set& set) {
  return std::count(set.begin(), set.end(), true);
}

/// One partition of several classes.
class BlindFinder {
 public:
  BlindFinder(const ProblemSpec& spec, const Abstraction& abstraction, const PlainPosts& posts,
              const PlainAnalysis& plain, std::size_t p)
      : spec_(spec),
        posts_(posts),
        plain_(plain),
        own_(plain.partitions[p]),
        classes_(input_classes(spec, abstraction.inputs, spec.coordination.partitions[p])),
        cells_(abstraction.grid.cells()),
        inputs_(abstraction.inputs.count()) {
    for (const auto& agents : spec.coordination.partitions[p].classes)
      sights_.emplace_back(spec, abstraction.grid, agents);
  }

  PlainBlind::Partition run() {
    find_layers();
    find_delays();
    find_tables();
    return std::move(result_);
  }

 private:
  /// IND_C(x) is not empty, and all of it is permitted and leads into the set.
  bool leads_into(std::int64_t x, const Set& target) const {
    if (plain_.terminal[index_of(x)]) return true;
    bool some = false;
    for (std::int64_t u = 0; u < inputs_; ++u) {
      bool is_chosen = true;
      for (std::size_t c = 0; c < classes_.size(); ++c)
        is_chosen = is_chosen && own_.projection[c][index_of(x)][index_of(classes_[c].action(u))];
      if (!is_chosen) continue;
      some = true;
      if (!plain_.permitted[index_of(x)][index_of(u)] || !posts_.stays_in(x, u, target)) return false;
    }
    return some;
  }

  Set next(const Set& layer) const {
    Set result(index_of(cells_), false);
    for (std::int64_t x = 0; x < cells_; ++x)
      result[index_of(x)] = layer[index_of(x)] && leads_into(x, layer);
    return result;
  }

  /// Where the task is over nobody has to choose.
  bool counts_in_fibre(std::int64_t x, const Set& layer) const {
    return layer[index_of(x)] && !plain_.terminal[index_of(x)];
  }

  /// B_1 from Z_1.
  void take_common_cells(Set& left) const {
    for (std::size_t c = 0; c < classes_.size(); ++c) {
      const auto actions = index_of(classes_[c].actions());
      std::vector<std::vector<std::int64_t>> counts(sights_[c].fibres, std::vector<std::int64_t>(actions, 0));
      for (std::int64_t x = 0; x < cells_; ++x) {
        for (std::size_t a = 0; counts_in_fibre(x, left) && a < actions; ++a)
          counts[sights_[c].fibre(x)][a] += own_.projection[c][index_of(x)][a] ? 1 : 0;
      }
      for (std::int64_t x = 0; x < cells_; ++x) {
        const std::vector<std::int64_t>& own = counts[sights_[c].fibre(x)];
        const auto most = static_cast<std::size_t>(std::max_element(own.begin(), own.end()) - own.begin());
        if (counts_in_fibre(x, left) && !own_.projection[c][index_of(x)][most]) left[index_of(x)] = false;
      }
    }
  }

  void find_layers() {
    const std::optional<std::int64_t>& most = spec_.coordination.max_delay;
    layers_ = {plain_.invariant};
    for (std::int64_t k = 0;; ++k) {
      result_.truncated = most && k == *most && size_of(layers_.back()) > 0;
      if (result_.truncated) break;
      Set layer = next(layers_.back());
      if (k == 0) take_common_cells(layer);
      if (layer == layers_.back()) {
        result_.fixed_point_index = static_cast<std::int32_t>(k);
        break;
      }
      layers_.push_back(std::move(layer));
    }
    for (const Set& layer : layers_) result_.sizes.push_back(size_of(layer));
  }

  /// What is said of k steps; so many are the last ones that are known.
  std::int32_t told(std::int64_t k) const {
    const auto last = static_cast<std::int64_t>(layers_.size()) - 1;
    return k >= last && !result_.truncated ? INT32_MAX : static_cast<std::int32_t>(std::min(k, last));
  }

  void find_delays() {
    for (std::int64_t x = 0; x < cells_; ++x) {
      std::int32_t countdown = own_.delay[index_of(x)] < 0 ? own_.delay[index_of(x)] : 0, delay = countdown;
      for (std::size_t k = 0; k < layers_.size() && plain_.invariant[index_of(x)]; ++k) {
        if (layers_[k][index_of(x)]) countdown = told(static_cast<std::int64_t>(k));
        if (!leads_into(x, layers_[k])) continue;
        // Into B_k for ever, or for one step more than k.
        const bool is_last = k + 1 == layers_.size();
        // Only k <= max_delay count, and one more step than these k would be too many.
        const bool is_cut = spec_.coordination.max_delay == static_cast<std::int64_t>(k);
        if (is_last && is_cut) delay = static_cast<std::int32_t>(k);
        if (is_last && !is_cut) delay = told(static_cast<std::int64_t>(k));
        if (!is_last) delay = static_cast<std::int32_t>(k) + 1;
      }
      result_.countdown.push_back(countdown);
      result_.delay.push_back(delay);
    }
  }

  void find_tables() {
    const std::int64_t steps = std::max<std::int64_t>(1, static_cast<std::int64_t>(layers_.size()) - 1);
    for (std::size_t c = 0; c < classes_.size(); ++c) {
      auto& table = result_.silent.emplace_back();
      for (std::int64_t k = 1; k <= steps; ++k) {
        table.emplace_back(sights_[c].fibres, Set(index_of(classes_[c].actions()), false));
        // K is a fixed point with its first layer, or there is no step at all.
        const bool is_known = k < static_cast<std::int64_t>(layers_.size());
        if (is_known || !result_.truncated)
          intersect(c, is_known ? layers_[index_of(k)] : layers_.back(), table.back());
      }
    }
  }

  void intersect(std::size_t c, const Set& layer, std::vector<Set>& rows) const {
    Set is_met(rows.size(), false);
    for (std::int64_t x = 0; x < cells_; ++x) {
      if (!counts_in_fibre(x, layer)) continue;
      const std::size_t fibre = sights_[c].fibre(x);
      for (std::size_t a = 0; a < rows[fibre].size(); ++a) {
        const bool has = own_.projection[c][index_of(x)][a];
        rows[fibre][a] = has && (!is_met[fibre] || rows[fibre][a]);
      }
      is_met[fibre] = true;
    }
  }

  const ProblemSpec& spec_;
  const PlainPosts& posts_;
  const PlainAnalysis& plain_;
  const PlainAnalysis::Partition& own_;
  std::vector<InputClass> classes_;
  std::int64_t cells_;
  std::int64_t inputs_;
  std::vector<PlainSight> sights_;
  std::vector<Set> layers_;
  PlainBlind::Partition result_;
};

}  // namespace

PlainSight::PlainSight(const ProblemSpec& spec, const UniformGrid& grid,
                       const std::vector<std::int32_t>& agents)
    : grid_(grid) {
  for (std::int32_t i = 0; index_of(i) < grid.size(); ++i) {
    const bool is_seen = std::any_of(agents.begin(), agents.end(), [&](std::int32_t agent) {
      const auto& sees = spec.agents[index_of(agent)].sees;
      return !sees || std::count(sees->begin(), sees->end(), i) > 0;
    });
    if (is_seen) seen_.push_back(index_of(i));
    if (is_seen) fibres *= index_of(grid[index_of(i)].count);
  }
}

std::size_t PlainSight::fibre(std::int64_t cell) const {
  std::int64_t number = 0;
  for (const std::size_t i : seen_) number = number * grid_[i].count + grid_.index(cell, i);
  return index_of(number);
}

PlainBlind silence_plainly(const ProblemSpec& spec, const Abstraction& abstraction, const Set& safe,
                           const Set& safe_beyond, const PlainAnalysis& plain) {
  const PlainPosts posts{abstraction, safe, safe_beyond};
  PlainBlind result;
  for (std::size_t p = 0; p < plain.partitions.size(); ++p) {
    const PlainAnalysis::Partition& own = plain.partitions[p];
    if (spec.coordination.partitions[p].classes.size() > 1) {
      result.partitions.push_back(BlindFinder(spec, abstraction, posts, plain, p).run());
    } else {
      result.partitions.push_back(
          {own.delay, own.delay, own.sizes, own.fixed_point_index, own.truncated, {}});
    }
  }
  return result;
}

}  // namespace coordreq
