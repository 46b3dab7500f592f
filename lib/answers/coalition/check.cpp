#include "answers/checking/all_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "answers/checking/answer_check.hpp"
#include "answers/checking/cell_location.hpp"
#include "answers/step_codes.hpp"
#include "base/index.hpp"
#include "spec/partition_names.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// The class of each agent.
std::vector<std::size_t> class_of_agents(const PartitionSpec& partition, std::size_t agents) {
  std::vector<std::size_t> result(agents);
  for (std::size_t c = 0; c < partition.classes.size(); ++c) {
    for (const std::int32_t agent : partition.classes[c]) result[at(agent)] = c;
  }
  return result;
}

/// The cost of the links that Kruskal's algorithm takes: inside classes, cheaper ones first, where they join
/// components.
Rational cost_of(const std::vector<std::size_t>& class_of, const std::vector<LinkCostSpec>& listed) {
  std::vector<std::tuple<Rational, std::size_t, std::size_t>> links;
  for (std::size_t a = 0; a < class_of.size(); ++a) {
    for (std::size_t b = a + 1; b < class_of.size(); ++b) {
      if (class_of[a] != class_of[b]) continue;
      const auto link = std::find_if(listed.begin(), listed.end(), [&](const LinkCostSpec& one) {
        return at(one.first) == a && at(one.second) == b;
      });
      links.emplace_back(link == listed.end() ? Rational(1) : link->cost, a, b);
    }
  }
  std::sort(links.begin(), links.end());
  std::vector<std::size_t> joined(class_of.size());
  std::iota(joined.begin(), joined.end(), std::size_t{0});
  Rational total = 0;
  for (const auto& [cost, a, b] : links) {
    const std::size_t from = joined[b];
    const std::size_t to = joined[a];
    if (from == to) continue;
    std::replace(joined.begin(), joined.end(), from, to);
    total += cost;
  }
  return total;
}

/// A partition with the properties by which partitions are compared.
struct Candidate {
  Rational cost;
  std::size_t largest_class = 0;
  std::string name;
  std::vector<std::uint8_t> together;  ///< [pair]

  [[nodiscard]] bool is_before(const Candidate& other) const {
    if (cost != other.cost) return cost < other.cost;
    return std::tie(largest_class, name) < std::tie(other.largest_class, other.name);
  }
};

Candidate candidate_of(const PartitionSpec& partition, std::size_t agents,
                       const std::vector<LinkCostSpec>& listed) {
  const std::vector<std::size_t> class_of = class_of_agents(partition, agents);
  Candidate result{.cost = cost_of(class_of, listed), .name = partition.name};
  for (const auto& members : partition.classes)
    result.largest_class = std::max(result.largest_class, members.size());
  for (std::size_t a = 0; a < agents; ++a) {
    for (std::size_t b = a + 1; b < agents; ++b)
      result.together.push_back(class_of[a] == class_of[b] ? 1 : 0);
  }
  return result;
}

class CoalitionCheck : public AnswerCheck {
 public:
  explicit CoalitionCheck(const CheckContext& context)
      : AnswerCheck(CheckSection::costs),
        grid_(*context.grid),
        safe_(context.claims->members("/safe")),
        invariant_(context.claims->members("/invariant")),
        delay_(context.claims->at("/delay").values),
        choice_(context.claims->at("/coalition")),
        chosen_(choice_.values.front()),
        horizon_(*context.spec->coordination.horizon) {
    const ProblemSpec& spec = *context.spec;
    for (const PartitionSpec& partition : spec.coordination.partitions)
      candidates_.push_back(candidate_of(partition, spec.agents.size(), spec.coordination.link_cost));
    rank();
    for (std::int32_t a = 0; at(a) < spec.agents.size(); ++a) {
      for (std::int32_t b = a + 1; at(b) < spec.agents.size(); ++b)
        pair_names_.push_back(class_name(spec.agents, {a, b}));
    }
    if (!pair_names_.empty()) critical_ = &context.claims->at("/critical_pair");
  }

  void check_all(ThreadTeam& team) override {
    constexpr std::int64_t kGrain = 4096;
    team.for_each(grid_.cells(), kGrain, [&](ThreadTeam::Range range, int) {
      for (std::int64_t cell = range.begin; cell < range.end; ++cell) check(cell);
    });
    check_sizes();
  }
  [[nodiscard]] std::vector<Finding> findings() const override {
    return {coalition_.finding(), pairs_.finding()};
  }

 private:
  /// Finds ranks to compare at each cell instead of costs, since rationals are slow to compare.
  void rank() {
    std::vector<std::size_t> order(candidates_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return candidates_[a].is_before(candidates_[b]); });
    rank_.resize(order.size());
    cost_rank_.resize(order.size());
    std::size_t costs = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (i > 0 && candidates_[order[i]].cost != candidates_[order[i - 1]].cost) ++costs;
      rank_[order[i]] = i;
      cost_rank_[order[i]] = costs;
    }
  }

  /// The value that the map must have at a cell.
  [[nodiscard]] std::int32_t cheapest_at(std::size_t x) const {
    if (safe_[x] == 0) return kOutsideSafe;
    if (invariant_[x] == 0) return kOutsideInvariant;
    std::int32_t best = kNoPartitionSuffices;
    for (std::size_t p = 0; p < rank_.size(); ++p) {
      if (delay_[p][x] < horizon_) continue;
      if (best == kNoPartitionSuffices || rank_[p] < rank_[at(best)]) best = static_cast<std::int32_t>(p);
    }
    return best;
  }

  void check(std::int64_t cell) {
    const auto x = static_cast<std::size_t>(cell);
    const std::int32_t expected = cheapest_at(x);
    coalition_.add_checked(1);
    if (chosen_[x] != expected) {
      coalition_.add_wrong(cell, [&] {
        return fmt::format("{}: {}, expected {}", location_of(grid_, cell), choice_text(chosen_[x]),
                           choice_text(expected));
      });
    }
    check_pairs(cell, expected);
  }

  void check_pairs(std::int64_t cell, std::int32_t cheapest) {
    const auto x = static_cast<std::size_t>(cell);
    for (std::size_t pair = 0; pair < critical_pairs().members.size(); ++pair) {
      bool critical = cheapest >= 0;
      for (std::size_t p = 0; p < rank_.size() && critical; ++p) {
        const bool counts = cost_rank_[p] == cost_rank_[at(cheapest)] && delay_[p][x] >= horizon_;
        critical = !counts || candidates_[p].together[pair] != 0;
      }
      pairs_.add_checked(1);
      if ((critical_pairs().members[pair][x] != 0) == critical) continue;
      pairs_.add_wrong(cell, [&] {
        return fmt::format("{}: {} is {}critical", location_of(grid_, cell), pair_names_[pair],
                           critical ? "" : "not ");
      });
    }
  }

  void check_sizes() {
    expect_size(coalition_, "numbers in cells", length(choice_.cells), counted(candidates_.size()));
    expect_size(pairs_, "numbers in cells", length(critical_pairs().cells), counted(pair_names_.size()));
    for (std::size_t p = 0; p < choice_.cells.size(); ++p) {
      const auto actual = std::count(chosen_.begin(), chosen_.end(), static_cast<std::int32_t>(p));
      expect_size(coalition_, "cells of " + candidates_[p].name, static_cast<std::int64_t>(choice_.cells[p]),
                  actual);
    }
    for (std::size_t pair = 0; pair < critical_pairs().cells.size(); ++pair) {
      const auto actual =
          std::count(critical_pairs().members[pair].begin(), critical_pairs().members[pair].end(), 1);
      expect_size(pairs_, "cells of " + pair_names_[pair],
                  static_cast<std::int64_t>(critical_pairs().cells[pair]), actual);
    }
  }

  /// [pair] The critical cells; empty if there are no pairs.
  [[nodiscard]] const FieldClaims& critical_pairs() const {
    static const FieldClaims nothing;
    return critical_ == nullptr ? nothing : *critical_;
  }

  /// The length of the attribute `cells` of so many values.
  static std::int64_t counted(std::size_t values) {
    constexpr std::size_t kMostCounted = 4096;
    return values <= kMostCounted ? static_cast<std::int64_t>(values) : 0;
  }

  static std::int64_t length(const std::vector<std::uint64_t>& counts) {
    return static_cast<std::int64_t>(counts.size());
  }

  void expect_size(Tally& tally, const std::string& what, std::int64_t claimed, std::int64_t actual) const {
    tally.add_checked(1);
    if (claimed == actual) return;
    tally.add_wrong(grid_.cells() + static_cast<std::int64_t>(choice_.cells.size()),
                    [&] { return fmt::format("{}: {}, expected {}", what, claimed, actual); });
  }

  [[nodiscard]] std::string choice_text(std::int32_t value) const {
    if (value == kNoPartitionSuffices) return "no partition";
    if (value == kOutsideSafe) return "not safe";
    return value == kOutsideInvariant ? "not invariant" : candidates_[at(value)].name;
  }

  const UniformGrid& grid_;
  const std::vector<std::uint8_t>& safe_;
  const std::vector<std::uint8_t>& invariant_;
  const std::vector<std::vector<std::int32_t>>& delay_;  ///< [partition][cell]
  const FieldClaims& choice_;
  const std::vector<std::int32_t>& chosen_;  ///< [cell] index of a partition, or a value that means a word
  const FieldClaims* critical_ = nullptr;    ///< null: there are no pairs
  std::vector<std::string> pair_names_;
  std::int64_t horizon_;
  std::vector<Candidate> candidates_;   ///< by partition
  std::vector<std::size_t> rank_;       ///< [partition] place in the order of preference
  std::vector<std::size_t> cost_rank_;  ///< [partition] its rank by cost alone
  Tally coalition_{"coalition"};
  Tally pairs_{"critical pairs"};
};

}  // namespace

/// Checks the coalitions in a file against its delays, which check_layers() checks: for each cell the
/// partitions whose delay reaches the horizon are compared by the cost of their cheapest network (Kruskal's
/// algorithm), then by their largest class and name, and each pair of agents is looked for in all partitions
/// of least cost. Also checks the sizes in the file.
/// @returns null: the spec has no horizon
std::unique_ptr<AnswerCheck> check_coalition(const CheckContext& context) {
  if (!context.spec->coordination.horizon) return nullptr;
  return std::make_unique<CoalitionCheck>(context);
}

}  // namespace coordreq
