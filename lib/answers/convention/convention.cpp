#include "answers/convention/convention.hpp"

#include <algorithm>

namespace coordreq {

std::vector<std::vector<bool>> convention_at(const std::vector<bool>& admissible,
                                             const std::vector<InputClass>& agents) {
  std::vector<std::vector<bool>> sets;
  sets.reserve(agents.size());
  for (const InputClass& agent : agents) sets.emplace_back(static_cast<std::size_t>(agent.actions()), false);
  const auto seed = std::find(admissible.begin(), admissible.end(), true) - admissible.begin();
  if (seed == static_cast<std::ptrdiff_t>(admissible.size())) return sets;
  const auto action_of = [&](std::size_t i, std::size_t u) {
    return static_cast<std::size_t>(agents[i].action(static_cast<std::int64_t>(u)));
  };
  for (std::size_t i = 0; i < agents.size(); ++i)
    sets[i][action_of(i, static_cast<std::size_t>(seed))] = true;
  for (std::size_t i = 0; i < agents.size(); ++i) {
    std::vector<bool> kept(sets[i].size(), true);
    for (std::size_t u = 0; u < admissible.size(); ++u) {
      if (admissible[u]) continue;
      bool others = true;
      for (std::size_t j = 0; others && j < agents.size(); ++j) others = j == i || sets[j][action_of(j, u)];
      if (others) kept[action_of(i, u)] = false;
    }
    sets[i] = std::move(kept);
  }
  return sets;
}

}  // namespace coordreq
