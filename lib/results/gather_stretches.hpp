#pragma once

#include <cstdint>
#include <vector>

#include "answers/field.hpp"
#include "base/thread_team.hpp"
#include "ranks/ranks.hpp"
#include "results/element_owners.hpp"

namespace coordreq {

/// Elements of an array that one of several processes is to have, whoever knows them.
struct GatheredStretch {
  int taker = 0;
  std::uint64_t begin = 0;
  std::uint64_t count = 0;
  Bytes bytes = {};
};

/// Together: every process sends what it knows of stretches to those who take them, and has the bytes of
/// those that it takes, in their order; the others are removed.
void gather_stretches(Ranks& ranks, ThreadTeam& team, const ElementOwners& owners, const ResultArray& array,
                      std::vector<GatheredStretch>& stretches);

}  // namespace coordreq
