#include "support/plain_risk.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include "spec/problem_spec.hpp"
#include "support/plain_posts.hpp"

namespace coordreq {
namespace {

std::size_t place_of(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

/// Adds the cells of a box.
void add_cells(const UniformGrid& grid, const std::vector<IndexRange>& box, std::size_t i, std::int64_t cell,
               std::vector<std::int64_t>& cells) {
  if (i == box.size()) return cells.push_back(cell);
  for (std::int64_t k = box[i].first; k <= box[i].last; ++k)
    add_cells(grid, box, i + 1, cell + k % grid[i].count * grid.stride(i), cells);
}

/// The joint inputs of which each class's part is that of some of C.
std::vector<bool> independent(const std::vector<bool>& controller, const ProblemSpec& spec,
                              const InputSpace& inputs, const PartitionSpec& partition) {
  std::vector<bool> result(controller.size(), true);
  for (const auto& agents : partition.classes) {
    const auto action = [&](std::size_t u) {
      std::vector<std::int64_t> values;
      for (const std::int32_t agent : agents) {
        for (const std::int32_t i : spec.agents[place_of(agent)].inputs)
          values.push_back(inputs.index(static_cast<std::int64_t>(u), place_of(i)));
      }
      return values;
    };
    std::set<std::vector<std::int64_t>> actions;
    for (std::size_t u = 0; u < controller.size(); ++u) {
      if (controller[u]) actions.insert(action(u));
    }
    for (std::size_t u = 0; u < controller.size(); ++u) result[u] = result[u] && actions.contains(action(u));
  }
  return result;
}

}  // namespace

PlainRisk::PlainRisk(const ProblemSpec& spec, const Abstraction& abstraction, const std::vector<bool>& safe,
                     const std::vector<bool>& safe_beyond, const PlainAnalysis& plain)
    : plain_(plain), successors_(spec.network->modes.size()) {
  const PlainPosts plainly{abstraction, safe, safe_beyond};
  const UniformGrid& grid = abstraction.grid;
  for (std::int64_t x = 0; x < grid.cells(); ++x) {
    auto& own = posts_.emplace_back();
    for (std::int64_t u = 0; u < abstraction.inputs.count(); ++u) {
      Post& post = own.emplace_back();
      bool has_left = false;
      std::vector<IndexRange> box;
      for (std::size_t i = 0; i < grid.size(); ++i) {
        const ResolvedRange range = abstraction.resolved(i, x, u);
        post.is_blocked = post.is_blocked || range.blocked;
        has_left = has_left || range.all_left();
        box.push_back(range.inside);
      }
      post.is_blocked = post.is_blocked || !plain.permitted[place_of(x)][place_of(u)] ||
                        (!abstraction.tubes.empty() && !plainly.has_safe_tube(x, u));
      if (!post.is_blocked && !has_left) add_cells(grid, box, 0, 0, post.cells);
    }
  }
  for (const NetworkModeSpec& mode : spec.network->modes) {
    is_one_.push_back(mode.partition.classes.size() == 1);
    auto& own = choices_.emplace_back();
    for (const std::vector<bool>& controller : plain.controller)
      own.push_back(independent(controller, spec, abstraction.inputs, mode.partition));
  }
  for (std::size_t t = 0; t < spec.network->transitions.size(); ++t) {
    const auto& [from, to] = spec.network->transitions[t];
    const ProbabilityRange& range = spec.network->probabilities[t];
    successors_[place_of(from)].push_back({place_of(to), range.low, range.high});
  }
}

PlainRisks PlainRisk::first() const {
  PlainRisks risks(successors_.size());
  for (auto& own : risks) {
    for (const bool is_invariant : plain_.invariant) own.emplace_back(is_invariant ? 0 : 1);
  }
  return risks;
}

/// The greatest of what each order of the modes gives that have as much as they may, one after the other.
Rational PlainRisk::expected(const PlainRisks& risks, std::size_t mode, std::int64_t cell) const {
  const std::vector<Successor>& next = successors_[mode];
  std::vector<std::size_t> order(next.size());
  std::iota(order.begin(), order.end(), 0);
  Rational greatest = -1;
  do {
    Rational rest = 1;
    for (const Successor& one : next) rest -= one.low;
    Rational sum = 0;
    for (const std::size_t i : order) {
      const Rational more = std::min(Rational(next[i].high - next[i].low), rest);
      rest -= more;
      sum += (next[i].low + more) * risks[next[i].mode][place_of(cell)];
    }
    greatest = std::max(greatest, sum);
  } while (std::next_permutation(order.begin(), order.end()));
  return greatest;
}

PlainRisks PlainRisk::next(const PlainRisks& risks, bool is_safest) const {
  PlainRisks result = first();
  for (std::size_t mode = 0; mode < successors_.size(); ++mode) {
    std::vector<Rational> expected_risk;
    for (std::size_t y = 0; y < posts_.size(); ++y)
      expected_risk.push_back(expected(risks, mode, static_cast<std::int64_t>(y)));
    for (std::size_t x = 0; x < posts_.size(); ++x) {
      if (!plain_.invariant[x] || plain_.terminal[x]) continue;
      const bool is_least = is_safest && is_one_[mode];
      Rational chosen = is_least ? 1 : 0;
      bool some = false;
      for (std::size_t u = 0; u < posts_[x].size(); ++u) {
        if (!choices_[mode][x][u]) continue;
        some = true;
        const Post& post = posts_[x][u];
        Rational worst = post.is_blocked ? 1 : 0;
        for (const std::int64_t y : post.cells) worst = std::max(worst, expected_risk[place_of(y)]);
        chosen = is_least ? std::min(chosen, worst) : std::max(chosen, worst);
      }
      result[mode][x] = some ? chosen : Rational(1);
    }
  }
  return result;
}

}  // namespace coordreq
