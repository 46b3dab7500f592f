#include "answers/checking/all_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "answers/checking/answer_check.hpp"
#include "answers/checking/claimed_values.hpp"
#include "answers/checking/class_choices.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using Members = std::vector<std::uint8_t>;

constexpr char kNetworkSafe[] = "/network_safe";

/// Data that all threads read.
struct Network {
  explicit Network(const CheckContext& context) : spec(*context.spec->network) {
    for (const NetworkModeSpec& mode : spec.modes) {
      const auto known = std::find(partitions.begin(), partitions.end(), mode.partition.classes);
      partition_of.push_back(static_cast<std::size_t>(known - partitions.begin()));
      if (known == partitions.end()) partitions.push_back(mode.partition.classes);
    }
    target.assign(spec.modes.size(), Members(static_cast<std::size_t>(context.grid->cells()), 1));
    for (const auto& [from, to] : spec.transitions) {
      Members& members = target[static_cast<std::size_t>(from)];
      const Members& next = context.claims->members(kNetworkSafe, static_cast<std::size_t>(to));
      for (std::size_t x = 0; x < members.size(); ++x) members[x] = members[x] & next[x];
    }
  }

  const NetworkSpec& spec;
  std::vector<std::vector<std::vector<std::int32_t>>> partitions;  ///< the different partitions of the modes
  std::vector<std::size_t> partition_of;                           ///< by mode
  std::vector<Members> target;                                     ///< T(q)
};

class NetworkChecker : public CellChecker {
 public:
  NetworkChecker(const CheckContext& context, const Network& network, Tally& tally)
      : context_(context),
        network_(network),
        tally_(tally),
        claimed_(context.claims->at(kNetworkSafe).members),
        inputs_(static_cast<std::size_t>(context.inputs->count())),
        choices_(network.partitions.size()) {
    for (const auto& partition : network.partitions)
      by_class_.emplace_back(context, partition,
                             ClassChoices::rules_in_mode(network.spec.acts_by_rule, partition));
  }

  void check(CheckedCell& cell) override {
    cell_ = &cell;
    if (cell.is_invariant() && !network_.spec.resynthesise) {
      for (std::size_t p = 0; p < choices_.size(); ++p) {
        by_class_[p].go_to(cell.number(), cell.admitted());
        choices_[p] = by_class_[p].joint();
      }
    }
    for (std::size_t mode = 0; mode < network_.spec.modes.size(); ++mode) {
      const bool claimed = claimed_[mode][cell.at()] != 0;
      tally_.add_checked(1);
      if (!cell.is_invariant()) {
        if (claimed) complain(mode, "safe, but not in K");
      } else if (cell.is_terminal()) {
        if (!claimed) complain(mode, "not safe, but the task is over");
      } else if (network_.spec.resynthesise) {
        if (claimed && !can_take_care(mode))
          doubt(mode, "safe, but agents with robust re-synthesis may leave");
      } else {
        compare(mode, claimed);
      }
    }
  }

 private:
  void compare(std::size_t mode, bool claimed) {
    const std::vector<std::int64_t>& choices = choices_[network_.partition_of[mode]];
    const bool expected =
        !choices.empty() && std::all_of(choices.begin(), choices.end(), [&](std::int64_t u) {
          return !cell_->is_forbidden(u) && is_inside(u, network_.target[mode]);
        });
    if (claimed == expected) return;
    doubt(mode, claimed ? "safe, but agents may leave" : "not safe, but agents cannot leave");
  }

  [[nodiscard]] bool can_take_care(std::size_t mode) {
    const std::vector<std::uint8_t> good = allowed_into(network_.target[mode]);
    ClassChoices& classes = by_class_[network_.partition_of[mode]];
    classes.go_to(cell_->number(), good);
    const std::vector<std::int64_t> mixed = classes.joint();
    return !mixed.empty() && std::all_of(mixed.begin(), mixed.end(), [&good](std::int64_t u) {
      return good[static_cast<std::size_t>(u)] != 0;
    });
  }

  [[nodiscard]] std::vector<std::uint8_t> allowed_into(const Members& set) {
    std::vector<std::uint8_t> result(inputs_, 0);
    for (std::size_t u = 0; u < inputs_; ++u) {
      const auto input = static_cast<std::int64_t>(u);
      result[u] = cell_->is_allowed(input) && is_inside(input, set) ? 1 : 0;
    }
    return result;
  }

  /// empty != f(x, u) subset of the set.
  [[nodiscard]] bool is_inside(std::int64_t u, const Members& set) { return cell_->least(u, set, 0, 1) != 0; }

  /// Counts a claim as open if the posts, and so the choices of agents, may be others than those of the
  /// analysis; else as wrong.
  void doubt(std::size_t mode, const char* what) {
    if (context_.sound_only()) {
      tally_.add_unproven();
    } else {
      complain(mode, what);
    }
  }
  void complain(std::size_t mode, const char* what) {
    const auto modes = static_cast<std::int64_t>(network_.spec.modes.size());
    tally_.add_wrong(cell_->number() * modes + static_cast<std::int64_t>(mode), [&] {
      return fmt::format("{}, mode {}: {}", cell_->location(), network_.spec.modes[mode].name, what);
    });
  }

  const CheckContext& context_;
  const Network& network_;
  Tally& tally_;
  const std::vector<Members>& claimed_;  ///< [mode][cell]
  std::size_t inputs_;
  std::deque<ClassChoices> by_class_;               ///< [partition] by rules, if agents act by them
  std::vector<std::vector<std::int64_t>> choices_;  ///< [partition] IND_C of this cell, or A
  CheckedCell* cell_ = nullptr;                     ///< the cell being checked
};

class NetworkCheck : public AnswerCheck {
 public:
  explicit NetworkCheck(const CheckContext& context)
      : AnswerCheck(CheckSection::modes), context_(context), network_(context) {
    tally_.set_note(network_.spec.resynthesise ? "safe, and perhaps less than what the iteration gives"
                                               : "a fixed point, not compared with others");
  }

  std::vector<Finding> compare_sizes(Comparison& sizes) override {
    const FieldClaims& claims = context_.claims->at(kNetworkSafe);
    for (std::size_t mode = 0; mode < claims.members.size(); ++mode) {
      sizes.expect("cells of mode " + network_.spec.modes[mode].name, claims.cells[mode],
                   count_members(claims.members[mode]));
    }
    return {};
  }
  std::unique_ptr<CellChecker> cell_checker() override {
    return std::make_unique<NetworkChecker>(context_, network_, tally_);
  }
  [[nodiscard]] std::vector<Finding> findings() const override { return {tally_.finding()}; }

 private:
  const CheckContext& context_;
  Network network_;
  Tally tally_{"network"};
};

}  // namespace

/// Bytes a cell: the target T(q) of each mode.
double network_check_memory(const ProblemSpec& spec) {
  return spec.network ? static_cast<double>(spec.network->modes.size()) : 0;
}

/// Checks the claims about single cells in each mode of the network, with values as in check_invariance().
/// With T(q) the intersection of the claimed W(q') over the modes q' that follow q, for every cell x and mode
/// q:
/// - x in W(q) exactly if x in K and every u in IND_C(x) (by rules: A(x), which is not empty) has a post,
/// inside T(q): W is a fixed point. Whether
///   it is the largest is not checked;
/// - `resynthesise`: x in W(q) only if x in K, some allowed u has a post inside T(q), and so has every
///   mixture of such u, which is allowed too. Whether the iteration of the contract ends there is not
///   checked. Either way agents are safe from all claimed cells. Also checks the number of cells of each
///   W(q).
/// @returns null: the spec has no network
std::unique_ptr<AnswerCheck> check_network(const CheckContext& context) {
  if (!context.spec->network) return nullptr;
  return std::make_unique<NetworkCheck>(context);
}

}  // namespace coordreq
