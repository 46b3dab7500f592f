#include "verify/check_network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "model/input_class.hpp"
#include "verify/allowed_pairs.hpp"
#include "verify/cell_place.hpp"

namespace coordreq {
namespace {

using Members = std::vector<std::uint8_t>;

/// What all threads read.
struct Network {
  explicit Network(const CellCheck& check) : spec(*check.spec->network) {
    for (const NetworkModeSpec& mode : spec.modes) {
      const auto known = std::find(partitions.begin(), partitions.end(), mode.partition.classes);
      partition_of.push_back(static_cast<std::size_t>(known - partitions.begin()));
      if (known == partitions.end()) partitions.push_back(mode.partition.classes);
    }
    target.assign(spec.modes.size(), Members(static_cast<std::size_t>(check.grid->cells()), 1));
    for (const auto& [from, to] : spec.transitions) {
      Members& own = target[static_cast<std::size_t>(from)];
      const Members& next = check.claims->network[static_cast<std::size_t>(to)];
      for (std::size_t x = 0; x < own.size(); ++x) own[x] = own[x] & next[x];
    }
  }

  const NetworkSpec& spec;
  std::vector<std::vector<std::vector<std::int32_t>>> partitions;  ///< different ones
  std::vector<std::size_t> partition_of;                           ///< by mode
  std::vector<Members> target;                                     ///< T(q)
};

/// One object a thread.
class NetworkChecker {
 public:
  NetworkChecker(const CellCheck& check, const Network& network, Tally& tally)
      : check_(check),
        network_(network),
        tally_(tally),
        posts_(*check.posts),
        allowed_(*check.spec, *check.grid, *check.inputs, check.claims->listed),
        inputs_(static_cast<std::size_t>(check.inputs->count())),
        choices_(network.partitions.size()) {
    if (check.tubes != nullptr) tubes_.emplace(*check.tubes);
    for (const auto& partition : network.partitions) {
      auto& classes = classes_.emplace_back();
      for (const auto& agents : partition)
        classes.emplace_back(class_of(*check.spec, *check.inputs, agents)).tabulate();
    }
  }

  void check(std::int64_t cell) {
    cell_ = cell;
    const Members& invariant = check_.claims->invariant;
    const bool stays = invariant[static_cast<std::size_t>(cell)] != 0;
    if (stays) {
      posts_.go_to(cell);
      if (tubes_) tubes_->go_to(cell);
      allowed_.go_to(cell);
      if (!network_.spec.resynthesise) find_choices(invariant);
    }
    for (std::size_t mode = 0; mode < network_.spec.modes.size(); ++mode) {
      const bool claimed = check_.claims->network[mode][static_cast<std::size_t>(cell)] != 0;
      tally_.add_checked(1);
      if (!stays) {
        if (claimed) complain(mode, "safe, but not in K");
      } else if (network_.spec.resynthesise) {
        if (claimed && !can_take_care(mode)) doubt(mode, "safe, but agents that take care may leave");
      } else {
        compare(mode, claimed);
      }
    }
  }

 private:
  void compare(std::size_t mode, bool claimed) {
    const std::vector<std::int64_t>& choices = choices_[network_.partition_of[mode]];
    forget();
    const bool expected =
        !choices.empty() && std::all_of(choices.begin(), choices.end(),
                                        [&](std::int64_t u) { return is_inside(u, network_.target[mode]); });
    if (claimed == expected) return;
    doubt(mode, claimed ? "safe, but agents may leave" : "not safe, but agents cannot leave");
  }

  [[nodiscard]] bool can_take_care(std::size_t mode) {
    const std::vector<std::uint8_t> good = allowed_into(network_.target[mode]);
    const std::vector<std::int64_t> mixed = independent(good, network_.partition_of[mode]);
    return !mixed.empty() && std::all_of(mixed.begin(), mixed.end(), [&good](std::int64_t u) {
      return good[static_cast<std::size_t>(u)] != 0;
    });
  }

  /// IND_C of each partition.
  void find_choices(const Members& invariant) {
    std::vector<std::uint8_t> admitted(inputs_, 0);
    if (check_.spec->controller.synthesis == Synthesis::maximal) {
      admitted = allowed_into(invariant);
    } else {
      for (std::size_t u = 0; u < inputs_; ++u) admitted[u] = allowed_(static_cast<std::int64_t>(u)) ? 1 : 0;
    }
    for (std::size_t p = 0; p < choices_.size(); ++p) choices_[p] = independent(admitted, p);
  }

  [[nodiscard]] std::vector<std::uint8_t> allowed_into(const Members& set) {
    std::vector<std::uint8_t> result(inputs_, 0);
    forget();
    for (std::size_t u = 0; u < inputs_; ++u) {
      const auto input = static_cast<std::int64_t>(u);
      result[u] = allowed_(input) && is_inside(input, set) ? 1 : 0;
    }
    return result;
  }

  /// The joint inputs of which each class's part is that of some of `joint`.
  [[nodiscard]] std::vector<std::int64_t> independent(const std::vector<std::uint8_t>& joint,
                                                      std::size_t partition) const {
    std::vector<std::uint8_t> is_choice(inputs_, 1);
    for (const InputClass& own : classes_[partition]) {
      std::vector<std::uint8_t> projection(static_cast<std::size_t>(own.actions()), 0);
      for (std::size_t u = 0; u < inputs_; ++u)
        projection[static_cast<std::size_t>(own.action(static_cast<std::int64_t>(u)))] |= joint[u];
      for (std::size_t u = 0; u < inputs_; ++u)
        is_choice[u] &= projection[static_cast<std::size_t>(own.action(static_cast<std::int64_t>(u)))];
    }
    std::vector<std::int64_t> result;
    for (std::size_t u = 0; u < inputs_; ++u) {
      if (is_choice[u] != 0) result.push_back(static_cast<std::int64_t>(u));
    }
    return result;
  }

  /// empty != f(x, u) subset of the set; forget() before another set.
  [[nodiscard]] bool is_inside(std::int64_t u, const Members& set) {
    return posts_.least(u, set, 0, 1, memory_) != 0 && (!tubes_ || tubes_->is_safe(u));
  }
  void forget() { memory_.assign(posts_.memory_size(), PostMinima::kNotKnown); }

  /// Where posts are perhaps others, so are the choices of agents.
  void doubt(std::size_t mode, const char* what) {
    if (check_.posts_are == PostsAre::perhaps_others) {
      tally_.add_unproven();
    } else {
      complain(mode, what);
    }
  }
  void complain(std::size_t mode, const char* what) {
    const auto modes = static_cast<std::int64_t>(network_.spec.modes.size());
    tally_.add_wrong(cell_ * modes + static_cast<std::int64_t>(mode), [&] {
      return fmt::format("{}, mode {}: {}", place_of(*check_.grid, cell_), network_.spec.modes[mode].name,
                         what);
    });
  }

  const CellCheck& check_;
  const Network& network_;
  Tally& tally_;
  PostMinima posts_;
  std::optional<CellTubes> tubes_;
  AllowedPairs allowed_;
  std::size_t inputs_;
  std::vector<std::vector<InputClass>> classes_;    ///< [partition]
  std::vector<std::vector<std::int64_t>> choices_;  ///< [partition] IND_C of this cell
  std::vector<std::int32_t> memory_;                ///< of posts_
  std::int64_t cell_ = 0;
};

}  // namespace

Finding check_network(const CellCheck& check, ThreadTeam& team) {
  constexpr std::int64_t kGrain = 256;
  const Network network(check);
  Tally tally("network");
  tally.set_note(network.spec.resynthesise ? "safe, and perhaps less than what the iteration gives"
                                           : "a fixed point, not compared with others");
  std::vector<std::unique_ptr<NetworkChecker>> checkers(static_cast<std::size_t>(team.size()));
  const bool all = check.cells.empty();
  const std::int64_t count = all ? check.grid->cells() : static_cast<std::int64_t>(check.cells.size());
  team.for_each(count, kGrain, [&](ThreadTeam::Range range, int worker) {
    auto& checker = checkers[static_cast<std::size_t>(worker)];
    if (!checker) checker = std::make_unique<NetworkChecker>(check, network, tally);
    for (std::int64_t i = range.begin; i < range.end; ++i)
      checker->check(all ? i : check.cells[static_cast<std::size_t>(i)]);
  });
  return tally.finding();
}

}  // namespace coordreq
