#include "answers/checking/all_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <limits>
#include <utility>

#include "answers/checking/answer_check.hpp"
#include "answers/checking/class_choices.hpp"
#include "answers/step_codes.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

constexpr char kRisk[] = "/risk";
constexpr char kDrawnRisk[] = "/risk_drawn";

/// A mode that may follow, and its probability.
struct Successor {
  std::size_t mode;
  double least;
  double more;  ///< the most that it may have beyond its least
};

/// The modes that may follow a mode.
struct Outgoing {
  std::vector<Successor> successors;
  double rest = 1;  ///< 1 less all of the least
};

std::vector<Outgoing> outgoing_of(const NetworkSpec& network) {
  std::vector<Outgoing> result(network.modes.size());
  std::vector<Rational> rest(network.modes.size(), 1);
  for (std::size_t t = 0; t < network.transitions.size(); ++t) {
    const auto from = static_cast<std::size_t>(network.transitions[t].first);
    const auto to = static_cast<std::size_t>(network.transitions[t].second);
    const ProbabilityRange& range = network.probabilities[t];
    rest[from] -= range.low;
    result[from].successors.push_back(
        {to, nearest_double(range.low), nearest_double(range.high - range.low)});
  }
  for (std::size_t mode = 0; mode < result.size(); ++mode) result[mode].rest = nearest_double(rest[mode]);
  return result;
}

/// The greatest expected risk over the modes that may follow.
double expected(const Outgoing& outgoing, const std::function<double(std::size_t mode)>& risk) {
  double sum = 0;
  std::vector<std::pair<double, double>> more;  // (risk, probability that its mode may have beyond its least)
  for (const Successor& next : outgoing.successors) {
    const double value = risk(next.mode);
    sum += next.least * value;
    more.emplace_back(value, next.more);
  }
  if (outgoing.rest == 0) return sum;
  std::sort(more.begin(), more.end(), std::greater<>());
  double rest = outgoing.rest;
  for (const auto& [value, most] : more) {
    const double given = std::min(most, rest);
    sum += given * value;
    rest -= given;
  }
  return sum;
}

/// The claim if it is a probability, else certainty: claims that are none are reported at their cell.
double as_probability(double claimed) {
  return claimed >= 0 && claimed <= 1 ? claimed : 1;
}

/// The expected risks after a mode, of all cells, as ranks in descending order among the values that occur.
struct Ranked {
  std::vector<double> risks;  ///< descending
  std::vector<std::int32_t> rank;
};

template <class Number>
Ranked rank_expected(const Outgoing& outgoing, const std::vector<std::vector<Number>>& risks) {
  std::vector<double> all(risks.front().size());
  for (std::size_t x = 0; x < all.size(); ++x)
    all[x] = expected(outgoing, [&](std::size_t mode) { return as_probability(risks[mode][x]); });
  Ranked result{.risks = all, .rank = {}};
  std::sort(result.risks.begin(), result.risks.end(), std::greater<>());
  result.risks.erase(std::unique(result.risks.begin(), result.risks.end()), result.risks.end());
  for (const double value : all) {
    const auto found = std::lower_bound(result.risks.begin(), result.risks.end(), value, std::greater<>());
    result.rank.push_back(static_cast<std::int32_t>(found - result.risks.begin()));
  }
  return result;
}

template <class Number>
std::vector<Ranked> rank_all(const std::vector<Outgoing>& outgoing,
                             const std::vector<std::vector<Number>>& risks) {
  std::vector<Ranked> result;
  for (const Outgoing& from : outgoing) result.push_back(rank_expected(from, risks));
  return result;
}

/// One more step at single cells. One object a thread.
class RiskStep {
 public:
  explicit RiskStep(const CheckContext& context) {
    for (const NetworkModeSpec& mode : context.spec->network->modes) {
      is_least_.push_back(context.spec->risk->is_safest && mode.partition.classes.size() == 1);
      const auto known = std::find(partitions_.begin(), partitions_.end(), mode.partition.classes);
      partition_of_.push_back(static_cast<std::size_t>(known - partitions_.begin()));
      if (known != partitions_.end()) continue;
      partitions_.push_back(mode.partition.classes);
      by_class_.emplace_back(
          context, mode.partition.classes,
          ClassChoices::rules_in_mode(context.spec->silence.has_value(), mode.partition.classes));
    }
    choices_.resize(partitions_.size());
  }

  /// Goes to a cell of K.
  void go_to(CheckedCell& cell) {
    cell_ = &cell;
    for (std::size_t p = 0; p < choices_.size(); ++p) {
      by_class_[p].go_to(cell.number(), cell.admitted());
      choices_[p] = by_class_[p].joint();
    }
  }
  /// T of a mode at the cell.
  [[nodiscard]] double risk(std::size_t mode, const Ranked& after) {
    const std::vector<std::int64_t>& choices = choices_[partition_of_[mode]];
    if (choices.empty()) return 1;
    double chosen = is_least_[mode] ? 1 : 0;
    for (const std::int64_t u : choices) {
      const double value = worst(u, after);
      chosen = is_least_[mode] ? std::min(chosen, value) : std::max(chosen, value);
    }
    return chosen;
  }

 private:
  [[nodiscard]] double worst(std::int64_t u, const Ranked& after) {
    constexpr std::int32_t kBlocked = -1;
    if (cell_->is_forbidden(u)) return 1;
    const std::int32_t rank = cell_->least(u, after.rank, kBlocked);
    if (rank == kBlocked) return 1;
    return rank == kUnbounded ? 0 : std::min(1.0, after.risks[static_cast<std::size_t>(rank)]);
  }

  std::vector<bool> is_least_;  ///< [mode]
  std::vector<std::vector<std::vector<std::int32_t>>> partitions_;
  std::vector<std::size_t> partition_of_;  ///< [mode]
  std::deque<ClassChoices> by_class_;      ///< [partition] by rules, if there are some
  CheckedCell* cell_ = nullptr;
  std::vector<std::vector<std::int64_t>> choices_;  ///< [partition]
};

/// Data that all threads read.
struct RiskClaims {
  explicit RiskClaims(const CheckContext& context)
      : spec(*context.spec),
        risks(context.claims->at(kRisk).reals),
        rate(context.claims->number(kRisk, "rate")),
        drawn(spec.risk->is_drawn ? &context.claims->at(kDrawnRisk).reals.front() : nullptr),
        outgoing(outgoing_of(*spec.network)),
        after(rank_all(outgoing, risks)) {
    std::size_t most = 0;
    for (const Outgoing& from : outgoing) most = std::max(most, from.successors.size());
    // An operation is off by at most half of epsilon; there are four for each successor.
    rounding = (4.0 * static_cast<double>(most) + 8) * std::numeric_limits<double>::epsilon();
  }

  const ProblemSpec& spec;
  const std::vector<std::vector<float>>& risks;  ///< [mode][cell]
  double rate;
  const std::vector<float>* drawn;  ///< [cell], null: the mode of the first step is not drawn
  std::vector<Outgoing> outgoing;
  std::vector<Ranked> after;  ///< [mode]
  double rounding = 0;        ///< relative, of one step
};

/// A tally that names what is wrong.
class RiskTally : public Tally {
 public:
  RiskTally(const CheckContext& context, const std::string& check) : Tally(check), context_(context) {}

  void complain(const CheckedCell& cell, std::size_t mode, const std::string& what) {
    const auto modes = static_cast<std::int64_t>(context_.spec->network->modes.size());
    add_wrong(cell.number() * modes + static_cast<std::int64_t>(mode), [&] {
      return fmt::format("{}, mode {}: {}", cell.location(), context_.spec->network->modes[mode].name, what);
    });
  }
  /// Counts a claim as open if posts, and so risks, may be others than those of the analysis; else as wrong.
  void doubt(const CheckedCell& cell, std::size_t mode, const std::string& what) {
    if (context_.sound_only()) {
      add_unproven();
    } else {
      complain(cell, mode, what);
    }
  }

 private:
  const CheckContext& context_;
};

class RiskChecker : public CellChecker {
 public:
  RiskChecker(const CheckContext& context, const RiskClaims& claims, RiskTally& tally)
      : claims_(claims), tally_(tally), step_(context) {}

  void check(CheckedCell& cell) override {
    if (cell.is_invariant()) step_.go_to(cell);
    for (std::size_t mode = 0; mode < claims_.risks.size(); ++mode) {
      const double claimed = double{claims_.risks[mode][cell.at()]};
      tally_.add_checked(1);
      if (!(claimed >= 0 && claimed <= 1)) {
        tally_.complain(cell, mode, "a risk that is no probability");
      } else if (!cell.is_invariant()) {
        if (claimed != 1) tally_.complain(cell, mode, fmt::format("risk {:.3g} outside K", claimed));
      } else if (cell.is_terminal()) {
        if (claimed != 0)
          tally_.complain(cell, mode, fmt::format("risk {:.3g}, but the task is over", claimed));
      } else {
        compare(cell, mode, claimed);
      }
    }
    if (claims_.drawn != nullptr) compare_drawn(cell);
  }

 private:
  /// The risk before the first draw follows from those claimed for the modes. It is rounded up to a float.
  void compare_drawn(const CheckedCell& cell) {
    constexpr double kFraction = 1e-6, kLeast = 1e-40;
    const auto claimed = double{(*claims_.drawn)[cell.at()]};
    const double value = std::min(1.0, expected(claims_.outgoing.front(), [&](std::size_t mode) {
                                    return as_probability(claims_.risks[mode][cell.at()]);
                                  }));
    tally_.add_checked(1);
    if (value * (1 - claims_.rounding) <= claimed && claimed <= value * (1 + kFraction) + kLeast) return;
    tally_.complain(
        cell, 0, fmt::format("risk {:.6g} where the first step is drawn, expected {:.6g}", claimed, value));
  }
  void compare(CheckedCell& cell, std::size_t mode, double claimed) {
    const double next = step_.risk(mode, claims_.after[mode]);
    if (next * (1 - claims_.rounding) <= claimed + claims_.rate) return;
    tally_.doubt(
        cell, mode,
        fmt::format("risk {:.6g}, but one more step gives {:.6g}, which is more than the rate beyond",
                    claimed, next));
  }

  const RiskClaims& claims_;
  RiskTally& tally_;
  RiskStep step_;
};

class RiskCheck : public AnswerCheck {
 public:
  explicit RiskCheck(const CheckContext& context)
      : AnswerCheck(CheckSection::modes),
        context_(context),
        claims_(context),
        tally_(context, "risk"),
        full_tally_(context, "risk within the horizon") {}

  std::unique_ptr<CellChecker> cell_checker() override {
    return std::make_unique<RiskChecker>(context_, claims_, tally_);
  }

  /// Computes V_N in N passes, and compares it.
  void check_all(ThreadTeam& team) override {
    if (!context_.is_full) return;
    std::vector<std::vector<double>> risks = first_risks();
    for (std::int64_t n = 0; n < claims_.spec.risk->horizon; ++n) {
      std::vector<std::vector<double>> next = risks;
      const std::vector<Ranked> after = rank_all(claims_.outgoing, risks);
      for_each_cell(team, [&](CheckedCell& cell, RiskStep& step) {
        if (!cell.is_invariant() || cell.is_terminal()) return;
        step.go_to(cell);
        for (std::size_t mode = 0; mode < next.size(); ++mode)
          next[mode][cell.at()] = step.risk(mode, after[mode]);
      });
      if (next == risks) break;
      risks = std::move(next);
    }
    for_each_cell(team, [&](CheckedCell& cell, RiskStep&) { compare(cell, risks); });
  }

  [[nodiscard]] std::vector<Finding> findings() const override {
    std::vector<Finding> result = {tally_.finding()};
    if (context_.is_full) result.push_back(full_tally_.finding());
    return result;
  }

 private:
  [[nodiscard]] std::vector<std::vector<double>> first_risks() const {
    std::vector<double> first;
    const std::vector<std::uint8_t>& safe = context_.claims->members("/safe");
    const std::vector<std::uint8_t>& invariant = context_.claims->members("/invariant");
    for (std::size_t x = 0; x < invariant.size(); ++x)
      first.push_back(safe[x] != 0 && invariant[x] != 0 ? 0 : 1);
    return std::vector<std::vector<double>>(claims_.risks.size(), first);
  }

  template <class Body>
  void for_each_cell(ThreadTeam& team, const Body& body) {
    team.for_each(context_.grid->cells(), 512, [&](ThreadTeam::Range range, int) {
      CheckedCell cell(context_);
      RiskStep step(context_);
      for (std::int64_t x = range.begin; x < range.end; ++x) {
        cell.go_to(x);
        body(cell, step);
      }
    });
  }

  void compare(const CheckedCell& cell, const std::vector<std::vector<double>>& risks) {
    const double steps = static_cast<double>(claims_.spec.risk->horizon);
    const double rounding = std::min(0.5, steps * claims_.rounding);
    constexpr double kFraction = 1e-3, kLeast = 1e-30;  // the most by which the analysis may round up
    for (std::size_t mode = 0; mode < risks.size(); ++mode) {
      full_tally_.add_checked(1);
      const auto claimed = double{claims_.risks[mode][cell.at()]};
      const double value = risks[mode][cell.at()];
      const bool is_low = claimed < value * (1 - rounding);
      if (!is_low && claimed <= value * (1 + rounding) * (1 + kFraction) + kLeast) continue;
      full_tally_.doubt(cell, mode, fmt::format("risk {:.6g}, expected {:.6g}", claimed, value));
    }
  }

  const CheckContext& context_;
  RiskClaims claims_;
  RiskTally tally_;
  RiskTally full_tally_;
};

}  // namespace

/// Checks the probability to leave K, with posts and arithmetic of its own (doubles, whose roundings are
/// allowed for):
/// - 1 outside K, and for every cell of K and mode T(V) <= V + rate, T being one more step (see find_risk()).
///   As V is nowhere below V_0, and T is monotone and T(v + c) <= T(v) + c, the risk within any n steps is
///   then at most V + n rate;
/// - CheckContext::is_full: V is V_N, computed in N passes over all cells: not below it, and at most 0.1 % +
///   1e-30 above it.
/// @returns null: the spec asks for no risk
std::unique_ptr<AnswerCheck> check_risk(const CheckContext& context) {
  if (!context.spec->risk) return nullptr;
  return std::make_unique<RiskCheck>(context);
}

/// Bytes a cell: ranks and expected risks, for each mode.
double risk_check_memory(const ProblemSpec& spec) {
  if (!spec.risk) return 0;
  // For each mode a rank a cell, and at most as many risks; while ranks are found two lists more. For N
  // passes also the risks before and after a pass.
  const auto modes = static_cast<double>(spec.network->modes.size());
  return modes * (sizeof(std::int32_t) + 2 * sizeof(double)) + 2 * sizeof(double);
}

}  // namespace coordreq
