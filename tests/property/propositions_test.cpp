// The paper's propositions on random systems, by walking through the finite abstraction with the choices that
// the results file grants (Kim, Arcak, Seshia, Kim, Shiraishi, SCAV 2018, section 4).

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <optional>

#include "answers/paths.hpp"
#include "answers/step_codes.hpp"
#include "expression/evaluate.hpp"
#include "model/input_class.hpp"
#include "reach/build_abstraction.hpp"
#include "spec/problem_spec.hpp"
#include "support/analysed_file.hpp"
#include "support/draw.hpp"
#include "support/random_problem.hpp"

namespace coordreq {
namespace {

/// The absorbing cell that stands for having left safely.
constexpr std::int64_t kGone = -1;

class World {
 public:
  World(const std::string& text, ThreadTeam& team)
      : file_(analysed_file(storing_everything(text), team)),
        abstraction_(build_abstraction(file_.spec, team)) {}

  [[nodiscard]] const Claims& claims() const { return file_.claims; }
  [[nodiscard]] std::int64_t cells() const { return abstraction_.grid.cells(); }
  [[nodiscard]] const CoordinationSpec& coordination() const { return file_.spec.coordination; }

  /// Every cell that can be next; nothing if the pair is blocked.
  [[nodiscard]] std::optional<std::vector<std::int64_t>> post(std::int64_t x, std::int64_t u) const {
    std::vector<std::int64_t> cells = {0};
    bool left = false;
    for (std::size_t i = 0; i < abstraction_.grid.size(); ++i) {
      const GridDimension& dimension = abstraction_.grid[i];
      const IndexRange raw = abstraction_.raw(i, x, u);
      const ResolvedRange range = abstraction_.resolved(i, x, u);
      if (range.blocked) return std::nullopt;
      left = left || (raw.first < 0 && dimension.below == Outside::safe) ||
             (raw.last >= dimension.count && dimension.above == Outside::safe);
      std::vector<std::int64_t> next;
      for (const std::int64_t cell : cells) {
        for (std::int64_t k = range.inside.first; k <= range.inside.last; ++k)
          next.push_back(cell + k % dimension.count * abstraction_.grid.stride(i));
      }
      cells = next;
    }
    if (left) cells.push_back(kGone);
    return cells;
  }

  /// Whether `allow` forbids the pair.
  [[nodiscard]] bool forbids(std::int64_t x, std::int64_t u) const {
    if (!file_.spec.controller.allow) return false;
    std::vector<RationalInterval> point(file_.spec.slot_count());
    const auto put = [&point](std::size_t slot, const Rational& value) {
      point[slot] = {.lower = value, .upper = value};
    };
    const UniformGrid& grid = abstraction_.grid;
    const InputSpace& inputs = abstraction_.inputs;
    for (std::size_t i = 0; i < grid.size(); ++i) put(i, grid[i].point(grid.index(x, i)));
    for (std::size_t j = 0; j < inputs.size(); ++j)
      put(grid.size() + j, inputs[j].values[static_cast<std::size_t>(inputs.index(u, j))]);
    return Evaluator<RationalInterval>(*file_.spec.controller.allow).condition(point) != Truth::yes;
  }

  /// C(x), or IND_C(x) of a partition.
  [[nodiscard]] std::vector<std::int64_t> choices(std::int64_t x,
                                                  std::optional<std::size_t> partition) const {
    std::vector<std::int64_t> result;
    for (std::int64_t u = 0; u < abstraction_.inputs.count(); ++u) {
      if (partition ? independent(x, u, *partition)
                    : bit(*claims().bits("/controller"), x, u, abstraction_.inputs.count()))
        result.push_back(u);
    }
    return result;
  }

 private:
  static bool bit(const std::vector<std::uint8_t>& bytes, std::int64_t x, std::int64_t a,
                  std::int64_t count) {
    return (bytes[static_cast<std::size_t>(x * ((count + 7) / 8) + a / 8)] >> (a % 8) & 1) != 0;
  }

  [[nodiscard]] bool independent(std::int64_t x, std::int64_t u, std::size_t p) const {
    const PartitionSpec& partition = coordination().partitions[p];
    for (std::size_t c = 0; c < partition.classes.size(); ++c) {
      const InputClass actions = class_of(file_.spec, abstraction_.inputs, partition.classes[c]);
      const std::int64_t action = actions.action(u);
      const std::string path = paths::actions(file_.spec, partition, c);
      if (!bit(*claims().bits(path), x, action, actions.actions())) return false;
    }
    return true;
  }

  ClaimedFile file_;
  Abstraction abstraction_;
};

/// A cell of K, if there is one.
std::optional<std::int64_t> draw_invariant(const World& world) {
  std::vector<std::int64_t> cells;
  for (std::int64_t x = 0; x < world.cells(); ++x) {
    if (world.claims().members("/invariant")[static_cast<std::size_t>(x)] != 0) cells.push_back(x);
  }
  if (cells.empty()) return std::nullopt;
  return pick(cells);
}

std::size_t draw_partition(const World& world) {
  return static_cast<std::size_t>(draw(0, static_cast<int>(world.coordination().partitions.size()) - 1));
}

TEST(Propositions, AStateOfDelayKSurvivesKStepsOfAnyChoices) {
  ThreadTeam team(1);
  EXPECT_TRUE(rc::check("k steps of IND_C stay in K", [&] {
    const World world(draw_problem(), team);
    const std::size_t p = draw_partition(world);
    const std::optional<std::int64_t> start = draw_invariant(world);
    RC_PRE(start.has_value());
    for (int run = 0; run < 20; ++run) {
      std::int64_t x = *start;
      const std::int32_t delay = world.claims().values("/delay", p)[static_cast<std::size_t>(x)];
      for (std::int32_t step = 0; step < std::min(delay, 25) && x != kGone; ++step) {
        const std::vector<std::int64_t> choices = world.choices(x, p);
        RC_ASSERT(!choices.empty());
        const auto next = world.post(x, pick(choices));
        RC_ASSERT((next.has_value() && !next->empty()));
        x = pick(*next);
        RC_ASSERT((x == kGone || world.claims().members("/invariant")[static_cast<std::size_t>(x)] != 0));
      }
    }
  }));
}

TEST(Propositions, AStateThatLeavesTheLayersHasAChoiceThatLeavesItsOwn) {
  ThreadTeam team(1);
  EXPECT_TRUE(rc::check("x in T(k), k < F: some post is not inside Z_k", [&] {
    const World world(draw_problem(), team);
    const std::size_t p = draw_partition(world);
    const std::vector<std::int32_t>& delay = world.claims().values("/delay", p);
    const bool is_truncated = world.claims().at("/fixed_point_index").integers[p] < 0;
    for (std::int64_t x = 0; x < world.cells(); ++x) {
      const std::int32_t k = delay[static_cast<std::size_t>(x)];
      if (k < 0 || k == kUnbounded || (is_truncated && k == *world.coordination().max_delay)) continue;
      const auto leaves = [&](std::int64_t u) {
        const auto next = world.post(x, u);
        const auto outside = [&](std::int64_t y) {
          return y != kGone && delay[static_cast<std::size_t>(y)] < k;
        };
        return !next || world.forbids(x, u) || std::any_of(next->begin(), next->end(), outside);
      };
      const std::vector<std::int64_t> choices = world.choices(x, p);
      RC_ASSERT((choices.empty() || std::any_of(choices.begin(), choices.end(), leaves)));
    }
  }));
}

/// Definition 3: count down, choose alone until 0, then coordinate one step and begin again.
TEST(Propositions, NoSelfTriggeredRunFromKLeavesS) {
  ThreadTeam team(1);
  EXPECT_TRUE(rc::check("self-triggered runs stay in S", [&] {
    const World world(draw_problem(), team);
    const std::size_t p = draw_partition(world);
    const std::vector<std::int32_t>& delay = world.claims().values("/delay", p);
    const std::optional<std::int64_t> start = draw_invariant(world);
    RC_PRE(start.has_value());
    std::int64_t x = *start;
    std::int32_t countdown = delay[static_cast<std::size_t>(x)];
    int coordinated = 0;
    for (int step = 0; step < 100 && x != kGone; ++step) {
      const bool alone = countdown > 0;
      coordinated += alone ? 0 : 1;
      const std::vector<std::int64_t> choices = world.choices(x, alone ? std::optional(p) : std::nullopt);
      RC_ASSERT(!choices.empty());
      const auto next = world.post(x, pick(choices));
      RC_ASSERT((next.has_value() && !next->empty()));
      x = pick(*next);
      if (x == kGone) break;
      RC_ASSERT(world.claims().members("/safe")[static_cast<std::size_t>(x)] != 0);
      if (!alone) {
        countdown = delay[static_cast<std::size_t>(x)];
      } else if (countdown != kUnbounded) {
        --countdown;
      }
    }
    RC_CLASSIFY(coordinated > 0, "coordinated at times");
  }));
}

}  // namespace
}  // namespace coordreq
