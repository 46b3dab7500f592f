#include "answers/ground.hpp"

#include "answers/invariance/safe_set.hpp"
#include "answers/invariance/safe_tubes.hpp"

namespace coordreq {

TubeSets Ground::tubes() const {
  if (abstraction->tubes.empty()) return {};
  return {&safe, beyond ? &*beyond : nullptr};
}

void lay_ground(Ground& ground, ThreadTeam& team) {
  const Abstraction& abstraction = *ground.abstraction;
  ground.safe = safe_set(ground.spec, abstraction, team);
  ground.allow = allow_table(ground.spec, abstraction, team, ground.listed ? &ground.listed->pairs : nullptr);
  ground.beyond = safe_beyond_limits(ground.spec, abstraction, ground.safe, team);
  ground.engine.emplace(abstraction, ground.allow ? &*ground.allow : nullptr, ground.tubes());
  ground.hull.emplace(*ground.engine);
  ground.tiles = Tiles::find(*ground.engine, *ground.hull, ground.safe);
  ground.order.emplace(abstraction.grid);
}

}  // namespace coordreq
