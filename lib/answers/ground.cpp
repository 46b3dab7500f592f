#include "answers/ground.hpp"

#include <numeric>
#include <utility>

#include "answers/answers.hpp"
#include "engine/join_rows.hpp"
#include "engine/layout.hpp"
#include "engine/safe_set.hpp"
#include "engine/safe_tubes.hpp"
#include "reach/build_abstraction.hpp"
#include "reach/serialise_abstraction.hpp"

namespace coordreq {
namespace {

/// Where each state of the spec stands in the grid.
std::vector<std::size_t> place_of_states(const std::vector<std::size_t>& layout) {
  std::vector<std::size_t> place(layout.size());
  for (std::size_t d = 0; d < layout.size(); ++d) place[layout[d]] = d;
  return place;
}

/// What is kept of it is the grid without joined rows, which are found anew.
void find_abstraction(Ground& ground, const StageWork& work) {
  ground.layout = choose_layout(ground.spec);
  ground.engine_spec = laid_out(ground.spec, ground.layout);
  std::optional<Abstraction>& abstraction = ground.abstraction;
  const auto load = [&](Archive& archive) {
    abstraction = Abstraction{.grid = make_grid(ground.engine_spec), .inputs = make_input_space(ground.engine_spec)};
    serialise(archive, ground.engine_spec, *abstraction);
  };
  const bool is_kept = work.store != nullptr && work.store->take(load) == StageStore::Kept::finished;
  if (!is_kept) abstraction = build_abstraction(ground.engine_spec, work.team);
  if (!is_read_by_runs(ground.spec)) abstraction->grid = join_rows(*abstraction);
  if (work.store == nullptr) return;
  work.store->finish(
      [&ground](Archive& archive) { serialise(archive, ground.engine_spec, *ground.abstraction); });
}

}  // namespace

Ground::Ground(const ProblemSpec& problem) : spec(problem), layout(problem.states.size()) {
  std::iota(layout.begin(), layout.end(), std::size_t{0});
}

SafeTubes Ground::tubes() const {
  if (abstraction->tubes.empty()) return {};
  return {&safe, beyond ? &*beyond : nullptr};
}

std::vector<Stage> ground_stages() {
  return {{"abstraction", [](Answers& answers, const StageWork& work) { find_abstraction(answers.ground, work); }},
          {"safe set", [](Answers& answers, const StageWork& work) { lay_ground(answers.ground, work.team); }}};
}

void lay_ground(Ground& ground, ThreadTeam& team) {
  const Abstraction& abstraction = *ground.abstraction;
  ground.safe = safe_set(ground.engine_spec, abstraction, team);
  ground.allow =
      allow_table(ground.engine_spec, abstraction, team, ground.listed ? &ground.listed->pairs : nullptr);
  ground.beyond = safe_beyond_limits(ground.engine_spec, abstraction, ground.safe, team);
  ground.engine.emplace(abstraction, ground.allow ? &*ground.allow : nullptr, ground.tubes());
  ground.hull.emplace(*ground.engine);
  ground.order.emplace(abstraction.grid, place_of_states(ground.layout));
}

}  // namespace coordreq
